#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "own_numerics.h"

/// curve.edit_pieces in space, judged by de Casteljau's rule of the test's own.
namespace keyline::operations {
namespace {

using nlohmann::json;
using own::result_of;

using Vec = std::array<double, 3>;

Vec vec(const json& p) { return {p[0], p[1], p.size() > 2 ? p[2].get<double>() : 0.0}; }
Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double norm(const Vec& a) { return std::hypot(a[0], a[1], a[2]); }

/// Point, first and second differences of a Bezier.
struct Place {
  Vec point{}, first{}, second{};
};
Place place(const json& bezier, double t) {
  std::vector<Vec> b;
  for (const json& p : bezier["points"]) b.push_back(vec(p));
  const double n = static_cast<double>(b.size()) - 1;
  Place at;
  while (b.size() > 1) {
    if (b.size() == 3)
      for (std::size_t k = 0; k < 3; ++k)
        at.second[k] = n * (n - 1) * (b[0][k] - 2 * b[1][k] + b[2][k]);
    if (b.size() == 2)
      for (std::size_t k = 0; k < 3; ++k) at.first[k] = n * (b[1][k] - b[0][k]);
    for (std::size_t i = 0; i + 1 < b.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) b[i][k] = (1 - t) * b[i][k] + t * b[i + 1][k];
    b.pop_back();
  }
  at.point = b[0];
  return at;
}

double curvature(const json& bezier, double t) {
  const Place p = place(bezier, t);
  return norm(cross(p.first, p.second)) / std::pow(norm(p.first), 3);
}

bool runs_one_way(const json& bezier) {
  bool rises = false, falls = false;
  double before = curvature(bezier, 0);
  for (int i = 1; i <= 300; ++i) {
    const double now = curvature(bezier, i / 300.0);
    rises |= now > before * (1 + 1e-8);
    falls |= now < before * (1 - 1e-8);
    before = now;
  }
  return !(rises && falls);
}

/// Sine of the angle between two directions.
double off(const Vec& a, const Vec& b) { return norm(cross(a, b)) / norm(a) / norm(b); }

double distance_from(const json& bezier, const Vec& p) {
  double least = 1e300;
  for (int i = 0; i <= 800; ++i)
    least = std::min(least, norm(minus(place(bezier, i / 800.0).point, p)));
  return least;
}

/// A spiral rail: a cubic spline of uneven control points.
json rail(std::mt19937& random, int points) {
  std::uniform_real_distribution<double> unit(-1, 1);
  json control = json::array();
  for (int i = 0; i < points; ++i) {
    const double turn = 0.45 * i, radius = 100 + 14 * i;
    control.push_back({radius * std::cos(turn) + 3 * unit(random),
                       radius * std::sin(turn) + 3 * unit(random), 25.0 * i + 3 * unit(random)});
  }
  json knots = {0, 0, 0, 0};
  for (int i = 1; i < points - 3; ++i) knots.push_back(i);
  for (int i = 0; i < 4; ++i) knots.push_back(points - 3);
  return {{"type", "bspline"}, {"degree", 3}, {"knots", knots}, {"points", control}};
}

/// The spline's pieces by an edit that moves nothing.
json pieces_of(const json& spline) {
  return result_of(
      {{"op", "curve.edit_pieces"}, {"curve", spline}, {"limit", 0}})["curve"]["curves"];
}

TEST(CurveEditInSpace, TakesEveryPieceToClassAAndKeepsItsJoints) {
  std::mt19937 random(9);
  int edited = 0, pieces = 0, calm_before = 0;
  for (int n = 0; n < 12; ++n) {
    SCOPED_TRACE(n);
    const json spline = rail(random, 7 + n % 5);
    const json given = pieces_of(spline);
    const json r = result_of({{"op", "curve.edit_pieces"}, {"curve", spline}});
    const json& now = r["curve"]["curves"];
    ASSERT_EQ(now.size(), given.size());
    EXPECT_EQ(r["joints_after"]["g1"], now.size() - 1);
    edited += r["edited"].get<int>();
    for (std::size_t i = 0; i < now.size(); ++i) {
      ++pieces;
      EXPECT_EQ(now[i]["points"].front(), given[i]["points"].front());
      EXPECT_EQ(now[i]["points"].back(), given[i]["points"].back());
      for (const double t : {0.0, 1.0})
        EXPECT_LT(off(place(now[i], t).first, place(given[i], t).first), 1e-9);
      calm_before += runs_one_way(given[i]);
      if (r["pieces"][i]["became"] == "edited") {
        EXPECT_TRUE(runs_one_way(now[i])) << i;
      }
      const double told = r["pieces"][i]["departure"];
      for (int k = 0; k <= 20; ++k) {
        EXPECT_LE(distance_from(given[i], place(now[i], k / 20.0).point), told + 0.03);
        EXPECT_LE(distance_from(now[i], place(given[i], k / 20.0).point), told + 0.03);
      }
    }
  }
  EXPECT_GT(edited, 0.9 * pieces);
  EXPECT_LT(calm_before, 0.8 * pieces);
}

// Two half turns of opposite bends out of the plane: a spline does not say that it is closed, its
// ends do.
TEST(CurveEditInSpace, KeepsAClosedCurveClosed) {
  const json loop{
      {"type", "bspline"},
      {"degree", 3},
      {"knots", {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2}},
      {"points",
       {{0, 0, 0}, {1, 2, 0.5}, {4, 2, 1}, {5, 0, 0}, {4, -2, -1}, {1, -2, -0.5}, {0, 0, 0}}}};
  const json r = result_of({{"op", "curve.edit_pieces"}, {"curve", loop}});
  EXPECT_EQ(r["curve"]["closed"], true);
  ASSERT_EQ(r["curve"]["curves"].size(), 2U);
  EXPECT_EQ(r["curve"]["curves"][1]["points"].back(), r["curve"]["curves"][0]["points"].front());
}

TEST(CurveEditInSpace, HalfTheWayAndLimitsAreKept) {
  std::mt19937 random(4);
  const json spline = rail(random, 9);
  const json given = pieces_of(spline);
  const json all = result_of({{"op", "curve.edit_pieces"}, {"curve", spline}});
  const json half = result_of({{"op", "curve.edit_pieces"}, {"curve", spline}, {"amount", 0.5}});
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto &a = given[i]["points"], &b = all["curve"]["curves"][i]["points"];
    if (a.size() != b.size()) continue;
    const auto& c = half["curve"]["curves"][i]["points"];
    for (std::size_t k = 0; k < a.size(); ++k)
      for (std::size_t x = 0; x < 3; ++x)
        EXPECT_NEAR(c[k][x].get<double>(), (a[k][x].get<double>() + b[k][x].get<double>()) / 2,
                    1e-9);
  }
  const double limit = all["departure"].get<double>() / 2;
  const json held = result_of({{"op", "curve.edit_pieces"}, {"curve", spline}, {"limit", limit}});
  EXPECT_LE(held["departure"].get<double>(), limit);
  EXPECT_LT(held["edited"].get<int>(), all["edited"].get<int>());
  EXPECT_EQ(held["joints_after"]["g1"], given.size() - 1);
}

/// Two loops from one place that go on in each other's direction, but bend to opposite sides there.
TEST(CurveEditInSpace, JointsOfLoopsFromOnePlaceAreComparedLikeOthers) {
  const json loops{
      {"type", "path"},
      {"curves",
       {{{"type", "bezier"}, {"points", {{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 0, 0}}}},
        {{"type", "bezier"}, {"points", {{0, 0, 0}, {-1, -1, -1}, {-2, 0, 0}, {0, 0, 0}}}}}}};
  const json joints = result_of({{"op", "curve.edit_pieces"}, {"curve", loops}})["joints_before"];
  EXPECT_EQ(joints, (json{{"g0", 2}, {"g1", 2}, {"g2", 0}}));
}

}  // namespace
}  // namespace keyline::operations
