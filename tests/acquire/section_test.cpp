#include "keyline/acquire/section.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/acquire/acquire.h"
#include "keyline/acquire/section_curves.h"
#include "keyline/acquire/symmetry.h"
#include "keyline/core/angle.h"
#include "keyline/numeric/random.h"

/// Sections of clouds: feet along the surface, curves told apart.
namespace keyline::acquire {
namespace {

using core::Point3;
using numeric::Random;

const Plane kAcross = plane_of({1, 0, 0}, 1);

/// Random points of a cone about the x axis whose radius at x = 1 is `radius`.
void add_cone(RawCurve& cloud, Random& random, double y, double radius, double slope, int count) {
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * core::kPi * (i + random.uniform()) / count;
    const double x = random.uniform(0.96, 1.04);
    const double r = radius + slope * (x - 1);
    cloud.points.push_back({x, y + r * std::cos(angle), r * std::sin(angle)});
  }
}

RawCurve empty_cloud() {
  RawCurve cloud;
  cloud.has_z = true;
  return cloud;
}

TEST(Section, FeetGoAlongTheSurface) {
  Random random(3);
  RawCurve cloud = empty_cloud();
  add_cone(cloud, random, 0, 1, 0.8, 300);
  const RawCurve cut = section_plane(cloud, kAcross, 0.03).value();
  double most = 0;
  for (const Point3& p : cut.points) {
    EXPECT_NEAR(p.x, 1, 1e-12);
    most = std::max(most, std::abs(std::hypot(p.y, p.z) - 1));
  }
  EXPECT_LE(most, 2e-3);  // straight onto the plane: 0.8 * 0.03
}

// Where a cloud is so dense that its band is wider than neighbours lie apart, feet go along the
// surface as well, and its line does not fall apart.
TEST(Section, DenseCloudsStayWhole) {
  for (const int count : {1200, 2500, 5000}) {
    Random random(8);
    RawCurve cloud = empty_cloud();
    add_cone(cloud, random, 0, 1, 0.8, count);
    const RawCurve cut = section_plane(cloud, kAcross, 0.03).value();
    double most = 0;
    for (const Point3& p : cut.points) most = std::max(most, std::abs(std::hypot(p.y, p.z) - 1));
    EXPECT_LE(most, 2e-3) << count;
    EXPECT_EQ(section_curves(cut, kAcross).size(), 1U) << count;
  }
}

// Points of a line that lie as close together as they stray from it are wide among the nearest few
// by chance: an area is wide from farther off, too.
TEST(Section, LinesThatStrayAsMuchAsTheyStepStayWhole) {
  Random random(9);
  RawCurve cut = empty_cloud();
  cut.scattered = true;
  for (int i = 0; i < 2000; ++i) {
    const double angle = random.uniform(0, 2 * core::kPi);
    const double r = 1 + random.uniform(-0.005, 0.005);
    cut.points.push_back({1, r * std::cos(angle), r * std::sin(angle)});
    cut.points.push_back({1, 3 + r * std::cos(angle + 1), r * std::sin(angle + 1)});
  }
  const auto curves = section_curves(cut, kAcross);
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[0].points.size() + curves[1].points.size(), 4000U);
}

/// Random points of a torus about the z axis whose tube of radius 30 runs at 100, which stray.
RawCurve torus(std::uint64_t seed, int count, double noise) {
  Random random(seed);
  RawCurve cloud = empty_cloud();
  while (static_cast<int>(cloud.points.size()) < count) {
    const double around = random.uniform(0, 2 * core::kPi);
    const double tube = random.uniform(0, 2 * core::kPi);
    if (random.uniform(0, 130) > 100 + 30 * std::cos(tube)) continue;
    const double r = 100 + (30 + noise * random.normal()) * std::cos(tube);
    cloud.points.push_back({r * std::cos(around), r * std::sin(around),
                            (30 + noise * random.normal()) * std::sin(tube)});
  }
  return cloud;
}

