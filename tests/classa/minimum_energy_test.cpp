#include "keyline/classa/minimum_energy.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "keyline/classa/strain_energy.h"
#include "keyline/core/angle.h"
#include "keyline/numeric/random.h"

namespace keyline::classa {
namespace {

using core::kPi;
using core::Vector2;

/// Least energy on a dense grid of the plane, each (alpha, s) with the longest first edge that
/// still ends within the tolerance: nothing in common with the search but Eq. 7.
double grid_minimum(const EnergyConditions& c, int steps) {
  const double chord = norm(c.chord);
  const double offset = core::angle_between(c.tangent, c.chord);
  const bool left = c.left.value_or(offset >= 0);
  double least = HUGE_VAL;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const double alpha = at(c.alpha, i / static_cast<double>(steps));
      const double edge = c.branch == Branch::growing ? 1 / std::cos(alpha) : std::cos(alpha);
      const double u = j / static_cast<double>(steps);
      const double s = c.branch == Branch::growing ? edge * std::exp(u * u * 3) : edge * (1 - u);
      if (!contains(c.s, s) || s <= 0) continue;
      const Vector2 reach = end_in_frame({alpha, s}, c.degree);
      const double off = core::direction_of(reach) - (left ? offset : -offset);
      const double across = chord * std::sin(off);
      if (std::cos(off) <= 0 || std::abs(across) > c.end_tolerance) continue;
      const double length =
          chord * std::cos(off) + std::sqrt(c.end_tolerance * c.end_tolerance - across * across);
      least = std::min(least, matrix_energy({alpha, s}, c.degree).value * norm(reach) / length);
    }
  }
  return least;
}

void expect_meets(const EnergyMinimum& m, const EnergyConditions& c) {
  EXPECT_LE(norm(m.chord - c.chord), c.end_tolerance + 1e-12 * norm(c.chord));
  const ControlMatrix matrix{m.left ? m.alpha : -m.alpha, m.s};
  const MatrixCurve made{{0, 0}, c.tangent, m.beta, matrix, c.degree};
  const auto end = to_bezier(made).control.back();
  EXPECT_LE(norm(Vector2{end.x, end.y} - m.chord), 1e-12 * norm(c.chord));
  EXPECT_NEAR(strain_energy(made), m.energy, 1e-11 * m.energy);
  EXPECT_TRUE(is_class_a(matrix, 1e-12));
  EXPECT_TRUE(contains(c.s, m.s));
  EXPECT_LE(m.alpha, c.alpha.high);
}

TEST(MinimumEnergy, NoWorseThanADenseGrid) {
  numeric::Random random(2015);
  const int steps = std::getenv("KEYLINE_FULL") ? 1000 : 200;
  int feasible = 0;
  for (int i = 0; feasible < 200; ++i) {
    ASSERT_LT(i, 1000);
    EnergyConditions c;
    c.degree = 2 + static_cast<int>(random.index(7));
    const bool falling = random.chance(0.25);
    c.branch = falling ? Branch::falling : Branch::growing;
    const double given = random.uniform(0.02, 1.0);
    const double s = falling ? std::cos(given) * random.uniform(0.4, 1.05)
                             : random.uniform(0.95, 2.5) / std::cos(given);
    const Vector2 reach = end_in_frame({given, s}, c.degree);
    c.tangent = random.uniform(0.1, 10) * core::unit_vector(random.uniform(-3, 3));
    const double turn = core::direction_of(c.tangent);
    c.chord = random.uniform(0.2, 5) * core::rotate_ccw(reach, turn);
    if (random.chance(0.5)) c.left = true;
    c.end_tolerance = norm(c.chord) * (random.chance(0.3) ? 1e-3 : random.uniform(0.005, 0.2));
    if (random.chance(0.2)) c.alpha = {random.uniform(0, 0.3), random.uniform(0.5, 1.2)};
    if (random.chance(0.2)) c.s = {random.uniform(0.1, 1), random.uniform(1.2, 3)};
    const double grid = grid_minimum(c, steps);
    const auto minimum = minimum_energy(c);
    if (!minimum) {
      EXPECT_EQ(grid, HUGE_VAL) << i << " " << minimum.error().message;
      continue;
    }
    ++feasible;
    EXPECT_LE(minimum->energy, grid * (1 + 1e-12) + 1e-15)
        << i << " degree " << c.degree << " at " << minimum->alpha << ", " << minimum->s;
    expect_meets(*minimum, c);
  }
}

/// With the end held exactly one freedom is left: compare with a fine scan along it.
TEST(MinimumEnergy, ExactEnd) {
  numeric::Random random(3);
  for (int i = 0; i < 60; ++i) {
    EnergyConditions c;
    c.degree = 2 + static_cast<int>(random.index(6));
    const double given = random.uniform(0.05, 1.0);
    const ControlMatrix m{given, random.uniform(1, 2.5) / std::cos(given)};
    c.chord = end_in_frame(m, c.degree);
    c.left = true;
    const auto minimum = minimum_energy(c);
    ASSERT_TRUE(minimum) << minimum.error().message;
    expect_meets(*minimum, c);
    EXPECT_LE(minimum->energy, matrix_energy(m, c.degree).value * (1 + 1e-12));
    const double angle = end_angle(m, c.degree);
    for (int k = 1; k < 4000; ++k) {
      const double alpha = c.alpha.high * k / 4000;
      const double s = scale_at_end_angle(alpha, angle, c.degree, {1 / std::cos(alpha), 100});
      const Vector2 reach = end_in_frame({alpha, s}, c.degree);
      if (std::abs(end_angle({alpha, s}, c.degree) - angle) > 1e-9) continue;
      const double energy = matrix_energy({alpha, s}, c.degree).value * norm(reach);
      EXPECT_LE(minimum->energy, energy / norm(c.chord) * (1 + 1e-12)) << alpha;
    }
  }
}

