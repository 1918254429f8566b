#include "keyline/surface/gordon.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace keyline::surface {
namespace {

using core::Point3;
using curve::BSpline3;

/// A curve through places of a function, as a cubic spline of its own: Hermite pieces.
template <class F>
BSpline3 drawn(const F& place) {
  constexpr int kPieces = 48;
  BSpline3 c{3, {0, 0, 0, 0}, {}, {}};
  const double h = 1.0 / kPieces;
  const auto slope = [&](double t) { return (place(t + 1e-5) - place(t - 1e-5)) / 2e-5; };
  for (int i = 0; i < kPieces; ++i) {
    const double a = i * h;
    const double b = a + h;
    if (i == 0) c.control.push_back(place(a));
    c.control.push_back(place(a) + (h / 3) * slope(a));
    c.control.push_back(place(b) - (h / 3) * slope(b));
    c.control.push_back(place(b));
    for (int k = 0; k < (i + 1 == kPieces ? 4 : 3); ++k) c.knots.push_back(b);
  }
  return c;
}

double radius_off(const BSplineSurface& s, double radius, bool sphere) {
  double worst = 0;
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 40; ++j) {
      const Point3 p = evaluate(s, i / 40.0, j / 40.0);
      const double r = sphere ? norm(p - Point3{}) : std::hypot(p.x, p.y);
      worst = std::max(worst, std::abs(r - radius));
    }
  return worst;
}

/// Meridians and parallels of a sphere of radius 100, 70 by 50 degrees.
std::vector<BSpline3> parallels(int n) {
  std::vector<BSpline3> all;
  for (int k = 0; k < n; ++k) {
    const double b = 0.1 + 0.87 * k / (n - 1);
    all.push_back(drawn([=](double t) {
      const double a = 1.22 * t;
      return Point3{100 * std::cos(b) * std::cos(a), 100 * std::cos(b) * std::sin(a),
                    100 * std::sin(b)};
    }));
  }
  return all;
}
std::vector<BSpline3> meridians(int n) {
  std::vector<BSpline3> all;
  for (int k = 0; k < n; ++k) {
    const double a = 1.22 * k / (n - 1);
    all.push_back(drawn([=](double t) {
      const double b = 0.1 + 0.87 * t;
      return Point3{100 * std::cos(b) * std::cos(a), 100 * std::cos(b) * std::sin(a),
                    100 * std::sin(b)};
    }));
  }
  return all;
}

// Two arcs and two lines of a cylinder: between them the Coons patch is the cylinder.
TEST(Gordon, ACylindersBordersGiveTheCylinder) {
  std::vector<BSpline3> arcs;
  for (const double z : {0.0, 70.0})
    arcs.push_back(
        drawn([z](double t) { return Point3{50 * std::cos(1.4 * t), 50 * std::sin(1.4 * t), z}; }));
  std::vector<BSpline3> lines;
  for (const double a : {1.4, 0.0})  // not in order
    lines.push_back(drawn([a](double t) {
      return Point3{50 * std::cos(a), 50 * std::sin(a), 70 - 70 * t};  // and downwards
    }));
  const auto made = gordon_surface(arcs, lines, {1e-3, 1e-3});
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_LE(made->deviation, 1e-3);
  EXPECT_LE(radius_off(made->surface, 50, false), 1e-3);
}

// Borders that miss each other by a hundredth: nothing is nearer to both than half of that, and
// what is as near as they are to each other is taken, however little the tolerance.
TEST(Gordon, CurvesThatMissEachOtherAreMetAsNearAsTheyMeet) {
  std::vector<BSpline3> arcs, lines;
  for (const double z : {0.0, 70.0})
    arcs.push_back(drawn([z](double t) { return Point3{50 * std::cos(t), 50 * std::sin(t), z}; }));
  for (const double a : {0.0, 1.0})
    lines.push_back(
        drawn([a](double t) { return Point3{50.01 * std::cos(a), 50.01 * std::sin(a), 70 * t}; }));
  const auto made = gordon_surface(arcs, lines, {1e-5, 0.02});
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_NEAR(made->gap, 0.01, 1e-6);
  EXPECT_GE(made->deviation, 0.005 - 1e-6);
  EXPECT_LE(made->deviation, 0.01 + 1e-6);
}

// The more sections of a sphere there are, the more of a sphere comes out.
TEST(Gordon, SectionsOfASphereGiveTheSphere) {
  double before = HUGE_VAL;
  for (const int n : {2, 3, 5, 9}) {
    const auto made = gordon_surface(parallels(n), meridians(n), {1e-3, 1e-3});
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_LE(made->deviation, 1e-3);
    const double off = radius_off(made->surface, 100, true);
    EXPECT_LE(off, std::max(1e-3, 0.3 * before)) << n;
    before = off;
  }
  EXPECT_LT(before, 1e-3);
}

// Cubic borders take one bicubic patch, and it is the one of Coons' formula.
TEST(Gordon, FourCubicBordersGiveOnePatch) {
  const auto cubic = [](const std::vector<Point3>& points) {
    return BSpline3{3, {0, 0, 0, 0, 1, 1, 1, 1}, points, {}};
  };
  const auto low = cubic({{0, 0, 0}, {1, 0, 0.6}, {2, 0, 0.6}, {3, 0, 0}});
  const auto high = cubic({{0, 2, 0.2}, {1, 2, 0.9}, {2, 2, 0.9}, {3, 2, 0.2}});
  const auto left = cubic({{0, 0, 0}, {0, 0.7, 0.3}, {0, 1.4, 0.4}, {0, 2, 0.2}});
  const auto right = cubic({{3, 0, 0}, {3, 0.7, 0.5}, {3, 1.4, 0.4}, {3, 2, 0.2}});
  const auto made = gordon_surface({low, high}, {left, right}, {1e-6, 1e-9});
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->surface.net.points.size(), 16U);
  EXPECT_LE(made->deviation, 1e-12);
  for (const double u : {0.2, 0.5, 0.9})
    for (const double v : {0.1, 0.6}) {
      const auto mixed = [](Point3 a, Point3 b, double t) { return core::mix(a, b, t); };
      const Point3 rows = mixed(evaluate(low, u), evaluate(high, u), v);
      const Point3 columns = mixed(evaluate(left, v), evaluate(right, v), u);
      const Point3 corners = mixed(mixed(evaluate(low, 0), evaluate(low, 1), u),
                                   mixed(evaluate(high, 0), evaluate(high, 1), u), v);
      const Point3 coons = rows + (columns - corners);
      EXPECT_LE(core::distance(evaluate(made->surface, u, v), coons), 1e-12);
    }
}

