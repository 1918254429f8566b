#include "keyline/fairing/rate_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/fairing/piece_energy.h"
#include "keyline/fairing/rate_descent.h"

#include "rate_given.h"

/// Joints whose rates are to be one, and the limits of the solve that makes them so.
namespace keyline::fairing::detail {
namespace {

FitChain of_curvatures(const std::vector<double>& curvatures) {
  FitChain chain;
  for (const double k : curvatures) chain.joints.push_back({{}, 0, k});
  chain.pieces.assign(curvatures.size() - 1, {.length = 0.5});
  return chain;
}

std::vector<std::pair<int, int>> between(const FitChain& chain) {
  std::vector<std::pair<int, int>> pieces;
  for (const RateJoint& joint : rate_joints(chain)) pieces.emplace_back(joint.before, joint.after);
  return pieces;
}

using Pieces = std::vector<std::pair<int, int>>;

TEST(RateJoints, AreThoseThroughWhichCurvatureRunsOneWay) {
  // Up, up, down, down, up.
  EXPECT_EQ(between(of_curvatures({0.1, 1, 3, 2, 1, 4})), (Pieces{{0, 1}, {2, 3}}));
  // Each piece the other way than the one before, whatever two of them make together.
  EXPECT_EQ(between(of_curvatures({1, 2, 1.5, 3, 2.5, 4})), Pieces{});
  EXPECT_EQ(between(of_curvatures({4, 3, 2})), (Pieces{{0, 1}}));
}

TEST(RateJoints, OfAClosedChainTheSeamIsOne) {
  FitChain chain = of_curvatures({2, 3, 1, 2});
  chain.closed = true;
  EXPECT_EQ(between(chain), (Pieces{{2, 0}}));
}

TEST(RateJoints, NeitherLinesNorArcsNorInflectionsHaveARate) {
  FitChain chain = of_curvatures({1, 2, 3});
  chain.pieces[1].kind = PieceKind::line;
  EXPECT_EQ(between(chain), Pieces{});
  EXPECT_EQ(between(of_curvatures({1, 1, 2})), Pieces{});
  EXPECT_EQ(between(of_curvatures({-1, 0, 2})), Pieces{});
}

// What a limit says a step changes is what the room left at the chain moved by it changes: rooms
// are linear in the unknowns.
TEST(RateModel, LimitsChangeAsTheirRoomDoes) {
  FitChain chain = of_curvatures({0.2, 0.5, 1, 0.8});
  for (std::size_t p = 0; p < 3; ++p) chain.joints[p + 1].position = {0.5 * double(p + 1), 0};
  chain.pieces[1].alpha = 0.4;
  std::vector<FitPoint> points;
  for (int i = 0; i < 12; ++i) points.push_back({.position = {0.125 * i, 0.01 * i}});
  chain.feet.assign(points.size(), {0, 0.5});
  RateProblem problem;
  problem.points = &points;
  problem.joints = rate_joints(chain);
  problem.slopes = {{-3, 3}, {-1, 1}, {-2, -0.5}};
  problem.growth = {1, 1, -1};
  problem.weights.tolerance = 0.1;
  RateModel model(chain, problem);
  model.linearise();
  ASSERT_EQ(model.limits.size(), 9U);
  Eigen::VectorXd step(model.unknowns.count());
  for (Eigen::Index i = 0; i < step.size(); ++i) step(i) = 0.01 * double(i % 5 - 2) + 0.003;
  const RateModel moved(model.moved(step, 1), problem);
  for (std::size_t i = 0; i < model.limits.size(); ++i)
    EXPECT_NEAR(model.limits[i].change(step), moved.limits[i].room - model.limits[i].room, 1e-12)
        << i;
}

// Of a piece whose curvature to the power -alpha is linear: the logarithm of |d curvature / ds| by
// differences near both ends.
TEST(LogRates, AreThoseOfThePiece) {
  for (const auto& [a, b, alpha] : {std::tuple{1.0, 3.0, 0.7},
                                    {3.0, 1.0, -2.5},
                                    {-1.0, -2.0, 0.0},
                                    {2.0, 2.1, 1.0},
                                    {-1.0, 2.0, -0.6},
                                    {3.0, -0.5, -1.0}}) {
    const lac::Piece piece{alpha, 1.7, a, b};
    const EndRates rates = log_rates(a, b, alpha, 1.7);
    EXPECT_NEAR(rates.start, std::log(std::abs(lac::curvature_rate(piece, 0))), 1e-12) << alpha;
    EXPECT_NEAR(rates.end, std::log(std::abs(lac::curvature_rate(piece, 1))), 1e-12) << alpha;
  }
}

/// Three pieces laid out end to end, with points beside them.
Given laid_out() {
  return of_pieces({{-0.7, 0.4, 0.5, 1}, {0.4, 0.3, 1, 3}, {-1.5, 0.3, 3, 5}}, false,
                   [](int i, int k) { return 0.004 * ((k + i) % 3 - 1) + 0.001; });
}

// The rows are what the values change by with each unknown, those of the equations what is missed.
TEST(RateModel, RowsAreDifferences) {
  for (const Hold hold : {Hold::free, Hold::position, Hold::direction}) {
    Given g = laid_out();
    g.problem.points = &g.points;
    g.chain.hold_end = hold;
    ASSERT_EQ(g.problem.joints.size(), 2U);
    g.problem.joints[1].tied = true;
    RateModel model(g.chain, g.problem);
    model.linearise();
    EXPECT_NEAR(model.gaps, 0.3 * std::abs(model.jump[1]), 1e-6);
    ASSERT_EQ(model.equation.rows(), 1 + (hold == Hold::free ? 0 : hold == Hold::position ? 2 : 3));
    expect_differences(model, g);
    // Weights of jumps go with the jumps themselves: those rows are told apart.
    const double by = std::sqrt(0.5 * 0.5 / std::hypot(model.jump[0], 0.1));
    const auto jumps = static_cast<Eigen::Index>(g.points.size()) + 3;
    for (int k = 0; k < model.unknowns.count(); ++k) {
      const Beside beside(model, g, k);
      EXPECT_NEAR(model.rows(jumps, k),
                  by * Beside::difference(beside.up.jump[0], beside.down.jump[0]), 1e-4);
    }
  }
}

// What a chain costs: the squares of its rows, but for the jumps, which count by their size.
TEST(RateModel, CostIsVariationOffsetsJumpsAndTips) {
  Given g = laid_out();
  g.problem.points = &g.points;
  RateModel model(g.chain, g.problem);
  model.linearise();
  const auto jumps = static_cast<Eigen::Index>(g.points.size()) + 3;
  double sum = model.value.squaredNorm() - model.value.segment<2>(jumps).squaredNorm();
  for (const double jump : model.jump) sum += 0.5 * (std::hypot(jump, 0.1) - 0.1);
  EXPECT_NEAR(model.cost, sum, 1e-9);
  double variation = 0;
  for (std::size_t p = 0; p < 3; ++p) {
    const double root = piece_energy(g.chain.joints[p].curvature, g.chain.joints[p + 1].curvature,
                                     g.chain.pieces[p].alpha)
                            .root;
    variation += root * root / g.chain.pieces[p].length / 20;
  }
  EXPECT_NEAR(model.variation, variation, 1e-12);
  EXPECT_NEAR(model.max_offset, 0.5, 1e-6);  // 0.005 of 0.01
}

// Where an open chain ends beside its last point counts a tenth of its square in tolerances, at
// either end alike.
TEST(RateModel, TipsCountATenth) {
  for (const double off : {1.0, 2.0, -0.5})
    for (const bool last : {false, true}) {
      Given g = laid_out();
      g.problem.points = &g.points;
      const double before = RateModel(g.chain, g.problem).cost;
      FitPoint& tip = last ? g.points.back() : g.points.front();
      const FitJoint& at = last ? g.chain.joints.back() : g.chain.joints.front();
      tip.position = tip.position + off * 0.01 * core::unit_vector(at.direction);
      EXPECT_NEAR(RateModel(g.chain, g.problem).cost - before, 0.1 * off * off, 1e-3) << off;
    }
}

// Gaps are told in tolerances, a turn at a tenth of a length: of the last joint, whose position
// nothing follows, each by itself.
TEST(RateModel, GapsAreOfPlaceAndTurn) {
  const auto gaps = [](core::Vector2 by, double turn) {
    Given g = laid_out();
    g.problem.points = &g.points;
    g.problem.joints.clear();
    FitJoint& last = g.chain.joints.back();
    last.position = last.position + by;
    last.direction += turn;
    return RateModel(g.chain, g.problem).gaps;
  };
  EXPECT_NEAR(gaps({0, 0}, 0), 0, 1e-6);
  const double along = gaps({0.002, 0}, 0);
  const double across = gaps({0, -0.003}, 0);
  EXPECT_GT(along, 0.2 - 1e-6);
  EXPECT_LT(along, 0.2 * std::numbers::sqrt2 + 1e-6);
  EXPECT_GT(across, 0.3 - 1e-6);
  EXPECT_LT(across, 0.3 * std::numbers::sqrt2 + 1e-6);
  EXPECT_NEAR(gaps({0, 0}, 0.05), 0.5, 1e-6);
  EXPECT_NEAR(gaps({0, 0}, -0.05), 0.5, 1e-6);
}

// A last step closes gaps and tied jumps to rounding; what is held stays.
TEST(CloseRates, MeetsWhatHasToBeMet) {
  for (const Hold hold : {Hold::free, Hold::direction}) {
    Given g = laid_out();
    g.problem.points = &g.points;
    g.chain.hold_start = g.chain.hold_end = hold;
    g.problem.weights.jump = 10;
    g.chain = solve_rates(g.chain, g.problem, 60, {}).chain;
    g.problem.joints[0].tied = g.problem.joints[1].tied = true;
    const FitChain closed = close_rates(g.chain, g.problem);
    const RateModel model(closed, g.problem);
    EXPECT_LT(model.gaps, 1e-7);
    EXPECT_NEAR(model.jump[0], 0, 1e-9);
    EXPECT_NEAR(model.jump[1], 0, 1e-9);
    if (hold == Hold::free) continue;
    EXPECT_EQ(closed.joints[0].position, g.chain.joints[0].position);
    EXPECT_EQ(closed.joints[0].direction, g.chain.joints[0].direction);
    EXPECT_NEAR(core::distance(closed.joints[3].position, g.problem.end.position), 0, 1e-10);
    EXPECT_NEAR(closed.joints[3].direction, g.problem.end.direction, 1e-10);
  }
}

// A solve lowers the cost, keeps slopes inside their range and curvature its sense, and what is
// held where it is.
TEST(SolveRates, KeepsWhatIsHeld) {
  for (const Hold hold : {Hold::free, Hold::position, Hold::direction, Hold::curvature}) {
    Given g = laid_out();
    g.problem.points = &g.points;
    g.chain.hold_start = g.chain.hold_end = hold;
    g.problem.slopes[1] = {-0.5, 0.5};
    const RateModel before(g.chain, g.problem);
    const RateSolution found = solve_rates(g.chain, g.problem, 60, {});
    const RateModel after(found.chain, g.problem);
    EXPECT_LT(after.cost, before.cost);
    EXPECT_LT(found.gaps, 0.05);
    EXPECT_LE(std::abs(found.chain.pieces[1].alpha), 0.5);
    for (std::size_t p = 0; p < 3; ++p)
      EXPECT_GT(found.chain.joints[p + 1].curvature, found.chain.joints[p].curvature);
    const FitJoint& start = found.chain.joints.front();
    const FitJoint& end = found.chain.joints.back();
    EXPECT_EQ(core::distance(start.position, g.chain.joints[0].position) < 1e-9,
              hold >= Hold::position);
    EXPECT_EQ(std::abs(start.direction - 0.2) < 1e-9, hold >= Hold::direction);
    EXPECT_EQ(std::abs(start.curvature - 0.5) < 1e-9, hold >= Hold::curvature);
    EXPECT_EQ(std::abs(end.curvature - 5) < 1e-9, hold >= Hold::curvature);
    EXPECT_EQ(core::distance(end.position, g.problem.end.position) < 1e-4, hold >= Hold::position);
  }
}

// Jumps that cost grow smaller.
TEST(SolveRates, TakesJumpsAway) {
  Given g = laid_out();
  g.problem.points = &g.points;
  g.problem.weights.jump = 10;
  const RateModel before(g.chain, g.problem);
  const RateSolution found = solve_rates(g.chain, g.problem, 40, {});
  double was = 0, is = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    was += std::abs(before.jump[k]);
    is += std::abs(found.jump[k]);
  }
  EXPECT_LT(is, 0.1 * was);
  EXPECT_LE(found.max_offset, 1.5);
}

// Where a chain is begun does not tell where it ends: moved about at random, within the limits, it
// comes to the same cost. A step that overshoots is shortened; without, five of twenty stay far
// off.
TEST(SolveRates, ComesToTheSameFromAfar) {
  Given g = laid_out();
  g.problem.points = &g.points;
  RateModel model(g.chain, g.problem);
  model.linearise();
  std::mt19937 random(5);
  constexpr std::array kJumps{0.5, 10.0};
  std::array<double, 2> cost{};
  for (std::size_t i = 0; i < 2; ++i) {
    g.problem.weights.jump = kJumps[i];
    cost[i] = RateModel(solve_rates(g.chain, g.problem, 200, {}).chain, g.problem).cost;
  }
  int far = 0;
  for (std::size_t k = 0; k < 20; ++k) {
    g.problem.weights.jump = kJumps[k % 2];
    Eigen::VectorXd step(model.unknowns.count());
    for (Eigen::Index i = 0; i < step.size(); ++i)
      step(i) = (i < 3 ? 0.01 : 0.5) * (random() / 2147483648.0 - 1);
    for (int p = 0; p < 3; ++p) step(model.unknowns.slope(p)) *= 2;
    double share = 1;
    for (const RateLimit& limit : model.limits)
      if (const double by = limit.change(step); by < 0)
        share = std::min(share, -0.8 * limit.room / by);
    const RateSolution found = solve_rates(model.moved(step, share), g.problem, 60, {});
    if (!(std::abs(RateModel(found.chain, g.problem).cost - cost[k % 2]) < 0.1)) ++far;
  }
  EXPECT_LE(far, 1);
}

// A point outside the tolerance costs the same whichever of all it is.
TEST(RateModel, EveryPointCounts) {
  std::vector<double> more;
  for (const bool last : {false, true}) {
    Given g = laid_out();
    g.problem.points = &g.points;
    const double before = RateModel(g.chain, g.problem).cost;
    FitPoint& point = last ? g.points.back() : g.points.front();
    const FitJoint& at = last ? g.chain.joints.back() : g.chain.joints.front();
    point.position =
        point.position + 0.02 * core::perpendicular_left(core::unit_vector(at.direction));
    const RateModel model(g.chain, g.problem);
    EXPECT_NEAR(model.max_offset, 2, 1e-3);
    more.push_back(model.cost - before);
  }
  EXPECT_GT(more[0], 0.01);
  EXPECT_NEAR(more[0], more[1], 1e-2 * more[0]);
}

}  // namespace
}  // namespace keyline::fairing::detail
