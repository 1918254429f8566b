#include "keyline/classa/cav.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/classa/farin.h"
#include "keyline/classa/strain_energy.h"
#include "keyline/core/angle.h"
#include "keyline/core/similarity.h"
#include "keyline/numeric/random.h"

namespace keyline::classa {
namespace {

using core::ErrorCode;
using core::kPi;
using core::Point2;
using core::Point3;

const MatrixCurve kOya{{0, 0}, {1, 2}, 1, {kPi / 4, 1.05}, 3};

CavOptions with_end_tolerance(double tolerance) {
  CavOptions options;
  options.end_tolerance = tolerance;
  return options;
}

TEST(Cav, ExampleOfThePaper) {  // [Oya] section 4.1
  const auto value = cav(kOya, with_end_tolerance(0.01));
  ASSERT_TRUE(value) << value.error().message;
  EXPECT_EQ(value->type, 3);
  EXPECT_NEAR(value->matrix->alpha, kPi / 4, 1e-15);
  EXPECT_NEAR(value->matrix->s, 1.05, 1e-15);
  EXPECT_NEAR(value->energy, 0.3925273087800361, 1e-10);
  ASSERT_TRUE(value->minimum);
  EXPECT_NEAR(value->minimum->alpha, 0.64737420, 2e-8);
  EXPECT_NEAR(value->minimum->s, 1.44038877, 2e-8);
  EXPECT_NEAR(value->minimum->beta, 0.64347980, 2e-8);
  EXPECT_NEAR(value->minimum->energy, 0.32873049786, 1e-10);
  const double l = std::hypot(kPi / 4 - value->minimum->alpha, 1.05 - value->minimum->s);
  EXPECT_NEAR(value->cav, diagonals(kDefaultAlphaMax).boundary * (1 + l), 1e-12);
  EXPECT_EQ(value->monotone.answer, curve::MonotoneVerdict::no);
}

TEST(Cav, DiagonalsGiveEquation10) {
  const Diagonals d = diagonals(kDefaultAlphaMax);
  EXPECT_EQ(std::round(8 * std::pow(d.boundary * d.plane, 2)), 110);
  EXPECT_EQ(std::round(8 * std::pow(d.boundary * d.plane, 3)), 407);
}

TEST(Cav, TypesOfTable1) {
  const auto minimum = minimum_energy({.chord = {4, 3}, .degree = 4});
  ASSERT_TRUE(minimum);
  const MatrixCurve best{{1, 1}, {1, 0}, minimum->beta, {minimum->alpha, minimum->s}, 4};
  const auto one = cav(best, with_end_tolerance(0));
  ASSERT_TRUE(one) << one.error().message;
  EXPECT_EQ(one->type, 1);
  EXPECT_EQ(one->cav, 0);
  const auto two = cav(MatrixCurve{{0, 0}, {1, 0}, 2, {0.5, 1.6}, 3});
  ASSERT_TRUE(two);
  EXPECT_EQ(two->type, 2);
  EXPECT_GT(two->cav, 0);
  EXPECT_EQ(two->monotone.answer, curve::MonotoneVerdict::yes);
  const auto four = cav(curve::Bezier2{{{0, 0}, {1, 0}, {2, 0.5}, {2.5, 2}}, {}});
  ASSERT_TRUE(four);
  EXPECT_EQ(four->type, 4);
  EXPECT_NEAR(four->cav, 13.74, 0.01);
  EXPECT_FALSE(four->matrix);
  const auto s_shaped = cav(curve::Bezier2{{{0, 0}, {1, 0}, {2, 1}, {3, 1}}, {}});
  ASSERT_TRUE(s_shaped);
  EXPECT_EQ(s_shaped->type, 5);
  EXPECT_NEAR(s_shaped->cav, 50.9, 0.1);
  const auto sharp = cav(curve::Bezier2{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}});  // alpha = pi/2
  ASSERT_TRUE(sharp);
  EXPECT_EQ(sharp->type, 5);
  const auto zero_edge = cav(curve::Bezier2{{{0, 0}, {1, 0}, {1, 0}, {2, 1}}, {}});
  ASSERT_TRUE(zero_edge);
  EXPECT_EQ(zero_edge->type, 5);
}

// Tab. 2 of [Oya]: the CAV of a Class A curve with one matrix is its distance from the minimum in
// the plane of alpha and s; here the minimum is given, and the distance (0.3, 0.4) by hand.
TEST(Cav, OfClassAIsTheDistanceInThePlane) {
  CavOptions options;
  options.minimum = EnergyMinimum{0.2, 1.2, 1, 1, {1, 0}, true};
  const auto value = cav(MatrixCurve{{0, 0}, {1, 0}, 2, {0.5, 1.6}, 3}, options);
  ASSERT_TRUE(value) << value.error().message;
  EXPECT_EQ(value->type, 2);
  EXPECT_NEAR(value->cav, 0.5, 1e-12);
}

// By default the end may lie 0.01 of the chord away. The energy falls as the end is let go, so that
// the minimum uses all of it.
TEST(Cav, EndMayLieAHundredthOfTheChordAway) {
  const auto value = cav(kOya);
  ASSERT_TRUE(value && value->minimum);
  const curve::Bezier2 c = to_bezier(kOya);
  const core::Vector2 chord = c.control.back() - c.control.front();
  EXPECT_NEAR(norm(value->minimum->chord - chord) / norm(chord), 0.01, 1e-6);
}

TEST(Cav, ReversingAndMovingChangeNothing) {
  numeric::Random random(7);
  for (int i = 0; i < 60; ++i) {
    MatrixCurve c{{random.uniform(-5, 5), 2}, {1, random.uniform(-2, 2)}, 2.5, {}, 3};
    c.matrix = {random.uniform(-1, 1), random.uniform(0.5, 2.2)};
    c.degree = 2 + static_cast<int>(random.index(5));
    curve::Bezier2 bezier = to_bezier(c);
    if (i % 3 == 0) bezier.control[1].x += 0.2;
    const auto value = cav(bezier);
    ASSERT_TRUE(value) << value.error().message;
    const core::Similarity2 map{3.7, random.uniform(-3, 3), {100, -20}};
    for (const auto& other : {reverse(bezier), transform(bezier, map)}) {
      const auto again = cav(other);
      ASSERT_TRUE(again);
      EXPECT_EQ(again->type, value->type);
      EXPECT_NEAR(again->cav, value->cav, 1e-5);
      ASSERT_EQ(again->minimum.has_value(), value->minimum.has_value());
      if (value->minimum) {
        EXPECT_NEAR(again->minimum->s, value->minimum->s, 1e-5);
      }
    }
  }
}

TEST(Cav, LiteralDirectionUsesTheFallingBranch) {
  const MatrixCurve shrinking{{0, 0}, {1, 0}, 1, {0.5, 0.7}, 3};
  CavOptions options;
  options.direction = Direction::as_given;
  const auto literal = cav(shrinking, options);
  ASSERT_TRUE(literal);
  EXPECT_FALSE(literal->reversed);
  EXPECT_EQ(literal->type, 2);
  EXPECT_NEAR(literal->matrix->s, 0.7, 1e-14);
  EXPECT_LE(literal->minimum->s, std::cos(literal->minimum->alpha) + 1e-12);
  const auto growing = cav(shrinking);
  ASSERT_TRUE(growing);
  EXPECT_TRUE(growing->reversed);
  EXPECT_NEAR(growing->matrix->s, 1 / 0.7, 1e-14);
  EXPECT_GE(growing->minimum->s * std::cos(growing->minimum->alpha), 1 - 1e-12);
}

TEST(Cav, StraightCurvesAreAtTheirMinimum) {
  for (const auto& control :
       {std::vector<Point2>{{0, 0}, {1, 2}}, std::vector<Point2>{{0, 0}, {1, 2}, {2, 4}},
        std::vector<Point2>{{3, 1}, {4, 1}, {6, 1}, {10, 1}}}) {
    const auto value = cav(curve::Bezier2{control, {}});
    ASSERT_TRUE(value) << value.error().message;
    EXPECT_EQ(value->type, 1);
    EXPECT_EQ(value->cav, 0);
    EXPECT_EQ(value->energy, 0);
  }
}

TEST(Cav, ATurnedPlaneCurveKeepsItsValueATwistedOneHasThePlanesMinimum) {
  const curve::Bezier2 flat = to_bezier(kOya);
  std::vector<Point3> tilted;
  for (const Point2& p : flat.control) tilted.push_back({p.x + 3, 0.6 * p.y, 0.8 * p.y});
  const auto plane = cav(flat);
  const auto space = cav(tilted);
  ASSERT_TRUE(plane && space);
  EXPECT_EQ(space->type, 3);
  EXPECT_NEAR(space->cav, plane->cav, 1e-6);
  tilted[2].z += 0.1;
  const auto twisted = cav(tilted);
  ASSERT_TRUE(twisted);
  EXPECT_EQ(twisted->type, 5);
  // Its minimum is that of a plane curve with its start, tangent and end.
  const core::Vector3 first = tilted[1] - tilted[0];
  const core::Vector3 chord = tilted[3] - tilted[0];
  EnergyConditions own;
  own.tangent = {norm(first), 0};
  own.chord = {dot(chord, first) / norm(first), norm(cross(first, chord)) / norm(first)};
  own.end_tolerance = 0.01 * norm(chord);
  const auto minimum = minimum_energy(own);
  ASSERT_TRUE(minimum && twisted->minimum);
  EXPECT_NEAR(twisted->minimum->energy, minimum->energy, 1e-9);
  EXPECT_LT(twisted->minimum->energy, twisted->energy);
  EXPECT_GT(twisted->energy, 0);
  EXPECT_NEAR(space->energy, plane->energy, 1e-9);
}

/// The greatest distance in the plane of Tab. 2, 0 <= alpha <= alpha_max and 0 <= s <= 2, between a
/// Class A place of growing edges and one that `counts`, on a grid.
template <class Counts>
double greatest_distance(double alpha_max, Counts counts) {
  constexpr int kSteps = 60;
  double most = 0;
  const auto each = [&](auto visit) {
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j <= kSteps; ++j) visit(alpha_max * i / kSteps, 2.0 * j / kSteps);
  };
  each([&](double a, double s) {
    if (s * std::cos(a) < 1) return;
    each([&](double b, double t) {
      if (counts(b, t)) most = std::max(most, std::hypot(a - b, s - t));
    });
  });
  return most;
}

