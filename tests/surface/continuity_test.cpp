#include "keyline/surface/continuity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "test_surfaces.h"

namespace keyline::surface {
namespace {

EdgeContinuity joint(const Surface& a, const Surface& b,
                     const std::optional<std::array<Edge, 2>>& edges = {}) {
  auto found = edge_continuity(a, b, edges);
  EXPECT_TRUE(found) << found.error().message;
  return found ? *found : EdgeContinuity{};
}

TEST(EdgeContinuity, HalvesOfOnePatchAreG3HoweverTheyRun) {
  const auto [a, b] = halves_u(crowned_patch());
  for (const Surface& second :
       {Surface{b}, Surface{transposed(b)}, Surface{reversed_u(b)},
        Surface{transposed(reversed_u(transposed(b)))}, Surface{elevate_degree(b, 1, 2)}}) {
    const EdgeContinuity c = joint(a, second);
    EXPECT_EQ(c.edges[0], Edge::u1);
    EXPECT_EQ(c.order, 3);
    EXPECT_LT(c.gap, 1e-11);
    EXPECT_LT(c.angle, 1e-12);
    EXPECT_LT(c.relative_curvature_jump, 1e-9);
    EXPECT_LT(c.relative_rate_jump, 1e-7);
  }
}

TEST(EdgeContinuity, EachRowOfTheNetTakesOneOrder) {
  const auto [a, b] = halves_u(crowned_patch());
  const double by[4] = {0.5, 1, 2, 60};
  const int order[4] = {-1, 0, 1, 2};
  for (int row = 0; row < 4; ++row) {
    SCOPED_TRACE(row);
    BezierSurface moved = b;
    for (int j = 0; j < 4; ++j) moved.net.at(row, j).z += by[row];
    EXPECT_EQ(joint(a, moved, std::array{Edge::u1, Edge::u0}).order, order[row]);
  }
}

// Two patches of one plane have no fold, though their edges part by half the gap allowed.
TEST(EdgeContinuity, EdgesThatRunApartInAPlaneDoNotFold) {
  const BezierSurface a{{2, 2, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}}}, {}};
  const BezierSurface b{{2, 2, {{1, 0, 0}, {1.0005, 1, 0}, {2, 0, 0}, {2, 1, 0}}}, {}};
  const EdgeContinuity c = joint(a, b, std::array{Edge::u1, Edge::u0});
  EXPECT_NEAR(c.gap, 0.0005, 1e-9);
  EXPECT_LT(c.angle, 1e-12);
}

void expect_the_same(const EdgeContinuity& one, const EdgeContinuity& two) {
  EXPECT_EQ(one.edges, (std::array{two.edges[1], two.edges[0]}));
  EXPECT_EQ(one.order, two.order);
  EXPECT_NEAR(one.gap, two.gap, 1e-12);
  EXPECT_NEAR(one.angle, two.angle, 1e-12);
  EXPECT_NEAR(one.relative_curvature_jump, two.relative_curvature_jump, 1e-12);
  EXPECT_NEAR(one.length, two.length, 1e-12);
}

// A flat patch and a narrower cylinder that continues it, from y = 2 to y = 5 of 7.
TEST(EdgeContinuity, TheCommonPartIsComparedWhicheverComesFirst) {
  const double r = 4;
  const BezierSurface flat{{2, 2, {{-5, 0, r}, {-5, 7, r}, {0, 0, r}, {0, 7, r}}}, {}};
  BezierSurface round = quarter_cylinder(0, 0, r, 3);
  for (auto& p : round.net.points) p.y += 2;
  const BezierSurface reversed = transposed(reversed_u(transposed(round)));
  for (const BezierSurface& part : {round, reversed}) {
    const EdgeContinuity c = joint(flat, part);
    EXPECT_EQ(c.edges, (std::array{Edge::u1, Edge::u0}));
    EXPECT_EQ(c.order, 1);
    EXPECT_LT(c.gap, 1e-12);
    EXPECT_NEAR(c.curvature_jump, 1 / r, 1e-12);
    EXPECT_NEAR(c.length, 3, 1e-12);
    ASSERT_EQ(c.samples.size(), 101U);
    for (int i = 0; i <= 100; ++i) {
      EXPECT_NEAR(c.samples[i].position.y, 2 + 0.03 * i, 1e-12);
      EXPECT_NEAR(c.samples[i].along, (2 + 0.03 * i) / 7, 1e-12);
    }
    expect_the_same(joint(part, flat), c);
  }
  // Lifted, the same gap is seen from both.
  for (auto& p : round.net.points) p.z += 0.01;
  const EdgeContinuity lifted = joint(flat, round, std::array{Edge::u1, Edge::u0});
  EXPECT_NEAR(lifted.gap, 0.01, 1e-12);
  expect_the_same(joint(round, flat, std::array{Edge::u0, Edge::u1}), lifted);
}

