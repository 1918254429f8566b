#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "keyline/fit/chain_data.h"
#include "keyline/fit/quintic_chain.h"
#include "keyline/fit/quintic_joints.h"
#include "keyline/fit/quintic_normal.h"
#include "keyline/fit/quintic_rate.h"
#include "keyline/fit/quintic_room.h"
#include "keyline/fit/quintic_solver.h"

namespace keyline::fit {
namespace {

using core::Point2;

/// A line a pixel per point, by its curvature, each point moved across at random by up to `noise`.
template <class Curvature>
std::vector<Point2> drawn(int length, double noise, Curvature curvature) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> off(-noise, noise);
  std::vector<Point2> points;
  Point2 p;
  double angle = 0;
  for (int i = 0; i <= 100 * length; ++i) {
    if (i % 100 == 0)
      points.push_back(p + off(random) * core::Vector2{-std::sin(angle), std::cos(angle)});
    p = p + 0.01 * core::Vector2{std::cos(angle), std::sin(angle)};
    angle += 0.01 * curvature(0.01 * i);
  }
  return points;
}

struct Comb {
  double length = 0, variation = 0, farthest = 0;
};

/// Straight from places: differences of the pieces' curvature, chords for the length.
Comb comb_of(const std::vector<curve::Bezier2>& pieces, const std::vector<Point2>& points = {}) {
  constexpr int kParts = 4000;
  Comb comb;
  std::vector<Point2> places;
  for (const curve::Bezier2& piece : pieces)
    for (int k = 0; k < kParts; ++k) {
      const double t = static_cast<double>(k) / kParts;
      const double u = static_cast<double>(k + 1) / kParts;
      const double step = core::distance(evaluate(piece, t), evaluate(piece, u));
      const double change = curvature(jet(piece, u)) - curvature(jet(piece, t));
      comb.length += step;
      comb.variation += change * change / step;
      places.push_back(evaluate(piece, t));
    }
  places.push_back(evaluate(pieces.back(), 1));
  comb.variation *= std::pow(comb.length, 3);
  for (const Point2 p : points) {
    double nearest = HUGE_VAL;
    for (const Point2 q : places) nearest = std::min(nearest, core::distance(p, q));
    comb.farthest = std::max(comb.farthest, nearest);
  }
  return comb;
}

TEST(CalmChain, CalmIsAnArcWhereOneLiesWithinTheTolerance) {
  const auto points = drawn(300, 0.3, [](double) { return 0.01; });
  const QuinticChain plain = fit_quintic_chain(points, false, {0.5, 48});
  const QuinticChain calm = fit_quintic_chain(points, false, {0.5, 48, true});
  ASSERT_TRUE(plain.within_tolerance && calm.within_tolerance);
  EXPECT_GT(comb_of(plain.pieces).variation, 0.1);
  EXPECT_LT(comb_of(calm.pieces).variation, 1e-2);  // of an arc 0
  EXPECT_LE(comb_of(calm.pieces, points).farthest, 0.5 + 1e-3);
}

TEST(CalmChain, CalmHasNoMoreThanTheClothoidTheLineWasDrawnBy) {
  const double rate = 0.02 / 400;
  const auto points = drawn(400, 0.3, [&](double s) { return rate * s; });
  const QuinticChain calm = fit_quintic_chain(points, false, {0.5, 48, true});
  ASSERT_TRUE(calm.within_tolerance);
  // the clothoid lies within the tolerance, its variation is rate² L⁴
  EXPECT_LE(comb_of(calm.pieces).variation, 1.05 * rate * rate * std::pow(400, 4));
  EXPECT_LE(comb_of(calm.pieces, points).farthest, 0.5 + 1e-3);
}

TEST(CalmChain, ANeedleOfOnePlaceGoesWhereTheToleranceAllowsIt) {
  auto points = drawn(600, 0, [](double s) { return 0.001 + 0.008 / 600 * s; });
  points[300].y += 0.4;
  const QuinticChain calm = fit_quintic_chain(points, false, {0.5, 48, true});
  ASSERT_TRUE(calm.within_tolerance);
  EXPECT_LE(comb_of(calm.pieces).variation, 1.05 * std::pow(0.008 / 600, 2) * std::pow(600, 4));
}

// A circle half way between both radii has no variation; least squares lie 0.7 too far inside.
TEST(CalmChain, PointsAtTheRimOfTheTolerancePullHarder) {
  std::vector<Point2> points;
  for (int i = 0; i < 628; ++i) {
    const double radius = i < 100 ? 100.85 : 100;
    points.push_back({radius * std::cos(0.01 * i), radius * std::sin(0.01 * i)});
  }
  const QuinticChain calm = fit_quintic_chain(points, true, {0.5, 48, true});
  ASSERT_TRUE(calm.within_tolerance);
  EXPECT_LT(comb_of(calm.pieces).variation, 1e-2);
}

/// A straight line whose last point lies 0.4 aside.
TEST(CalmChain, AFreeEndGoesWhereTheLineDoes) {
  auto points = drawn(200, 0, [](double) { return 0.0; });
  points.back().y += 0.4;
  const QuinticChainOptions held = {.tolerance = 0.5, .calm = true};
  QuinticChainOptions free = held;
  free.free_end = true;
  const QuinticChain exact = fit_quintic_chain(points, false, held);
  const QuinticChain near = fit_quintic_chain(points, false, free);
  ASSERT_TRUE(exact.within_tolerance && near.within_tolerance);
  EXPECT_EQ(exact.pieces.back().control.back(), points.back());
  EXPECT_EQ(near.pieces.front().control.front(), points.front());
  EXPECT_LE(core::distance(near.pieces.back().control.back(), points.back()), 0.5);
  EXPECT_LT(comb_of(near.pieces).variation, 1e-2);
}

TEST(CalmChain, JointsOfACalmChainStayG2) {
  const auto points = drawn(500, 0.4, [](double s) { return 0.02 * std::sin(s / 40); });
  const auto pieces = fit_quintic_chain(points, false, {0.5, 48, true}).pieces;
  ASSERT_GT(pieces.size(), 1);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const auto before = jet(pieces[i - 1], 1);
    const auto after = jet(pieces[i], 0);
    EXPECT_EQ(pieces[i - 1].control.back(), pieces[i].control.front());
    EXPECT_NEAR(curvature(before), curvature(after), 1e-9);
  }
}

