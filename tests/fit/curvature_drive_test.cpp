#include "keyline/fit/curvature_drive.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "keyline/curve/jet.h"
#include "keyline/curve/monotone.h"
#include "keyline/fit/curvature_target.h"
#include "keyline/numeric/random.h"

namespace keyline::fit {
namespace {

using core::Point2;
using core::Vector2;
using curve::PiecewiseBezier;

/// Quintics whose edges turn left all the way; lengths from `length(piece, edge)`.
template <class Length>
PiecewiseBezier turning_chain(int pieces, const Length& length) {
  PiecewiseBezier chain;
  Point2 p{1, 2};
  double angle = 0.3;
  double last = 0;
  for (int i = 0; i < pieces; ++i) {
    curve::Bezier2 piece{{p}, {}};
    double a1 = 0;
    for (int n = 0; n < 5; ++n) {
      double a = length(i, n);
      if (n == 0) a1 = a;
      // the curvature of the joint from this side: 0.8 a2 sin / a1²
      if (i > 0 && n == 1) a = last * a1 * a1 / (0.8 * std::sin(0.12));
      p = p + a * Vector2{std::cos(angle), std::sin(angle)};
      piece.control.push_back(p);
      if (n < 4) angle += 0.12;
      if (n == 4)
        last = 0.8 * core::distance(piece.control[4], piece.control[3]) * std::sin(0.12) / (a * a);
    }
    chain.pieces.push_back(piece);
  }
  return chain;
}

std::vector<CurvatureTarget> curvatures(const PiecewiseBezier& chain, int n) {
  std::vector<CurvatureTarget> targets;
  for (int i = 0; i < n; ++i) {
    const double t = (i + 0.5) / n;
    targets.push_back({t, curvature(jet(chain, t))});
  }
  return targets;
}

double rms(const std::vector<CurvatureTarget>& targets) {
  double sum = 0;
  for (const auto& t : targets) sum += t.curvature * t.curvature;
  return std::sqrt(sum / static_cast<double>(targets.size()));
}

TEST(CurvatureDrive, MeetsTargetsOfTheSameDirections) {
  numeric::Random random(5);
  for (int pieces = 1; pieces <= 6; ++pieces) {
    SCOPED_TRACE(pieces);
    const PiecewiseBezier wanted =
        turning_chain(pieces, [&](int, int) { return random.uniform(0.8, 1.3); });
    const PiecewiseBezier start = turning_chain(pieces, [](int, int) { return 1.0; });
    const auto targets = curvatures(wanted, 24 * pieces);
    const auto result = drive_curvature(start, targets);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_TRUE(result->converged);
    EXPECT_LT(result->after, 1e-3 * rms(targets));
    EXPECT_LT(result->after, 1e-6 * result->before);
    for (std::size_t i = 0; i < wanted.pieces.size(); ++i)
      for (std::size_t k = 0; k < 6; ++k)
        EXPECT_LT(core::distance(result->chain.pieces[i].control[k], wanted.pieces[i].control[k]),
                  1e-4);
  }
}

TEST(CurvatureDrive, KeepsJointsAndTheHeldEnd) {
  const PiecewiseBezier start = turning_chain(3, [](int, int) { return 1.0; });
  auto targets = curvatures(start, 60);
  for (auto& t : targets) t.curvature *= 1 + 0.2 * std::sin(5 * t.t);
  for (const bool hold : {false, true}) {
    const auto result = drive_curvature(start, targets, {.hold_end = hold});
    ASSERT_TRUE(result);
    EXPECT_LT(result->after, result->before);
    const auto& pieces = result->chain.pieces;
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
      EXPECT_EQ(pieces[i].control[5], pieces[i + 1].control[0]);
      EXPECT_NEAR(curvature(jet(pieces[i], 1)), curvature(jet(pieces[i + 1], 0)), 1e-10);
    }
    EXPECT_EQ(pieces[0].control[0], start.pieces[0].control[0]);
    EXPECT_EQ(result->end_moved < 1e-9, hold) << result->end_moved;
  }
}

/// Curvature that no lengths have: the least squares go on falling while an edge goes to nothing.
TEST(CurvatureDrive, LeavesEveryEdgeALength) {
  const PiecewiseBezier s{{{{{0, 0}, {1, 1}, {2, 1}, {3, -1}, {4, -1}, {5, 0}}, {}}}, 0};
  auto targets = curvatures(s, 40);
  for (auto& t : targets) t.curvature = t.t < 0.5 ? 100 : 0;
  const auto result = drive_curvature(s, targets);
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->notes.empty());
  for (const curve::Bezier2& piece : result->chain.pieces)
    for (std::size_t k = 1; k < piece.control.size(); ++k) {
      const double length = core::distance(piece.control[k - 1], piece.control[k]);
      EXPECT_GT(length, 1e-3);
      EXPECT_LT(length, 1e3);
    }
}

