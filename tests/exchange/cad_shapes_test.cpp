#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/document/document.h"

#include "cad_fixture.h"
#include "step_text.h"

/// Curves, wires and faces of STEP files written by hand after ISO 10303-42, and where they lie by
/// its formulas.
namespace keyline::exchange {
namespace {

using core::Point2;
using core::Point3;
using document::Document;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class CadShapes : public CadTest {
 protected:
  Document read(const std::string& text) const { return read_sound("d.step", text); }
};

// 4.4.26: c + r (cos u x + sin u y); about -z, y is z x x = (0, -1, 0).
TEST_F(CadShapes, ArcsTurnAboutTheirAxis) {
  const std::string circles =
      "#31=CIRCLE('',#32,2.);\n#32=AXIS2_PLACEMENT_3D('',#33,#34,#16);\n#33=" +
      point_text({5, 7, 0}) +
      "#34=DIRECTION('',(0.,0.,-1.));\n#35=CIRCLE('',#36,2.);\n"
      "#36=AXIS2_PLACEMENT_3D('',#37,#18,#19);\n#37=" +
      point_text({0, 0, 5});
  const Document d = read(step_curves(
      "#21,#22", trimmed_text(21, "#31", 1, 2.5) + trimmed_text(22, "#35", 0, 2) + circles));
  ASSERT_EQ(d.paths.size(), 1U);
  // x is (0, 1), y is z x x = (1, 0).
  const auto on = [](double u) { return Point2{5 + 2 * std::sin(u), 7 + 2 * std::cos(u)}; };
  for (const double t : {0.0, 0.5, 1.0})
    EXPECT_LT(distance(evaluate(d.paths[0].path, t), on(1 + 1.5 * t)), 1e-14) << t;
  ASSERT_EQ(d.space_curves.size(), 1U);  // not in the plane of the drawing
  const Point3 end{2 * std::cos(2), 2 * std::sin(2), 5};
  EXPECT_LT(distance(evaluate(d.space_curves[0].curve, 1), end), 1e-14);
}

// 4.4.27: (4 cos u, 2 sin u), from anywhere in a turn.
TEST_F(CadShapes, EllipsesStartWhereTheyDo) {
  const double turn = 2 * std::numbers::pi;
  for (const auto& [from, to] : {std::pair{0.0, 1.0},
                                 {5.5, 7.0},
                                 {7.0, 8.5},
                                 {-7.0, -6.0},
                                 {-1.0, 0.5},
                                 {0.0, turn},
                                 {turn - 1e-12, 2 * turn - 1e-12},
                                 {1e-12, 1.0}}) {
    SCOPED_TRACE(from);
    const Document d = read(
        step_curves("#21", trimmed_text(21, "#31", from, to) + "#31=ELLIPSE('',#14,4.,2.);\n"));
    ASSERT_EQ(d.paths.size(), 1U);
    const auto& path = d.paths[0].path;
    EXPECT_EQ(path.closed, to - from == turn);
    const auto on = [](double u) { return Point2{4 * std::cos(u), 2 * std::sin(u)}; };
    EXPECT_LT(distance(evaluate(path, 0), on(from)), 1e-9);
    EXPECT_LT(distance(evaluate(path, 1), on(to)), 1e-9);
    double turned = 0;
    for (int i = 0; i < 32; ++i) {
      const Point2 a = evaluate(path, i / 32.0), b = evaluate(path, (i + 1) / 32.0);
      EXPECT_NEAR(std::hypot(a.x / 4, a.y / 2), 1, 1e-12);
      turned += std::atan2(a.x / 4 * b.y / 2 - a.y / 2 * b.x / 4, a.x * b.x / 16 + a.y * b.y / 4);
    }
    EXPECT_NEAR(turned, to - from, 1e-9);
  }
}

// 4.4.30 to 4.4.32: a segment against its curve's sense runs from its end to its start; points and
// chains in space are told.
TEST_F(CadShapes, CompositeCurvesRunBySense) {
  const auto segment = [](int n, const std::string& sense, const std::string& curve) {
    return '#' + std::to_string(n) + "=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.," + sense + ',' +
           curve + ");\n";
  };
  const auto polyline = [](int n, Point3 a, Point3 b) {
    const auto name = [n](int k) { return '#' + std::to_string(n + k); };
    return name(0) + "=POLYLINE('',(" + name(1) + ',' + name(2) + "));\n" + name(1) + '=' +
           point_text(a) + name(2) + '=' + point_text(b);
  };
  const auto chain = [&](double z, const std::string& more) {
    return read(step_curves(
        "#21" + more, "#21=COMPOSITE_CURVE('',(#22,#23,#24),.F.);\n" + segment(22, ".T.", "#30") +
                          segment(23, ".F.", "#34") + segment(24, ".T.", "#38") +
                          polyline(30, {0, 0, 0}, {4, 0, 0}) + polyline(34, {4, 3, z}, {4, 0, 0}) +
                          polyline(38, {4, 3, z}, {0, 0, 0})));
  };
  const Document flat = chain(0, ",#15");
  ASSERT_EQ(flat.paths.size(), 1U);
  EXPECT_TRUE(flat.paths[0].path.closed);
  EXPECT_EQ(flat.paths[0].path.curves.size(), 3U);
  EXPECT_LT(distance(evaluate(flat.paths[0].path, 1.0 / 3), {4, 0}), 1e-14);
  EXPECT_LT(distance(evaluate(flat.paths[0].path, 0.5), {4, 1.5}), 1e-14);
  EXPECT_THAT(flat.skipped, ElementsAre("1 point"));
  const Document bent = chain(1, "");
  EXPECT_THAT(bent.skipped,
              ElementsAre("1 chain of curves in space; the curves stand by themselves"));
  EXPECT_EQ(bent.paths.size() + bent.space_curves.size(), 3U);
  const Document one =
      read(step_curves("#21", "#21=COMPOSITE_CURVE('',(#22),.F.);\n" + segment(22, ".T.", "#30") +
                                  polyline(30, {0, 0, 0}, {4, 0, 1})));
  EXPECT_EQ(one.space_curves.size(), 1U);
  EXPECT_THAT(one.skipped, IsEmpty());
}

/// Face n on a surface with straight edges between these corners, every other against its line.
std::string face_text(int n, const std::string& surface, const std::vector<Point3>& corners) {
  const auto name = [](int k) { return '#' + std::to_string(k); };
  const int count = static_cast<int>(corners.size());
  std::string loop, text;
  for (int i = 0; i < count; ++i) {
    const int b = n + 10 * (i + 1);
    const bool back = i % 2 == 1;
    const int next = n + 10 * ((i + 1) % count + 1);
    const Point3 here = corners[static_cast<std::size_t>(i)];
    const Point3 there = corners[static_cast<std::size_t>((i + 1) % count)];
    const core::Vector3 along = (back ? -1 : 1) / distance(here, there) * (there - here);
    const std::string ends =
        back ? name(next + 2) + ',' + name(b + 2) : name(b + 2) + ',' + name(next + 2);
    loop += (i == 0 ? "" : ",") + name(b);
    text += name(b) + "=ORIENTED_EDGE('',*,*," + name(b + 1) + (back ? ",.F.);\n" : ",.T.);\n") +
            name(b + 1) + "=EDGE_CURVE(''," + ends + ',' + name(b + 4) + ",.T.);\n" + name(b + 2) +
            "=VERTEX_POINT(''," + name(b + 3) + ");\n" + name(b + 3) + '=' + point_text(here) +
            name(b + 4) + "=LINE(''," + name((back ? next : b) + 3) + ',' + name(b + 5) + ");\n" +
            name(b + 5) + "=VECTOR(''," + name(b + 6) + ",1.);\n" + name(b + 6) +
            "=DIRECTION('',(" + digits_of(along.x) + ',' + digits_of(along.y) + ',' +
            digits_of(along.z) + "));\n";
  }
  return name(n) + "=ADVANCED_FACE('',(" + name(n + 1) + ")," + surface + ",.T.);\n" + name(n + 1) +
         "=FACE_OUTER_BOUND(''," + name(n + 2) + ",.T.);\n" + name(n + 2) + "=EDGE_LOOP('',(" +
         loop + "));\n" + text;
}

/// The loop's corners, where each of its curves goes on from the one before.
std::vector<Point3> corners_of(const std::vector<document::SpaceCurve>& loop) {
  std::vector<Point3> corners;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    corners.push_back(evaluate(loop[i], 0));
    EXPECT_LT(distance(evaluate(loop[i], 1), evaluate(loop[(i + 1) % loop.size()], 0)), 1e-12);
  }
  return corners;
}

const std::string kPlane = "#30=PLANE('',#14);\n";

TEST_F(CadShapes, EdgesOffTheBorderTrim) {
  const auto only = [this](const std::vector<Point3>& corners) {
    return read(shell_text("#40", kPlane + face_text(40, "#30", corners)));
  };
  const Document whole = only({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}});
  ASSERT_EQ(whole.surfaces.size(), 1U);
  EXPECT_EQ(whole.surfaces[0].label.name, "part");
  EXPECT_EQ(whole.surfaces[0].trims, 0);
  EXPECT_THAT(whole.surfaces[0].trim_loops, IsEmpty());
  EXPECT_THAT(whole.skipped, IsEmpty());
  const std::vector<Point3> triangle{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};
  const Document cut = only(triangle);
  ASSERT_EQ(cut.surfaces.size(), 1U);
  EXPECT_EQ(cut.surfaces[0].trims, 1);
  EXPECT_THAT(cut.skipped,
              ElementsAre("part: trimmed by 1 edge: the whole underlying surface is here"));
  ASSERT_EQ(cut.surfaces[0].trim_loops.size(), 1U);
  const auto corners = corners_of(cut.surfaces[0].trim_loops[0]);
  ASSERT_EQ(corners.size(), 3U);
  double area = 0;
  for (std::size_t i = 0; i < 3; ++i)
    area += (corners[i].x * corners[(i + 1) % 3].y - corners[i].y * corners[(i + 1) % 3].x) / 2;
  EXPECT_NEAR(area, 6, 1e-12);  // counterclockwise about the normal
  EXPECT_LT(distance(evaluate(cut.surfaces[0].surface, 1, 1), {4, 3, 0}), 1e-12);
  // Near the border is not on it.
  const Document near =
      only({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {3.9, 2, 0}, {3.9, 2.9, 0}, {3, 3, 0}, {0, 3, 0}});
  EXPECT_EQ(near.surfaces.at(0).trims, 3);
}

