#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/document/document.h"

#include "cad_fixture.h"
#include "step_text.h"

/// Parts of surfaces and curves of STEP files written by hand after ISO 10303-42, which lie where
/// its formulas say.
namespace keyline::exchange {
namespace {

using core::Point3;
using document::Document;
using testing::IsEmpty;

class CadPatches : public CadTest {
 protected:
  Document read(const std::string& text) const { return read_sound("p.step", text); }
};

std::string name(int n) { return '#' + std::to_string(n); }

std::string direction_text(int n, Point3 p) {
  return name(n) + "=DIRECTION('',(" + digits_of(p.x) + ',' + digits_of(p.y) + ',' +
         digits_of(p.z) + "));\n";
}

/// Entity n and those behind it: axes.
std::string axes_text(int n, Point3 at, Point3 z, Point3 x) {
  return name(n) + "=AXIS2_PLACEMENT_3D(''," + name(n + 1) + ',' + name(n + 2) + ',' + name(n + 3) +
         ");\n" + name(n + 1) + '=' + point_text(at) + direction_text(n + 2, z) +
         direction_text(n + 3, x);
}

/// A curve as entity n and those behind it.
using CurveText = std::function<std::string(int n)>;

CurveText line(Point3 a, Point3 b) {
  return [=](int n) {
    const core::Vector3 along = 1 / distance(a, b) * (b - a);
    return name(n) + "=LINE(''," + name(n + 1) + ',' + name(n + 2) + ");\n" + name(n + 1) + '=' +
           point_text(a) + name(n + 2) + "=VECTOR(''," + name(n + 3) + ",1.);\n" +
           direction_text(n + 3, {along.x, along.y, along.z});
  };
}

CurveText circle(Point3 center, Point3 axis, Point3 x, double radius) {
  return [=](int n) {
    return name(n) + "=CIRCLE(''," + name(n + 1) + ',' + digits_of(radius) + ");\n" +
           axes_text(n + 1, center, axis, x);
  };
}

/// A kind of surface with its formula, and the curves along u and along v on it.
struct Kind {
  std::string text;  ///< entity #30 and those up to #39
  std::function<Point3(double u, double v)> at;
  std::function<CurveText(double v)> along_u;
  std::function<CurveText(double u)> along_v;
  std::function<double(Point3)> v_of;
  double wide = 1;  ///< x over y of what runs around
};

constexpr Point3 kX{1, 0, 0}, kZ{0, 0, 1};

/// What turns about z, its distance from the axis and its height by v.
Kind turned(const std::string& text, const std::function<double(double)>& far,
            const std::function<double(double)>& high, const std::function<double(Point3)>& v_of) {
  Kind kind{text, {}, {}, {}, v_of};
  kind.at = [=](double u, double v) {
    return Point3{far(v) * std::cos(u), far(v) * std::sin(u), high(v)};
  };
  kind.along_u = [=](double v) { return circle({0, 0, high(v)}, kZ, kX, far(v)); };
  kind.along_v = [at = kind.at](double u) { return line(at(u, 0), at(u, 1)); };
  return kind;
}

/// The same with circles of this radius, so far from the axis, along v.
Kind round(const std::string& text, double middle, double radius) {
  Kind kind = turned(
      text, [=](double v) { return middle + radius * std::cos(v); },
      [=](double v) { return radius * std::sin(v); },
      [=](Point3 p) { return std::atan2(p.z, std::hypot(p.x, p.y) - middle); });
  kind.along_v = [=](double u) {
    const Point3 out{std::cos(u), std::sin(u), 0}, in{std::sin(u), -std::cos(u), 0};
    return circle({middle * out.x, middle * out.y, 0}, in, out, radius);
  };
  return kind;
}

const std::string kAxis = "AXIS1_PLACEMENT('',#15,#18);\n";
const std::string kMeridian =
    "#32=CIRCLE('',#33,1.);\n" + axes_text(33, {5, 0, 0}, {0, -1, 0}, {1, 0, 0});

std::vector<Kind> kinds() {
  const auto height = [](Point3 p) { return p.z; };
  const auto same = [](double v) { return v; };
  std::vector<Kind> all{
      turned(
          "#30=CYLINDRICAL_SURFACE('',#14,3.);\n", [](double) { return 3.0; }, same, height),
      turned(
          "#30=CONICAL_SURFACE('',#14,3.," + digits_of(std::atan(0.5)) + ");\n",
          [](double v) { return 3 + 0.5 * v; }, same, height),
      turned(
          "#30=SURFACE_OF_REVOLUTION('',#32,#31);\n#31=" + kAxis + line({3, 0, 0}, {3, 0, 1})(32),
          [](double) { return 3.0; }, same, height),
      round("#30=SPHERICAL_SURFACE('',#14,3.);\n", 0, 3),
      round("#30=TOROIDAL_SURFACE('',#14,5.,1.);\n", 5, 1),
      round("#30=SURFACE_OF_REVOLUTION('',#32,#31);\n#31=" + kAxis + kMeridian, 5, 1)};
  Kind oval = all[0];
  oval.wide = 2;
  oval.text =
      "#30=SURFACE_OF_LINEAR_EXTRUSION('',#31,#32);\n#31=ELLIPSE('',#14,6.,3.);\n"
      "#32=VECTOR('',#18,1.);\n";
  oval.at = [](double u, double v) { return Point3{6 * std::cos(u), 3 * std::sin(u), v}; };
  oval.along_u = [](double v) {
    return [v](int n) {
      return name(n) + "=ELLIPSE(''," + name(n + 1) + ",6.,3.);\n" +
             axes_text(n + 1, {0, 0, v}, kZ, kX);
    };
  };
  oval.along_v = [at = oval.at](double u) { return line(at(u, 0), at(u, 1)); };
  all.push_back(oval);
  return all;
}

struct Range {
  double u1, u2, v1, v2;
};

/// One face of it between those parameters; whole in v where that is a turn.
std::string patch_text(const Kind& kind, const Range& r) {
  const bool whole = r.v2 - r.v1 > 6;
  const std::array<Point3, 4> corner{kind.at(r.u1, r.v1), kind.at(r.u2, r.v1), kind.at(r.u2, r.v2),
                                     kind.at(r.u1, r.v2)};
  const std::array<CurveText, 4> curve{kind.along_u(r.v1), kind.along_v(r.u2), kind.along_u(r.v2),
                                       kind.along_v(r.u1)};
  const std::array<int, 4> starts{0, 1, whole ? 0 : 3, 0},
      ends{1, whole ? 1 : 2, whole ? 1 : 2, whole ? 0 : 3};
  std::string text = kind.text +
                     "#40=ADVANCED_FACE('',(#41),#30,.T.);\n#41=FACE_OUTER_BOUND('',#42,.T.);\n"
                     "#42=EDGE_LOOP('',(#50,#51,#52,#53));\n";
  for (int i = 0; i < 4; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const int edge = whole && i == 2 ? 0 : i;  // the seam is one edge
    text += name(50 + i) + "=ORIENTED_EDGE('',*,*," + name(60 + edge) + (i < 2 ? ",.T." : ",.F.") +
            ");\n" + name(70 + 2 * i) + "=VERTEX_POINT(''," + name(71 + 2 * i) + ");\n" +
            name(71 + 2 * i) + '=' + point_text(corner[k]) + name(60 + i) + "=EDGE_CURVE(''," +
            name(70 + 2 * starts[k]) + ',' + name(70 + 2 * ends[k]) + ',' + name(100 + 10 * i) +
            ",.T.);\n" + curve[k](100 + 10 * i);
  }
  return shell_text("#40", text);
}

/// In radians from a, from -1e-9 on.
double turn_from(double a, double b) {
  const double turn = 2 * std::numbers::pi;
  const double by = std::fmod(std::fmod(b - a, turn) + turn, turn);
  return by > turn - 1e-9 ? by - turn : by;
}

/// Every place of the surface at the parameters the formula has for it, from `from` on.
void expect_at(const Kind& kind, const surface::Surface& s, const Range& r) {
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j) {
      const Point3 p = evaluate(s, i / 4.0, j / 4.0);
      const double u = std::atan2(p.y * kind.wide, p.x), v = kind.v_of(p);
      EXPECT_LT(distance(p, kind.at(u, v)), 1e-9);
      const double along = turn_from(r.u1, u);
      EXPECT_LT(along, r.u2 - r.u1 + 1e-9);
      if (i % 4 == 0) {
        EXPECT_NEAR(along, i == 0 ? 0 : r.u2 - r.u1, 1e-9);
      }
      if (j % 4 == 0) {
        const double here = j == 0 ? r.v1 : r.v2;
        EXPECT_NEAR(std::remainder(v - here, 2 * std::numbers::pi), 0, 1e-9) << j;
      }
      if (j == 2) {
        EXPECT_GT(v, r.v1 + 0.1);
        EXPECT_LT(v, r.v2 - 0.1);
      }
    }
}

// 4.4.60 to 4.4.69.
TEST_F(CadPatches, LieBetweenTheirBorders) {
  for (const Kind& kind : kinds())
    for (const Range& r : {Range{2.5, 4, 0.2, 1.2}, {-0.7, 0.6, -0.5, 0.5}}) {
      SCOPED_TRACE(kind.text.substr(0, 25) + " from " + digits_of(r.u1));
      const Document d = read(patch_text(kind, r));
      ASSERT_EQ(d.surfaces.size(), 1U);
      EXPECT_EQ(d.surfaces[0].trims, 0);
      EXPECT_THAT(d.skipped, IsEmpty());
      expect_at(kind, d.surfaces[0].surface, r);
    }
}

// A turn of v begins at 0 wherever the face has its seam.
TEST_F(CadPatches, MayGoRoundOneWay) {
  for (const Kind& kind : {kinds()[4], kinds()[5]})
    for (const double seam : {0.0, 0.7, -2.0}) {
      SCOPED_TRACE(kind.text.substr(0, 25) + digits_of(seam));
      const double turn = 2 * std::numbers::pi;
      const Document d = read(patch_text(kind, {0.5, 1.5, seam, seam + turn}));
      ASSERT_EQ(d.surfaces.size(), 1U);
      const surface::Surface& s = d.surfaces[0].surface;
      double turned = 0;
      for (int j = 0; j < 16; ++j) {
        const Point3 a = evaluate(s, 0.3, j / 16.0), b = evaluate(s, 0.3, (j + 1) / 16.0);
        EXPECT_LT(distance(a, kind.at(std::atan2(a.y, a.x), kind.v_of(a))), 1e-9);
        turned += std::remainder(kind.v_of(b) - kind.v_of(a), turn);
      }
      EXPECT_NEAR(turned, turn, 1e-6);
      EXPECT_LT(distance(evaluate(s, 0, 0), kind.at(0.5, 0)), 1e-9);
      EXPECT_LT(distance(evaluate(s, 1, 0), kind.at(1.5, 0)), 1e-9);
    }
}

/// The ellipse 2 cos v, sin v, half a unit along its normal.
core::Point2 beside_ellipse(double v) {
  const double by = 0.5 / std::hypot(std::cos(v), 2 * std::sin(v));
  return {(2 + by) * std::cos(v), (1 + 2 * by) * std::sin(v)};
}

/// Distance from the ellipse itself, near v.
double from_ellipse(core::Point2 p, double v) {
  const auto far = [&](double t) { return std::hypot(2 * std::cos(t) - p.x, std::sin(t) - p.y); };
  double low = v - 0.5, high = v + 0.5;
  for (int i = 0; i < 80; ++i) {
    const double a = (2 * low + high) / 3, b = (low + 2 * high) / 3;
    (far(a) < far(b) ? high : low) = far(a) < far(b) ? b : a;
  }
  return far(0.5 * (low + high));
}

CurveText beside_ellipse_text(Point3 center, Point3 axis, Point3 x) {
  return [=](int n) {
    return name(n) + "=OFFSET_CURVE_3D(''," + name(n + 1) + ",0.5,.F.," + name(n + 6) + ");\n" +
           name(n + 1) + "=ELLIPSE(''," + name(n + 2) + ",2.,1.);\n" +
           axes_text(n + 2, center, axis, x) + direction_text(n + 6, {-axis.x, -axis.y, -axis.z});
  };
}

/// What is told of a form that is not exact: within how much it is.
double told_within(const Document& d, const std::string& of) {
  for (const std::string& told : d.skipped)
    if (told.starts_with(of)) return std::stod(told.substr(of.size()));
  ADD_FAILURE() << of << " is not told";
  return 0;
}

// 4.4.70: half a unit along the normal of an oval ring. There is no exact form; how far the one
// here is off is told, in two digits.
TEST_F(CadPatches, OfOffsetsAreWithinWhatIsTold) {
  Kind ring = turned(
      "#30=OFFSET_SURFACE('',#31,0.5,.F.);\n"
      "#31=SURFACE_OF_REVOLUTION('',#32,#38);\n#38=" +
          kAxis + "#32=ELLIPSE('',#33,2.,1.);\n" + axes_text(33, {5, 0, 0}, {0, -1, 0}, {1, 0, 0}),
      [](double v) { return 5 + beside_ellipse(v).x; },
      [](double v) { return beside_ellipse(v).y; }, {});
  ring.along_v = [](double u) {
    const Point3 out{std::cos(u), std::sin(u), 0};
    return beside_ellipse_text({5 * out.x, 5 * out.y, 0}, {out.y, -out.x, 0}, out);
  };
  const Document d = read(patch_text(ring, {0.5, 1.5, 0.2, 1.2}));
  ASSERT_EQ(d.surfaces.size(), 1U);
  const double within = told_within(d, "part: its exact form; a surface within ");
  EXPECT_GT(within, 0);
  EXPECT_LT(within, 1e-6);
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j) {
      const Point3 p = evaluate(d.surfaces[0].surface, i / 10.0, j / 10.0);
      const double off = from_ellipse({std::hypot(p.x, p.y) - 5, p.z}, 0.2 + 0.1 * j);
      EXPECT_NEAR(off, 0.5, 1.05 * within);
    }
}