TEST(CurvatureDrive, SplitsAtInflectionsFirst) {
  const PiecewiseBezier s{{{{{0, 0}, {1, 1}, {2, 1}, {3, -1}, {4, -1}, {5, 0}}, {}}}, 0};
  auto targets = curvatures(s, 40);
  for (auto& t : targets) t.curvature *= 0.8;
  const auto result = drive_curvature(s, targets);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->chain.pieces.size(), 2U);
  EXPECT_LT(result->after, 0.6 * result->before);
}

bool all_monotone(const PiecewiseBezier& chain) {
  return std::ranges::all_of(chain.pieces, [](const curve::Bezier2& piece) {
    return certify_monotone_curvature(piece).answer == curve::MonotoneVerdict::yes;
  });
}

/// Edges that turn by one angle and grow by one ratio: a curve of monotone curvature.
PiecewiseBezier growing(double ratio) {
  return turning_chain(1, [ratio](int, int n) { return std::pow(ratio, n); });
}

TEST(CurvatureDrive, KeepsMonotonePiecesMonotone) {
  const PiecewiseBezier start = growing(1.1);
  ASSERT_TRUE(all_monotone(start));
  auto targets = curvatures(start, 24);
  for (auto& t : targets) t.curvature *= 1 + 0.5 * std::sin(20 * t.t);
  const auto free = drive_curvature(start, targets);
  const auto kept = drive_curvature(start, targets, {.keep_monotone = true});
  ASSERT_TRUE(free && kept);
  EXPECT_FALSE(all_monotone(free->chain));
  EXPECT_TRUE(all_monotone(kept->chain));
  EXPECT_LT(free->after, kept->after);
  EXPECT_LT(kept->after, kept->before);
}

TEST(CurvatureDrive, GoesAsFarAsMonotonePiecesStayMonotone) {
  const PiecewiseBezier start = growing(1.1);
  const auto all = drive_curvature(start, curvatures(growing(1.15), 24), {.keep_monotone = true});
  ASSERT_TRUE(all);
  EXPECT_EQ(all->share, 1);
  EXPECT_TRUE(all->notes.empty());
  EXPECT_LT(all->after, 1e-6 * all->before);
  // Where they do not all the way, a 512th farther is too far.
  const auto part = [&](double share) {
    auto targets = curvatures(start, 24);
    for (auto& t : targets) t.curvature *= 1 + share * 0.5 * std::sin(20 * t.t);
    return targets;
  };
  const auto kept = drive_curvature(start, part(1), {.keep_monotone = true});
  ASSERT_TRUE(kept);
  EXPECT_GT(kept->share, 0);
  EXPECT_LT(kept->share, 1);
  EXPECT_EQ(kept->notes.size(), 1u);
  const auto there = drive_curvature(start, part(kept->share));
  const auto beyond = drive_curvature(start, part(kept->share + 1.0 / 512));
  ASSERT_TRUE(there && beyond);
  EXPECT_FALSE(all_monotone(beyond->chain));
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_LT(core::distance(there->chain.pieces[0].control[k], kept->chain.pieces[0].control[k]),
              1e-9);
  }
}

