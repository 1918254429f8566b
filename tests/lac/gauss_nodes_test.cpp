#include "keyline/lac/lanes/gauss_nodes.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keyline/lac/lanes/chord_lanes.h"

namespace keyline::lac::detail {
namespace {

// A rule of n nodes takes degree 2 n - 1 to rounding, and not degree 2 n where that is not far
// below.
TEST(GaussNodes, AreOfTheirCount) {
  for (const int n : {8, 12, 16, 24, 32}) {
    const GaussNodes& rule = gauss_nodes(n);
    for (const int degree : {0, 1, n, 2 * n - 1}) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
      EXPECT_NEAR(sum * (degree + 1), 1, 1e-14) << n << ' ' << degree;
    }
    EXPECT_GT(rule.nodes[0], 0);
    EXPECT_LT(rule.nodes[n - 1], 1);
  }
  // Asked for more than a rule has, the next one serves.
  EXPECT_EQ(&gauss_nodes(9), &gauss_nodes(12));
  EXPECT_EQ(&gauss_nodes(13), &gauss_nodes(16));
  EXPECT_EQ(&gauss_nodes(17), &gauss_nodes(24));
  EXPECT_EQ(&gauss_nodes(25), &gauss_nodes(32));
  EXPECT_NE(&gauss_nodes(8), &gauss_nodes(12));
}

TEST(ChordLanes, NodesGrowWithTheReach) {
  const auto grows = [](auto nodes, double most) {
    int last = 0;
    for (double reach = 0; reach < most; reach += 0.01) {
      EXPECT_GE(nodes(reach), last);
      last = nodes(reach);
    }
    return last;
  };
  EXPECT_EQ(grows(nodes_for, 16), 32);
  EXPECT_EQ(grows(rough_nodes_for, 16), 24);
  for (double reach = 0; reach < 16; reach += 0.1)
    EXPECT_LE(rough_nodes_for(reach), nodes_for(reach));
}

/// The sums of a panel by Simpson's rule.
PanelSums simpson(const PanelJob& job) {
  constexpr int kSteps = 4000;
  PanelSums sum;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = job.from + job.width * i / kSteps;
    const double w = (i == 0 || i == kSteps ? 1 : i % 2 ? 4 : 2) / (3.0 * kSteps) * job.width;
    const double total = job.b == 0 ? x : -std::expm1(-job.b * x) / job.b;
    const double angle = job.scale * total;
    const double f = w * std::exp(-job.a * x);
    const double c = f * std::cos(angle - job.centre), s = f * std::sin(angle - job.centre);
    sum.x += c;
    sum.y += s;
    sum.angle_x += angle * c;
    sum.angle_y += angle * s;
  }
  return sum;
}

// With the nodes that its reach asks for a panel is right to rounding.
TEST(ChordLanes, PanelsAreTheirIntegrals) {
  for (const double a : {0.0, 0.4, 3.0})
    for (const double b : {-0.6, 0.0, 1.4, 4.0})
      for (const double from : {0.0, 0.5})
        for (const double width : {0.3, 0.8}) {
          const auto total = [&](double x) { return b == 0 ? x : -std::expm1(-b * x) / b; };
          PanelJob job{a, b, from, width, 1.2, 0, 16};
          const double low = job.scale * total(from), high = job.scale * total(from + width);
          job.centre = 0.5 * (low + high);
          job.nodes = nodes_for(std::max(a, std::abs(b)) * width + std::abs(high - low));
          const PanelSums found = panel_sums(job), meant = simpson(job);
          EXPECT_NEAR(found.x, meant.x, 1e-13);
          EXPECT_NEAR(found.y, meant.y, 1e-13);
          EXPECT_NEAR(found.angle_x, meant.angle_x, 1e-13);
          EXPECT_NEAR(found.angle_y, meant.angle_y, 1e-13);
        }
}

// Just below each bound the count still carries a panel to 1e-13, whatever part of its reach is
// decay and what turning; far beyond it no longer does.
TEST(ChordLanes, CountsAreNoneTooFew) {
  const auto error = [](double reach, int nodes) {
    double most = 0;
    for (const double turn : {0.2, 0.5, 0.8}) {
      // Of the reach a part is decay and the rest turning.
      PanelJob job{(1 - turn) * reach, 0, 0, 1, turn * reach, 0.5 * turn * reach, nodes};
      const PanelSums found = panel_sums(job), meant = simpson(job);
      most = std::max({most, std::abs(found.x - meant.x), std::abs(found.y - meant.y)});
    }
    return most;
  };
  for (const double reach : {1.39, 3.29, 5.19}) EXPECT_LT(error(reach, nodes_for(reach)), 1e-13);
  EXPECT_GT(error(8.0, 12), 1e-13);
}

}  // namespace
}  // namespace keyline::lac::detail