/// A strip from x = `from` to `to` over the polyline (y, z) at the knots y of [0, 1].
BSplineSurface folded_strip(double from, double to, const std::vector<core::Point2>& line) {
  BSplineSurface s;
  s.degree = {1, 1};
  s.knots = {{{0, 0, 1, 1}, {0}}};
  s.net = {2, static_cast<int>(line.size()), {}};
  for (const double x : {from, to})
    for (const auto& [y, z] : line) s.net.points.push_back({x, y, z});
  for (const auto& p : line) s.knots[1].push_back(p.x);
  s.knots[1].push_back(1);
  return s;
}

// A thousand spans, one vertex lifted: no one of 101 places is near it.
TEST(EdgeContinuity, KnotsAreComparedToo) {
  std::vector<core::Point2> level;
  for (int i = 0; i <= 1000; ++i) level.push_back({i / 1000.0, 0});
  auto lifted = level;
  lifted[505].y = 0.5;
  const auto edges = std::array{Edge::u1, Edge::u0};
  for (const bool first : {true, false}) {
    const EdgeContinuity c = joint(folded_strip(0, 1, first ? lifted : level),
                                   folded_strip(1, 2, first ? level : lifted), edges);
    EXPECT_NEAR(c.gap, 0.5, 1e-9) << first;
    EXPECT_EQ(c.order, -1);
  }
}

// A roof whose ridge runs on over the joint: both sides of it fold, but neither against the other,
// in whichever sense the edges run, and where one edge ends at the ridge of the other.
TEST(EdgeContinuity, ACreaseThatRunsOnIsNoFold) {
  const Surface roof = folded_strip(0, 1, {{0, 0}, {0.5, 0.3}, {1, 0}});
  const BSplineSurface next = folded_strip(1, 2, {{0, 0}, {0.5, 0.3}, {1, 0}});
  const BezierSurface slope{{2, 2, {{1, 0, 0}, {1, 0.5, 0.3}, {2, 0, 0}, {2, 0.5, 0.3}}}, {}};
  BSplineSurface against = next;
  for (int i = 0; i < 2; ++i) std::swap(against.net.at(i, 0), against.net.at(i, 2));
  for (const Surface& other : {Surface{next}, Surface{against}, Surface{slope}}) {
    for (const EdgeContinuity& c : {joint(roof, other), joint(other, roof)}) {
      EXPECT_EQ(c.order, 3);
      EXPECT_LT(c.gap, 1e-12);
      EXPECT_LT(c.angle, 1e-9);
    }
  }
}

TEST(EdgeContinuity, JumpsHaveTheirSize) {
  // A flat top runs into a quarter cylinder: curvature 0 to 1/r, the rate 0 on both sides.
  const double r = 4;
  BezierSurface flat{{2, 2, {}}, {}};
  flat.net.points = {{-5, 0, r}, {-5, 7, r}, {0, 0, r}, {0, 7, r}};
  EdgeContinuity c = joint(flat, quarter_cylinder(0, 0, r, 7));
  EXPECT_EQ(c.order, 1);
  EXPECT_NEAR(c.curvature_jump, 1 / r, 1e-12);
  EXPECT_NEAR(c.relative_curvature_jump, 1, 1e-12);
  EXPECT_NEAR(c.rate_jump, 0, 1e-12);
  // Two radii, tangent along the top.
  c = joint(quarter_cylinder(0, 0, 2, 7), quarter_cylinder(0, -2, 4, 7),
            std::array{Edge::u0, Edge::u0});
  EXPECT_NEAR(c.angle, std::numbers::pi, 1e-12);  // they lie on the same side: a fold back
  // A fold of 0.3 rad.
  BezierSurface tilted = flat;
  tilted.net.points = {{0, 0, r},
                       {0, 7, r},
                       {5 * std::cos(0.3), 0, r - 5 * std::sin(0.3)},
                       {5 * std::cos(0.3), 7, r - 5 * std::sin(0.3)}};
  c = joint(flat, tilted);
  EXPECT_EQ(c.order, 0);
  EXPECT_NEAR(c.angle, 0.3, 1e-12);
  for (auto& p : tilted.net.points) p.z += 0.01;
  c = joint(flat, tilted);
  EXPECT_EQ(c.order, -1);
  EXPECT_NEAR(c.gap, 0.01, 1e-12);
}

TEST(EdgeContinuity, RateAcrossAnExtrudedCurveIsTheCurvesOwn) {
  // Extruded cubic z(x): curvature rate across x = 0 is z''' at a horizontal start.
  const auto ribbon = [](double side, double third) {
    BezierSurface s{{4, 2, {}}, {}};
    for (int i = 0; i < 4; ++i)
      for (const double y : {0.0, 3.0})
        s.net.points.push_back({side * i / 3.0, y, (i == 3 ? side * third / 6 : 0.0)});
    return s;
  };
  const EdgeContinuity c = joint(ribbon(-1, 0.5), ribbon(1, 2));
  EXPECT_NEAR(c.rate_jump, 1.5, 1e-12);
  EXPECT_EQ(c.order, 2);
}

