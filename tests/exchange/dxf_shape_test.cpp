#include "keyline/exchange/dxf/dxf_shape.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"

namespace keyline::exchange::detail {
namespace {

using core::Point3;
using core::Vector3;
using curve::Bezier3;

// The arbitrary axis algorithm of the DXF reference: the x axis lies at right angles to the world's
// y axis where the direction is within 1/64 of z, else to the world's z axis.
TEST(ExtrusionFrame, IsThatOfTheArbitraryAxis) {
  struct Case {
    Vector3 direction, x, y;
  };
  const double s = std::sqrt(0.5);
  for (const Case& c : {Case{{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}},
                        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                        {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
                        {{0, -5, 0}, {1, 0, 0}, {0, 0, 1}},
                        {{3, 0, 3}, {0, 1, 0}, {-s, 0, s}}}) {
    const Affine3 frame = extrusion_frame(c.direction);
    EXPECT_LT(norm(frame.x - c.x), 1e-15);
    EXPECT_LT(norm(frame.y - c.y), 1e-15);
    EXPECT_LT(norm(frame.z - c.direction / norm(c.direction)), 1e-15);
  }
  // Within 1/64 of z the x axis has no part along y, farther off none along z.
  for (const auto& [direction, near] : {std::pair{Vector3{0.015, -0.015, 1}, true},
                                        {{0.015, 0.0165, 1}, false},
                                        {{-0.0165, 0.01, -1}, false},
                                        {{-0.015, 0.01, -1}, true}}) {
    const Affine3 frame = extrusion_frame(direction);
    EXPECT_NEAR(near ? frame.x.y : frame.x.z, 0, 1e-16);
    EXPECT_GT(std::abs(near ? frame.x.x : frame.x.y), 0.3);
    EXPECT_NEAR(norm(frame.x), 1, 1e-15);
    EXPECT_LT(norm(cross(frame.x, frame.y) - frame.z), 1e-15);
    EXPECT_NEAR(dot(frame.x, frame.z), 0, 1e-15);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vector3& none :
       {Vector3{0, 0, 1}, {0, 0, 7}, {0, 0, 0}, {0, HUGE_VAL, 0}, {nan, 0, 1}}) {
    const Affine3 frame = extrusion_frame(none);
    EXPECT_EQ(frame.x, (Vector3{1, 0, 0}));
    EXPECT_EQ(frame.y, (Vector3{0, 1, 0}));
    EXPECT_EQ(frame.z, (Vector3{0, 0, 1}));
    EXPECT_EQ(frame.origin, Point3{});
  }
}

/// First point of an edge, its last, and the largest difference of its points from a radius about
/// a centre.
double off_the_circle(const std::vector<Bezier3>& pieces, Point3 centre, double radius) {
  double most = 0;
  for (const Bezier3& piece : pieces)
    for (int i = 0; i <= 20; ++i)
      most = std::max(most, std::abs(distance(evaluate(piece, i / 20.0), centre) - radius));
  return most;
}

// An edge of bulge b = tan(turn / 4) lies on the circle of radius c (1 + b^2) / (4 |b|), c the
// chord, its centre c (1 - b^2) / (4 b) to the left of the chord's middle.
TEST(PolylineShape, BulgesAreArcsOfTheirCircle) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-3, 3);
  for (const double bulge : {-4.0, -1.0, -0.4, -1e-3, 1e-3, 0.2, 0.9, 1.0, 2.5})
    for (int n = 0; n < 5; ++n) {
      const Point3 a{any(random), any(random), 0.5}, b{any(random), any(random), 0.5};
      const auto shape = polyline_shape({{a, bulge}, {b, 0}}, false);
      const auto* pieces = std::get_if<std::vector<Bezier3>>(&shape);
      ASSERT_TRUE(pieces);
      EXPECT_EQ(pieces->front().control.front(), a);
      EXPECT_EQ(pieces->back().control.back(), b);
      const Vector3 chord = b - a;
      const Vector3 left{-chord.y, chord.x, 0};
      const double c = norm(chord);
      const double radius = c * (1 + bulge * bulge) / (4 * std::abs(bulge));
      const Point3 centre = mix(a, b, 0.5) + (1 - bulge * bulge) / (4 * bulge) * left;
      EXPECT_LT(off_the_circle(*pieces, centre, radius), 1e-12 * radius);
      const double turn = 4 * std::atan(std::abs(bulge));
      EXPECT_EQ(pieces->size(), static_cast<std::size_t>(std::ceil(turn / (core::kPi / 2) - 1e-9)));
      // The middle lies b c / 2 to the right of the chord's.
      const double half = static_cast<double>(pieces->size()) / 2;
      const auto k = std::min(static_cast<std::size_t>(half), pieces->size() - 1);
      const Point3 middle = evaluate((*pieces)[k], half - static_cast<double>(k));
      EXPECT_LT(distance(middle, mix(a, b, 0.5) + (-bulge / 2) * left), 1e-12 * radius);
    }
}

// Programs write bulges that are rounding alone for straight edges.
TEST(PolylineShape, SlightBulgesLieAtTheirChord) {
  const Point3 a{12.34, 5.67, 0}, b{112.9, 48.1, 0};
  const Vector3 right{(b - a).y, -(b - a).x, 0};
  for (const double size : {1e-6, 1e-9, 1e-11, 1e-14, 2.2e-16, 1e-17, 1e-300})
    for (const double bulge : {size, -size}) {
      const auto shape = polyline_shape({{a, bulge}, {b, 0}}, false);
      const auto& pieces = std::get<std::vector<Bezier3>>(shape);
      ASSERT_EQ(pieces.size(), 1U);
      EXPECT_LT(distance(evaluate(pieces[0], 0.5), mix(a, b, 0.5) + (bulge / 2) * right), 3e-14);
      // Tangents of a slight arc leave the chord by half its turn: 2 b.
      EXPECT_LT(distance(pieces[0].control[1], mix(a, b, 0.5) + bulge * right), 3e-14);
    }
}

TEST(PolylineShape, RepeatedPointsAreOneAndClosedOnesEndWhereTheyStart) {
  const Point3 a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0};
  const auto points = [](const DxfShape& shape) {
    return std::get<curve::Polyline3>(shape).points;
  };
  EXPECT_EQ(points(polyline_shape({{a, 0}, {a, 0}, {b, 0}, {c, 0}, {c, 0}}, false)),
            (std::vector<Point3>{a, b, c}));
  EXPECT_EQ(points(polyline_shape({{a, 0}, {b, 0}, {c, 0}}, true)),
            (std::vector<Point3>{a, b, c, a}));
  EXPECT_EQ(points(polyline_shape({{a, 0}, {b, 0}, {c, 0}, {a, 0}}, true)),
            (std::vector<Point3>{a, b, c, a}));
  EXPECT_TRUE(points(polyline_shape({}, true)).empty());
  // The bulge behind the last point bends the edge that closes; of repeated points the last one's.
  EXPECT_EQ(points(polyline_shape({{a, 0}, {b, 0}, {c, 1}}, false)).size(), 3u);
  EXPECT_EQ(std::get<std::vector<Bezier3>>(polyline_shape({{a, 0}, {b, 0}, {c, 1}}, true)).size(),
            4u);
  EXPECT_EQ(points(polyline_shape({{a, 1}, {a, 0}, {b, 0}}, false)).size(), 2u);
}

