#include "keyline/lac/hermite/chord_kernel.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/lac/hermite/chord_search.h"
#include "keyline/lac/segment/segment.h"

/// Chords of unit arms, and the search for one of a given angle.
namespace keyline::lac::detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The piece of length 1 that turns by theta between curvatures e^q apart, heavy end first.
Piece heavy_first(double alpha, double theta, double q) {
  const double k0 = alpha < 0 ? std::exp(q) : 1, k1 = alpha < 0 ? 1 : std::exp(q);
  const double turns = total_turning(Piece{alpha, 1, k0, k1});
  return {alpha, 1, k0 * theta / turns, k1 * theta / turns};
}

TEST(ChordValue, IsThePiecesDisplacement) {
  for (const double alpha : {-3.0, -1.0, -0.2, 0.0, 0.5, 1.0, 2.5})
    for (const double theta : {0.1, 2.0, 5.5})
      for (const double q : {1e-3, 0.7, 6.0}) {
        const ChordValue v = chord_value(decays_of(alpha), theta, q);
        const core::Vector2 meant = displacement(heavy_first(alpha, theta, q), 1);
        EXPECT_NEAR(v.chord.x, meant.x, 2e-14) << alpha << ' ' << theta << ' ' << q;
        EXPECT_NEAR(v.chord.y, meant.y, 2e-14) << alpha << ' ' << theta << ' ' << q;
      }
}

TEST(ChordValue, SlopeIsItsDifference) {
  for (const double alpha : {-3.0, -0.2, 0.0, 0.5, 1.0, 2.5})
    for (const double theta : {0.5, 4.0})
      for (const double q : {0.0, 0.5, 5.0}) {
        constexpr double h = 1e-4;
        const auto chord = [&](double at) {
          // Before 0 the ends have changed places: the other way round.
          const Piece p = heavy_first(alpha, theta, at);
          return displacement(p, 1);
        };
        const core::Vector2 by = (chord(q + h) - chord(q - h)) / (2 * h);
        const ChordValue v = chord_value(decays_of(alpha), theta, q);
        EXPECT_NEAR(v.slope.x, by.x, 1e-8) << alpha << ' ' << theta << ' ' << q;
        EXPECT_NEAR(v.slope.y, by.y, 1e-8) << alpha << ' ' << theta << ' ' << q;
      }
}

// Where all the turning lies next to the light end the chord is straight but for that.
TEST(ChordValue, TurnsLateForSlopesFromZeroToOne) {
  for (const double alpha : {0.1, 0.3, 0.7}) {
    const Decays d = decays_of(alpha);
    const double q = 601 / -d.b;
    const ChordValue late = chord_value(d, 2, q);
    const ChordValue before = chord_value(d, 2, 599 / -d.b);
    EXPECT_NEAR(late.chord.x, before.chord.x, 1e-13);
    EXPECT_NEAR(late.chord.y, before.chord.y, 1e-13);
  }
  // Of slope 0 lengths go as q itself, so that a share of 1 / q is still to be seen.
  const ChordValue one = chord_value(decays_of(0), 2, 650), two = chord_value(decays_of(0), 2, 550);
  EXPECT_NEAR((1 - one.chord.x) * 650, (1 - two.chord.x) * 550, 1e-11);
  EXPECT_NEAR(one.chord.y * 650, two.chord.y * 550, 1e-11);
  EXPECT_NEAR(one.slope.y, -one.chord.y / 650, 1e-15);
}

TEST(CircleSlope, IsItsFormulaAndItsSeries) {
  for (const double theta : {0.0999, 0.1001, 1.0, 6.0}) {
    const double h = theta / 2;
    EXPECT_NEAR(circle_slope(theta), (1 - h / std::tan(h)) / theta, 1e-12);
  }
  EXPECT_NEAR(circle_slope(1e-6), 1e-6 / 12, 1e-20);
}

TEST(Decays, AreOfArcAndAngle) {
  const auto is = [](double alpha, double a, double b, double k) {
    const Decays d = decays_of(alpha);
    EXPECT_EQ(d.a, a);
    EXPECT_EQ(d.b, b);
    EXPECT_EQ(d.k, k);
  };
  is(-2, 2, 3, 2);
  is(0.25, 0.25, -0.75, 0.25);
  is(0.75, 0.75, -0.25, 0.25);
  is(3, 3, 2, 2);
}