// Given in another order, turned round or reaching farther, the same curves make the same surface.
TEST(Gordon, OrderAndDirectionOfCurvesDoNotMatter) {
  auto u = parallels(3);
  const auto v = meridians(3);
  const auto plain = gordon_surface(u, v, {1e-3, 1e-3});
  std::swap(u[0], u[2]);
  u[1] = curve::reverse(u[1]);
  const auto other = gordon_surface(u, v, {1e-3, 1e-3});
  ASSERT_TRUE(plain && other);
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j) {
      const Point3 p = evaluate(plain->surface, i / 10.0, j / 10.0);
      double least = HUGE_VAL;
      for (const auto& [a, b] : {std::pair{i, j}, {10 - i, j}, {i, 10 - j}, {10 - i, 10 - j}})
        least = std::min(least, core::distance(p, evaluate(other->surface, a / 10.0, b / 10.0)));
      EXPECT_LE(least, 1e-6);
    }
}

// Places along both curves were looked at in equal shares, so that the crossing was missed
// by 4.5e-5 here, and others took minutes.
TEST(Gordon, CurvesAMillionTimesAsLongAsTheOthersAreCrossed) {
  const auto line = [](Point3 a, Point3 b) { return BSpline3{1, {0, 0, 1, 1}, {a, b}, {}}; };
  const auto made = gordon_surface(
      {line({-2e8, 0, 0}, {7e8, 0, 0}), line({-2e8, 1, 0}, {7e8, 1, 0})},
      {line({0, -0.3, 0}, {0, 1.6, 0}), line({1, -0.3, 0}, {1, 1.6, 0})}, {1e-3, 1e-3});
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_LT(made->gap, 1e-6);  // the digits of places at 7e8
  EXPECT_LT(distance(evaluate(made->surface, 0.5, 0.5), {0.5, 0.5, 0}), 1e-5);
}

// Two sections in one place, borders that meet in a corner, and diagonals in place of borders,
// whose patch would be a bow tie: no order of such curves makes a patch of each mesh.
TEST(Gordon, CurvesThatMeetOthersOfTheirDirectionAreNamed) {
  const auto line = [](Point3 a, Point3 b) { return BSpline3{1, {0, 0, 1, 1}, {a, b}, {}}; };
  const BSpline3 low = line({0, 0, 0}, {3, 0, 0}), middle = line({0, 1, 0}, {3, 1, 0}),
                 high = line({0, 2, 0}, {3, 2, 0});
  const BSpline3 left = line({0, 0, 0}, {0, 2, 0}), right = line({3, 0, 0}, {3, 2, 0});
  const BSpline3 rising = line({0, 0, 0}, {3, 2, 0}), falling = line({0, 2, 0}, {3, 0, 0});
  struct Case {
    const char* path;
    std::vector<BSpline3> u, v;
  };
  for (const Case& c : {Case{"along_u[2]", {low, middle, middle, high}, {left, right}},
                        Case{"along_v[1]", {low, high}, {left, rising}},
                        Case{"along_v[1]", {low, high}, {rising, falling}}}) {
    const auto refused = gordon_surface(c.u, c.v);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, core::ErrorCode::bad_input);
    EXPECT_EQ(refused.error().path, c.path);
    EXPECT_NE(refused.error().message.find("of its own direction"), std::string::npos);
  }
  // beyond the outermost of the others they may meet
  EXPECT_TRUE(gordon_surface({line({-3, -1, 0}, {3, 1, 0}), line({-3, 1, 0}, {3, -1, 0})},
                             {line({1, -2, 0}, {1, 2, 0}), line({2, -2, 0}, {2, 2, 0})}));
}

TEST(Gordon, CurvesThatMakeNoNetAreNamed) {
  auto u = parallels(3);
  const auto v = meridians(2);
  for (Point3& p : u[1].control) p.z += 5;
  const auto missed = gordon_surface(u, v, {1e-3, 1e-3});
  ASSERT_FALSE(missed);
  EXPECT_EQ(missed.error().code, core::ErrorCode::bad_input);
  EXPECT_EQ(missed.error().path, "along_u[1]");
  EXPECT_FALSE(gordon_surface({parallels(2)[0]}, v));
  const BSpline3 corner{1, {0, 0, 0.5, 1, 1}, {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}}, {}};
  BSpline3 far = corner;
  for (Point3& p : far.control) p.y = 2;
  const std::vector<BSpline3> sides = {{1, {0, 0, 1, 1}, {{0, 0, 0}, {0, 2, 0}}, {}},
                                       {1, {0, 0, 1, 1}, {{2, 0, 0}, {2, 2, 0}}, {}}};
  const auto sharp = gordon_surface({corner, far}, sides, {1e-4, 1e-4});
  ASSERT_FALSE(sharp);
  EXPECT_EQ(sharp.error().code, core::ErrorCode::not_converged);
}

}  // namespace
}  // namespace keyline::surface
