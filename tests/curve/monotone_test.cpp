#include "keyline/curve/monotone.h"

#include <array>
#include <cmath>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include "test_curves.h"

namespace keyline::curve {
namespace {

using core::Point2;
using core::Vector2;
using Answer = MonotoneVerdict::Answer;

/// Edges v, Mv, M^2 v, … with M a rotation by `angle` times s: Class A (Mineur) where
/// s cos(angle) >= 1 or s <= cos(angle).
Bezier2 class_a(int degree, double angle, double s, double direction) {
  Bezier2 c;
  Point2 p{0, 0};
  Vector2 edge = core::unit_vector(direction);
  c.control.push_back(p);
  for (int i = 0; i < degree; ++i) {
    p = p + edge;
    c.control.push_back(p);
    edge = s * core::rotate_ccw(edge, angle);
  }
  return c;
}

/// Largest and smallest dkappa/ds, times the squared length of the chord polygon, among samples.
std::pair<double, double> sampled_rates(const Bezier2& c, int n) {
  double low = 1e300;
  double high = -1e300;
  for (int i = 1; i < n; ++i) {
    const double rate = curvature_rate(c, static_cast<double>(i) / n);
    low = std::min(low, rate);
    high = std::max(high, rate);
  }
  return {low, high};
}

TEST(Monotone, ParabolaFromItsVertex) {
  const Bezier2 half{{{0, 0}, {0.5, 0}, {1, 1}}, {}};
  EXPECT_EQ(certify_monotone_curvature(half, 0).answer, Answer::yes);
  EXPECT_EQ(certify_monotone_curvature(half, 0).direction, -1);
  const Bezier2 over{{{-0.01, 1e-4}, {0.495, -0.01}, {1, 1}}, {}};
  const auto v = certify_monotone_curvature(over);
  EXPECT_EQ(v.answer, Answer::no);
  EXPECT_GT(curvature_rate(over, v.witness), 0);
  EXPECT_EQ(v.direction, -1);
}

TEST(Monotone, ClassABeziersAreCertified) {
  for (int degree = 2; degree <= 12; ++degree) {
    for (const double angle : {0.05, 0.2, 0.35, 0.5}) {
      for (const double margin : {1.001, 1.1, 1.5}) {
        const Bezier2 c = class_a(degree, angle, margin / std::cos(angle), 0.3 * degree);
        const auto v = certify_monotone_curvature(c);
        EXPECT_EQ(v.answer, Answer::yes) << degree << ' ' << angle << ' ' << margin;
        EXPECT_EQ(v.direction, -1);
        EXPECT_EQ(certify_monotone_curvature(reverse(c)).answer, Answer::yes);
      }
    }
  }
}

TEST(Monotone, BoundaryOfClassAIsNeverRefuted) {
  for (int degree = 2; degree <= 8; ++degree) {
    for (const double angle : {0.05, 0.3, 0.6, 1.0}) {
      const Bezier2 c = class_a(degree, angle, 1 / std::cos(angle), 0.7);
      EXPECT_NE(certify_monotone_curvature(c).answer, Answer::no) << degree << ' ' << angle;
    }
  }
}

TEST(Monotone, AgreesWithDenseSamplesOnRandomCurves) {
  std::array<int, 3> seen{};
  for (unsigned seed = 0; seed < 400; ++seed) {
    Bezier2 c = random_bezier(seed, 2 + static_cast<int>(seed) % 6, seed % 2 == 1);
    Draw draw(seed);
    if (seed % 4 < 3) c = subcurve(c, 0.3, 0.3 + draw(0.01, 0.4));
    const auto v = certify_monotone_curvature(c);
    ++seen[v.answer];
    const auto [low, high] = sampled_rates(c, 1000);
    if (v.answer == Answer::yes) {
      const double noise = 1e-9 * std::max(std::abs(low), std::abs(high));
      EXPECT_TRUE(low >= -noise || high <= noise) << seed;
    }
    if (v.answer == Answer::no) {
      EXPECT_LT(curvature_rate(c, v.witness) * v.direction, 0) << seed;
    }
    if (low < 0 && high > 0) {
      EXPECT_NE(v.answer, Answer::yes) << seed;
    }
    EXPECT_NE(v.answer, Answer::undecided) << seed;
  }
  EXPECT_GT(seen[Answer::yes], 50);
  EXPECT_GT(seen[Answer::no], 50);
}

TEST(Monotone, DoesNotDependOnPoseSizeOrDirection) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Bezier2 c = subcurve(random_bezier(seed, 4, seed % 2 == 1), 0.2, 0.5);
    const auto v = certify_monotone_curvature(c);
    const auto moved = certify_monotone_curvature(transform(c, {1e-7, 2.1, {3e-7, 5e-7}}));
    const auto back = certify_monotone_curvature(reverse(c));
    EXPECT_EQ(v.answer, moved.answer);
    EXPECT_EQ(v.direction, moved.direction);
    EXPECT_EQ(v.answer, back.answer);
    EXPECT_EQ(v.direction, back.direction);  // curvature and arc length both change sign
  }
}

