#include "keyline/lac/g2/g2_hermite.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/hermite.h"
#include "keyline/lac/segment/piece_shape.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point2;
using core::Pose2;

/// How far a chain is from a request: position by the chord, direction, curvature relative.
double misfit(const Chain& chain, const CurvatureElement& start, const CurvatureElement& end) {
  const double chord = distance(start.pose.position, end.pose.position);
  const Pose2 at = end_pose(chain);
  const double turned = std::abs(core::wrap_angle(at.direction - end.pose.direction));
  const auto apart = [&](double k, double wanted) {
    return std::abs(k - wanted) / std::max(std::abs(wanted), 1 / chord);
  };
  EXPECT_EQ(chain.start, start.pose);
  EXPECT_EQ(largest_joint_gap(chain).curvature, 0);
  return std::max({distance(at.position, end.pose.position) / chord, turned,
                   apart(chain.pieces.front().curvature_start, start.curvature),
                   apart(chain.pieces.back().curvature_end, end.curvature)});
}

CurvatureElement element(double x, double y, double direction, double curvature) {
  return {{{x, y}, direction}, curvature};
}

TEST(PieceShape, AgreesWithTheSegmentAndItsDifferences) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 4000; ++i) {
    const double alpha = i % 4 == 0 ? -1 : 4 * any(random);
    const double k0 = 3 * any(random);
    double k1 = 3 * any(random);
    if (alpha >= 0) k1 = std::copysign(k1, k0);
    const detail::CurvatureVariable linear;
    const auto shape = detail::piece_shape(alpha, k0, k1, linear, linear);
    const Piece piece{alpha, 1, k0, k1};
    ASSERT_LT(norm(shape.chord - displacement(piece, 1)), 3e-14) << alpha << " " << k0 << " " << k1;
    ASSERT_NEAR(shape.turning, total_turning(piece), 3e-14);
    if (std::min(std::abs(k0), std::abs(k1)) < 0.1) continue;
    const double h = 1e-5;
    const auto shifted = [&](double s) { return displacement({alpha, 1, k0 + s, k1}, 1); };
    const auto slope = (shifted(h) - shifted(-h)) / (2 * h);
    ASSERT_LT(norm(shape.chord_by[0] - slope), 1e-6) << alpha << " " << k0 << " " << k1;
    const auto grown = [&](double s) {
      return (1 + s) * displacement({alpha, 1, k0 * (1 + s), k1 * (1 + s)}, 1);
    };
    const auto growth = (grown(h) - grown(-h)) / (2 * h);
    ASSERT_LT(norm(shape.chord_by_length - growth), 1e-7);
  }
}

TEST(SolveG2, GivesBackASinglePiece) {
  for (const double alpha : {-2.0, -1.0, -0.3, 0.0, 0.5, 1.0, 2.0}) {
    const Segment s{{{1, 2}, 0.7}, alpha, 3, 0.2, 0.9};
    const Pose2 end = end_pose(s);
    const auto solution = solve_g2({s.start, 0.2}, {end, 0.9}, alpha);
    ASSERT_TRUE(solution) << alpha << solution.error().message;
    ASSERT_EQ(solution->chain.pieces.size(), 1u) << alpha;
    EXPECT_NEAR(solution->chain.pieces[0].length, 3, 1e-11);
  }
}

// Its end curvature moves by 6e-9 of itself with rounding of the ends.
TEST(SolveG2, GivesBackASinglePieceOfASteepSlope) {
  const auto solution = solve_g2(
      element(0, 0, -1.141428809551464, -0.20553739380426572),
      element(0.3122628834857598, -0.8971053364368451, -1.323974022288521, -0.0531213596297699),
      -14.072797117751868);
  ASSERT_TRUE(solution) << solution.error().message;
  EXPECT_EQ(solution->chain.pieces.size(), 1u);
}