TEST(Cav, StepsOfEquation10AreTheLargestValuesInThePlaneOfTable2) {
  const LargestValues most = largest_values(kDefaultAlphaMax);
  EXPECT_EQ(std::round(8 * most.class_a), 12);
  EXPECT_EQ(std::round(8 * most.one_matrix), 38);
  EXPECT_EQ(std::round(8 * most.several), 110);
  EXPECT_EQ(std::round(8 * most.none), 407);
  const double d = diagonals(kDefaultAlphaMax).boundary;
  for (const double alpha_max : {0.6, kDefaultAlphaMax}) {
    const LargestValues at = largest_values(alpha_max);
    const double class_a =
        greatest_distance(alpha_max, [](double b, double t) { return t * std::cos(b) >= 1; });
    EXPECT_LE(class_a, at.class_a * (1 + 1e-12));
    EXPECT_NEAR(class_a, at.class_a, 0.05);
    const double other = greatest_distance(
        alpha_max, [](double b, double t) { return t > std::cos(b) && t * std::cos(b) < 1; });
    const double l = at.one_matrix / diagonals(alpha_max).boundary - 1;
    EXPECT_LE(other, l * (1 + 1e-12));
    EXPECT_NEAR(other, l, 0.05);
  }
  EXPECT_NEAR(most.one_matrix, d * 2.8953, 1e-3);
}