TEST(QuinticSolver, VariationIsThatOfThePiecesItReturns) {
  const auto points = drawn(300, 0.2, [](double s) { return 0.02 * std::cos(s / 60); });
  const ChainData data = prepare_chain_data(points, false);
  QuinticSolver solver(data, false, joint_indices(data, 3), {.tolerance = 1});
  solver.run();
  const Comb comb = comb_of(solver.result().pieces);
  const double scale = std::pow(data.length.back() / comb.length, 3);  // of the data: longer
  EXPECT_NEAR(solver.variation() / (scale * comb.variation), 1, 3e-3);
}

/// Sums of a few places and a row, beside the same summed one by one in the unknowns.
TEST(QuinticNormal, GathersWhatEachPlaceAsksFor) {
  JointedQuintics chain;
  chain.joints = {{{1, 2}, 0.3, 0.05}, {{20, 9}, 0.9, -0.02}};
  chain.lengths = {{4, 5, 3.5, 4.5}};
  const JointedQuintic piece = piece_of(chain, 0);
  constexpr double kPrice = 3;
  QuinticNormal sums;
  QuinticNormal::Matrix wanted_matrix = QuinticNormal::Matrix::Zero();
  QuinticNormal::Row wanted_row = QuinticNormal::Row::Zero();
  for (const double t : {0.0, 0.2, 0.55, 1.0}) {
    const core::Vector2 across = {std::cos(3 * t), std::sin(3 * t)};
    sums.add_place(t, across, 1 + t, 2 - t);
    const QuinticRow slopes = sensitivity(piece, place_weights(t));
    QuinticNormal::Row row;
    for (std::size_t c = 0; c < 12; ++c) row[static_cast<Eigen::Index>(c)] = dot(slopes[c], across);
    wanted_matrix += kPrice * (1 + t) * row * row.transpose();
    wanted_row += kPrice * (2 - t) * row;
  }
  const QuinticWeights weights = second_weights(0.4);
  std::array<core::Vector2, 6> by;
  for (std::size_t k = 0; k < 6; ++k) by[k] = weights[k] * core::Vector2{0.6, -0.8};
  sums.add_row(by, 7);
  const QuinticRow slopes = sensitivity(piece, weights);
  QuinticNormal::Row row;
  for (std::size_t c = 0; c < 12; ++c)
    row[static_cast<Eigen::Index>(c)] = dot(slopes[c], {0.6, -0.8});
  wanted_matrix += row * row.transpose();
  wanted_row += 7 * row;
  QuinticNormal::Matrix matrix;
  QuinticNormal::Row wanted;
  sums.gather(piece, kPrice, matrix, wanted);
  EXPECT_LT((matrix - wanted_matrix).norm(), 1e-12 * wanted_matrix.norm());
  EXPECT_LT((wanted - wanted_row).norm(), 1e-12 * wanted_row.norm());
}

/// Slope and second derivative of half the cost, beside differences; many places at once.
TEST(ToleranceRoom, CostsMinusTheLogarithmOfWhatIsLeft) {
  const auto cost = [](double d) {
    ToleranceRoom room;
    EXPECT_TRUE(room.add(d * d));
    return room.cost();
  };
  for (const double d : {0.1, 0.5, 0.9}) {
    ToleranceRoom room;
    ASSERT_TRUE(room.add(d * d));
    const double h = 1e-4;
    EXPECT_NEAR(room.pull() * d, (cost(d + h) - cost(d - h)) / (4 * h), 1e-5);
    EXPECT_NEAR(room.stiffness(), (cost(d + h) - 2 * cost(d) + cost(d - h)) / (2 * h * h), 1e-3);
    EXPECT_NEAR(room.gap(), 2 * room.pull() * d * (1 - d), 1e-12);
  }
  ToleranceRoom room;
  for (int i = 0; i < 5000; ++i) ASSERT_TRUE(room.add(0.9));
  EXPECT_NEAR(room.cost(), -5000 * std::log(0.1), 1e-6);
  EXPECT_FALSE(room.add(1));
}