TEST(Monotone, CirclesAndLinesUpToRounding) {
  const auto circle = certify_monotone_curvature(quarter_circle());
  EXPECT_NE(circle.answer, Answer::no);
  EXPECT_LT(circle.backward, 1e-14);
  // Weights 1, 1, 2 make the quarter circle exact: constant curvature, certified.
  const Bezier2 exact{{{1, 0}, {1, 1}, {0, 1}}, {1, 1, 2}};
  EXPECT_EQ(certify_monotone_curvature(exact, 0).answer, Answer::yes);
  EXPECT_EQ(certify_monotone_curvature(exact, 0).direction, 0);
  const Bezier2 line{{{0, 0}, {1, 1}, {2, 2}, {5, 5}}, {}};
  EXPECT_EQ(certify_monotone_curvature(line, 0).answer, Answer::yes);
  for (const double angle : {0.3, 1.1, 2.9}) {
    const auto turned = certify_monotone_curvature(transform(line, {1, angle, {0.1, 7}}));
    EXPECT_NE(turned.answer, Answer::no);
  }
  EXPECT_EQ(certify_monotone_curvature(Bezier2{{{0, 0}, {3, 1}}, {}}).answer, Answer::yes);
}

TEST(Monotone, CuspsAndCurvesWithoutLength) {
  const Bezier2 inside{{{1, -1}, {-1.0 / 3, 1}, {-1.0 / 3, -1}, {1, 1}}, {}};
  EXPECT_EQ(certify_monotone_curvature(inside).answer, Answer::no);
  const Bezier2 at_end{{{0, 0}, {0, 0}, {1, 0}, {4, 0.5}}, {}};
  EXPECT_EQ(certify_monotone_curvature(at_end).answer, Answer::yes);
  EXPECT_EQ(certify_monotone_curvature(at_end).direction, -1);
  const Bezier2 point{{{1, 1}, {1, 1}, {1, 1}}, {}};
  EXPECT_EQ(certify_monotone_curvature(point).answer, Answer::undecided);
  const Bezier2 there_and_back{{{0, 0}, {2, 0}, {1, 0}}, {}};
  EXPECT_NE(certify_monotone_curvature(there_and_back).answer, Answer::yes);
}

TEST(Monotone, DoubleZeroInsideIsNotAGuess) {
  // Parabola from the vertex with one ulp taken off: a vertex inside by about 1e-16.
  const Bezier2 c{{{0, 0}, {0.5, -1e-17}, {1, 1}}, {}};
  const auto v = certify_monotone_curvature(c);
  EXPECT_EQ(v.answer, Answer::undecided);
  EXPECT_LT(v.backward, 1e-12);
}