TEST_F(CadShapes, FacesOfOnePartAreNumbered) {
  const Document d = read(shell_text(
      "#40,#140", kPlane + face_text(40, "#30", {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}}) +
                      face_text(140, "#30", {{4, 0, 0}, {9, 0, 0}, {9, 3, 0}, {4, 3, 0}})));
  ASSERT_EQ(d.surfaces.size(), 2U);
  EXPECT_EQ(d.surfaces[0].label.name, "part/face-1");
  EXPECT_EQ(d.surfaces[1].label.name, "part/face-2");
  std::vector<Point3> starts;  // in whatever order OCCT keeps faces
  for (const auto& named : d.surfaces) starts.push_back(evaluate(named.surface, 0, 0));
  EXPECT_THAT(starts, testing::UnorderedElementsAre(Point3{0, 0, 0}, Point3{4, 0, 0}));
}

/// A whole ring about z, 5 from its axis and 1 thick, whose one corner stands at u, v.
std::string ring_text(double u, double v) {
  const double wide = 5 + std::cos(v);
  const Point3 out{std::cos(u), std::sin(u), 0}, in{std::sin(u), -std::cos(u), 0};
  const auto direction = [](Point3 p) {
    return "DIRECTION('',(" + digits_of(p.x) + ',' + digits_of(p.y) + ',' + digits_of(p.z) +
           "));\n";
  };
  return "#30=TOROIDAL_SURFACE('',#14,5.,1.);\n#40=ADVANCED_FACE('',(#41),#30,.T.);\n"
         "#41=FACE_OUTER_BOUND('',#42,.T.);\n#42=EDGE_LOOP('',(#43,#44,#45,#46));\n"
         "#43=ORIENTED_EDGE('',*,*,#51,.T.);\n#44=ORIENTED_EDGE('',*,*,#52,.T.);\n"
         "#45=ORIENTED_EDGE('',*,*,#51,.F.);\n#46=ORIENTED_EDGE('',*,*,#52,.F.);\n"
         "#51=EDGE_CURVE('',#53,#53,#55,.T.);\n#52=EDGE_CURVE('',#53,#53,#56,.T.);\n"
         "#53=VERTEX_POINT('',#54);\n#54=" +
         point_text({wide * out.x, wide * out.y, std::sin(v)}) + "#55=CIRCLE('',#57," +
         digits_of(wide) +
         ");\n#56=CIRCLE('',#58,1.);\n#57=AXIS2_PLACEMENT_3D('',#59,#18,#60);\n#59=" +
         point_text({0, 0, std::sin(v)}) + "#60=" + direction(out) +
         "#58=AXIS2_PLACEMENT_3D('',#61,#62,#63);\n#61=" + point_text({5 * out.x, 5 * out.y, 0}) +
         "#62=" + direction(in) +
         "#63=" + direction({std::cos(v) * out.x, std::cos(v) * out.y, std::sin(v)});
}

