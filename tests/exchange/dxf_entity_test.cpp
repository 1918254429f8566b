#include "keyline/exchange/dxf/dxf_entity.h"

#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "keyline/exchange/dxf/affine3.h"
#include "keyline/exchange/dxf/dxf_units.h"

/// Entities of DXF by what the format says of their groups.
namespace keyline::exchange::detail {
namespace {

using core::Point3;

constexpr double kPi = std::numbers::pi;

DxfTag tag(int code, const char* text) { return {.text = text, .code = code}; }

DxfEntity entity(const char* type, std::vector<DxfTag> tags) {
  DxfEntity e;
  e.type = type;
  e.tags = std::move(tags);
  return e;
}

EllipseArc arc_of(const DxfEntity& e) { return std::get<EllipseArc>(dxf_curve_of(e)->shape); }

TEST(DxfEntity, ValuesAreTheFirstOfTheirCode) {
  const std::vector<DxfTag> tags{tag(10, "1.5"), tag(20, "2"), tag(30, "-3"), tag(10, "9"),
                                 tag(70, "5"),   tag(62, "x"), tag(8, "a")};
  EXPECT_EQ(real(tags, 10), 1.5);
  EXPECT_EQ(real(tags, 40, 7), 7);
  EXPECT_EQ(real(tags, 62, 3), 3);
  EXPECT_EQ(integer(tags, 70), 5);
  EXPECT_EQ(integer(tags, 71, 3), 3);
  EXPECT_EQ(text(tags, 8), "a");
  EXPECT_EQ(text(tags, 9), "");
  EXPECT_EQ(point(tags, 10), (Point3{1.5, 2, -3}));
  EXPECT_EQ(vector(tags, 210, {0, 0, 1}), (core::Vector3{0, 0, 1}));
}

// What cannot be read counts where geometry is taken from: not in a colour, a layer or a comment.
TEST(DxfEntity, UnreadableNumbersAreNamedWhereTheyCount) {
  for (const int code : {10, 38, 40, 47, 50, 59, 70, 79, 90, 99, 210, 239})
    EXPECT_TRUE(unreadable(entity("LINE", {tag(code, "abc")}))) << code;
  for (const int code : {1, 8, 9, 39, 48, 60, 62, 69, 100, 209, 240, 370, 1000})
    EXPECT_FALSE(unreadable(entity("LINE", {tag(code, "abc")}))) << code;
  DxfEntity polyline = entity("POLYLINE", {tag(70, "1")});
  polyline.vertices = {{tag(10, "1")}, {tag(10, "1e400")}};
  ASSERT_TRUE(unreadable(polyline));
  EXPECT_EQ(unreadable(polyline)->text, "1e400");
}

TEST(DxfEntity, EightTypesAreCurves) {
  for (const char* type :
       {"LINE", "ARC", "CIRCLE", "ELLIPSE", "LWPOLYLINE", "POLYLINE", "SPLINE", "HELIX"})
    EXPECT_TRUE(is_dxf_curve(type)) << type;
  for (const char* type : {"TEXT", "INSERT", "POINT", "line", ""})
    EXPECT_FALSE(is_dxf_curve(type)) << type;
}

// Angles are degrees, counter-clockwise from the start on: past 360 they go on.
TEST(DxfEntity, ArcsRunCounterClockwise) {
  const auto of = [](const char* from, const char* to) {
    return arc_of(
        entity("ARC", {tag(10, "1"), tag(20, "2"), tag(40, "3"), tag(50, from), tag(51, to)}));
  };
  const EllipseArc quarter = of("0", "90");
  EXPECT_EQ(quarter.center, (Point3{1, 2, 0}));
  EXPECT_EQ(quarter.major, (core::Vector3{3, 0, 0}));
  EXPECT_EQ(quarter.minor, (core::Vector3{0, 3, 0}));
  EXPECT_NEAR(quarter.to - quarter.from, kPi / 2, 1e-15);
  const EllipseArc over = of("270", "90");
  EXPECT_NEAR(over.from, 1.5 * kPi, 1e-15);
  EXPECT_NEAR(over.to, 2.5 * kPi, 1e-14);
  const EllipseArc turned = of("370", "380");
  EXPECT_NEAR(turned.from, kPi / 18, 1e-14);
  EXPECT_NEAR(turned.to, kPi / 9, 1e-14);
  const auto circle = dxf_curve_of(entity("CIRCLE", {tag(40, "2")}));
  EXPECT_TRUE(circle->closed);
  EXPECT_NEAR(std::get<EllipseArc>(circle->shape).to, 2 * kPi, 1e-15);
  EXPECT_FALSE(dxf_curve_of(entity("ARC", {tag(40, "2"), tag(51, "9")}))->closed);
  EXPECT_FALSE(dxf_curve_of(entity("CIRCLE", {tag(40, "0")})));
  EXPECT_FALSE(dxf_curve_of(entity("CIRCLE", {tag(40, "-1")})));
}

// Seen from below (210 is (0, 0, -1)) x runs the other way.
TEST(DxfEntity, ExtrusionsMirror) {
  const EllipseArc arc = arc_of(
      entity("ARC", {tag(10, "1"), tag(20, "2"), tag(40, "3"), tag(51, "90"), tag(230, "-1")}));
  EXPECT_NEAR(arc.center.x, -1, 1e-15);
  EXPECT_NEAR(arc.center.y, 2, 1e-15);
  EXPECT_NEAR(arc.major.x, -3, 1e-15);
  EXPECT_NEAR(arc.minor.y, 3, 1e-15);
}

TEST(DxfEntity, EllipsesHaveTheirRatioAndParameters) {
  const EllipseArc whole = arc_of(entity("ELLIPSE", {tag(11, "4"), tag(40, "0.5")}));
  EXPECT_EQ(whole.major, (core::Vector3{4, 0, 0}));
  EXPECT_NEAR(whole.minor.y, 2, 1e-15);
  EXPECT_NEAR(whole.to - whole.from, 2 * kPi, 1e-15);
  EXPECT_TRUE(dxf_curve_of(entity("ELLIPSE", {tag(11, "4")}))->closed);
  const EllipseArc back = arc_of(entity("ELLIPSE", {tag(11, "4"), tag(40, "-0.5")}));
  EXPECT_NEAR(back.minor.y, -2, 1e-15);  // it runs clockwise
  const auto part = dxf_curve_of(entity("ELLIPSE", {tag(11, "4"), tag(41, "5"), tag(42, "1")}));
  EXPECT_FALSE(part->closed);
  EXPECT_NEAR(std::get<EllipseArc>(part->shape).to, 1 + 2 * kPi, 1e-12);
  const EllipseArc far = arc_of(entity("ELLIPSE", {tag(11, "4"), tag(41, "0"), tag(42, "20")}));
  EXPECT_NEAR(far.to, 20 - 6 * kPi, 1e-12);  // not more than once round
  EXPECT_FALSE(dxf_curve_of(entity("ELLIPSE", {tag(11, "0")})));
  EXPECT_FALSE(dxf_curve_of(entity("ELLIPSE", {tag(11, "1"), tag(40, "0")})));
  EXPECT_FALSE(dxf_curve_of(entity("ELLIPSE", {tag(11, "1"), tag(42, "1e6")})));
  EXPECT_TRUE(dxf_curve_of(entity("ELLIPSE", {tag(11, "1"), tag(42, "999999")})));
}

TEST(DxfEntity, LinesHaveTwoEnds) {
  const auto line = dxf_curve_of(entity("LINE", {tag(10, "1"), tag(21, "4"), tag(31, "5")}));
  const auto& points = std::get<curve::Polyline3>(line->shape).points;
  EXPECT_EQ(points, (std::vector<Point3>{{1, 0, 0}, {0, 4, 5}}));
  EXPECT_FALSE(line->closed);
  EXPECT_FALSE(dxf_curve_of(entity("LINE", {tag(10, "1"), tag(11, "1")})));
}

// 38 is the elevation of a light polyline, bit 1 of 70 says that it is closed.
TEST(DxfEntity, LightPolylinesHaveAnElevation) {
  const DxfEntity e =
      entity("LWPOLYLINE", {tag(90, "3"), tag(70, "1"), tag(38, "7"), tag(10, "0"), tag(20, "1"),
                            tag(10, "2"), tag(20, "3"), tag(10, "4"), tag(20, "1")});
  const auto curve = dxf_curve_of(e);
  ASSERT_TRUE(curve);
  EXPECT_TRUE(curve->closed);
  const auto& points = std::get<curve::Polyline3>(curve->shape).points;
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[1], (Point3{2, 3, 7}));
  EXPECT_EQ(points[3], points[0]);
  DxfEntity short_of = e;
  short_of.tags[0] = tag(90, "4");
  EXPECT_FALSE(dxf_curve_of(short_of));
  DxfEntity open = e;
  open.tags[1] = tag(70, "2");
  EXPECT_FALSE(dxf_curve_of(open)->closed);
}

// Flags of the old polyline: 1 closed, 8 in space, 16 and 64 a mesh; 16 of a vertex is its spline's
// frame.
TEST(DxfEntity, OldPolylinesHaveFlags) {
  const auto of = [](const char* flags, const char* own = "0") {
    DxfEntity e = entity("POLYLINE", {tag(70, flags), tag(30, "5")});
    e.vertices = {{tag(10, "0")}, {tag(10, "1"), tag(30, "2"), tag(70, own)}, {tag(10, "2")}};
    return dxf_curve_of(e);
  };
  const auto points = [](const auto& curve) {
    return std::get<curve::Polyline3>(curve->shape).points;
  };
  EXPECT_EQ(points(of("0"))[1], (Point3{1, 0, 5}));
  EXPECT_EQ(points(of("8"))[1], (Point3{1, 0, 2}));
  EXPECT_EQ(points(of("0", "16")).size(), 2U);
  EXPECT_TRUE(of("1")->closed);
  EXPECT_FALSE(of("16"));
  EXPECT_FALSE(of("64"));
}

// Points of a polyline in space are the world's, and its edges straight, whatever else stands
// there.
TEST(DxfEntity, PolylinesInSpaceHaveNeitherBulgesNorAPlane) {
  const auto of = [](const char* flags, const char* bulge) {
    DxfEntity e = entity("POLYLINE", {tag(70, flags), tag(230, "-1")});
    e.vertices = {{tag(10, "0"), tag(42, bulge)}, {tag(10, "1"), tag(30, "2")}};
    return dxf_curve_of(e);
  };
  for (const char* bulge : {"0", "0.5"}) {
    const auto space = of("8", bulge);
    ASSERT_TRUE(space) << bulge;
    const auto* line = std::get_if<curve::Polyline3>(&space->shape);
    ASSERT_TRUE(line) << bulge;
    EXPECT_EQ(line->points, (std::vector<Point3>{{0, 0, 0}, {1, 0, 2}}));
  }
  EXPECT_EQ(std::get<curve::Polyline3>(of("0", "0")->shape).points[1].x, -1);  // seen from below
  EXPECT_FALSE(std::holds_alternative<curve::Polyline3>(of("0", "0.5")->shape));
}

// Four points and eight knots make a cubic.
TEST(DxfEntity, SplinesWithoutADegreeAreCubic) {
  std::vector<DxfTag> tags;
  for (const char* knot : {"0", "0", "0", "0", "1", "1", "1", "1"}) tags.push_back(tag(40, knot));
  for (const char* x : {"0", "1", "2", "3"}) tags.push_back(tag(10, x));
  const auto spline = dxf_curve_of(entity("SPLINE", tags));
  ASSERT_TRUE(spline) << spline.error().message;
  EXPECT_EQ(std::get<curve::BSpline3>(spline->shape).degree, 3);
}

TEST(DxfEntity, SplinesHaveKnotsAndWeights) {
  std::vector<DxfTag> tags{tag(71, "1"), tag(40, "0"), tag(40, "0"), tag(40, "1"), tag(40, "1"),
                           tag(10, "1"), tag(20, "2"), tag(30, "3"), tag(10, "4")};
  const auto spline = dxf_curve_of(entity("SPLINE", tags));
  ASSERT_TRUE(spline);
  const auto& s = std::get<curve::BSpline3>(spline->shape);
  EXPECT_EQ(s.degree, 1);
  EXPECT_EQ(s.knots, (std::vector<double>{0, 0, 1, 1}));
  EXPECT_EQ(s.control, (std::vector<Point3>{{1, 2, 3}, {4, 0, 0}}));
  EXPECT_TRUE(s.weights.empty());
  // Weights that are all one are none; others stay.
  tags.push_back(tag(41, "2"));
  tags.push_back(tag(41, "2"));
  EXPECT_TRUE(
      std::get<curve::BSpline3>(dxf_curve_of(entity("SPLINE", tags))->shape).weights.empty());
  tags.back() = tag(41, "3");
  EXPECT_EQ(std::get<curve::BSpline3>(dxf_curve_of(entity("SPLINE", tags))->shape).weights,
            (std::vector<double>{2, 3}));
  // What a helix says of itself is no part of its spline.
  tags.resize(9);
  tags.push_back(tag(100, "AcDbHelix"));
  tags.push_back(tag(10, "9"));
  tags.push_back(tag(40, "9"));
  EXPECT_EQ(std::get<curve::BSpline3>(dxf_curve_of(entity("HELIX", tags))->shape).control.size(),
            2U);
}

// A knot that rounding set back by a billionth of the range is mended, by more refused.
TEST(DxfEntity, KnotsThatStepBackByRoundingAreMended) {
  const auto of = [](const char* inner) {
    return dxf_curve_of(entity("SPLINE", {tag(71, "1"), tag(40, "0"), tag(40, "0"), tag(40, "5"),
                                          tag(40, inner), tag(40, "10"), tag(40, "10"),
                                          tag(10, "0"), tag(10, "1"), tag(10, "2"), tag(10, "3")}));
  };
  const auto mended = of("4.999999995");
  ASSERT_TRUE(mended);
  EXPECT_EQ(std::get<curve::BSpline3>(mended->shape).knots[3], 5);
  EXPECT_FALSE(of("4.9999999"));
}

TEST(DxfEntity, FitPointsMakeACurveToo) {
  EXPECT_TRUE(dxf_curve_of(entity("SPLINE", {tag(11, "0"), tag(11, "1"), tag(11, "2")})));
  EXPECT_FALSE(dxf_curve_of(entity("SPLINE", {tag(11, "0"), tag(11, "0")})));
  EXPECT_FALSE(dxf_curve_of(entity("SPLINE", {})));
}

TEST(Affine3, FirstTheInnerThenTheOuter) {
  const Affine3 turn{{0, 1, 0}, {-1, 0, 0}, {0, 0, 2}, {10, 0, 0}};
  const Affine3 move{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 2, 3}};
  EXPECT_EQ(apply(turn, Point3{1, 2, 3}), (Point3{8, 1, 6}));
  EXPECT_EQ(apply(turn, core::Vector3{1, 2, 3}), (core::Vector3{-2, 1, 6}));
  const Point3 p{0.5, -1, 4};
  EXPECT_EQ(apply(combined(turn, move), p), apply(turn, apply(move, p)));
  EXPECT_EQ(apply(combined(move, turn), p), apply(move, apply(turn, p)));
}

