#include "keyline/fit/control_edges.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/curve/jet.h"

namespace keyline::fit {
namespace {

using core::Point2;
using core::Vector2;
using curve::PiecewiseBezier;

constexpr Point2 kStart{3, -2};

/// Random pieces; each starts in the last one's direction and, where `g2`, with its curvature.
std::vector<Edges> random_edges(std::mt19937& random, std::size_t pieces, bool g2) {
  std::uniform_real_distribution<double> bend(0.1, 0.5);
  std::uniform_real_distribution<double> length(0.4, 1.6);
  std::vector<Edges> all(pieces);
  double angle = 0.7;
  for (std::size_t i = 0; i < pieces; ++i)
    for (std::size_t n = 0; n < kEdges; ++n) {
      if (n > 0) angle += bend(random);
      all[i].direction[n] = core::unit_vector(angle);
      all[i].length[n] = length(random);
    }
  // kappa = 4/5 |e x f| / |e|^3 at an end with the edges e and f.
  for (std::size_t i = 1; g2 && i < pieces; ++i) {
    const Edges& a = all[i - 1];
    Edges& b = all[i];
    const double wanted =
        0.8 * a.length[3] * cross(a.direction[3], a.direction[4]) / (a.length[4] * a.length[4]);
    b.length[1] =
        wanted * b.length[0] * b.length[0] / (0.8 * cross(b.direction[0], b.direction[1]));
  }
  return all;
}

Eigen::VectorXd lengths_of(const std::vector<Edges>& edges) {
  Eigen::VectorXd a(static_cast<Eigen::Index>(kEdges * edges.size()));
  for (Eigen::Index k = 0; k < a.size(); ++k)
    a[k] = edges[static_cast<std::size_t>(k) / kEdges].length[static_cast<std::size_t>(k) % kEdges];
  return a;
}

/// A move of the unknowns with which a held end can still be reached.
Eigen::VectorXd moved(Eigen::VectorXd x, std::mt19937& random) {
  std::uniform_real_distribution<double> by(-0.02, 0.02);
  for (double& v : x) v += by(random);
  return x;
}

TEST(ControlEdges, AreThoseOfTheCurve) {
  std::mt19937 random(1);
  const std::vector<Edges> edges = random_edges(random, 3, false);
  const PiecewiseBezier chain = chain_of(kStart, edges, lengths_of(edges));
  EXPECT_EQ(chain.pieces.front().control.front(), kStart);
  Point2 p = kStart;
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(chain.pieces[i].control.size(), 6u);
    for (std::size_t n = 0; n < kEdges; ++n) {
      p = p + edges[i].length[n] * edges[i].direction[n];
      EXPECT_LT(distance(chain.pieces[i].control[n + 1], p), 1e-14);
    }
  }
  const auto again = edges_of(chain);
  ASSERT_TRUE(again);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t n = 0; n < kEdges; ++n) {
      EXPECT_NEAR((*again)[i].length[n], edges[i].length[n], 1e-14);
      EXPECT_LT(norm((*again)[i].direction[n] - edges[i].direction[n]), 1e-14);
    }
}

TEST(ControlEdges, HaveALengthHoweverShort) {
  std::mt19937 random(2);
  std::vector<Edges> edges = random_edges(random, 2, false);
  edges[1].length[3] = 1e-9;
  EXPECT_TRUE(edges_of(chain_of({0, 0}, edges, lengths_of(edges))));
  edges[1].length[3] = 0;
  const auto none = edges_of(chain_of({0, 0}, edges, lengths_of(edges)));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, core::ErrorCode::bad_input);
  EXPECT_EQ(none.error().path, "curve.curves[1]");
}