// 4.4.66: everywhere 1 from the circle of 5, once around in both directions, wherever it is cut.
TEST_F(CadShapes, WholeRingsAreReadWhereverTheyAreCut) {
  for (const auto& [u, v] : {std::pair{0.0, 0.0}, {0.5, 1.0}, {-1.0, 3.0}, {3.0, -2.0}}) {
    SCOPED_TRACE(v);
    const Document d = read(shell_text("#40", ring_text(u, v)));
    ASSERT_EQ(d.surfaces.size(), 1U);
    double around = 0, across = 0;
    for (int i = 0; i < 64; ++i) {
      const auto far = [](Point3 p) { return std::hypot(p.x, p.y) - 5; };
      const auto turn = [](double ax, double ay, double bx, double by) {
        return std::atan2(ax * by - ay * bx, ax * bx + ay * by);
      };
      const Point3 a = evaluate(d.surfaces[0].surface, i / 64.0, 0.25);
      const Point3 b = evaluate(d.surfaces[0].surface, (i + 1) / 64.0, 0.25);
      around += turn(a.x, a.y, b.x, b.y);
      const Point3 e = evaluate(d.surfaces[0].surface, 0.25, i / 64.0);
      const Point3 f = evaluate(d.surfaces[0].surface, 0.25, (i + 1) / 64.0);
      across += turn(far(e), e.z, far(f), f.z);
      EXPECT_NEAR(std::hypot(far(e), e.z), 1, 1e-9);
    }
    EXPECT_NEAR(around, 2 * std::numbers::pi, 1e-6);
    EXPECT_NEAR(across, 2 * std::numbers::pi, 1e-6);
  }
}