/// The value and its change with every unknown, beside differences.
TEST(QuinticRate, ChangesAsItsSlopesSay) {
  JointedQuintics chain;
  chain.joints = {{{1, 2}, 0.3, 0.05}, {{20, 9}, 0.9, -0.02}};
  chain.lengths = {{4, 5, 3.5, 4.5}};
  for (const std::size_t at : {0UL, 9UL, 20UL}) {
    const RatePlace& node = rate_nodes()[at];
    const auto rate = [&](const JointedQuintics& of) { return rate_at(piece_of(of, 0), node); };
    const RateNode here = rate(chain);
    const QuinticRow first = sensitivity(piece_of(chain, 0), node.first);
    const QuinticRow second = sensitivity(piece_of(chain, 0), node.second);
    const QuinticRow third = sensitivity(piece_of(chain, 0), node.third);
    const auto slope_by = [&](double QuinticLengths::* length) {
      JointedQuintics more = chain;
      JointedQuintics less = chain;
      more.lengths[0].*length += 1e-5;
      less.lengths[0].*length -= 1e-5;
      return (rate(more).value - rate(less).value) / 2e-5;
    };
    const std::array lengths = {&QuinticLengths::a, &QuinticLengths::b, &QuinticLengths::c,
                                &QuinticLengths::d};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t c = 4 + k;
      const double told = dot(first[c], here.by_first) + dot(second[c], here.by_second) +
                          dot(third[c], here.by_third);
      EXPECT_NEAR(told, slope_by(lengths[k]), 1e-7) << at << ' ' << k;
    }
  }
}

/// Three weighted sums and the change of each by every unknown, beside differences.
TEST(JointedQuintics, SensitivityIsTheSlopeOfEverySum) {
  JointedQuintics chain;
  chain.joints = {{{1, 2}, 0.3, 0.05}, {{20, 9}, 0.9, -0.02}};
  chain.lengths = {{4, 5, 3.5, 4.5}};
  for (const QuinticWeights& weights :
       {place_weights(0.3), first_weights(0.6), second_weights(0.2), third_weights(0.7)}) {
    const QuinticRow row = sensitivity(piece_of(chain, 0), weights);
    const auto unknowns = [](JointedQuintics& of) -> std::array<double*, 12> {
      QuinticJoint& p = of.joints[0];
      QuinticJoint& q = of.joints[1];
      QuinticLengths& l = of.lengths[0];
      return {&p.place.x, &p.place.y, &p.direction, &p.curvature, &l.a,         &l.b,
              &l.c,       &l.d,       &q.place.x,   &q.place.y,   &q.direction, &q.curvature};
    };
    for (std::size_t c = 0; c < 12; ++c) {
      const auto moved = [&](double by) {
        JointedQuintics other = chain;
        *unknowns(other)[c] += by;
        return weighted(piece_of(other, 0).control, weights);
      };
      const core::Vector2 slope = (moved(1e-5) - moved(-1e-5)) / 2e-5;
      EXPECT_NEAR(row[c].x, slope.x, 1e-6 * (1 + std::abs(slope.x))) << c;
      EXPECT_NEAR(row[c].y, slope.y, 1e-6 * (1 + std::abs(slope.y))) << c;
    }
  }
}

TEST(JointedQuintics, WeightsAreDerivativesOfEachOther) {
  const QuinticHandles control = {{{0, 0}, {1, 2}, {3, -1}, {4, 5}, {7, 2}, {8, 8}}};
  const auto slope = [&](auto weights, double t) {
    return (weighted(control, weights(t + 1e-5)) - weighted(control, weights(t - 1e-5))) / 2e-5;
  };
  for (const double t : {0.1, 0.45, 0.8}) {
    const auto near = [](core::Vector2 a, core::Vector2 b) {
      EXPECT_NEAR(a.x, b.x, 1e-5 * (1 + std::abs(b.x)));
      EXPECT_NEAR(a.y, b.y, 1e-5 * (1 + std::abs(b.y)));
    };
    near(weighted(control, first_weights(t)), slope(place_weights, t));
    near(weighted(control, second_weights(t)), slope(first_weights, t));
    near(weighted(control, third_weights(t)), slope(second_weights, t));
    const curve::Bezier2 piece{{control.begin(), control.end()}, {}};
    near(place(control, t) - Point2{}, evaluate(piece, t) - Point2{});
  }
}

}  // namespace
}  // namespace keyline::fit
