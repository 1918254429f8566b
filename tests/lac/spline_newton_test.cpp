#include "keyline/lac/g2/spline_newton.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/lac/chain/chain.h"
#include "keyline/lac/g2/g2_shooting.h"
#include "keyline/lac/g2/spline.h"

/// Newton's methods of the chain solvers, on problems made from their answers.
namespace keyline::lac::detail {
namespace {

constexpr double kPi = std::numbers::pi;

/// The problem whose answer is this open chain: chords and the turns between them.
SplineProblem from_answer(const Chain& chain) {
  SplineProblem p;
  const auto poses = joints(chain);
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    p.chord.push_back(core::distance(poses[i].position, poses[i + 1].position));
    p.alpha.push_back(chain.pieces[i].alpha);
  }
  const auto direction = [&](std::size_t i) {
    return core::direction_of(poses[i + 1].position - poses[i].position);
  };
  const std::size_t n = p.chord.size();
  p.turn.assign(n + 1, 0);
  for (std::size_t i = 1; i < n; ++i) p.turn[i] = core::wrap_angle(direction(i) - direction(i - 1));
  return p;
}

const Chain kAnswer{
    {{0, 0}, 0.2}, {{-1, 1, 0.4, 0.9}, {-0.6, 1.2, 0.9, 0.5}, {0.5, 0.8, 0.5, 1.1}}, false};

void expect_answer(const SplineProblem& problem) {
  SplineState state = guessed_state(problem);
  int iterations = 0;
  ASSERT_TRUE(solve_spline_newton(problem, state, iterations));
  EXPECT_GT(iterations, 1);
  EXPECT_LT(iterations, 15);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(state.length[i], kAnswer.pieces[i].length, 1e-11) << i;
    EXPECT_NEAR(state.curvature[i], kAnswer.pieces[i].curvature_start, 1e-10) << i;
  }
  EXPECT_NEAR(state.curvature[3], 1.1, 1e-10);
}

// By end curvatures, by end angles, by one of each.
TEST(SplineNewton, FindsTheChainThatTheProblemIsMadeOf) {
  const auto poses = joints(kAnswer);
  const double first = core::direction_of(poses[1].position - poses[0].position);
  const double last = core::direction_of(poses[3].position - poses[2].position);
  SplineProblem problem = from_answer(kAnswer);
  problem.start.curvature = 0.4;
  problem.end.curvature = 1.1;
  expect_answer(problem);
  problem.start = {first - poses[0].direction, {}};
  problem.end = {poses[3].direction - last, {}};
  expect_answer(problem);
  problem.start = {{}, 0.4};
  expect_answer(problem);
}

// Free ends: curvature goes on as it is at the next point.
TEST(SplineNewton, FreeEndsAreArcs) {
  SplineProblem problem = from_answer(kAnswer);
  SplineState state = guessed_state(problem);
  int iterations = 0;
  ASSERT_TRUE(solve_spline_newton(problem, state, iterations));
  EXPECT_NEAR(state.curvature[0], state.curvature[1], 1e-12);
  EXPECT_NEAR(state.curvature[3], state.curvature[2], 1e-12);
}

// Both conditions at an end: the span has a joint in its middle.
TEST(SplineNewton, SpansWithBothConditionsAreTwoPieces) {
  const auto poses = joints(kAnswer);
  const double first = core::direction_of(poses[1].position - poses[0].position);
  SplineProblem problem = from_answer(kAnswer);
  problem.start = {first - poses[0].direction, 0.1};
  problem.end.curvature = 1.1;
  SplineState state = guessed_state(problem);
  int iterations = 0;
  ASSERT_TRUE(solve_spline_newton(problem, state, iterations));
  const auto pieces = pieces_of_span(problem, state, 0);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].curvature_start, 0.1);
  EXPECT_EQ(pieces[0].curvature_end, pieces[1].curvature_start);
  EXPECT_EQ(pieces[0].length, pieces[1].length);
  EXPECT_EQ(pieces_of_span(problem, state, 1).size(), 1U);
  const Chain span{{poses[0].position, poses[0].direction}, pieces, false};
  EXPECT_NEAR(core::distance(end_pose(span).position, poses[1].position), 0, 1e-12);
  problem.start = {{}, 0.4};
  const double last = core::direction_of(poses[3].position - poses[2].position);
  problem.end = {poses[3].direction - last, 3.0};
  state = guessed_state(problem);
  ASSERT_TRUE(solve_spline_newton(problem, state, iterations));
  const auto end = pieces_of_span(problem, state, 2);
  ASSERT_EQ(end.size(), 2U);
  EXPECT_EQ(end[1].curvature_end, 3.0);
}