/// Edges s^k R^k v about an axis at the angle `tilt` from v: a helix on a cone. End and energy for
/// a first edge of length 1.
struct ConicalHelix {
  core::Vector3 end, first;
  curve::Bezier3 curve;
  ConicalHelix(double alpha, double s, double tilt, int degree) {
    first = {std::sin(tilt), 0, std::cos(tilt)};
    core::Point3 at;
    curve.control.push_back(at);
    double length = 1;
    for (int k = 0; k < degree; ++k) {
      at = at + length * core::Vector3{std::sin(tilt) * std::cos(k * alpha),
                                       std::sin(tilt) * std::sin(k * alpha), std::cos(tilt)};
      curve.control.push_back(at);
      length *= s;
    }
    end = at - curve.control.front();
  }
  double off_tangent() const { return std::atan2(norm(cross(first, end)), dot(first, end)); }
};

TEST(Cav, NoConicalHelixOfClassABendsLessThanThePlaneMinimum) {
  for (const double angle : {0.3, 0.7, 1.1}) {
    EnergyConditions conditions;
    conditions.chord = {std::cos(angle), std::sin(angle)};
    const auto plane = minimum_energy(conditions);
    ASSERT_TRUE(plane);
    double least = HUGE_VAL;
    int met = 0;
    for (int i = 1; i <= 24; ++i)
      for (int j = 1; j <= 16; ++j) {
        const double alpha = kDefaultAlphaMax * i / 24;
        const double tilt = core::kPi / 2 * j / 16;
        // s by bisection: the end leaves the tangent by the angle asked for.
        double low = 1, high = 12;
        const auto off = [&](double s) {
          return ConicalHelix(alpha, s, tilt, 3).off_tangent() - angle;
        };
        if (off(low) * off(high) > 0) continue;
        const bool rises = off(high) > 0;
        for (int k = 0; k < 60; ++k) {
          const double s = 0.5 * (low + high);
          ((off(s) > 0) == rises ? high : low) = s;
        }
        const ConicalHelix helix(alpha, low, tilt, 3);
        if (certify_monotone_curvature(helix.curve).answer != curve::MonotoneVerdict::yes) continue;
        ++met;
        // Scaled to a chord of length 1.
        least = std::min(least, strain_energy(helix.curve) * norm(helix.end));
      }
    EXPECT_GT(met, 10);
    EXPECT_GE(least, plane->energy * (1 - 1e-6)) << angle;
  }
}