/// Farthest of many places of one chain from the other: the nearest of its places, then thirds of
/// the parameter's interval.
double farthest(const PiecewiseBezier& from, const PiecewiseBezier& to) {
  constexpr int kPlaces = 200;
  double most = 0;
  for (int i = 0; i <= kPlaces; ++i) {
    const Point2 p = evaluate(from, static_cast<double>(i) / kPlaces);
    const auto off = [&](double t) {
      return core::distance(p, evaluate(to, std::clamp(t, 0.0, 1.0)));
    };
    int best = 0;
    for (int k = 1; k <= kPlaces; ++k)
      if (off(k / double{kPlaces}) < off(best / double{kPlaces})) best = k;
    double low = (best - 1.0) / kPlaces, high = (best + 1.0) / kPlaces;
    for (int k = 0; k < 60; ++k) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (off(a) < off(b) ? high : low) = off(a) < off(b) ? b : a;
    }
    most = std::max(most, std::min(off(0.5 * (low + high)), off(best / double{kPlaces})));
  }
  return most;
}

// Nearly straight stretches say nothing about their length: without a bound curves drift away.
TEST(CurvatureDrive, StaysWithinTheLargestDeviation) {
  PiecewiseBezier start =
      turning_chain(4, [](int i, int n) { return (n == 2 ? 1.3 : 1) + 0.2 * i; });
  for (curve::Bezier2& piece : start.pieces)
    for (Point2& p : piece.control) p = {p.x, 0.1 * p.y};
  const auto target = smooth_target(start, false);
  double last = HUGE_VAL;
  for (const double most : {0.01, 0.05, 0.2}) {
    SCOPED_TRACE(most);
    const auto result = drive_curvature(start, target, {.hold_end = true, .max_deviation = most});
    ASSERT_TRUE(result);
    EXPECT_LE(result->moved, most);
    EXPECT_LE(farthest(result->chain, start), result->moved);
    EXPECT_LE(farthest(start, result->chain), result->moved);
    EXPECT_LT(result->after, result->before);
    EXPECT_LE(result->after, last * 1.05) << "more room, nearer";
    last = result->after;
  }
}

/// Turns left with a curvature that grows or falls unevenly.
PiecewiseBezier random_chain(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double wave = 0.3 * unit(random);
  const double phase = 6 * unit(random);
  return turning_chain(2 + static_cast<int>(random() % 3), [&](int i, int n) {
    return 1 + 0.15 * i + wave * std::sin(phase + 2.0 * n + i) + 0.05 * unit(random);
  });
}

// The distance was taken at quarters of pieces along the normals: 0.0082 told, 0.0118 true.
TEST(CurvatureDrive, ItsDistanceIsABound) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int n = 0; n < 12; ++n) {
    SCOPED_TRACE(n);
    const PiecewiseBezier start = random_chain(random);
    const double most = std::pow(10, -3 + 2 * unit(random));
    const auto result = drive_curvature(start, smooth_target(start, false),
                                        {.hold_end = true, .max_deviation = most});
    ASSERT_TRUE(result);
    EXPECT_LE(result->moved, most);
    EXPECT_LE(farthest(result->chain, start), result->moved + 1e-12);
    EXPECT_LE(farthest(start, result->chain), result->moved + 1e-12);
  }
}