TEST(SolveG2, FindsTwoPiecesWhereTwoWereLaid) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0, 1);
  for (int i = 0; i < 60; ++i) {
    const double alpha = -3 + 6 * any(random);
    const Chain laid{{{0, 0}, 0.3},
                     {{alpha, 0.5 + any(random), 0.3 + any(random), 0.2 + any(random)},
                      {alpha, 0.5 + any(random), 0, 0.3 + any(random)}},
                     false};
    Chain chain = laid;
    chain.pieces[1].curvature_start = chain.pieces[0].curvature_end;
    const CurvatureElement start{chain.start, chain.pieces[0].curvature_start};
    const CurvatureElement end{end_pose(chain), chain.pieces[1].curvature_end};
    const auto solution = solve_g2(start, end, alpha);
    ASSERT_TRUE(solution) << alpha << " " << i << solution.error().message;
    EXPECT_EQ(solution->chain.pieces.size(), 2u) << alpha << " " << i;
    EXPECT_LT(misfit(solution->chain, start, end), 1e-12);
  }
}

TEST(SolveG2, MeetsRandomRequestsThatMayInflect) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  int solved = 0;
  const int count = 300;
  for (int i = 0; i < count; ++i) {
    const double alpha = i % 3 == 0 ? -1 : -0.4 - 2 * std::abs(any(random));
    const auto start = element(0, 0, 1.2 * any(random), 3 * any(random));
    const auto end = element(2, 0, 1.2 * any(random), 3 * any(random));
    const auto solution = solve_g2(start, end, alpha);
    if (!solution) continue;
    ++solved;
    ASSERT_LT(misfit(solution->chain, start, end), 1e-12) << i;
  }
  EXPECT_EQ(solved, count);
}

TEST(SolveG2, MeetsWildRequests) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const double alpha = i % 2 == 0 ? -1 : -5 + 4.9 * any(random);
    const auto start = element(0, 0, 3.1 * any(random), 10 * any(random));
    const auto end = element(1, 0, 3.1 * any(random), 10 * any(random));
    const auto solution = solve_g2(start, end, alpha);
    ASSERT_TRUE(solution) << i << ' ' << alpha << solution.error().message;
    ASSERT_LT(misfit(solution->chain, start, end), 1e-12) << i;
    // No wilder than the one segment that has no regard to curvature.
    const auto one = solve_g1_directions(start.pose, end.pose, alpha);
    ASSERT_TRUE(one);
    EXPECT_LE(arc_length(solution->chain), std::max(12.0, 2 * one->segment.length));
  }
}

TEST(SolveG2, MeetsWhateverIsAsked) {
  EXPECT_TRUE(rc::check([] {
    const auto fraction = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
    const CurvatureElement start{{{0, 0}, fraction()}, 3 * fraction()};
    const CurvatureElement end{{{2, fraction()}, fraction()}, 3 * fraction()};
    const double alpha = -0.1 - std::abs(3 * fraction());
    const auto s = solve_g2(start, end, alpha);
    RC_ASSERT(s.has_value());
    const auto at = end_pose(s->chain);
    RC_ASSERT(distance(at.position, end.pose.position) < 2e-12);
    RC_ASSERT(std::abs(at.direction - end.pose.direction) < 1e-12);
    RC_ASSERT(s->chain.pieces.back().curvature_end == end.curvature);
    RC_ASSERT(s->chain.pieces.front().curvature_start == start.curvature);
  }));
}

TEST(SolveG2, KeepsTheSignOfCurvatureForSlopesFromZeroOn) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> any(0, 1);
  int solved = 0;
  const int count = 200;
  for (int i = 0; i < count; ++i) {
    const double alpha = 2.5 * any(random);
    const double from = -0.1 - any(random);
    const double to = 0.1 + any(random);
    const auto start = element(0, 0, from, 0.1 + 2 * any(random));
    const auto end = element(1, 0, to, 0.1 + 2 * any(random));
    const auto solution = solve_g2(start, end, alpha);
    if (!solution) {  // then one segment without regard to curvature does not exist either
      EXPECT_EQ(solution.error().code, ErrorCode::not_converged);
      EXPECT_FALSE(solve_g1_directions(start.pose, end.pose, alpha)) << i;
      continue;
    }
    ++solved;
    ASSERT_LT(misfit(solution->chain, start, end), 1e-12) << i;
    EXPECT_NEAR(solution->absolute_turning, to - from, 1e-9);
  }
  EXPECT_GT(solved, count * 8 / 10);
}