/// Points of a spiral in space, far from even.
std::vector<Point3> spiral(int n) {
  std::vector<Point3> p;
  for (int i = 0; i < n; ++i) {
    const double a = 0.5 * i + 0.04 * i * i;
    p.push_back({(1 + a) * std::cos(a), (1 + a) * std::sin(a), 0.3 * i});
  }
  return p;
}

/// Derivatives of a cubic by chord length h: first and second at either end.
Vector3 first(const Bezier3& c, bool end, double h) {
  return (3 / h) * (end ? c.control[3] - c.control[2] : c.control[1] - c.control[0]);
}
Vector3 second(const Bezier3& c, bool end, double h) {
  const auto& q = c.control;
  return (6 / (h * h)) * (end ? (q[3] - q[2]) - (q[2] - q[1]) : (q[2] - q[1]) - (q[1] - q[0]));
}

void expect_smooth(const Bezier3& a, const Bezier3& b) {
  const double h = distance(a.control[0], a.control[3]);
  const double k = distance(b.control[0], b.control[3]);
  EXPECT_EQ(a.control[3], b.control[0]);
  EXPECT_LT(norm(first(a, true, h) - first(b, false, k)),
            1e-10);  // a loop: 20 points behind count 1e-11
  EXPECT_LT(norm(second(a, true, h) - second(b, false, k)), 1e-9);
}

