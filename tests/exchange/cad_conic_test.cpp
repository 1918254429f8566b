#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/document/document.h"

#include "cad_fixture.h"
#include "iges_text.h"
#include "step_text.h"

/// Conics (IGES 5.3, 4.4) and the matrices that place them (4.21): expected are the points that the
/// equation and the ends have.
namespace keyline::exchange {
namespace {

using core::Point2;
using core::Point3;
using core::Vector2;
using document::Document;
using testing::HasSubstr;
using testing::IsEmpty;

/// A conic arc by points of it, in a frame: an ellipse m cos t, n sin t, a hyperbola m cosh t, n
/// sinh t, a parabola t^2 / 4 m, t.
struct Arc {
  const char* what;
  int form;
  double m;
  double n;
  double from;
  double to;
  double angle;  ///< of the frame
  Vector2 center;

  Point2 at(double t) const {
    const Vector2 p = form == 1   ? Vector2{m * std::cos(t), n * std::sin(t)}
                      : form == 2 ? Vector2{m * std::cosh(t), n * std::sinh(t)}
                                  : Vector2{t * t / (4 * m), t};
    const double c = std::cos(angle), s = std::sin(angle);
    return Point2{c * p.x - s * p.y, s * p.x + c * p.y} + center;
  }
  /// The parameters of entity 104; the equation of the frame with x and y put in.
  std::string text(double factor = 1) const {
    const double c = std::cos(angle), s = std::sin(angle);
    const double xx = form == 3 ? 0 : 1 / (m * m);
    const double yy = form == 3 ? 1 : (form == 1 ? 1 : -1) / (n * n);
    const double x = form == 3 ? -4 * m : 0;
    const double constant = form == 3 ? 0 : -1;
    const double a = xx * c * c + yy * s * s;
    const double b = 2 * (xx - yy) * c * s;
    const double cc = xx * s * s + yy * c * c;
    const Vector2 d{x * c, x * s};
    const Vector2 o = center;
    std::string made = "104";
    for (const double v :
         {a, b, cc, d.x - 2 * a * o.x - b * o.y, d.y - 2 * cc * o.y - b * o.x,
          a * o.x * o.x + b * o.x * o.y + cc * o.y * o.y - d.x * o.x - d.y * o.y + constant})
      made += ',' + digits_of(factor * v);
    made += ",0.";
    for (const Point2 p : {at(from), at(to)}) made += ',' + digits_of(p.x) + ',' + digits_of(p.y);
    return made;
  }
};

constexpr double kPi = std::numbers::pi;
const Arc kArcs[] = {{"ellipse along x", 1, 2, 1, 0, kPi / 2, 0, {}},
                     {"ellipse along y", 1, 1, 2, 0, kPi / 2, 0, {}},
                     {"more than half of it", 1, 1, 2, 1, 5, 0, {}},
                     {"ellipse elsewhere", 1, 1, 3, 2, 4, 0, {10, -4}},
                     {"ellipse aslant", 1, 2, 1, 0, kPi / 2, kPi / 4, {}},
                     {"ellipse aslant elsewhere", 1, 3, 1, -1, 2, 2, {5, 6}},
                     {"circle", 1, 2, 2, 1, 4, 0, {3, 1}},
                     {"hyperbola to x", 2, 2, 1, -1, 1, 0, {}},
                     {"hyperbola to -x", 2, 2, 1, -1, 1.5, kPi, {}},
                     {"hyperbola to y", 2, 1, 2, -1, 0.5, kPi / 2, {}},
                     {"hyperbola to -y, backwards", 2, 1, 2, 1, -0.5, -kPi / 2, {1, 2}},
                     {"hyperbola aslant", 2, 1, 2, -0.5, 1, 2.5, {-3, 7}},
                     {"parabola to x", 3, 1, 0, -2, 4, 0, {}},
                     {"parabola to -x", 3, 2, 0, -2, 4, kPi, {}},
                     {"parabola to y", 3, 1, 0, 2, -4, kPi / 2, {}},
                     {"parabola to -y, backwards", 3, 1, 0, -2, 4, -kPi / 2, {1, 1}},
                     {"parabola aslant", 3, 0.5, 0, -1, 3, 0.7, {4, -2}}};

class CadConic : public CadTest {
 protected:
  Document read(const std::vector<IgesEntity>& entities, int unit = 2) const {
    return read_sound("d.iges", iges_file(entities, unit));
  }
};

/// How far a path departs from the arc, in ends and at points between them.
double departure(const document::Path& path, const Arc& arc) {
  double worst = std::max(distance(evaluate(path, 0), arc.at(arc.from)),
                          distance(evaluate(path, 1), arc.at(arc.to)));
  for (int i = 1; i < 8; ++i) {
    const Point2 p = evaluate(path, i / 8.);
    double nearest = INFINITY;
    constexpr int kSteps = 4000;
    for (int k = 0; k <= kSteps; ++k)
      nearest = std::min(nearest, distance(p, arc.at(arc.from + (arc.to - arc.from) * k / kSteps)));
    // Half a step of the samples beside the point: at most the speed times that.
    worst = std::max(worst, nearest > 0.01 ? nearest : 0);
  }
  return worst;
}

TEST_F(CadConic, ArcsLieWhereTheirEquationHasThem) {
  for (const double factor : {1., -3e4, 1e-4})
    for (const bool in_form : {true, false}) {
      std::vector<IgesEntity> entities;
      for (const Arc& arc : kArcs)
        entities.push_back({.parameters = arc.text(factor), .form = in_form ? arc.form : 0});
      const Document d = read(entities);
      EXPECT_THAT(d.skipped, IsEmpty());
      ASSERT_EQ(d.paths.size(), std::size(kArcs)) << factor;
      for (std::size_t i = 0; i < std::size(kArcs); ++i)
        EXPECT_LT(departure(d.paths[i].path, kArcs[i]), 1e-12) << kArcs[i].what << ' ' << factor;
    }
}

TEST_F(CadConic, MayBeOfAnySize) {
  for (const Arc& arc :
       {Arc{"large", 1, 1e4, 2e3, 0, 2, 0.3, {1e4, 0}}, Arc{"flat", 1, 1, 1e3, 0, 2, 0, {}},
        Arc{"large", 2, 3e3, 4e4, -1, 1, 2, {}}, Arc{"large", 3, 1e3, 0, -1e3, 3e3, 2, {}},
        Arc{"small", 1, 1e-3, 2e-3, 0, 2, 0.3, {}}, Arc{"small", 2, 1e-3, 2e-3, -1, 1, 3, {}},
        Arc{"small", 3, 1e-3, 0, -1e-3, 3e-3, 2, {}}}) {
    SCOPED_TRACE(arc.what + std::to_string(arc.form));
    const Document d = read({{.parameters = arc.text(), .form = arc.form}});
    ASSERT_EQ(d.paths.size(), 1U);
    const double size = std::max(arc.m, arc.n) + norm(arc.center);
    EXPECT_LT(distance(evaluate(d.paths[0].path, 0), arc.at(arc.from)), 1e-11 * size);
    EXPECT_LT(distance(evaluate(d.paths[0].path, 1), arc.at(arc.to)), 1e-11 * size);
  }
}

// Mils become millimetres, and a matrix, itself in mils, moves the arc.
TEST_F(CadConic, MayBePlacedAndInAnyUnit) {
  const Arc arc{"", 2, 100, 200, 1, -0.5, -kPi / 2, {100, 200}};
  const Document d = read({{.parameters = arc.text(), .matrix = 3, .form = 2},
                           {.parameters = "124,0.,-1.,0.,1000.,1.,0.,0.,0.,0.,0.,1.,0."}},
                          8);
  ASSERT_EQ(d.paths.size(), 1U);
  for (const double t : {0., 1.}) {
    const Point2 p = arc.at(t == 0 ? arc.from : arc.to);
    EXPECT_LT(distance(evaluate(d.paths[0].path, t), {0.0254 * (1000 - p.y), 0.0254 * p.x}), 1e-12);
  }
}

// At z = 3, read backwards: turning the frame over must not move it.
TEST_F(CadConic, KeepsItsHeight) {
  std::string text = Arc{"", 3, 1, 0, 2, -4, 0, {}}.text();
  text.replace(text.find(",0.,", text.size() - 100), 4, ",3.,");
  const Document d = read({{.parameters = text, .form = 3}});
  ASSERT_EQ(d.space_curves.size(), 1U) << text;
  EXPECT_LT(distance(evaluate(d.space_curves[0].curve, 0), {1, 2, 3}), 1e-12);
  EXPECT_LT(distance(evaluate(d.space_curves[0].curve, 1), {4, -4, 3}), 1e-12);
}

TEST_F(CadConic, IsAPartOfAChain) {
  const Arc arc{"", 3, 1, 0, 2, -4, kPi / 2, {}};  // from (-2, 1) to (4, 4)
  const Document d = read({{.parameters = "102,2,3,5"},
                           {.parameters = "110,-5.,1.,0.,-2.,1.,0.", .status = "00010000"},
                           {.parameters = arc.text(), .form = 3, .status = "00010000"}});
  ASSERT_EQ(d.paths.size(), 1U);
  EXPECT_LT(distance(evaluate(d.paths[0].path, 0), {-5, 1}), 1e-12);
  EXPECT_LT(distance(evaluate(d.paths[0].path, 1), {4, 4}), 1e-12);
}

const std::string kRight5 = "124,1.,0.,0.,5.,0.,1.,0.,0.,0.,0.,1.,0.";
const std::string kQuarterTurn = "124,0.,-1.,0.,0.,1.,0.,0.,0.,0.,0.,1.,0.";

// The inner one first: x + 5, then the turn, then x + 5 again.
TEST_F(CadConic, MatricesMayBePlacedByMatrices) {
  const Document d = read({{.parameters = "110,0.,0.,0.,1.,1.,0.", .matrix = 3},
                           {.parameters = kRight5, .matrix = 5},
                           {.parameters = kQuarterTurn, .matrix = 7},
                           {.parameters = kRight5},
                           {.parameters = "110,0.,0.,0.,1.,1.,0.", .matrix = 5}});
  ASSERT_EQ(d.paths.size(), 2U);
  EXPECT_LT(distance(evaluate(d.paths[0].path, 0), {5, 5}), 1e-12);
  EXPECT_LT(distance(evaluate(d.paths[0].path, 1), {4, 6}), 1e-12);
  EXPECT_LT(distance(evaluate(d.paths[1].path, 0), {5, 0}), 1e-12);
  EXPECT_LT(distance(evaluate(d.paths[1].path, 1), {4, 1}), 1e-12);
}

TEST_F(CadConic, AMatrixPlacedByItselfIsRefused) {
  const auto d =
      read_text("d.iges", iges_file({{.parameters = "110,0.,0.,0.,1.,1.,0.", .matrix = 3},
                                     {.parameters = kRight5, .matrix = 5},
                                     {.parameters = kQuarterTurn, .matrix = 3}}));
  ASSERT_FALSE(d);
  EXPECT_THAT(d.error().message, HasSubstr("placed by itself"));
}

}  // namespace
}  // namespace keyline::exchange