// $INSUNITS of the DXF reference: 1 inches, 2 feet, 3 miles … 21 US survey feet of 1200/3937 m.
TEST(DxfUnits, AreThoseOfTheReference) {
  struct Case {
    int code;
    double metres;
  };
  const auto own = [](const std::string& name) {
    return name == "mm"   ? 1e-3
           : name == "cm" ? 1e-2
           : name == "m"  ? 1.0
           : name == "km" ? 1e3
           : name == "in" ? 0.0254
                          : 0.3048;
  };
  for (const Case& c : {Case{1, 0.0254},
                        {2, 0.3048},
                        {3, 1609.344},
                        {4, 1e-3},
                        {5, 1e-2},
                        {6, 1},
                        {7, 1e3},
                        {8, 0.0254e-6},
                        {9, 0.0254e-3},
                        {10, 0.9144},
                        {11, 1e-10},
                        {12, 1e-9},
                        {13, 1e-6},
                        {14, 0.1},
                        {15, 10},
                        {16, 100},
                        {21, 1200.0 / 3937}}) {
    const DxfUnit* unit = dxf_unit_of(c.code);
    ASSERT_TRUE(unit) << c.code;
    EXPECT_NEAR(unit->factor * own(unit->name) / c.metres, 1, 1e-12) << c.code;
  }
  EXPECT_EQ(std::string(dxf_unit_of(0)->name), "");
  for (const int none : {-1, 17, 18, 19, 20, 22, 25}) EXPECT_FALSE(dxf_unit_of(none)) << none;
  EXPECT_EQ(dxf_unit("mm"), 4);
  EXPECT_EQ(dxf_unit("in"), 1);
  EXPECT_EQ(dxf_unit("ft"), 2);
  EXPECT_EQ(dxf_unit("m"), 6);
  EXPECT_EQ(dxf_unit("px"), 0);
  EXPECT_EQ(dxf_unit(""), 0);
}

}  // namespace
}  // namespace keyline::exchange::detail