TEST(EdgeContinuity, TolerancesAreTheCallers) {
  const auto [a, b] = halves_u(crowned_patch());
  BezierSurface moved = b;
  for (auto& p : moved.net.points) p.z += 0.005;
  EXPECT_EQ(joint(a, moved).order, -1);
  EdgeTolerance wide;
  wide.gap = 0.01;
  const auto c = edge_continuity(a, moved, {}, wide);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->order, 3);
  wide.angle = -1;
  EXPECT_EQ(edge_continuity(a, moved, {}, wide).error().path, "angle");
  EXPECT_EQ(edge_continuity(a, moved, {}, {}, 1).error().path, "samples");
}

// A panel of 100 mm may gape by 0.001 mm: so may the same panel told in metres or inches.
TEST(EdgeContinuity, GapsCountInEveryUnitTheSame) {
  for (const double unit : {1.0, 1e-3, 1 / 25.4, 1e3}) {
    SCOPED_TRACE(unit);
    const auto order_at = [unit](double gap) {
      BezierSurface left{{2, 2, {{0, 0, 0}, {0, 100, 0}, {100, 0, 0}, {100, 100, 0}}}, {}};
      BezierSurface right = left;
      for (auto& p : right.net.points) p.x += 100 + gap;
      for (BezierSurface* s : {&left, &right})
        for (auto& p : s->net.points) p = {unit * p.x, unit * p.y, unit * p.z};
      return joint(left, right).order;
    };
    EXPECT_EQ(order_at(0.001), 3);
    EXPECT_EQ(order_at(0.002), -1);
  }
}

TEST(EdgeContinuity, CollapsedEdgesAreComparedByPosition) {
  const Surface s = sphere_octant(1);
  const EdgeContinuity c = joint(s, s, std::array{Edge::v1, Edge::v1});
  EXPECT_EQ(c.gap, 0);
  EXPECT_FALSE(c.samples[50].defined);
  EXPECT_EQ(c.without_normal, 101);
  EXPECT_EQ(c.order, 0);  // where no normal is, no fold can be denied
}

/// An eighth of a sphere turned by `turn` about the z axis and sheared by y += shear x.
BezierSurface turned_octant(double turn, double shear) {
  BezierSurface s = sphere_octant(1);
  for (auto& p : s.net.points) {
    const double x = p.x * std::cos(turn) - p.y * std::sin(turn);
    const double y = p.x * std::sin(turn) + p.y * std::cos(turn);
    p = {x, y + shear * x, p.z};
  }
  return s;
}

// The shear keeps the meridian x = 0 and tilts the tangent plane at (0, 1, 0) from y = 1 to
// y = 1 + x / 2. Both poles lie together without a gap, but a point is no joint.
TEST(EdgeContinuity, PolesAreNoJoint) {
  const EdgeContinuity folded = joint(sphere_octant(1), turned_octant(core::kPi / 2, 0.5));
  EXPECT_EQ(folded.edges, (std::array{Edge::u1, Edge::u0}));
  EXPECT_EQ(folded.order, 0);
  EXPECT_NEAR(folded.angle, std::atan(0.5), 1e-9);
  // A pole at the end of a good joint takes nothing from it.
  const EdgeContinuity smooth = joint(sphere_octant(1), turned_octant(core::kPi / 2, 0));
  EXPECT_EQ(smooth.order, 3);
  EXPECT_EQ(smooth.without_normal, 1);
}

// Nor is an edge that is next to a point, however near the corner it lies.
TEST(EdgeContinuity, AnEdgeShorterThanAGapIsNoJoint) {
  const BezierSurface flat{{2, 2, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}}}, {}};
  const BezierSurface bulging{
      {2, 3, {{1, 0, 0}, {1, 0.5, 0.002}, {1, 1, 0}, {1 + 1e-6, 0, 0}, {1.5, 0.5, 0}, {2, 1, 0}}},
      {}};
  const EdgeContinuity c = joint(flat, bulging);
  EXPECT_EQ(c.edges, (std::array{Edge::u1, Edge::u0}));
  EXPECT_NEAR(c.gap, 1e-3, 1e-5);
}

// A first row that is there twice leaves the surface but not its derivative across the edge.
TEST(EdgeContinuity, ARowThatIsThereTwiceHidesNoFold) {
  const BezierSurface flat{{2, 2, {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}}}, {}};
  const BezierSurface tilted{
      {3, 2, {{1, 0, 0}, {1, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 1}, {2, 1, 1}}}, {}};
  const EdgeContinuity c = joint(flat, tilted);
  EXPECT_EQ(c.edges, (std::array{Edge::u1, Edge::u0}));
  EXPECT_EQ(c.gap, 0);
  EXPECT_EQ(c.order, 0);
  EXPECT_EQ(c.without_normal, 101);
}

}  // namespace
}  // namespace keyline::surface