TEST(ControlEdges, CurvatureIsThatOfTheCurveAndItsGradientIsThatOfDifferences) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<Edges> edges = random_edges(random, 1, false);
    const PiecewiseBezier chain = chain_of(kStart, edges, lengths_of(edges));
    for (const double u : {0.0, 0.1, 0.37, 0.5, 0.9, 1.0}) {
      std::array<double, kEdges> gradient;
      const double k = curvature_with_gradient(edges[0], u, &gradient);
      EXPECT_NEAR(k, curvature(jet(chain.pieces[0], u)), 1e-13 * (1 + std::abs(k)));
      EXPECT_EQ(curvature_with_gradient(edges[0], u, nullptr), k);
      for (std::size_t n = 0; n < kEdges; ++n) {
        constexpr double kStep = 1e-5;
        std::array<Edges, 2> beside{edges[0], edges[0]};
        beside[0].length[n] -= kStep;
        beside[1].length[n] += kStep;
        const double slope = (curvature_with_gradient(beside[1], u, nullptr) -
                              curvature_with_gradient(beside[0], u, nullptr)) /
                             (2 * kStep);
        EXPECT_NEAR(gradient[n], slope, 1e-7 * (1 + std::abs(slope))) << u << " " << n;
      }
    }
  }
}

struct Freedom {
  const char* name;
  bool g2;
  FreeLengths::Held held;
  Eigen::Index free;  ///< of three pieces: 15, a joint takes one, an end that is held two
};
constexpr Freedom kFreedoms[] = {
    {"all free", false, {}, 15},
    {"joints", true, {}, 13},
    {"held", true, {.end = true}, 11},
    {"ends fixed", true, {.outermost = true}, 9},
    {"both", true, {.end = true, .outermost = true}, 7},
    {"closed", true, {.closed = true}, 11},
};