// What drawings call a donut.
TEST(PolylineShape, TwoVerticesWithHalfCirclesMakeAWholeOne) {
  const Point3 a{0, 0, 0};
  const Point3 b{2, 0, 0};
  const auto round = std::get<std::vector<Bezier3>>(polyline_shape({{a, 1}, {b, 1}}, true));
  ASSERT_EQ(round.size(), 4U);
  EXPECT_EQ(round[1].control.back(), b);
  EXPECT_EQ(round[3].control.back(), a);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(distance(evaluate(round[i], 0.3), Point3{1, 0, 0}), 1, 1e-15) << i;
}

TEST(FitPointSpline, IsTheCubicSplineByChordLength) {
  const auto p = spiral(9);
  for (const bool given : {false, true}) {
    const Vector3 start = given ? Vector3{0, 2, 0} : Vector3{};
    const Vector3 end = given ? Vector3{-1, -1, 1} : Vector3{};
    const auto pieces = fit_point_spline(p, start, end, false);
    ASSERT_EQ(pieces.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_EQ(pieces[i].control[0], p[i]);
      EXPECT_EQ(pieces[i].control[3], p[i + 1]);
      if (i > 0) expect_smooth(pieces[i - 1], pieces[i]);
    }
    const double h = distance(p[0], p[1]), k = distance(p[7], p[8]);
    if (!given) {
      EXPECT_LT(norm(second(pieces[0], false, h)), 1e-12);
      EXPECT_LT(norm(second(pieces[7], true, k)), 1e-12);
      continue;
    }
    EXPECT_NEAR(dot(first(pieces[0], false, h), start) / norm(start),
                norm(first(pieces[0], false, h)), 1e-13);
    EXPECT_NEAR(dot(first(pieces[7], true, k), end) / norm(end), norm(first(pieces[7], true, k)),
                1e-13);
  }
}

TEST(FitPointSpline, OfALoopIsAsSmoothWhereItCloses) {
  for (const int n : {3, 5, 24}) {
    std::vector<Point3> p;
    for (int i = 0; i < n; ++i) {
      const double a = 2 * core::kPi * (i + 0.2 * std::sin(i)) / n;
      p.push_back({3 * std::cos(a), std::sin(a), 0});
    }
    for (const bool repeated : {false, true}) {
      if (repeated) p.push_back(p.front());
      const auto pieces = fit_point_spline(p, {1, 2, 3}, {4, 5, 6}, true);
      ASSERT_EQ(pieces.size(), static_cast<std::size_t>(n));
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        EXPECT_EQ(pieces[i].control[0], p[i]);
        expect_smooth(pieces[i], pieces[(i + 1) % pieces.size()]);
      }
    }
  }
}