// Points of an ellipse, closed: the joints' angles agree all round, and as with every method of
// Newton's the last steps double the digits, so that few are enough.
TEST(SplineNewton, ClosedChainsTakeFewSteps) {
  std::vector<core::Point2> points;
  for (int i = 0; i < 9; ++i)
    points.push_back({2 * std::cos(kPi * i / 4.5 + 0.1), std::sin(kPi * i / 4.5 + 0.1)});
  SplineProblem problem;
  problem.closed = true;
  problem.alpha.assign(9, -0.5);
  const auto side = [&](int i) { return points[(i + 1) % 9] - points[i % 9]; };
  for (int i = 0; i < 9; ++i) {
    problem.chord.push_back(core::norm(side(i)));
    problem.turn.push_back(
        core::wrap_angle(core::direction_of(side(i)) - core::direction_of(side(i + 8))));
  }
  SplineState state = guessed_state(problem);
  int iterations = 0;
  ASSERT_TRUE(solve_spline_newton(problem, state, iterations));
  EXPECT_LE(iterations, 5);
  double turned = 0;
  for (std::size_t i = 0; i < 9; ++i) turned += total_turning(pieces_of_span(problem, state, i)[0]);
  EXPECT_NEAR(turned, 2 * kPi, 1e-10);
}

// A regular polygon: arcs of its circle.
TEST(SplineNewton, OfAPolygonIsItsCircle) {
  SplineProblem problem;
  problem.closed = true;
  const int n = 7;
  problem.chord.assign(n, 2 * std::sin(kPi / n));
  problem.alpha.assign(n, -1);
  problem.turn.assign(n, 2 * kPi / n);
  SplineState state = straight_state(problem);
  EXPECT_EQ(state.curvature, std::vector<double>(n, 0));
  EXPECT_EQ(state.length, problem.chord);
  state = guessed_state(problem);
  // 2 times the turn over two chords, and the chord longer by (k c / 2)^2 / 6.
  const double k = 2 * kPi / n / problem.chord[0];
  EXPECT_NEAR(state.curvature[3], k, 1e-14);
  const double h = 0.5 * k * problem.chord[0];
  EXPECT_NEAR(state.length[3], problem.chord[0] * (1 + h * h / 6), 1e-14);
  int iterations = 0;
  ASSERT_TRUE(solve_spline_newton(problem, state, iterations));
  for (int i = 0; i < n; ++i) {
    EXPECT_NEAR(state.curvature[i], 1, 1e-12);
    EXPECT_NEAR(state.length[i], 2 * kPi / n, 1e-12);
  }
}

// From far off too: steps that gain less than a tenth of what they are are halved, and the answer
// is the same.
TEST(SplineNewton, ComesFromFarOff) {
  SplineProblem problem = from_answer(kAnswer);
  problem.start.curvature = 0.4;
  problem.end.curvature = 1.1;
  for (const double factor : {0.2, 3.0}) {
    SplineState state = guessed_state(problem);
    for (double& k : state.curvature) k *= factor;
    int iterations = 0;
    ASSERT_TRUE(solve_spline_newton(problem, state, iterations)) << factor;
    EXPECT_NEAR(state.curvature[1], 0.9, 1e-10);
  }
}

// ---- Short chains ------------------------------------------------------------------------

UnitG2 request_of(const Chain& chain, double alpha) {
  const core::Pose2 end = end_pose(chain);
  const double size = core::norm(end.position - chain.start.position);
  const double along = core::direction_of(end.position - chain.start.position);
  return {chain.start.direction - along, end.direction - along,
          chain.pieces.front().curvature_start * size, chain.pieces.back().curvature_end * size,
          alpha};
}