// Chord angles of pieces are found again: from their start in the direction of growing radius.
TEST(SolveChordAngle, FindsTheRangeOfAPiece) {
  for (const double alpha : {-3.0, -1.0, -0.2, 0.0, 0.5, 1.0, 2.5})
    for (const double theta : {0.05, 1.0, 3.0, 5.0})
      for (const double q : {0.01, 0.5, 3.0}) {
        const Piece piece = heavy_first(alpha, theta, q);
        core::Vector2 chord = displacement(piece, 1);
        double psi = std::atan2(chord.y, chord.x);
        if (psi < 0) psi += 2 * std::numbers::pi;
        if (alpha >= 0) psi = theta - psi;  // heavy end: where the radius is larger
        const ChordSolution s = solve_chord_angle(alpha, theta, psi);
        ASSERT_EQ(s.status, ChordStatus::solved) << alpha << ' ' << theta << ' ' << q;
        EXPECT_NEAR(s.range, q, 1e-9 * (1 + 1 / (theta * q))) << alpha << ' ' << theta << ' ' << q;
        EXPECT_NEAR(s.chord_length, std::hypot(chord.x, chord.y), 1e-10);
      }
}

TEST(SolveChordAngle, SaysWhatLiesOutside) {
  const double limit = limit_chord_angle(-1, 1);
  EXPECT_EQ(solve_chord_angle(-1, 1, limit + 1e-9).status, ChordStatus::beyond_region);
  EXPECT_EQ(solve_chord_angle(-1, 1, limit).range, kInfinity);
  EXPECT_EQ(solve_chord_angle(-1, 1, limit - 1e-6).status, ChordStatus::solved);
  EXPECT_EQ(solve_chord_angle(0.5, 1, 1).status, ChordStatus::beyond_region);
  EXPECT_EQ(solve_chord_angle(0.5, 1, 1 - 1e-200).status, ChordStatus::beyond_region);
  // A circle, the least there is.
  const ChordSolution circle = solve_chord_angle(-1, 2, 1);
  EXPECT_EQ(circle.range, 0);
  EXPECT_NEAR(circle.chord_length, std::sin(1), 1e-15);
}

// ---- The search by itself, on functions that are known ------------------------------------

SearchSetup setup() {
  SearchSetup s;
  s.limit_drawn = true;
  return s;
}

/// 1 - e^{-q} less what is wanted.
ChordSample towards(double q, double wanted) {
  const double left = std::isinf(q) ? 0 : std::exp(-q);
  return {q, 1 - left - wanted, left, 1, 0};
}

TEST(SearchChord, FindsTheRootOfAnExponential) {
  for (const double wanted : {1e-6, 0.3, 0.9, 1 - 1e-9})
    for (const double guess : {1e-3, 1.0, 30.0}) {
      SearchSetup s = setup();
      s.guess = guess;
      const auto found = search_chord(s, [&](double q) { return towards(q, wanted); });
      EXPECT_EQ(found.status, ChordStatus::solved);
      EXPECT_NEAR(found.range, -std::log1p(-wanted), 1e-6) << wanted << ' ' << guess;
    }
  const auto beyond = search_chord(setup(), [](double q) { return towards(q, 1.1); });
  EXPECT_EQ(beyond.status, ChordStatus::beyond_region);
  SearchSetup open = setup();
  open.limit_drawn = false;
  open.inside = true;
  EXPECT_EQ(search_chord(open, [](double q) { return towards(q, 1.1); }).status,
            ChordStatus::beyond_precision);
}

TEST(SearchChord, NewtonsStepIsExactForExponentials) {
  const SearchSetup s = setup();
  for (const double q : {0.1, 1.0, 3.0})
    EXPECT_NEAR(q + newton_step(s, towards(q, 0.6)), -std::log(0.4), 1e-13);
  EXPECT_EQ(newton_step(s, towards(0.1, 1.5)), kInfinity);
  EXPECT_EQ(newton_step(s, {1, 0.5, -1, 1, 0}), -kInfinity);
  EXPECT_EQ(newton_step(s, {1, -0.5, 0, 1, 0}), kInfinity);
}

TEST(SearchChord, SecantIsExactInItsVariable) {
  SearchSetup s = setup();
  EXPECT_TRUE(is_resolved(s));
  EXPECT_NEAR(secant(s, towards(0.2, 0.6), towards(3, 0.6)), -std::log(0.4), 1e-13);
  EXPECT_NEAR(secant(s, towards(0.2, 0.6), towards(kInfinity, 0.6)), -std::log(0.4), 1e-13);
  s.k = 1e-3;
  EXPECT_FALSE(is_resolved(s));
  const auto sample = [](double q) { return ChordSample{q, 0.6 - 1 / (1 + q), 0, 1, 0}; };
  EXPECT_NEAR(secant(s, sample(0.1), sample(5)), 1 / 0.6 - 1, 1e-13);
}

TEST(SearchChord, BracketsAreHalvedOrTheirLogarithm) {
  EXPECT_EQ(middle_of(1, 3), 2);
  EXPECT_EQ(middle_of(0, 1000), 500);
  EXPECT_NEAR(middle_of(3, 399999), std::sqrt(4 * 400000.0) - 1, 1e-9);
}

}  // namespace
}  // namespace keyline::lac::detail
