#include "keyline/fairing/rate_model.h"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace keyline::fairing::detail