TEST(Cav, BadInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto code = [](const auto& result) {
    return result ? ErrorCode::internal : result.error().code;
  };
  CavOptions options;
  for (const double alpha_max : {0.0, -1.0, kPi / 2, 2.0, nan}) {
    options.alpha_max = alpha_max;
    EXPECT_EQ(code(cav(kOya, options)), ErrorCode::bad_input);
    EXPECT_EQ(cav(kOya, options).error().path, "alpha_max");
  }
  EXPECT_EQ(code(cav(kOya, with_end_tolerance(-1))), ErrorCode::bad_input);
  EXPECT_EQ(code(cav(kOya, with_end_tolerance(100))), ErrorCode::bad_input);
  MatrixCurve c = kOya;
  c.tangent = {0, 0};
  EXPECT_EQ(code(cav(c)), ErrorCode::bad_input);
  EXPECT_EQ(code(cav(curve::Bezier2{{{1, 1}, {1, 1}, {1, 1}}, {}})), ErrorCode::bad_input);
  EXPECT_EQ(code(cav(curve::Bezier2{{{1, 1}, {nan, 1}, {1, 3}}, {}})), ErrorCode::bad_input);
  EXPECT_EQ(code(cav(curve::Bezier2{{{1, 1}}, {}})), ErrorCode::bad_input);
  EXPECT_EQ(code(cav(curve::Bezier2{{{1, 1}, {2, 1}, {1, 3}}, {1, 2, 1}})), ErrorCode::unsupported);
  EXPECT_EQ(code(cav(std::vector<Point3>{{1, 1, 1}, {1, 1, 1}})), ErrorCode::bad_input);
  EXPECT_TRUE(cav(MatrixCurve{{0, 0}, {1, 0}, 1, {0.05, 1.1}, 15}));
}