// 4.4.37: an offset curve, by itself and swept.
TEST_F(CadPatches, OfOffsetCurvesAreWithinWhatIsTold) {
  const CurveText beside = beside_ellipse_text({0, 0, 0}, {0, 0, -1}, kX);
  const Document d = read(step_curves("#21", trimmed_text(21, "#31", -1.2, -0.2) + beside(31)));
  ASSERT_EQ(d.paths.size(), 1U);
  const double within = told_within(d, "part: its exact form; a curve within ");
  EXPECT_LT(within, 1e-6);
  for (int i = 0; i <= 20; ++i) {
    const core::Point2 p = evaluate(d.paths[0].path, i / 20.0);
    EXPECT_NEAR(from_ellipse(p, 1.2 - 0.05 * i), 0.5, 1.05 * within);
  }
  Kind wall = kinds()[0];
  wall.text =
      "#30=SURFACE_OF_LINEAR_EXTRUSION('',#31,#38);\n" + beside(31) + "#38=VECTOR('',#18,1.);\n";
  wall.at = [](double u, double v) { return Point3{beside_ellipse(u).x, -beside_ellipse(u).y, v}; };
  wall.along_u = [](double v) { return beside_ellipse_text({0, 0, v}, {0, 0, -1}, kX); };
  wall.along_v = [at = wall.at](double u) { return line(at(u, 0), at(u, 1)); };
  const Document swept = read(patch_text(wall, {0.2, 1.2, 0, 2}));
  ASSERT_EQ(swept.surfaces.size(), 1U);
  const double near = told_within(swept, "part: its exact form; a surface within ");
  EXPECT_LT(near, 1e-6);
  for (int i = 0; i <= 20; ++i) {
    const Point3 p = evaluate(swept.surfaces[0].surface, i / 20.0, 0.3);
    EXPECT_NEAR(from_ellipse({p.x, -p.y}, 0.2 + 0.05 * i), 0.5, 1.05 * near);
  }
}

