#include "keyline/fairing/rate_joints.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/lac/chain/chain.h"

/// Joints of one rate, of small chains whose rates are known.
namespace keyline::fairing::detail {
namespace {

/// Points on a chain laid out from these pieces, so many steps on each.
struct Given {
  FitChain chain;
  std::vector<FitPoint> points;
  explicit Given(const std::vector<lac::Piece>& pieces, int steps = 8) {
    const lac::Chain truth{{{0, 0}, 0.2}, pieces, false};
    const auto segments = lac::segments(truth);
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const lac::Segment& s = segments[i];
      chain.joints.push_back({s.start.position, s.start.direction, s.curvature_start});
      chain.pieces.push_back({.length = s.length, .alpha = s.alpha});
      for (int k = i == 0 ? 0 : 1; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        points.push_back({.position = lac::evaluate(s, t)});
        chain.feet.push_back({static_cast<int>(i), t});
      }
    }
    const core::Pose2 end = lac::end_pose(truth);
    chain.joints.push_back({end.position, end.direction, pieces.back().curvature_end});
    chain.first_at_start = chain.last_at_end = true;
  }
  RateReport join(double tolerance) {
    RateOptions options;
    options.tolerance = tolerance;
    return join_rates(chain, points, options);
  }
};

/// Logarithm of the rate's jump before a piece.
double jump_before(const FitChain& chain, int piece) {
  const auto of = [&](int p) {
    return lac::Piece{chain.pieces[p].alpha, chain.pieces[p].length, chain.joints[p].curvature,
                      chain.joints[p + 1].curvature};
  };
  return std::log(
      std::abs(lac::curvature_rate(of(piece - 1), 1) / lac::curvature_rate(of(piece), 0)));
}

/// Of joints that are of one rate.
int joined(const FitChain& chain) {
  int count = 0;
  for (int p = 1; p < static_cast<int>(chain.pieces.size()); ++p)
    count += std::abs(jump_before(chain, p)) < 1e-6;
  return count;
}

double farthest(const FitChain& chain, const std::vector<FitPoint>& points) {
  double most = 0;
  for (const double offset : offsets(chain, points)) most = std::max(most, std::abs(offset));
  return most;
}

TEST(JoinRates, ArcsHaveNoneAndOnePieceHasNoJoint) {
  Given arc({{-1, 0.5, 1, 2}, {-1, 0.5, 2, 2}});
  arc.chain.pieces[1].kind = PieceKind::arc;
  const RateReport none = arc.join(1e-3);
  EXPECT_FALSE(none.within);
  EXPECT_EQ(none.joints, 0);
  Given one({{-1, 1, 1, 2}});
  const RateReport single = one.join(1e-3);
  EXPECT_TRUE(single.within);
  EXPECT_EQ(single.missed, 0);
  EXPECT_TRUE(single.stay.empty());
}

// Parts of one piece are of one rate already.
TEST(JoinRates, PartsOfOnePieceAreJoined) {
  const lac::Piece whole{-0.5, 1, 1, 3};
  const double k = lac::curvature(whole, 0.4);
  Given g({{-0.5, 0.4, 1, k}, {-0.5, 0.6, k, 3}});
  const RateReport report = g.join(1e-3);
  EXPECT_TRUE(report.within);
  EXPECT_EQ(report.joints, 1);
  EXPECT_EQ(report.missed, 0);
  EXPECT_TRUE(report.stay.empty());
  EXPECT_EQ(joined(g.chain), 1);
  EXPECT_LE(farthest(g.chain, g.points), 1e-3);
}

// A rate that grows by a twentieth at a joint becomes one; feet are where they were.
TEST(JoinRates, AJumpGoesWhileThePointsStayNear) {
  Given g({{-1, 0.5, 1, 2}, {-1, 0.5, 2, 3.05}});
  const RateReport report = g.join(2e-3);
  EXPECT_TRUE(report.within);
  EXPECT_EQ(report.joints, static_cast<int>(g.chain.pieces.size()) - 1);
  EXPECT_EQ(report.missed, 0);
  EXPECT_EQ(joined(g.chain), report.joints);
  EXPECT_LE(farthest(g.chain, g.points), 2e-3);
  double before = -1;
  std::vector<double> starts{0};
  for (const FitPiece& piece : g.chain.pieces) starts.push_back(starts.back() + piece.length);
  for (std::size_t j = 0; j < g.points.size(); ++j) {
    const Foot& foot = g.chain.feet[j];
    const double along = starts[static_cast<std::size_t>(foot.piece)] +
                         foot.fraction * g.chain.pieces[foot.piece].length;
    EXPECT_GT(along, before);
    EXPECT_NEAR(along, static_cast<double>(j) / 16, 0.01);
    before = along;
  }
}

// Where two pieces do not come to one rate within the tolerance, those beside the jump are parted:
// of more pieces all joints are of one.
TEST(JoinRates, PiecesBesideAJumpArePartedWhereThatHelps) {
  for (const auto& [last, tolerance] : {std::pair{3.0, 8e-4}, {6.0, 6e-4}}) {
    Given g({{-1, 0.5, 1, 1.5}, {-1, 0.5, 1.5, last}});
    const RateReport report = g.join(tolerance);
    EXPECT_TRUE(report.within);
    EXPECT_EQ(g.chain.pieces.size(), 4U);
    EXPECT_EQ(report.joints, 3);
    EXPECT_EQ(report.missed, 0);
    EXPECT_EQ(joined(g.chain), 3);
    EXPECT_LE(farthest(g.chain, g.points), tolerance);
  }
}

/// Four parts of one piece, whose points err a little.
Given parts() {
  const lac::Piece whole{-0.5, 1, 1, 3};
  const auto k = [&](double t) { return lac::curvature(whole, t); };
  Given g({{-0.5, 0.25, 1, k(0.25)},
           {-0.5, 0.25, k(0.25), k(0.5)},
           {-0.5, 0.25, k(0.5), k(0.75)},
           {-0.5, 0.25, k(0.75), 3}});
  for (std::size_t j = 0; j < g.points.size(); ++j)
    g.points[j].position.y += 2e-4 * std::sin(7.0 * static_cast<double>(j));
  return g;
}

// Where no two may be held, by a rule of the test's own, all but one give way, each of them once:
// three chains are judged, with three ties, two and one.
TEST(JoinRates, TiesGiveWayOneByOne) {
  Given g = parts();
  RateOptions options;
  options.tolerance = 5e-3;
  int judged = 0;
  options.loses = [&](const FitChain& chain) {
    ++judged;
    return joined(chain) > 1 ? std::optional(RateLoss::waves) : std::nullopt;
  };
  const RateReport report = join_rates(g.chain, g.points, options);
  EXPECT_TRUE(report.within);
  ASSERT_EQ(report.joints, 3);
  EXPECT_EQ(judged, 3);
  EXPECT_EQ(report.missed, 2);
  EXPECT_EQ(joined(g.chain), 1);
  ASSERT_EQ(report.stay.size(), 2U);
  EXPECT_NE(report.stay[0].piece, report.stay[1].piece);
  for (const RateReport::Stay& stay : report.stay) {
    EXPECT_EQ(stay.loss, RateLoss::waves);
    EXPECT_GT(std::abs(jump_before(g.chain, stay.piece)), 1e-6);
  }
}

// Where none may be, none is, and why is told of each.
TEST(JoinRates, WhereNothingMayBeHeldNothingIs) {
  Given g = parts();
  RateOptions options;
  options.tolerance = 5e-3;
  options.loses = [](const FitChain&) { return std::optional(RateLoss::bounds); };
  const RateReport report = join_rates(g.chain, g.points, options);
  EXPECT_FALSE(report.within);
  EXPECT_EQ(report.missed, report.joints);
  ASSERT_EQ(report.stay.size(), 3U);
  for (const RateReport::Stay& stay : report.stay) EXPECT_EQ(stay.loss, RateLoss::bounds);
}

// Of a chain with one joint: tied with the others, then without it, then joint by joint in two
// passes, each of which makes the points outside dearer twice before it gives up. A judge who lets
// the last of these pass, and only that, has the joint.
TEST(JoinRates, PointsOutsideAreMadeDearerTwice) {
  const lac::Piece whole{-0.5, 1, 1, 3};
  const double k = lac::curvature(whole, 0.4);
  for (const int passes : {8, 9}) {
    Given g({{-0.5, 0.4, 1, k}, {-0.5, 0.6, k, 3}});
    RateOptions options;
    options.tolerance = 1e-3;
    int judged = 0;
    options.loses = [&](const FitChain&) {
      return ++judged < passes ? std::optional(RateLoss::tolerance) : std::nullopt;
    };
    const RateReport report = join_rates(g.chain, g.points, options);
    EXPECT_EQ(judged, 8);
    EXPECT_EQ(report.within, passes == 8);
    EXPECT_EQ(joined(g.chain) == 1 && report.missed == 0, passes == 8);
  }
}

// Clothoids of one rate but for one joint, where it jumps by a hundredth, which the points do not
// let go: that one gives way, not its neighbours.
TEST(JoinRates, TheTieThatIsStrainedMostGivesWay) {
  for (const int bad : {2, 4}) {
    std::vector<lac::Piece> pieces;
    double curvature = 1;
    for (int i = 0; i < 6; ++i) {
      const double next = curvature + 0.4 * (i < bad ? 1 : std::exp(0.01));
      pieces.push_back({-1, 0.2, curvature, next});
      curvature = next;
    }
    Given g(pieces, 12);
    const RateReport report = g.join(3e-6);
    EXPECT_TRUE(report.within);
    EXPECT_EQ(report.joints, 5);
    EXPECT_EQ(joined(g.chain), 4);
    ASSERT_EQ(report.stay.size(), 1U);
    EXPECT_EQ(report.stay[0].piece, bad);
    EXPECT_EQ(report.stay[0].loss, RateLoss::tolerance);
  }
}

}  // namespace
}  // namespace keyline::fairing::detail