// Judged with a slack a thousand times the certificate's, a piece certified "yes" came back "no".
TEST(CurvatureDrive, WhatIsCertifiedMonotoneStaysCertified) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(0, 1);
  int certified = 0;
  for (int n = 0; n < 20; ++n) {
    const double growth = 1.03 + 0.12 * unit(random);  // Class A while edges turn by less
    const PiecewiseBezier start =
        turning_chain(2, [&](int i, int k) { return std::pow(growth, 5 * i + k); });
    const auto kept =
        drive_curvature(start, rhythm_target(start, false).places, {.keep_monotone = true});
    ASSERT_TRUE(kept);
    ASSERT_EQ(kept->chain.pieces.size(), start.pieces.size());
    for (std::size_t i = 0; i < start.pieces.size(); ++i) {
      using curve::MonotoneVerdict;
      if (certify_monotone_curvature(start.pieces[i]).answer != MonotoneVerdict::yes) continue;
      ++certified;
      EXPECT_EQ(certify_monotone_curvature(kept->chain.pieces[i]).answer, MonotoneVerdict::yes);
    }
  }
  EXPECT_GT(certified, 5);
}

TEST(CurvatureDrive, HoldsPlaceAndCurvatureWhereTheCurveGoesOn) {
  const PiecewiseBezier start = turning_chain(4, [](int, int) { return 1.0; });
  auto targets = curvatures(start, 96);
  for (auto& t : targets) t.curvature *= 1 + 0.2 * std::sin(5 * t.t);
  const auto result = drive_curvature(start, targets, {.hold_end = true, .hold_curvature = true});
  ASSERT_TRUE(result);
  EXPECT_LT(result->after, result->before);
  for (const double t : {0.0, 1.0}) {
    EXPECT_LT(core::distance(evaluate(result->chain, t), evaluate(start, t)), 1e-9);
    EXPECT_NEAR(curvature(jet(result->chain, t)), curvature(jet(start, t)), 1e-9);
  }
}

TEST(CurvatureDrive, RefusesWhatItCannotTake) {
  const PiecewiseBezier start = turning_chain(1, [](int, int) { return 1.0; });
  const auto targets = curvatures(start, 10);
  const auto code = [](const auto& result) {
    return result ? core::ErrorCode::internal : result.error().code;
  };
  EXPECT_EQ(code(drive_curvature({}, targets)), core::ErrorCode::bad_input);
  EXPECT_EQ(code(drive_curvature(start, {{0.5, 1}})), core::ErrorCode::bad_input);
  EXPECT_EQ(code(drive_curvature(start, {{0.5, 1}, {1.5, 1}})), core::ErrorCode::bad_input);
  EXPECT_EQ(code(drive_curvature(start, {{0.5, 1}, {0.5, 2}})), core::ErrorCode::bad_input);
  PiecewiseBezier gap = start;
  gap.pieces.push_back(start.pieces[0]);
  EXPECT_EQ(code(drive_curvature(gap, targets)), core::ErrorCode::bad_input);
  PiecewiseBezier stuck = start;
  stuck.pieces[0].control[2] = stuck.pieces[0].control[1];
  EXPECT_EQ(code(drive_curvature(stuck, targets)), core::ErrorCode::bad_input);
  const PiecewiseBezier line{{{{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}, {}}}, 0};
  EXPECT_EQ(code(drive_curvature(line, targets, {.hold_end = true})), core::ErrorCode::undrawable);
}

TEST(CurvatureTarget, SmoothingTakesWavesOutAndKeepsTrends) {
  const PiecewiseBezier chain =
      turning_chain(8, [](int i, int n) { return (1 + 0.04 * i) * (n == 2 ? 1.25 : 1.0); });
  const auto now = curvatures(chain, 8 * 24);
  const auto smooth = smooth_target(chain, false);
  const auto wiggle = [](const std::vector<CurvatureTarget>& k) {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < k.size(); ++i)
      sum += std::abs(k[i - 1].curvature - 2 * k[i].curvature + k[i + 1].curvature);
    return sum;
  };
  EXPECT_LT(wiggle(smooth), 0.1 * wiggle(now));
  const auto driven = drive_curvature(chain, smooth, {.hold_end = true});
  ASSERT_TRUE(driven);
  EXPECT_LT(driven->after, 0.5 * driven->before);
}