TEST(Monotone, HostileNumbers) {
  const Bezier2 wild{{{1e300, -1e300}, {-1e-300, 1e300}, {3, 1e-300}, {1e300, 7}}, {}};
  EXPECT_NO_THROW(certify_monotone_curvature(wild));
  const Bezier2 weighted{{{0, 0}, {1, 2}, {3, 1}}, {1e-300, 1, 1e300}};
  EXPECT_NO_THROW(certify_monotone_curvature(weighted));
  EXPECT_THROW(certify_monotone_curvature(Bezier2{{{0, 0}, {NAN, 1}}, {}}), core::InvalidInput);
  const Bezier2 high = random_bezier(5, 30, true);
  EXPECT_EQ(certify_monotone_curvature(high).answer, Answer::no);
}

TEST(Monotone, SplinesPieceByPieceAndAtJoints) {
  // Two halves of one Class A curve, joined by their knots: monotone.
  const Bezier2 c = class_a(3, 0.3, 1.3, 0);
  const BSpline2 plain{3, {0, 0, 0, 0, 1, 1, 1, 1}, c.control, {}};
  EXPECT_EQ(certify_monotone_curvature(insert_knot(plain, 0.4)).answer, Answer::yes);
  const BSpline2 corner{1, {0, 0, 1, 2, 2}, {{0, 0}, {1, 0}, {1, 1}}, {}};
  const auto v = certify_monotone_curvature(corner);
  EXPECT_EQ(v.answer, Answer::no);
  EXPECT_DOUBLE_EQ(v.witness, 0.5);
  // Quadratic spline: curvature jumps at the joint.
  // Two knots that the parameter cannot tell apart are as one.
  const auto two_knots = [](double last, double second) {
    return BSpline2{3,
                    {-1, -1, -1, -1, 0, second, 2, 2, 2, 2},
                    {{0, 0}, {1, 0}, {2, 0.4}, {2.8, 1.2}, {3, 2}, {3 - last, 2.5}},
                    {}};
  };
  for (const double last : {0.1, 2.0}) {
    const MonotoneVerdict one = certify_monotone_curvature(two_knots(last, 0));
    const MonotoneVerdict two = certify_monotone_curvature(two_knots(last, 1e-16));
    EXPECT_EQ(two.answer, one.answer);
    EXPECT_EQ(two.direction, one.direction);
  }
  const BSpline2 jump{2, {0, 0, 0, 1, 2, 2, 2}, {{0, 0}, {1, 0}, {2, 1}, {2, 5}}, {}};
  EXPECT_EQ(certify_monotone_curvature(jump).answer, Answer::no);
}

using Exact = boost::multiprecision::cpp_rational;

/// r' . r'' of a quadratic, up to a positive factor, at its start and at its end, exactly: where
/// the two differ in sign, curvature has an extremum between.
std::pair<Exact, Exact> rates(const Bezier2& c) {
  Exact start = 0;
  Exact end = 0;
  for (const double Point2::* axis : {&Point2::x, &Point2::y}) {
    const Exact a(c.control[0].*axis);
    const Exact b(c.control[1].*axis);
    const Exact d(c.control[2].*axis);
    start += (b - a) * (d - 2 * b + a);
    end += (d - b) * (d - 2 * b + a);
  }
  return {start, end};
}

// Parabolas whose vertex lies a rounding within or before their start, whose differences of control
// points are not exact in doubles: the answer is that of rational arithmetic.
TEST(Monotone, CoordinatesThatRoundAreReadAsTheyAre) {
  int within = 0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    Draw draw(seed);
    const Vector2 edge = draw(0.5, 2) * core::unit_vector(draw(-3, 3));
    const Vector2 bend = draw(0.2, 1) * core::perpendicular_left(edge);
    const Point2 p0{1e-3 * draw(-1, 1), 1e-3 * draw(-1, 1)};
    const Point2 p1 = p0 + edge;
    Bezier2 c{{p0, p1, p1 + edge + bend}, {}};
    const auto [start, end] = rates(c);
    const bool monotone = start * end >= 0;
    within += monotone ? 0 : 1;
    const auto v = certify_monotone_curvature(c, 0);
    EXPECT_EQ(v.answer == Answer::yes, monotone) << seed;
  }
  EXPECT_GT(within, 500);  // both kinds are among them
  EXPECT_LT(within, 2500);
}