// Near its top a torus slopes across the plane so flatly that straight feet fill the ring between
// its two circles; along the surface they come to lie on them.
TEST(Section, FlatSlopesAreFollowedToTheirSection) {
  for (const double height : {25.0, 28.0}) {
    const double half = std::sqrt(900 - height * height);
    const Plane plane = plane_of({0, 0, 1}, height);
    const RawCurve cut = section_plane(torus(1, 12000, 0), plane, 1.7).value();
    double most = 0;
    for (const Point3& p : cut.points)
      most = std::max(most, std::abs(std::abs(std::hypot(p.x, p.y) - 100) - half));
    EXPECT_LE(most, 0.6) << height;
    EXPECT_GE(cut.points.size(), 300U) << height;
    EXPECT_EQ(section_curves(cut, plane).size(), 2U) << height;
  }
}

// Two circles a tenth of their size apart are two curves, however wide a gap is bridged elsewhere;
// so they are where points stray more than they step.
TEST(Section, LinesBesideEachOtherAreNotLinked) {
  for (const double noise : {0.0, 0.05}) {
    const Plane plane = plane_of({0, 0, 1}, 28);
    const RawCurve cut = section_plane(torus(2, 40000, noise), plane, 1.7).value();
    const auto curves = section_curves(cut, plane);
    ASSERT_EQ(curves.size(), 2U) << noise;
    EXPECT_GE(curves[0].points.size() + curves[1].points.size(), 0.98 * cut.points.size());
    for (const RawCurve& curve : curves) {
      const bool outer = std::hypot(curve.points[0].x, curve.points[0].y) > 100;
      for (const Point3& p : curve.points) EXPECT_EQ(std::hypot(p.x, p.y) > 100, outer);
    }
  }
}

TEST(Symmetry, WithoutAPlaneTheBoxAndPlanesAreOffered) {
  // Two turns of a coil: half a turn about a line across matches, no mirror does.
  std::vector<Point3> coil;
  for (int i = 0; i < 6000; ++i) {
    const double t = i / 5999.0;
    coil.push_back({std::cos(4 * core::kPi * t), std::sin(4 * core::kPi * t), 10 * t});
  }
  const auto found = symmetry_plane(coil);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, core::ErrorCode::undrawable);
  EXPECT_NE(found.error().hint.find("z from 0 to 10"), std::string::npos) << found.error().hint;
  EXPECT_NE(found.error().hint.find("or z=5"), std::string::npos) << found.error().hint;
}

TEST(Section, PointsThereSeveralTimesCountOnce) {
  Random random(5);
  RawCurve once = empty_cloud();
  add_cone(once, random, 0, 1, 0.3, 400);
  RawCurve thrice = once;
  for (int copy = 0; copy < 2; ++copy)
    thrice.points.insert(thrice.points.end(), once.points.begin(), once.points.end());
  thrice.weights.assign(thrice.points.size(), 1);
  const RawCurve expected = section_plane(once, kAcross, 0.03).value();
  const RawCurve cut = section_plane(thrice, kAcross, 0.03).value();
  EXPECT_EQ(cut.points, expected.points);
  EXPECT_EQ(cut.weights, std::vector<double>(expected.points.size(), 3));
}

TEST(Section, FeetStayWhereNothingSlopes) {
  Random random(4);
  RawCurve cloud = empty_cloud();
  add_cone(cloud, random, 0, 1, 0, 300);
  const RawCurve cut = section_plane(cloud, Axis::x, 1, 0.03).value();
  std::size_t at = 0;
  for (const Point3& p : cloud.points) {
    if (std::abs(p.x - 1) > 0.03) continue;
    EXPECT_EQ(cut.points[at].y, p.y);
    EXPECT_EQ(cut.points[at++].z, p.z);
  }
}