/// Quintics along a curve of length 4 whose curvature grows evenly from 0.1 to 0.5.
PiecewiseBezier clothoid() {
  PiecewiseBezier chain;
  constexpr int kPieces = 4;
  const auto place = [](double s) {
    Point2 p;
    constexpr int kSteps = 4000;
    for (int i = 0; i < kSteps; ++i) {
      const double u = s * (i + 0.5) / kSteps;
      const double angle = 0.1 * u + 0.05 * u * u;
      p = p + (s / kSteps) * Vector2{std::cos(angle), std::sin(angle)};
    }
    return p;
  };
  for (int k = 0; k < kPieces; ++k) {
    const double s0 = 4.0 * k / kPieces;
    const double s1 = 4.0 * (k + 1) / kPieces;
    const double h = (s1 - s0) / 5;
    const auto tangent = [](double s) {
      const double angle = 0.1 * s + 0.05 * s * s;
      return Vector2{std::cos(angle), std::sin(angle)};
    };
    const Point2 p = place(s0);
    const Point2 q = place(s1);
    const Vector2 t0 = tangent(s0);
    const Vector2 t1 = tangent(s1);
    const double k0 = 0.1 + 0.1 * s0;
    const double k1 = 0.1 + 0.1 * s1;
    chain.pieces.push_back(
        {{p, p + h * t0, p + (2 * h) * t0 + (1.25 * k0 * h * h) * core::perpendicular_left(t0),
          q - (2 * h) * t1 + (1.25 * k1 * h * h) * core::perpendicular_left(t1), q - h * t1, q},
         {}});
  }
  return chain;
}

/// Largest distance of the targets' curvatures from what a share of the length is to have.
template <class Wanted>
double worst_target(const RhythmTarget& target, Wanted wanted) {
  double worst = 0;
  for (const CurvatureTarget& t : target.places)
    worst = std::max(worst, std::abs(t.curvature - wanted(t.t)));
  return worst;
}

TEST(CurvatureTarget, RhythmOfAClothoidIsItsOwn) {
  const RhythmTarget target = rhythm_target(clothoid(), false);
  EXPECT_LT(worst_target(target, [](double v) { return 0.1 + 0.4 * v; }), 0.01);
}

// Closed forms of the general formula: slope 0 is the geometric mean of curvatures, and of a
// clothoid the nearest accelerating curve is itself, the nearest decelerating one that of slope
// 0.5.
TEST(CurvatureTarget, GivesAClothoidWhatRhythmIsWanted) {
  const PiecewiseBezier chain = clothoid();
  EXPECT_LT(worst_target(rhythm_target(chain, false, WantedRhythm::accelerating),
                         [](double v) { return 0.1 + 0.4 * v; }),
            0.01);
  EXPECT_LT(worst_target(rhythm_target(chain, false, WantedRhythm::stable),
                         [](double v) { return 0.1 * std::pow(5, v); }),
            0.01);
  const auto half = [](double v) {
    return std::pow((1 - v) / std::sqrt(0.1) + v / std::sqrt(0.5), -2);
  };
  EXPECT_LT(worst_target(rhythm_target(chain, false, WantedRhythm::decelerating), half), 0.01);
}

TEST(CurvatureTarget, StretchesFromAStraightPlaceKeepANegativeSlope) {
  // an S: its curvature goes through 0 once
  PiecewiseBezier chain;
  chain.pieces.push_back({{{0, 0}, {1, 0.1}, {2, 0.6}, {3, 1.0}, {4, 1.5}, {5, 1.6}}, {}});
  EXPECT_EQ(rhythm_target(chain, false, WantedRhythm::accelerating).straight_ended, 0U);
  EXPECT_EQ(rhythm_target(chain, false).straight_ended, 0U);
  EXPECT_GE(rhythm_target(chain, false, WantedRhythm::stable).straight_ended, 2U);
}

}  // namespace
}  // namespace keyline::fit