/// Minima inside the region, both rates of the energy 0 there: alpha, s and energy with 25 digits
/// (tests/classa/energy_minima.py). Not along the edge, where golden section finds them.
TEST(MinimumEnergy, MeetsMinimaOfHighPrecision) {
  struct Case {
    int degree;
    double offset, slack, alpha, s, energy;
  };
  for (const Case& c : {
           Case{6, 0.48, 0.12, 0.1160486489295118, 1.240914218939864, 0.3946906494230953},
           Case{7, 1.51, 0.23, 0.3669198464196878, 1.157242022443382, 3.896042380724366},
           Case{4, 1.33, 0.15, 0.6533798373266173, 1.288557388880866, 3.450873037782011},
           Case{2, 0.66, 0.26, 0.6363186756705933, 1.691418102976892, 0.4774142377917016},
           Case{8, 0.65, 0.1, 0.1273406072318221, 1.177755078037703, 0.8996990839580629},
       }) {
    SCOPED_TRACE(c.degree);
    const auto m = minimum_energy({.chord = {std::cos(c.offset), std::sin(c.offset)},
                                   .degree = c.degree,
                                   .end_tolerance = c.slack});
    ASSERT_TRUE(m) << m.error().message;
    EXPECT_NEAR(m->alpha, c.alpha, 1e-10);
    EXPECT_NEAR(m->s, c.s, 1e-10);
    EXPECT_NEAR(m->energy, c.energy, 1e-13 * c.energy);
  }
}

TEST(MinimumEnergy, IsItsOwnMinimum) {
  EnergyConditions c{.tangent = {1, 2}, .chord = {-1, 5}, .degree = 5};
  const auto once = minimum_energy(c);
  ASSERT_TRUE(once);
  c.chord = once->chord;
  const auto twice = minimum_energy(c);
  ASSERT_TRUE(twice);
  EXPECT_NEAR(twice->alpha, once->alpha, 1e-7);
  EXPECT_NEAR(twice->s, once->s, 1e-7);
}

TEST(MinimumEnergy, SaysWhenNothingIsFeasible) {
  EnergyConditions c{.chord = {0.1, 1}, .degree = 2, .alpha = {0, 0.4}};
  const auto none = minimum_energy(c);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, core::ErrorCode::undrawable);
  EXPECT_NE(none.error().message.find("no Class A curve of degree 2"), std::string::npos);
  c.degree = 6;  // more edges turn farther
  EXPECT_TRUE(minimum_energy(c));
  c.s = {0.1, 0.9};  // no room on the growing branch
  EXPECT_FALSE(minimum_energy(c));
  c = {.chord = {0, 0}};
  EXPECT_FALSE(minimum_energy(c));
  c = {.chord = {-1, 0}, .left = true};  // straight back: three edges turn half way round at most
  EXPECT_FALSE(minimum_energy(c));
}

TEST(MinimumEnergy, StraightConditions) {
  const auto m = minimum_energy({.tangent = {2, 0}, .chord = {6, 0}, .end_tolerance = 0.06});
  ASSERT_TRUE(m);
  EXPECT_EQ(m->alpha, 0);
  EXPECT_EQ(m->s, 1);
  EXPECT_EQ(m->energy, 0);
  EXPECT_NEAR(m->beta, 6.06 / 6, 1e-14);
}

TEST(MinimumEnergy, BadConditions) {
  const auto refused = [](const EnergyConditions& c) {
    const auto m = minimum_energy(c);
    return !m && m.error().code == core::ErrorCode::bad_input;
  };
  EXPECT_TRUE(refused({.tangent = {0, 0}}));
  EXPECT_TRUE(refused({.chord = {NAN, 0}}));
  EXPECT_TRUE(refused({.degree = 1}));
  EXPECT_TRUE(refused({.degree = 31}));
  EXPECT_TRUE(refused({.end_tolerance = -1}));
  EXPECT_TRUE(refused({.end_tolerance = 1}));
  EXPECT_TRUE(refused({.alpha = {0, kPi / 2}}));
  EXPECT_TRUE(refused({.alpha = {0.5, 0.4}}));
  EXPECT_TRUE(refused({.s = {0, 1}}));
}

// Built from the answer: a curve that turns by more than a whole turn is among those that reach its
// end in a narrow range around its matrix; whoever looks at the first turn alone finds none.
TEST(MinimumEnergy, CurvesOfMoreThanOneTurnAreFound) {
  const double alpha = 0.95;
  const double s = 1.03 / std::cos(alpha);
  const MatrixCurve truth{{0, 0}, {1, 0}, 1, {alpha, s}, 9};  // turns by 8 * 0.95 = 7.6 rad
  const curve::Bezier2 c = to_bezier(truth);
  EnergyConditions conditions;
  conditions.chord = c.control.back() - c.control.front();
  conditions.degree = 9;
  conditions.alpha = {alpha - 0.02, alpha + 0.02};
  conditions.s = {0.98 * s, 1.02 * s};
  conditions.left = true;
  const auto found = minimum_energy(conditions);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(norm(found->chord - conditions.chord), 1e-9 * norm(conditions.chord));
  EXPECT_NEAR(found->alpha, alpha, 0.02);
  const MatrixCurve drawn{{0, 0}, {1, 0}, found->beta, {found->alpha, found->s}, 9};
  const curve::Bezier2 reached = to_bezier(drawn);
  EXPECT_LT(distance(reached.control.back(), c.control.back()), 1e-6 * norm(conditions.chord));
  EXPECT_LE(found->energy, strain_energy(c) * (1 + 1e-9));
}

}  // namespace
}  // namespace keyline::classa