TEST(Section, PartsAndClumpsAreToldApart) {
  Random random(5);
  RawCurve cloud = empty_cloud();
  add_cone(cloud, random, 0, 1, 0.2, 240);
  add_cone(cloud, random, 2.6, 0.5, 0.2, 140);
  for (int i = 0; i < 120; ++i)  // a face met flat
    cloud.points.push_back(
        {1 + random.uniform(-0.01, 0.01), random.uniform(5, 5.6), random.uniform(0, 0.6)});
  const RawCurve cut = section_plane(cloud, kAcross, 0.03).value();
  const auto curves = section_curves(cut, kAcross);
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[0].id, "section-1");
  for (std::size_t k = 0; k < 2; ++k) {
    const KeyLine line = acquire_key_line(curves[k]).value();
    EXPECT_TRUE(line.closed);
    EXPECT_NEAR(line.length, 2 * core::kPi * (k == 0 ? 1 : 0.5), 0.03);
  }
}

// Points drawn wholly by chance leave gaps many usual steps wide: two loops are two closed curves
// all the same, but for one in a hundred or so, and a loop with a fifth cut out stays open.
TEST(Section, LoopsOfARandomSampleClose) {
  int closed = 0;
  int loops = 0;
  int open = 0;
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    Random random(seed);
    for (const int count : {100, 200, 400}) {
      RawCurve two = empty_cloud();
      RawCurve cut_open = empty_cloud();
      for (int i = 0; i < count; ++i) {
        const double angle = random.uniform(0, 2 * core::kPi);
        two.points.push_back({1, 5 * std::cos(angle), 5 * std::sin(angle)});
        two.points.push_back({1, 20 + 4 * std::sin(2 * angle), 4 * std::cos(2 * angle)});
        cut_open.points.push_back({1, 5 * std::cos(0.8 * angle), 5 * std::sin(0.8 * angle)});
      }
      for (const RawCurve& part :
           section_curves(section_plane(two, kAcross, 0.03).value(), kAcross)) {
        const KeyLine line = acquire_key_line(part).value();
        ++loops;
        closed += line.closed && std::abs(line.length - 10 * core::kPi) < 0.1 * 10 * core::kPi;
        closed += line.closed && std::abs(line.length - 8 * core::kPi) < 0.1 * 8 * core::kPi;
      }
      const auto arcs = section_curves(section_plane(cut_open, kAcross, 0.03).value(), kAcross);
      open += arcs.size() == 1 && !acquire_key_line(arcs[0]).value().closed;
    }
  }
  EXPECT_EQ(loops, 150);
  EXPECT_GE(closed, 144);
  EXPECT_EQ(open, 75);
}

TEST(Section, OneCurveComesBackAsItIs) {
  Random random(6);
  RawCurve cloud = empty_cloud();
  add_cone(cloud, random, 0, 1, 0, 200);
  const RawCurve cut = section_plane(cloud, kAcross, 0.03).value();
  const auto curves = section_curves(cut, kAcross);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].points.size(), cut.points.size());
  EXPECT_EQ(curves[0].id, cut.id);
}

/// A corner of a random sample: points nearer to each other than they scatter, in the order of the
/// shortest way, which turns back among them.
TEST(Section, TurnbacksOfASampleAreAveraged) {
  RawCurve line;
  line.has_z = line.scattered = true;
  const auto add = [&](double x, double y) { line.points.push_back({x, y, 0}); };
  for (int i = 0; i < 12; ++i) add(0.1 * i, 0);
  add(1.195, -0.01), add(1.21, 0.02), add(1.19, 0.012), add(1.205, 0.05);
  for (int i = 1; i < 12; ++i) add(1.2, 0.05 + 0.1 * i);
  const KeyLine averaged = acquire_key_line(line).value();
  EXPECT_LT(averaged.points.size(), line.points.size());
  EXPECT_NEAR(averaged.length, 2.35, 0.03);
  line.scattered = false;
  EXPECT_EQ(acquire_key_line(line).value().points.size(), line.points.size());
}

}  // namespace
}  // namespace keyline::acquire