TEST(FreeLengths, StartWhereTheyAre) {
  std::mt19937 random(4);
  for (const Freedom& f : kFreedoms) {
    SCOPED_TRACE(f.name);
    const std::vector<Edges> edges = random_edges(random, 3, f.g2);
    const FreeLengths free(edges, f.held);
    EXPECT_TRUE(free.can_hold());
    EXPECT_EQ(free.size(), f.free);
    Eigen::VectorXd a;
    ASSERT_TRUE(free.expand(free.unknowns(), a, nullptr));
    EXPECT_LT((a - lengths_of(edges)).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(FreeLengths, KeepJointsEndsAndWhatIsFixed) {
  std::mt19937 random(5);
  for (const Freedom& f : kFreedoms) {
    SCOPED_TRACE(f.name);
    const std::vector<Edges> edges = random_edges(random, 3, f.g2);
    const FreeLengths free(edges, f.held);
    Eigen::VectorXd a;
    ASSERT_TRUE(free.expand(moved(free.unknowns(), random), a, nullptr));
    EXPECT_GT(a.minCoeff(), 0);
    const Eigen::VectorXd before = lengths_of(edges);
    const PiecewiseBezier chain = chain_of(kStart, edges, a);
    for (std::size_t i = 1; f.g2 && i < 3; ++i) {
      EXPECT_NEAR(curvature(jet(chain.pieces[i - 1], 1)), curvature(jet(chain.pieces[i], 0)),
                  1e-12);
    }
    if (f.held.end || f.held.closed) {
      EXPECT_LT(distance(chain.pieces.back().control.back(),
                         chain_of(kStart, edges, before).pieces.back().control.back()),
                1e-13);
    }
    for (const Eigen::Index k : {0, 1, 13, 14}) {
      if (f.held.outermost) {
        EXPECT_EQ(a[k], before[k]);
      }
    }
  }
}

TEST(FreeLengths, SlopesAreThoseOfDifferences) {
  std::mt19937 random(6);
  for (const Freedom& f : kFreedoms) {
    SCOPED_TRACE(f.name);
    const FreeLengths free(random_edges(random, 3, f.g2), f.held);
    const Eigen::VectorXd x = moved(free.unknowns(), random);
    Eigen::VectorXd a, less, more;
    RowMatrix by_x;
    ASSERT_TRUE(free.expand(x, a, &by_x));
    ASSERT_EQ(by_x.rows(), 15);
    ASSERT_EQ(by_x.cols(), free.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      constexpr double kStep = 1e-5;
      Eigen::VectorXd beside = x;
      beside[k] = x[k] - kStep;
      ASSERT_TRUE(free.expand(beside, less, nullptr));
      beside[k] = x[k] + kStep;
      ASSERT_TRUE(free.expand(beside, more, nullptr));
      EXPECT_LT(((more - less) / (2 * kStep) - by_x.col(k)).cwiseAbs().maxCoeff(), 1e-8);
    }
  }
}

/// A closed oval: its last joint is one as all the others.
TEST(FreeLengths, OfAClosedChainKeepTheLastJointToo) {
  constexpr double kAngles[2][kEdges] = {{0, 0.3, 1.9, 2, core::kPi},
                                         {0, 0.5, 1.4, 2.6, core::kPi}};
  std::vector<Edges> edges(2);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t n = 0; n < kEdges; ++n) {
      edges[i].direction[n] = core::unit_vector(kAngles[i][n] + (i == 0 ? 0 : core::kPi));
      edges[i].length[n] = 1;
    }
  Vector2 rest;  // what the middle edges have to make good
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& d = edges[i].direction;
    const auto& before = edges[1 - i].direction;
    edges[i].length[1] = cross(before[3], before[4]) / cross(d[0], d[1]);
    for (const std::size_t n : {0, 1, 3, 4}) rest = rest - edges[i].length[n] * d[n];
  }
  const Vector2 a = edges[0].direction[2], b = edges[1].direction[2];
  edges[0].length[2] = cross(rest, b) / cross(a, b);
  edges[1].length[2] = cross(a, rest) / cross(a, b);
  const FreeLengths free(edges, {.closed = true});
  EXPECT_EQ(free.size(), 6);  // of 10: two joints and the end
  std::mt19937 random(7);
  Eigen::VectorXd lengths;
  ASSERT_TRUE(free.expand(moved(free.unknowns(), random), lengths, nullptr));
  const PiecewiseBezier chain = chain_of(kStart, edges, lengths);
  EXPECT_LT(distance(chain.pieces[1].control[5], kStart), 1e-13);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(curvature(jet(chain.pieces[i], 1)), curvature(jet(chain.pieces[1 - i], 0)), 1e-12);
}

TEST(FreeLengths, OfJointsThatAreNotG2StayFree) {
  std::mt19937 random(8);
  std::vector<Edges> edges = random_edges(random, 2, true);
  EXPECT_EQ(FreeLengths(edges, {}).size(), 9);
  edges[1].length[1] *= 1.01;  // curvature, too
  EXPECT_EQ(FreeLengths(edges, {}).size(), 10);
  edges[1].length[1] /= 1.01;
  const double corner = 0.3;
  for (auto& d : edges[1].direction) d = core::rotate_ccw(d, corner);
  EXPECT_EQ(FreeLengths(edges, {}).size(), 10);
}

TEST(FreeLengths, OfALineHoldNoEnd) {
  std::vector<Edges> edges(1);
  for (std::size_t n = 0; n < kEdges; ++n) {
    edges[0].direction[n] = {1, 0};
    edges[0].length[n] = 1;
  }
  EXPECT_FALSE(FreeLengths(edges, {.end = true}).can_hold());
  EXPECT_TRUE(FreeLengths(edges, {}).can_hold());
}

TEST(FreeLengths, RefuseWhatLeavesALengthNone) {
  std::mt19937 random(9);
  const FreeLengths free(random_edges(random, 2, true), {.end = true});
  Eigen::VectorXd a;
  for (Eigen::Index k = 0; k < free.size(); ++k) {
    Eigen::VectorXd x = free.unknowns();
    x[k] = 601;
    EXPECT_FALSE(free.expand(x, a, nullptr));
    x[k] = -601;
    EXPECT_FALSE(free.expand(x, a, nullptr));
  }
  // All lengths but the two that hold the end tenfold: one of those would have to run backwards.
  Eigen::VectorXd x = free.unknowns();
  for (double& v : x) v += std::log(10.0);
  EXPECT_FALSE(free.expand(x, a, nullptr));
}

}  // namespace
}  // namespace keyline::fit
