#include "keyline/exchange/svg/cubic_path.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/exchange/cad/planar_form.h"
#include "keyline/exchange/cad/spline_corners.h"
#include "keyline/exchange/svg/drawing_layers.h"

/// Curves on their way into drawings and CAD files.
namespace keyline::exchange {
namespace {

using core::Point2;
using core::Point3;
using curve::Bezier2;

TEST(CubicPath, LinesAndBeziersStayWhatTheyAre) {
  const Bezier2 line{{{0, 0}, {1, 0}}, {}}, bent{{{1, 0}, {2, 1}, {3, 0}}, {}},
      cubic{{{3, 0}, {4, 1}, {5, -1}, {6, 0}}, {}};
  document::Path path{{{line}, {bent}, {cubic}}, false};
  const CubicPath made = cubic_path(path, "name", 1e-3);
  ASSERT_EQ(made.path.pieces.size(), 3U);
  EXPECT_EQ(made.path.pieces[0], line);
  EXPECT_EQ(made.path.pieces[1], bent);
  EXPECT_EQ(made.path.pieces[2], cubic);
  EXPECT_EQ(made.deviation, 0);
  EXPECT_EQ(made.path.name, "name");
  EXPECT_FALSE(made.path.closed);
  // Degree 4 and weights are no part of SVG.
  const Bezier2 quartic{{{0, 0}, {1, 1}, {2, -1}, {3, 1}, {4, 0}}, {}};
  EXPECT_GT(cubic_path({{{quartic}}, false}, "", 1e-3).path.pieces.size(), 1U);
  const Bezier2 rational{{{0, 0}, {1, 1}, {2, 0}}, {1, 3, 1}};
  const CubicPath cubics = cubic_path({{{rational}}, false}, "", 1e-3);
  for (const Bezier2& piece : cubics.path.pieces) EXPECT_TRUE(piece.weights.empty());
  EXPECT_LE(cubics.deviation, 1e-3);
  EXPECT_GT(cubics.deviation, 0);
}

TEST(CubicPath, PolylinesAreTheirEdges) {
  const curve::Polyline2 line{{{0, 0}, {1, 0}, {1, 0}, {1, 2}}};
  const CubicPath made = cubic_path({{{line}}, false}, "", 1e-3);
  ASSERT_EQ(made.path.pieces.size(), 2U);  // no edge of no length
  EXPECT_EQ(made.path.pieces[1].control, (std::vector<Point2>{{1, 0}, {1, 2}}));
}

// Ends that meet to a billionth of the size meet exactly; farther ones stay apart.
TEST(CubicPath, EndsThatAllButMeetAreMadeToMeet) {
  const auto triangle = [](double gap, bool closed) {
    const document::Path path{{{Bezier2{{{0, 0}, {10, 0}}, {}}},
                               {Bezier2{{{10, gap}, {5, 8}}, {}}},
                               {Bezier2{{{5, 8}, {0, gap}}, {}}}},
                              closed};
    return cubic_path(path, "", 1e-3).path;
  };
  const SvgPath near = triangle(9e-9, true);
  EXPECT_TRUE(near.closed);
  EXPECT_EQ(near.pieces[2].control.back(), (Point2{0, 0}));
  EXPECT_EQ(near.pieces[1].control.front(), (Point2{10, 0}));
  const SvgPath far = triangle(1.1e-8, true);
  EXPECT_FALSE(far.closed);
  EXPECT_EQ(far.pieces[1].control.front(), (Point2{10, 1.1e-8}));
  EXPECT_FALSE(triangle(0, false).closed);
}

TEST(CubicPath, AClosedChainIsALoopByItself) {
  const double pi = std::numbers::pi;
  const lac::Chain circle{{{1, 0}, pi / 2}, {{-1, 2 * pi, 1, 1}}, true};
  EXPECT_TRUE(cubic_path({{{circle}}, false}, "", 1e-3).path.closed);
  lac::Chain open = circle;
  open.closed = false;
  EXPECT_FALSE(cubic_path({{{open}}, false}, "", 1e-3).path.closed);
}

// ---- Layers of a drawing -----------------------------------------------------------------

TEST(DrawingLayers, AreOnePerNameInTheirOrder) {
  document::Document d;
  const auto add = [&](const char* name, const char* layer, double width) {
    d.paths.push_back(
        {{name, layer, "#010203"}, {{{Bezier2{{{0, 0}, {1, 0}}, {}}}}, false}, width});
  };
  add("a", "glass", 0.5);
  add("b", "body", 0);
  add("c", "glass", 0);
  add("d", "", 0);
  add("", "", 0);
  d.space_curves.resize(2);
  Written written;
  const auto layers = drawing_layers(d, 1e-3, written);
  ASSERT_EQ(layers.size(), 4U);
  EXPECT_EQ(layers[0].name, "glass");
  EXPECT_EQ(layers[0].paths.size(), 2U);
  EXPECT_EQ(layers[0].paths[0].width, 0.5);
  EXPECT_EQ(layers[0].paths[1].name, "c");
  EXPECT_EQ(layers[0].paths[1].color, "#010203");
  EXPECT_EQ(layers[1].name, "body");
  EXPECT_EQ(layers[2].name, "d");
  EXPECT_EQ(layers[3].name, "key-line");
  ASSERT_EQ(written.notes.size(), 1U);
  EXPECT_EQ(written.notes[0], "2 space curves are not in the drawing: it is planar");
  EXPECT_EQ(drawing_options(d, written).unit, "mm");
  d.unit = "in";
  written.deviation = 0.0125;
  EXPECT_EQ(drawing_options(d, written).unit, "in");
  EXPECT_NE(drawing_options(d, written).title.find("within 0.0125 of"), std::string::npos);
}

// ---- Planes ------------------------------------------------------------------------------

TEST(PlanarForm, IsExactInThePlaneOfTheCurve) {
  const curve::Bezier3 flat{{{0, 5, 0}, {1, 5, 2}, {3, 5, 1}, {4, 5, 3}}, {1, 2, 1, 1}};
  const auto form = planar_form({flat});
  ASSERT_TRUE(form);
  const auto& c = std::get<Bezier2>(form->curve.value);
  EXPECT_EQ(c.control, (std::vector<Point2>{{0, 0}, {1, 2}, {3, 1}, {4, 3}}));
  EXPECT_EQ(c.weights, flat.weights);
  EXPECT_EQ(in_words(form->plane), "in the plane y = 5; x and z");
  curve::Bezier3 bent = flat;
  bent.control[1].y += 4e-8;
  EXPECT_FALSE(planar_form({bent}));
  bent.control[1].y = 5 + 1e-10;
  EXPECT_TRUE(planar_form({bent}));
  const curve::Polyline3 line{{{2, 0, 0}, {2, 1, 0}, {2, 0, 1}}};
  EXPECT_EQ(in_words(planar_form({line})->plane), "in the plane x = 2; y and z");
  const curve::BSpline3 spline{1, {0, 0, 1, 2, 2}, {{0, 0, -3}, {1, 0, -3}, {0, 1, -3}}, {}};
  const auto level = planar_form({spline});
  EXPECT_EQ(in_words(level->plane), "in the plane z = -3; x and y");
  EXPECT_EQ(std::get<curve::BSpline2>(level->curve.value).knots, spline.knots);
  EXPECT_FALSE(planar_form({curve::Polyline3{{{1, 1, 1}, {1, 1, 1}}}}));
  EXPECT_EQ(in_words({{}, {0.6, 0.8, 0}, {0, 0, 1}}), "in a plane of its own");
}

TEST(Flatten, LeavesWhatIsBentInSpace) {
  document::Document d;
  d.space_curves.push_back(
      {{"flat", "", ""}, {curve::Polyline3{{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 1}}}}, true});
  d.space_curves.push_back(
      {{"bent", "", ""}, {curve::Polyline3{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}});
  const auto laid = flatten(d);
  ASSERT_EQ(laid.size(), 1U);
  EXPECT_TRUE(laid[0].half_breadth);
  EXPECT_EQ(laid[0].plane.origin.z, 1);
  ASSERT_EQ(d.paths.size(), 1U);
  EXPECT_EQ(d.paths[0].label.name, "flat");
  EXPECT_TRUE(d.paths[0].path.closed);
  ASSERT_EQ(d.space_curves.size(), 1U);
  EXPECT_EQ(d.space_curves[0].label.name, "bent");
}

// A path as one cubic spline in space: knots thrice inside, four times at its ends.
TEST(Placed, IsOneCubicSpline) {
  const document::Path path{
      {{Bezier2{{{0, 0}, {3, 0}}, {}}}, {Bezier2{{{3, 0}, {4, 2}, {6, 0}}, {}}}}, false};
  const auto curve = placed(path, {{0, 5, 0}, {1, 0, 0}, {0, 0, 1}}, 1e-3);
  const auto& s = std::get<curve::BSpline3>(curve.value);
  EXPECT_EQ(s.degree, 3);
  EXPECT_EQ(s.knots, (std::vector<double>{0, 0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1, 1}));
  ASSERT_EQ(s.control.size(), 7U);
  EXPECT_EQ(s.control[1], (Point3{1, 5, 0}));
  EXPECT_EQ(s.control[3], (Point3{3, 5, 0}));
  EXPECT_NEAR(s.control[4].z, 4 / 3.0, 1e-15);
  EXPECT_EQ(s.control[6], (Point3{6, 5, 0}));
}

// ---- Corners of splines ------------------------------------------------------------------

TEST(SplineCorners, PartWhereADirectionTurns) {
  using detail::parted_at_corners;
  const auto cubic = [](double turn) {
    return curve::BSpline2{3,
                           {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2},
                           {{0, 0}, {1, 1}, {2, 1}, {3, 0}, {4, -1 + turn}, {5, 0}, {6, 0}},
                           {}};
  };
  // In (1, -1) and out (1, -1 + turn): the angle between is half the turn at first.
  EXPECT_EQ(parted_at_corners(cubic(1.9e-6)).size(), 1U);
  const auto parts = parted_at_corners(cubic(2.1e-6));
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(core::distance(evaluate(parts[0], 1), {3, 0}), 0, 1e-14);
  EXPECT_NEAR(core::distance(evaluate(parts[1], 1), {6, 0}), 0, 1e-14);
}

TEST(SplineCorners, StraightSpansAreLines) {
  using detail::parted_at_corners;
  curve::BSpline2 spline{3,
                         {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2},
                         {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {4, 2}, {6, 2}},
                         {}};
  const auto parts = parted_at_corners(spline);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(std::get<Bezier2>(parts[0].value).control, (std::vector<Point2>{{0, 0}, {3, 0}}));
  EXPECT_TRUE(std::holds_alternative<curve::BSpline2>(parts[1].value));
  // Control points that turn back, or leave the line, draw none.
  spline.control[1] = {2.5, 0};
  EXPECT_FALSE(std::holds_alternative<Bezier2>(parted_at_corners(spline)[0].value));
  spline.control[1] = {1, 1e-9};
  EXPECT_FALSE(std::holds_alternative<Bezier2>(parted_at_corners(spline)[0].value));
  const curve::BSpline2 polygon{1, {0, 0, 1, 2, 2}, {{0, 0}, {1, 0}, {1, 1}}, {}};
  const auto line = parted_at_corners(polygon);
  ASSERT_EQ(line.size(), 1U);
  EXPECT_EQ(std::get<curve::Polyline2>(line[0].value).points, polygon.control);
}

}  // namespace
}  // namespace keyline::exchange