TEST(G2Shooting, FindsTheTwoPiecesTheDataWereTakenFrom) {
  for (const double alpha : {-2.0, -1.0, -0.5, 0.5, 1.5}) {
    const Chain chain{{}, {{alpha, 0.7, 0.5, 1.5}, {alpha, 0.4, 1.5, 1}}, false};
    const double size = core::norm(end_pose(chain).position - core::Point2{});
    ShortChain start;
    start.curvature = {0.5 * size, 1.3 * size, 1 * size, 0};
    start.length = {0.6 / size, 0.5 / size, 0};
    double residual = 1;
    const auto found = shoot(request_of(chain, alpha), start, &residual);
    ASSERT_TRUE(found) << alpha;
    EXPECT_LE(residual, 2e-13);
    EXPECT_NEAR(found->curvature[1], 1.5 * size, 1e-10) << alpha;
    EXPECT_NEAR(found->length[0], 0.7 / size, 1e-10) << alpha;
    EXPECT_NEAR(found->length[1], 0.4 / size, 1e-10) << alpha;
  }
}

TEST(G2Shooting, OfThreePiecesTheOuterLengthsFollowTheMiddleOne) {
  const Chain chain{{}, {{-1, 0.8, 0.5, 1.5}, {-1, 0.4, 1.5, 0.9}, {-1, 0.8, 0.9, 0.2}}, false};
  const double size = core::norm(end_pose(chain).position - core::Point2{});
  ShortChain start;
  start.pieces = 3;
  start.outer = 2;
  start.curvature = {0.5 * size, 1.3 * size, 1 * size, 0.2 * size};
  start.length = {0, 0.45 / size, 0};
  EXPECT_NEAR(start.length_of(0), 0.9 / size, 1e-15);
  EXPECT_NEAR(start.length_of(1), 0.45 / size, 1e-15);
  const auto found = shoot(request_of(chain, -1), start, nullptr);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->length[1], 0.4 / size, 1e-10);
  EXPECT_NEAR(found->curvature[1], 1.5 * size, 1e-10);
  EXPECT_NEAR(found->curvature[2], 0.9 * size, 1e-10);
}

// What is too long, too short or too bent from the start is not followed.
TEST(G2Shooting, RefusesWhatIsAstray) {
  const Chain chain{{}, {{-1, 0.7, 0.5, 1.5}, {-1, 0.4, 1.5, 1}}, false};
  const double size = core::norm(end_pose(chain).position - core::Point2{});
  UnitG2 request = request_of(chain, -1);
  ShortChain start;
  start.curvature = {0.5 * size, 1.3 * size, 1 * size, 0};
  start.length = {0.6 / size, 0.5 / size, 0};
  EXPECT_TRUE(shoot(request, start, nullptr));
  request.longest = 1.05;
  EXPECT_FALSE(shoot(request, start, nullptr));
  request.longest = 24;
  start.length[0] = 1e-8;
  EXPECT_FALSE(shoot(request, start, nullptr));
  start.length[0] = 0.6 / size;
  start.curvature[1] = 16.5 / start.length[0];  // more than 16 over its length
  EXPECT_FALSE(shoot(request, start, nullptr));
}

TEST(G2Shooting, SizeOfAMissIsItsLargest) {
  EXPECT_EQ(size_of(Miss{1, -3, 2}), 3);
  EXPECT_EQ(size_of(Miss{}), 0);
  EXPECT_EQ(size_of(Miss{1, HUGE_VAL, 2}), 1e300);
  EXPECT_EQ(size_of(Miss{std::nan(""), 0, 0}), 1e300);
}

// In the clothoid spline the curvature keeps its sign in a span, in that of the slopes wanted it
// came to change it: 9 of 6,000 random requests had such a piece of slope from 0 on.
TEST(SolveSpline, PiecesAreSoundWhereSlopesMoveAnInflection) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const double slopes[] = {1.0, 0.0, -0.01, -0.0001, 0.5, 2.0};
  int solved = 0;
  for (int n = 0; n < 1500; ++n) {
    std::vector<core::Point2> points;
    SplineOptions options;
    const int count = 4 + static_cast<int>(random() % 5);
    for (int i = 0; i < count; ++i) points.push_back({i + 0.8 * unit(random), 3 * unit(random)});
    for (int i = 1; i < count; ++i) options.alpha.push_back(slopes[random() % 6]);
    const auto spline = solve_spline(points, options);
    if (!spline) continue;
    ++solved;
    const auto valid = validate(spline->chain);
    ASSERT_TRUE(valid) << n << ": " << valid.error().message << ' ' << valid.error().path;
    EXPECT_LE(largest_joint_gap(spline->chain).curvature, 0);
    EXPECT_LE(spline->deviation, 1e-11);
  }
  EXPECT_GE(solved, 1400);
}

}  // namespace
}  // namespace keyline::lac::detail
