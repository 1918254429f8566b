#include "keyline/lac/hermite/clamped.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/lac/cad/cad.h"
#include "keyline/lac/hermite/region.h"

namespace keyline::lac {
namespace {

using core::Point2;

/// Largest of the end's distance from (1, 0) and of its direction's error.
double residual(const G1Chain& s) {
  const core::Pose2 end = end_pose(s.chain);
  const double wanted = s.turning - s.chord_angle;
  return std::max(distance(end.position, {1, 0}),
                  std::abs(core::wrap_angle(end.direction - wanted)));
}

TEST(SolveG1Chain, MeetsEveryDrawableRequest) {
  const bool full = std::getenv("KEYLINE_FULL") != nullptr;
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(0, 1);
  double worst = 0;
  int clamped = 0;
  for (int n = 0; n < (full ? 1000000 : 50000); ++n) {
    // Every eighth request with a slope next to 0 or 1, where ratios are largest.
    const double near = (n % 16 == 0 ? 0 : 1) + 0.07 * (2 * unit(random) - 1);
    const double alpha = n % 8 == 0 ? near : -10 + 20 * unit(random);
    const double theta = std::exp(std::log(1e-6) + unit(random) * std::log(3e6));
    const core::Interval region = drawable_region(alpha, theta);
    const double edge = std::pow(10, -14 * unit(random));
    const double share = n % 3 == 0 ? edge : n % 3 == 1 ? 1 - edge : unit(random);
    const double psi = core::at(region, share);
    if (!(psi > region.low && psi < region.high)) continue;
    const auto solution = solve_g1_chain({theta, psi, 1, -psi}, alpha);
    ASSERT_TRUE(solution) << alpha << ' ' << theta << ' ' << share << solution.error().message;
    const double r = residual(*solution);
    EXPECT_LE(r, 1e-12) << alpha << ' ' << theta << ' ' << share;
    worst = std::max(worst, r);
    clamped += solution->clamped;
  }
  EXPECT_LT(worst, 1e-12);  // 5e-13 where curvatures differ by e^550, else 1e-14
  EXPECT_GT(clamped, 100);
}

TEST(SolveG1Chain, HoldsAtLimitingSlopesAHairInsideTheRegion) {
  for (const double alpha : {-1e3, -10.0, -1.0, -0.3, -0.03, -1e-13, 0.0, 1e-13, 0.03, 0.3, 0.5,
                             0.97, 1 - 1e-13, 1.0, 1 + 1e-13, 1.03, 1.5, 2.0, 1e3}) {
    for (const double theta : {1e-6, 1e-3, 0.5, 2.0, 3.0}) {
      const core::Interval region = drawable_region(alpha, theta);
      for (const double share :
           {1e-14, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 2e-3, 0.3, 0.5, 0.7, 1 - 2e-3, 1 - 1e-3, 1 - 1e-4,
            1 - 1e-6, 1 - 1e-9, 1 - 1e-12, 1 - 1e-14}) {
        SCOPED_TRACE(testing::Message() << alpha << ' ' << theta << ' ' << share);
        const double psi = core::at(region, share);
        const auto solution = solve_g1_chain({theta, psi, 1, -psi}, alpha);
        ASSERT_TRUE(solution) << solution.error().message;
        EXPECT_LE(residual(*solution), 1e-12);
        EXPECT_TRUE(validate(solution->chain));
        EXPECT_EQ(largest_joint_gap(solution->chain).curvature, 0);
        EXPECT_EQ(solution->reversed, psi < theta / 2);
      }
    }
  }
}

/// Where one piece just still serves, the clamped form must agree with it.
TEST(SolveG1Chain, AgreesWithOnePieceWhereBothServe) {
  const double theta = 1.3;
  int compared = 0;
  for (const double alpha : {-0.02, 0.0, 0.02, 0.98, 1.0, 1.02}) {
    double before = 0;
    double change = 0;
    for (double edge = 1e-3; edge < 4e-3; edge *= 1.0005) {
      const double psi = theta * (1 - edge);
      if (!(psi < drawable_region(alpha, theta).high)) continue;
      const auto s = solve_g1_chain({theta, psi, 1, -psi}, alpha);
      ASSERT_TRUE(s);
      const double length = arc_length(s->chain);
      if (change != 0) {
        EXPECT_GT((length - before) / change, 0.98);  // smooth, through the change of form too
        EXPECT_LT((length - before) / change, 1.02);
        ++compared;
      }
      change = before > 0 ? length - before : 0;
      before = length;
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(SolveG1Chain, ServesAtExtremeScales) {
  for (const double alpha : {0.0, 1e-13, 1.0, 1 - 1e-13}) {
    for (const double scale : {1e-150, 1.0, 1e150}) {
      for (const double off : {1e-2, 3e-3, 1e-3, 1e-6}) {
        const Point2 p0{0, 0}, p1{off * scale, 0.0}, p2{1.1 * scale, scale};
        const auto s = solve_g1_chain(p0, p1, p2, alpha);
        ASSERT_TRUE(s) << alpha << ' ' << scale << ' ' << off << s.error().message;
        EXPECT_LE(distance(end_pose(s->chain).position, p2), 1e-13 * scale);
        EXPECT_TRUE(validate(s->chain)) << alpha << ' ' << scale << ' ' << off;
      }
    }
  }
}

TEST(SolveG1Chain, MeetsAllDirectionsForSlopesBelowZero) {
  const bool full = std::getenv("KEYLINE_FULL") != nullptr;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  int split = 0;
  for (int n = 0; n < (full ? 500000 : 20000); ++n) {
    const double alpha = n % 2 == 0 ? -std::pow(10, -3 + 3.5 * unit(random)) : -10 * unit(random);
    const double size = n % 3 == 0 ? 3e-3 : 2.9;
    const double from = size * (2 * unit(random) - 1);
    double to = size * (2 * unit(random) - 1);
    if (n % 5 == 0) to = from * (1 + 1e-6 * unit(random));
    if (n % 50 == 7) to = -from;
    const auto solved = solve_g1_directions_chain({{0, 0}, from}, {{1, 0}, to}, alpha);
    ASSERT_TRUE(solved) << alpha << ' ' << from << ' ' << to << solved.error().message;
    const core::Pose2 end = end_pose(solved->chain);
    EXPECT_LE(distance(end.position, {1, 0}), 1e-12) << alpha << ' ' << from << ' ' << to;
    EXPECT_LE(std::abs(core::wrap_angle(end.direction - to)), 1e-12) << alpha << ' ' << from;
    split += solved->chain.pieces.size() == 2;
  }
  EXPECT_GT(split, 0);
}

/// From its inflection the sharp part's curvature grows as s^(-1/alpha): so slowly at first, next
/// to slope 0, that no double tells the other end's.
TEST(SolveG1Chain, IsSplitAtAnInflectionThatNoDoublesTell) {
  const double alpha = -1e-4;
  for (const double to : {1.5, 2.5, 3.1})
    for (const bool reversed : {true, false}) {
      const auto s = reversed ? solve_g1_directions_chain({{0, 0}, alpha}, {{1, 0}, to}, alpha)
                              : solve_g1_directions_chain({{0, 0}, to}, {{1, 0}, alpha}, alpha);
      ASSERT_TRUE(s) << to;
      ASSERT_EQ(s->chain.pieces.size(), 2U) << to;
      EXPECT_LE(distance(end_pose(s->chain).position, {1, 0}), 1e-12) << to;
      EXPECT_EQ(s->chain.pieces[0].curvature_end, 0);
      EXPECT_EQ(s->chain.pieces[1].curvature_start, 0);
      EXPECT_EQ(s->reversed, reversed);
      const Piece& sharp = s->chain.pieces[reversed ? 1 : 0];
      const double most = std::abs(reversed ? sharp.curvature_end : sharp.curvature_start);
      EXPECT_NEAR(s->lambda * -alpha * sharp.length * most, 1, 1e-12) << to;
    }
}

TEST(SolveG1Chain, BecomesBeziersAndSplines) {
  for (const double alpha : {0.0, 1.0}) {
    const auto s = solve_g1_chain(Point2{0, 0}, Point2{1e-6, 0}, Point2{3, 1}, alpha);
    ASSERT_TRUE(s);
    ASSERT_TRUE(s->clamped);
    for (const int degree : {3, 5}) {
      for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
        const auto beziers = to_beziers(s->chain, {degree, tolerance, true});
        ASSERT_TRUE(beziers) << alpha << ' ' << degree << ' ' << tolerance;
        EXPECT_LE(beziers->deviation, tolerance);
        EXPECT_LE(beziers->pieces.size(), 12U);
        const auto spline = to_bspline(s->chain, {degree, tolerance, true});
        ASSERT_TRUE(spline) << spline.error().message;
        EXPECT_LE(distance(spline->curve.control.back(), {3, 1}), 1e-12);
      }
    }
  }
}

TEST(SolveG1Chain, DirectionsAndHandlesAgree) {
  for (const double alpha : {-0.01, 0.0, 1.0, 1.01}) {
    const double theta = 0.9;
    const double psi = core::at(drawable_region(alpha, theta), 1e-5);
    const auto a = solve_g1_chain({theta, psi, 1, -psi}, alpha);
    const auto b = solve_g1_directions_chain({{0, 0}, -psi}, {{1, 0}, theta - psi}, alpha);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->chain.pieces.size(), b->chain.pieces.size());
    EXPECT_NEAR(arc_length(a->chain), arc_length(b->chain), 1e-12);
  }
  EXPECT_FALSE(solve_g1_chain({0, 0}, {-1, 0}, {1, 0}, 0));
  EXPECT_FALSE(solve_g1_chain({0, 0}, {1, 1}, {2, 0}, NAN));
  EXPECT_FALSE(solve_g1_directions_chain({{0, 0}, NAN}, {{1, 0}, 1}, 0));
}

}  // namespace
}  // namespace keyline::lac