TEST(SolveG2, IsTheSameCurveTurnedScaledAndMirrored) {
  const auto start = element(0, 0, 0.5, -0.4);
  const auto end = element(2, 0.3, -0.9, 0.7);
  for (const double alpha : {-1.0, -2.0, -0.5}) {
    const auto plain = solve_g2(start, end, alpha);
    ASSERT_TRUE(plain);
    const core::Similarity2 map{37, 2.1, {5, -3}};
    const auto mapped = [&](const CurvatureElement& e) {
      return CurvatureElement{{apply(map, e.pose.position), e.pose.direction + map.rotation},
                              e.curvature / map.scale};
    };
    const auto moved = solve_g2(mapped(start), mapped(end), alpha);
    ASSERT_TRUE(moved);
    ASSERT_EQ(moved->chain.pieces.size(), plain->chain.pieces.size());
    for (const double t : {0.2, 0.5, 0.9}) {
      const Point2 p = apply(map, evaluate(plain->chain, t));
      EXPECT_LT(distance(p, evaluate(moved->chain, t)), 1e-9 * map.scale);
    }
    const auto back = [](const CurvatureElement& e) {
      return CurvatureElement{{e.pose.position, e.pose.direction + core::kPi}, -e.curvature};
    };
    const auto reversed = solve_g2(back(end), back(start), alpha);
    ASSERT_TRUE(reversed);
    EXPECT_LT(distance(evaluate(reversed->chain, 0.3), evaluate(plain->chain, 0.7)), 1e-9);
  }
}

// Steep ends have several chains of three pieces; which was found first hung on the end set out
// from.
TEST(SolveG2, IsTheSameCurveOnTheWayBack) {
  std::mt19937_64 random(29);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  for (int n = 0; n < 300; ++n) {
    const double from = uniform(2.2, 2.9), to = -uniform(1.4, 2.9), alpha = uniform(-4, -0.3);
    const double first = uniform(-1, 1), last = uniform(-1, 1);
    const auto there = solve_g2(element(0, 0, from, first), element(3, 0, to, last), alpha);
    const auto back = solve_g2(element(0, 0, to, -last), element(3, 0, from, -first), alpha);
    ASSERT_EQ(there.has_value(), back.has_value());
    if (!there) continue;
    ASSERT_EQ(there->chain.pieces.size(), back->chain.pieces.size());
    const Point2 p = evaluate(there->chain, 0.3), q = evaluate(back->chain, 0.7);
    EXPECT_LT(std::hypot(3 - p.x - q.x, p.y + q.y), 1e-9 * arc_length(there->chain))
        << from << ' ' << to << ' ' << first << ' ' << last << ' ' << alpha;
  }
}

TEST(SolveG2, SaysWhyThereIsNoCurve) {
  const auto s = solve_g2(element(0, 0, 0.5, 1), element(1, 0, 0.5, -1), 1);
  ASSERT_FALSE(s);
  EXPECT_EQ(s.error().code, ErrorCode::undrawable);
  EXPECT_NE(s.error().hint.find("slope -1 serves"), std::string::npos) << s.error().hint;
  const auto sign = solve_g2(element(0, 0, -0.5, -1), element(1, 0, 0.5, 1), 0.5);
  ASSERT_FALSE(sign);
  EXPECT_NE(sign.error().hint.find("one segment serves"), std::string::npos);
}

TEST(SolveG2, RefusesBadInput) {
  const auto good = element(0, 0, 0, 0);
  EXPECT_EQ(solve_g2(good, good, -1).error().code, ErrorCode::bad_input);
  EXPECT_EQ(solve_g2(good, element(1, 0, 0, std::nan("")), -1).error().code, ErrorCode::bad_input);
  EXPECT_EQ(solve_g2(good, element(1, 0, 0, 0), INFINITY).error().code, ErrorCode::bad_input);
  const auto line = solve_g2(good, element(1, 0, 0, 0), 2);
  ASSERT_TRUE(line);
  EXPECT_EQ(line->chain.pieces.size(), 1u);
}

TEST(SolveG2, WorksAtExtremeScales) {
  for (const double scale : {1e-150, 1e150}) {
    const auto start = element(0, 0, -0.4, 0.3 / scale);
    const auto end = element(scale, 0, 0.6, 0.9 / scale);
    const auto s = solve_g2(start, end, -1);
    ASSERT_TRUE(s);
    EXPECT_LT(misfit(s->chain, start, end), 1e-12);
  }
}

}  // namespace
}  // namespace keyline::lac