/// Edges of equal length tell no direction: turning does.
TEST(Cav, ReversingWithEqualEdges) {
  curve::Bezier2 c{{{0, 0}}, {}};
  double direction = 0;
  for (const double turn : {0.0, 0.2, 0.5}) {
    direction += turn;
    c.control.push_back(c.control.back() + core::unit_vector(direction));
  }
  const auto one = cav(c);
  const auto two = cav(reverse(c));
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->type, 4);
  EXPECT_NE(one->reversed, two->reversed);
  EXPECT_NEAR(one->minimum->s, two->minimum->s, 1e-7);
  EXPECT_NEAR(one->minimum->energy, two->minimum->energy, 1e-12);
}

// A minimum that turns by 1e-4 only: read from its other end the same curve had one of 1.6 % more
// energy.
TEST(Cav, ReversingNextToStraight) {
  curve::Bezier3 c{{{98.93710965363694, -41.32801475736639, -154.10777203475578},
                    {160.73409454914673, -41.32801475736639, -153.4857088224802},
                    {222.5310794446565, -41.32801475736639, -151.61951918565353}},
                   {}};
  const auto value = cav(c);
  std::reverse(c.control.begin(), c.control.end());
  const auto reversed = cav(c);
  ASSERT_TRUE(value && reversed && value->minimum && reversed->minimum);
  EXPECT_NE(value->reversed, reversed->reversed);
  EXPECT_NEAR(reversed->minimum->energy / value->minimum->energy, 1, 1e-9);
  EXPECT_NEAR(reversed->cav, value->cav, 1e-6);
}

TEST(Cav, SizeDoesNotMatter) {
  const auto reference = cav(to_bezier(kOya));
  ASSERT_TRUE(reference);
  for (const double size : {1e-60, 1e-9, 1e6, 1e60}) {
    MatrixCurve c = kOya;
    c.tangent = size * c.tangent;
    const auto value = cav(to_bezier(c));
    ASSERT_TRUE(value) << size << ": " << value.error().message;
    EXPECT_EQ(value->type, 3);
    EXPECT_NEAR(value->cav, reference->cav, 1e-7);
    EXPECT_NEAR(value->energy * size, reference->energy, 1e-9);
    EXPECT_EQ(value->monotone.answer, reference->monotone.answer);
  }
}

/// Whatever the points: a finite value or a reason.
TEST(Cav, AnyPointsAtAll) {
  numeric::Random random(99);
  int valued = 0;
  for (int i = 0; i < 400; ++i) {
    curve::Bezier2 c;
    const double grid = random.chance(0.5) ? 1.0 : 1e-3;
    const std::size_t count = 2 + random.index(7);
    for (std::size_t k = 0; k < count; ++k)
      c.control.push_back({grid * std::round(random.uniform(-2, 2) / grid),
                           grid * std::round(random.uniform(-2, 2) / grid)});
    const auto value = cav(c);
    if (!value) {
      EXPECT_FALSE(value.error().message.empty());
      EXPECT_NE(value.error().code, ErrorCode::internal);
      continue;
    }
    ++valued;
    EXPECT_TRUE(std::isfinite(value->cav));
    EXPECT_FALSE(std::isnan(value->energy));
    EXPECT_TRUE(value->minimum || !value->no_minimum.empty());
    const auto back = cav(reverse(c));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->type, value->type);
    EXPECT_NEAR(back->cav, value->cav, 1e-6 * value->cav);
    ASSERT_EQ(back->minimum.has_value(), value->minimum.has_value()) << i;
    if (value->minimum) {
      EXPECT_NEAR(back->minimum->energy, value->minimum->energy,
                  1e-9 * value->minimum->energy + 1e-15);
    }
  }
  EXPECT_GT(valued, 380);  // the points of a few coincide
}

}  // namespace
}  // namespace keyline::classa