TEST(DxfShape, IsMovedAsItsPointsAre) {
  const Affine3 map{{0, 2, 0}, {-3, 0, 0}, {0, 1, 1}, {10, 20, 30}};
  const auto at = [&](Point3 p) { return Point3{10 - 3 * p.y, 20 + 2 * p.x + p.z, 30 + p.z}; };
  const std::vector<Point3> p{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  EXPECT_EQ(std::get<curve::Polyline3>(mapped(curve::Polyline3{p}, map)).points,
            (std::vector<Point3>{at(p[0]), at(p[1]), at(p[2])}));
  const auto pieces = std::get<std::vector<Bezier3>>(mapped(std::vector<Bezier3>{{p, {}}}, map));
  EXPECT_EQ(pieces.at(0).control, (std::vector<Point3>{at(p[0]), at(p[1]), at(p[2])}));
  const auto arc =
      std::get<EllipseArc>(mapped(EllipseArc{{1, 1, 1}, {2, 0, 0}, {0, 1, 0}, 0.5, 2}, map));
  EXPECT_EQ(arc.center, at({1, 1, 1}));
  EXPECT_EQ(arc.major, (Vector3{0, 4, 0}));
  EXPECT_EQ(arc.minor, (Vector3{-3, 0, 0}));
  EXPECT_EQ(arc.from, 0.5);
  EXPECT_EQ(arc.to, 2);
}

TEST(AddShape, IsAPathInThePlaneAndASpaceCurveElsewhere) {
  document::Document d;
  const document::Label label{"name", "layer", {}};
  ASSERT_TRUE(add_shape(d, curve::Polyline3{{{0, 0, 0}, {1, 0, 0}}}, false, label));
  ASSERT_TRUE(add_shape(d, curve::Polyline3{{{0, 0, 2}, {1, 0, 2}}}, false, label));
  ASSERT_TRUE(add_shape(d, EllipseArc{{1, 2, 0}, {3, 0, 0}, {0, 3, 0}, 0, 1}, false, label));
  ASSERT_EQ(d.paths.size(), 2u);
  ASSERT_EQ(d.space_curves.size(), 1u);
  for (const document::NamedPath& path : d.paths) {
    EXPECT_EQ(path.label.name, "name");
    EXPECT_EQ(path.label.layer, "layer");
    EXPECT_EQ(path.stroke_width, 0);  // DXF's are of paper
    EXPECT_FALSE(path.path.closed);
  }
  const auto* chain = std::get_if<lac::Chain>(&d.paths[1].path.curves.at(0).value);
  ASSERT_TRUE(chain);
  ASSERT_EQ(chain->pieces.size(), 1u);
  EXPECT_NEAR(chain->pieces[0].curvature_start, 1.0 / 3, 1e-15);
  EXPECT_NEAR(chain->pieces[0].length, 3, 1e-15);
}

TEST(AddShape, HeightsOfRoundingAreNone) {
  document::Document d;
  for (const double z : {7e-12, 9e-12})  // 1e-12 of the size
    for (const Point3 end : {Point3{8, 0, z}, Point3{0, -8, z}})
      ASSERT_TRUE(add_shape(d, curve::Polyline3{{{0, 0, 0}, end}}, false, {}));
  EXPECT_EQ(d.paths.size(), 2U);
  EXPECT_EQ(d.space_curves.size(), 2U);
}

// Both rules are free of units: rounding makes no ellipse of a large circle, nor a skewed ellipse a
// circle because it is small.
TEST(AddShape, CirclesAreToldFromEllipsesInAnySize) {
  for (const double r : {1e-6, 1.0, 1e6})
    for (const double skew : {0.0, 1e-10}) {
      const double t = 0.7 + core::kPi / 2 + skew;
      document::Document d;
      const EllipseArc e{{},
                         {r * std::cos(0.7), r * std::sin(0.7), 0},
                         {r * std::cos(t), r * std::sin(t), 0},
                         0,
                         2};
      ASSERT_TRUE(add_shape(d, e, false, {}));
      const auto& first = d.paths.at(0).path.curves.at(0).value;
      EXPECT_EQ(std::holds_alternative<lac::Chain>(first), skew == 0) << r << ' ' << skew;
    }
}

TEST(AddShape, AWholeEllipseEndsExactlyWhereItStarts) {
  document::Document d;
  const EllipseArc whole{{0.1, 0.2, 0}, {3, 1, 0}, {-0.5, 1.5, 0}, 0.3, 0.3 + 2 * core::kPi};
  ASSERT_TRUE(add_shape(d, whole, true, {}));
  const auto& curves = d.paths.at(0).path.curves;
  ASSERT_EQ(curves.size(), 4U);
  EXPECT_EQ(std::get<curve::Bezier2>(curves.back().value).control.back(),
            std::get<curve::Bezier2>(curves.front().value).control.front());
}

TEST(DxfShape, IsFiniteWhereEveryNumberIs) {
  const double inf = HUGE_VAL;
  EXPECT_TRUE(is_finite(curve::Polyline3{{{0, 0, 0}, {1, 0, 0}}}));
  EXPECT_FALSE(is_finite(curve::Polyline3{{{0, 0, 0}, {1, inf, 0}}}));
  EXPECT_FALSE(is_finite(curve::Polyline3{{{0, 0, inf}, {1, 0, 0}}}));
  EXPECT_FALSE(is_finite(std::vector<Bezier3>{{{{0, 0, 0}, {1, 0, inf}}, {}}}));
}

}  // namespace
}  // namespace keyline::exchange::detail