/// Cross product of the whole edge and the third difference of a cubic's control points, exactly.
Exact turning_of_rate(const Bezier2& c) {
  const auto third = [&](double Point2::* axis) {
    const auto at = [&](std::size_t i) { return Exact(c.control[i].*axis); };
    return Exact(at(3) - 3 * at(2) + 3 * at(1) - at(0));
  };
  const Exact x = Exact(c.control[3].x) - Exact(c.control[0].x);
  const Exact y = Exact(c.control[3].y) - Exact(c.control[0].y);
  return x * third(&Point2::y) - y * third(&Point2::x);
}

// Four points that are even on a line but for a few roundings. Curvature's rate is the cross
// product of the first and the third derivative, but for terms smaller by the size of a rounding:
// rational arithmetic tells which way it goes, and differences of the points taken in doubles do
// not.
TEST(Monotone, DifferencesThatRoundAreNotTakenForExact) {
  int decided = 0;
  for (unsigned seed = 0; seed < 4000; ++seed) {
    Draw draw(seed);
    const Vector2 edge = draw(0.5, 2) * core::unit_vector(draw(-3, 3));
    Bezier2 c{{{1e-3 * draw(-1, 1), 1e-3 * draw(-1, 1)}}, {}};
    for (int i = 1; i < 4; ++i) {
      const Vector2 jitter{1e-15 * draw(-1, 1), 1e-15 * draw(-1, 1)};
      c.control.push_back(c.control[0] + (i * edge + jitter));
    }
    const Exact rate = turning_of_rate(c);
    const auto v = certify_monotone_curvature(c, 0);
    if (abs(rate) < 1e-25 || v.answer != Answer::yes) continue;
    ++decided;
    EXPECT_EQ(v.direction, rate > 0 ? 1 : -1) << seed;
  }
  EXPECT_GT(decided, 3000);
}

// (5 (2t - 1)^3, (2t - 1)^5): curvature falls to minus infinity, and from infinity on: its rate
// never changes sign, only the cusp at the middle says that it is not monotone. Integer control
// points.
TEST(Monotone, ALoneCuspInsideIsSeen) {
  const Bezier2 c{{{-5, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}, {5, 1}}, {}};
  EXPECT_LT(curvature_rate(c, 0.3), 0);
  EXPECT_LT(curvature_rate(c, 0.7), 0);
  const auto v = certify_monotone_curvature(c);
  EXPECT_EQ(v.answer, Answer::no);
  EXPECT_EQ(v.witness, 0.5);
}

// Two parabolas end to end, curvature rising on both: at a joint it may jump up, not down.
TEST(Monotone, JointsMayJumpTheWayTheCurveGoes) {
  const double angle = 0.3;
  const auto joined = [angle](double next) {
    BSpline2 c{2, {0, 0, 0, 0.5, 0.5, 1, 1, 1}, {{0, 0}}, {}};
    Vector2 edge{2, 0};
    for (const double length : {2.0, 1.2, next, 0.6 * next}) {
      edge = length * core::unit_vector(core::direction_of(edge));
      c.control.push_back(c.control.back() + edge);
      const bool joint = c.control.size() == 3;  // straight on at the joint
      edge = core::rotate_ccw(edge, joint ? 0 : angle);
    }
    return c;
  };
  // Ends of a parabola of edges a, b: |a x b| / (2 |a|^3), so 0.205 before and 0.0887 / next after.
  const auto up = certify_monotone_curvature(joined(0.3));
  EXPECT_EQ(up.answer, Answer::yes);
  EXPECT_EQ(up.direction, 1);
  const auto down = certify_monotone_curvature(joined(0.7));
  EXPECT_EQ(down.answer, Answer::no);
  EXPECT_EQ(certify_monotone_curvature(reverse(joined(0.3))).answer, Answer::yes);
}

}  // namespace
}  // namespace keyline::curve
