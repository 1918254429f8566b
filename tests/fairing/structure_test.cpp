#include "keyline/fairing/structure.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/lac/chain/chain.h"
#include "keyline/numeric/random.h"

/// Which joints a noisy chain should have.
namespace keyline::fairing::detail {
namespace {

FitChain line(int pieces, int points) {
  FitChain chain;
  for (int i = 0; i <= pieces; ++i) chain.joints.push_back({{double(i) / pieces, 0}, 0, 0});
  chain.pieces.assign(static_cast<std::size_t>(pieces), {.length = 1.0 / pieces});
  for (int j = 0; j < points; ++j) {
    const double at = (j + 0.5) / points * pieces;
    chain.feet.push_back({static_cast<int>(at), at - std::floor(at)});
  }
  return chain;
}

// Squares of offsets in units of the noise, and ln N for each of three numbers of a piece; guides
// count for nothing, means for as many as they hold.
TEST(StructureScore, IsTheInformationCriterion) {
  const FitChain chain = line(2, 4);
  std::vector<FitPoint> points;
  for (int j = 0; j < 4; ++j) points.push_back({.position = {(j + 0.5) / 4, 0.1 * (j + 1)}});
  points[1].weight = 2;
  points[2].count = 5;
  const double noise = 0.2;
  const double squares = 0.01 + 2 * 0.04 + 0.09 + 0.16;
  EXPECT_NEAR(structure_score(chain, points, noise), squares / 0.04 + 3 * std::log(8) * 2, 1e-10);
  points[3].count = 0;
  EXPECT_NEAR(structure_score(chain, points, noise), (squares - 0.16) / 0.04 + 3 * std::log(7) * 2,
              1e-10);
}

/// Points of a chain with errors across it, and a chain of more pieces than it has.
struct Given {
  FitChain chain;
  std::vector<FitPoint> points;
};
Given noisy(const lac::Chain& truth, int pieces, int n, double noise) {
  numeric::Random random(4);
  Given g;
  g.chain.first_at_start = g.chain.last_at_end = true;
  for (const core::Point2 p : lac::sample(truth, n)) {
    g.points.push_back(
        {.position = {p.x + noise * random.normal(), p.y + noise * random.normal()}});
  }
  const double step = 1.0 / pieces;
  for (int i = 0; i <= pieces; ++i) {
    g.chain.joints.push_back({lac::evaluate(truth, i * step), lac::tangent_angle(truth, i * step),
                              lac::curvature(truth, i * step)});
    if (i < pieces) g.chain.pieces.push_back({.length = lac::arc_length(truth) * step});
  }
  for (int j = 0; j < n; ++j) {
    const double at = std::min(double(j) / (n - 1) * pieces, pieces - 1e-9);
    g.chain.feet.push_back({static_cast<int>(at), at - std::floor(at)});
  }
  return g;
}

TEST(ImproveStructure, LeavesOutJointsThatNoPointAsksFor) {
  Given g = noisy({{{0, 0}, 0}, {{-1, 1, 0.5, 2}}, false}, 4, 120, 1e-3);
  ChainSearchOptions options;
  options.accept = {.tolerance = 5e-3, .noise = 1e-3};
  options.threads = 1;
  const double before = structure_score(g.chain, g.points, 1e-3);
  EXPECT_TRUE(improve_structure(g.chain, g.points, options));
  EXPECT_EQ(g.chain.pieces.size(), 1U);
  EXPECT_LT(structure_score(g.chain, g.points, 1e-3), before);
}

TEST(ImproveStructure, KeepsAJointThatThePointsAskFor) {
  const lac::Chain truth{{{0, 0}, 0}, {{-1, 0.5, 0.5, 6}, {-1, 0.5, 6, 0.5}}, false};
  const Given g = noisy(truth, 2, 200, 1e-3);
  ChainSearchOptions options;
  options.accept = {.tolerance = 1e-2, .noise = 1e-3};
  options.threads = 1;
  FitChain two = g.chain;
  EXPECT_TRUE(improve_structure(two, g.points, options));
  EXPECT_EQ(two.pieces.size(), 2U);  // one piece cannot bend up and down again
}

TEST(ImproveStructure, ChainsThatAreNotAcceptedStay) {
  Given g = noisy({{{0, 0}, 0}, {{-1, 1, 0.5, 2}}, false}, 3, 120, 1e-3);
  ChainSearchOptions options;
  options.accept = {.tolerance = 1e-4, .noise = 1e-3};
  EXPECT_FALSE(improve_structure(g.chain, g.points, options));
  EXPECT_EQ(g.chain.pieces.size(), 3U);
}

}  // namespace
}  // namespace keyline::fairing::detail