// A free-form surface stays whole, whatever a face takes of it.
TEST_F(CadShapes, FreeFormSurfacesStayWhole) {
  const std::string net = "#31=" + point_text({0, 0, 0}) + "#32=" + point_text({0, 3, 0}) +
                          "#33=" + point_text({4, 0, 0}) + "#34=" + point_text({4, 3, 0});
  const std::string rest = "((#31,#32),(#33,#34)),.UNSPECIFIED.,.F.,.F.,.F.";
  for (const std::string& surface : {"#30=BEZIER_SURFACE('',1,1," + rest + ");\n",
                                     "#30=B_SPLINE_SURFACE_WITH_KNOTS('',1,1," + rest +
                                         ",(2,2),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.);\n"}) {
    SCOPED_TRACE(surface);
    const Document d = read(shell_text(
        "#40", surface + net + face_text(40, "#30", {{1, 1, 0}, {3, 1, 0}, {3, 2, 0}, {1, 2, 0}})));
    ASSERT_EQ(d.surfaces.size(), 1U);
    EXPECT_EQ(d.surfaces[0].trims, 4);
    EXPECT_LT(distance(evaluate(d.surfaces[0].surface, 0, 0), {0, 0, 0}), 1e-12);
    EXPECT_LT(distance(evaluate(d.surfaces[0].surface, 1, 1), {4, 3, 0}), 1e-12);
  }
}

// Weights that change in one direction alone are weights.
TEST_F(CadShapes, SurfacesMayBeRationalOneWay) {
  for (const std::string weights : {"((1.,0.5),(1.,0.5))", "((1.,1.),(0.5,0.5))"}) {
    const std::string net = "#31=" + point_text({0, 0, 0}) + "#32=" + point_text({0, 3, 0}) +
                            "#33=" + point_text({4, 0, 0}) + "#34=" + point_text({4, 3, 0});
    const Document d = read(shell_text(
        "#40",
        "#30=(BOUNDED_SURFACE()B_SPLINE_SURFACE(1,1,((#31,#32),(#33,#34)),.UNSPECIFIED.,.F.,"
        ".F.,.F.)B_SPLINE_SURFACE_WITH_KNOTS((2,2),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.)"
        "GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE(" +
            weights + ")REPRESENTATION_ITEM('')SURFACE());\n" + net +
            face_text(40, "#30", {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}})));
    ASSERT_EQ(d.surfaces.size(), 1U);
    // Halfway the corner of weight 1 counts twice: at a third of the way.
    const bool across = weights.starts_with("((1.,0.5)");
    const Point3 middle = across ? Point3{2, 1, 0} : Point3{4.0 / 3, 1.5, 0};
    EXPECT_LT(distance(evaluate(d.surfaces[0].surface, 0.5, 0.5), middle), 1e-12) << weights;
  }
}

}  // namespace
}  // namespace keyline::exchange
