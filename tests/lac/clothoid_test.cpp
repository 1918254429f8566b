// Clothoids between handles, by what a clothoid is: the tangent angle is quadratic in the length.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/hermite.h"

namespace keyline::lac {
namespace {

using core::Point2;

struct End {
  long double x = 0, y = 0, direction = 0;
};

/// Gauss's rule on the Fresnel integral itself, in long double.
End end_of(const Segment& s) {
  const long double slope = static_cast<long double>(s.curvature_end) - s.curvature_start;
  const auto angle = [&](long double t) {
    return s.start.direction + s.length * t * (s.curvature_start + slope * t / 2);
  };
  const auto integral = [&](auto&& f) {
    long double sum = 0;
    for (int panel = 0; panel < 4; ++panel) {
      sum += boost::math::quadrature::gauss<long double, 30>::integrate(
          [&](long double t) { return f(angle(t)); }, panel / 4.0L, (panel + 1) / 4.0L);
    }
    return s.length * sum;
  };
  return {s.start.position.x + integral([](long double a) { return std::cos(a); }),
          s.start.position.y + integral([](long double a) { return std::sin(a); }), angle(1)};
}

double miss(const Segment& s, Point2 p2, double direction) {
  const End end = end_of(s);
  const double chord = distance(s.start.position, p2);
  const double turn = static_cast<double>(end.direction) - direction;
  return std::max(
      std::hypot(static_cast<double>(end.x - p2.x), static_cast<double>(end.y - p2.y)) / chord,
      std::abs(core::wrap_angle(turn)));
}

/// Handles over the unit chord, turning by theta, the chord at `share` of the way from the circle
/// to an inflection; either turn and either end first.
G1Problem handles(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double theta = unit(random) < 0.5 ? 3.1 * unit(random) : std::exp(-14 * unit(random));
  // A third of the turning is the limit for small angles (k0 = 2 theta at one end, 0 at the other).
  const double psi = theta * (1.0 / 3 + unit(random) / 3);
  const double side = std::sin(theta - psi) / std::sin(theta);
  const double up = unit(random) < 0.5 ? 1 : -1;
  return {{0, 0}, {side * std::cos(psi), up * side * std::sin(psi)}, {1, 0}, -1};
}

TEST(Clothoids, MeetTheirHandlesByTheFresnelIntegral) {
  std::mt19937 random(91);
  double worst = 0;
  int in_one_step = 0;
  for (int n = 0; n < 400; ++n) {
    const G1Problem p = handles(random);
    const auto s = solve_g1(p.p0, p.p1, p.p2, -1);
    ASSERT_TRUE(s) << s.error().message;
    worst = std::max(worst, miss(s->segment, p.p2, core::direction_of(p.p2 - p.p1)));
    in_one_step += s->iterations == 1 ? 1 : 0;
    EXPECT_EQ(s->reversed,
              std::abs(s->segment.curvature_start) < std::abs(s->segment.curvature_end));
  }
  RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
  EXPECT_LE(worst, 2e-15);
  EXPECT_GE(in_one_step, 390);  // what the first guess is good for
}

TEST(Clothoids, TheBatchDrawsTheSameOnes) {
  std::mt19937 random(92);
  std::vector<G1Problem> problems(777);
  for (G1Problem& p : problems) p = handles(random);
  // The curve that just does not inflect: the batch hands it to the guarded search.
  problems[5] = {{0, 0}, {0, 0}, {1, 0}, -1};
  problems[6].alpha = -2;
  std::vector<G1Outcome> outcomes(problems.size());
  solve_g1(problems, outcomes);
  double worst = 0;
  for (std::size_t n = 7; n < problems.size(); ++n) {
    const G1Problem& p = problems[n];
    ASSERT_TRUE(outcomes[n].drawn) << n;
    worst = std::max(worst, miss(outcomes[n].segment, p.p2, core::direction_of(p.p2 - p.p1)));
    const auto s = solve_g1(p.p0, p.p1, p.p2, -1);
    EXPECT_NEAR(outcomes[n].lambda, s->lambda, 1e-12 * (1e-3 + s->lambda));
  }
  EXPECT_LE(worst, 2e-15);
}

// The one step and the guarded search are different code: they meet near the inflection.
TEST(Clothoids, StayInOnePieceUpToTheInflection) {
  for (const double theta : {1e-4, 0.3, 1.5, 2.9, 3.12}) {
    double before = 1e9;
    for (int digits = 1; digits <= 12; ++digits) {
      // The limit's angle: that of the clothoid whose curvature grows from nothing.
      const Segment limit{{}, -1, 1, 2 * theta, 0};
      const End end = end_of(limit);
      const double last = std::atan2(static_cast<double>(end.y), static_cast<double>(end.x));
      const double gap = (last - theta / 2) * std::pow(10, -digits);
      if (gap < 4e-15) break;  // not to be told from the limit
      const double psi = last - gap;
      const auto s = solve_g1(HandleAngles{theta, psi, 1, -psi}, -1);
      ASSERT_TRUE(s) << theta << ' ' << digits;
      EXPECT_LE(miss(s->segment, {1, 0}, theta - psi), 2e-15) << theta << ' ' << digits;
      EXPECT_LT(s->segment.curvature_end, before);
      EXPECT_GT(s->segment.curvature_end, 0);
      before = s->segment.curvature_end;
    }
  }
}

}  // namespace
}  // namespace keyline::lac