// Circles are arcs of the drawing where no more than 1e-12 of their size sticks out of its plane.
TEST_F(CadPatches, CirclesOffTheirPlaneAreNoArcs) {
  const auto drawn = [this](Point3 axis, double height) {
    const Document d = read(step_curves(
        "#21", trimmed_text(21, "#31", 0, 2) + circle({0, 0, height}, axis, kX, 2)(31)));
    EXPECT_EQ(d.paths.size() + d.space_curves.size(), 1U);
    return d.paths.size() == 1 &&
           std::holds_alternative<lac::Chain>(d.paths[0].path.curves[0].value);
  };
  EXPECT_TRUE(drawn({0, 0, 1}, 0));
  for (const double side : {1.0, -1.0}) {
    EXPECT_TRUE(drawn({0, 0.9e-12 * side, 1}, 0));
    EXPECT_TRUE(drawn({0.9e-12 * side, 0, -1}, 0));
    EXPECT_FALSE(drawn({0, 1.5e-12 * side, 1}, 0));
    EXPECT_FALSE(drawn({1.5e-12 * side, 0, -1}, 0));
    EXPECT_TRUE(drawn({0, 0, 1}, 1.9e-12 * side));
    EXPECT_FALSE(drawn({0, 0, 1}, 3e-12 * side));
  }
}

// Ends no farther apart than 1e-7 of the curve's size are one point.
TEST_F(CadPatches, CurvesCloseWhereTheirEndsMeet) {
  for (const double size : {1.0, 50.0})
    for (const double apart : {0.0, 0.9e-7, 1.1e-7}) {
      std::string text =
          "#21=B_SPLINE_CURVE_WITH_KNOTS('',3,(#31,#32,#33,#34),.UNSPECIFIED.,.U.,.F.,(4,4),"
          "(0.,1.),.UNSPECIFIED.);\n";
      const std::vector<Point3> control{
          {0, 0, 0}, {0.6 * size, 0.8 * size, 0}, {-0.3, 0.4, 0}, {apart * size, 0, 0}};
      for (int i = 0; i < 4; ++i)
        text += name(31 + i) + '=' + point_text(control[static_cast<std::size_t>(i)]);
      const Document d = read(step_curves("#21", text));
      ASSERT_EQ(d.paths.size(), 1U);
      EXPECT_EQ(d.paths[0].path.closed, apart < 1e-7) << size << ", " << apart;
      EXPECT_EQ(d.paths[0].stroke_width, 0);  // CAD files have none
    }
}

}  // namespace
}  // namespace keyline::exchange
