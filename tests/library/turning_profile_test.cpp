#include "keyline/library/turning_profile.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "keyline/curve/polyline.h"

#include "tests/library/library_files.h"

namespace keyline::library {
namespace {

TurningProfile of(const auto& curve) { return turning_profile(curve::PlanarView(curve)); }

lac::Chain mirrored(lac::Chain chain) {
  chain.start.direction = -chain.start.direction;
  chain.start.position.y = -chain.start.position.y;
  for (lac::Piece& piece : chain.pieces) {
    piece.curvature_start = -piece.curvature_start;
    piece.curvature_end = -piece.curvature_end;
  }
  return chain;
}

/// A circular arc of turning w turns by w/64 from each part to the next: 63 equal steps.
TEST(TurningProfile, IsTheTurningBetweenParts) {
  const double turning = 1.5;
  const TurningProfile arc = of(lac::Chain{{}, {{-1, 3, turning / 3, turning / 3}}, false});
  const TurningProfile line = of(lac::Chain{{}, {{-1, 3, 0, 0}}, false});
  EXPECT_NEAR(compare(arc, line, false).distance, std::sqrt(63.0) * turning / 64, 1e-6);
}

TEST(TurningProfile, SizePoseAndDirectionChangeNothing) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    const lac::Chain chain = testing::random_chain(seed);
    const TurningProfile profile = of(chain);
    const core::Similarity2 map{37.5, 2.1, {-100, 40}};
    const lac::Chain moved = lac::transform(chain, map);
    const TurningMatch same = compare(profile, of(moved), false);
    EXPECT_LT(same.distance, 1e-5);  // 63 floats of some radians
    EXPECT_FALSE(same.reversed);
    const TurningMatch back = compare(profile, of(lac::reverse(moved)), false);
    EXPECT_LT(back.distance, 1e-5);
    EXPECT_TRUE(back.reversed);
    const TurningMatch image = compare(profile, of(mirrored(moved)), true);
    EXPECT_LT(image.distance, 1e-5);
    EXPECT_TRUE(image.mirrored);
  }
}

TEST(TurningProfile, MirrorImagesDifferWhereTheyAreNotAllowed) {
  const lac::Chain chain = {{}, {{-1, 3, 0.1, 1}}, false};
  const TurningProfile profile = of(chain);
  EXPECT_GT(compare(profile, of(mirrored(chain)), false).distance, 0.1);
  EXPECT_LT(compare(profile, of(mirrored(chain)), true).distance, 1e-5);
}

/// A corner is turning like any other; where it stands moves the profile smoothly.
TEST(TurningProfile, CornersStayFinite) {
  const auto corner_at = [](double u) {
    return of(curve::Polyline2{{{0, 0}, {u, 0}, {u, 1 - u}}});
  };
  const TurningProfile straight = of(curve::Polyline2{{{0, 0}, {1, 0}}});
  const double whole = compare(corner_at(0.5), straight, false).distance;
  EXPECT_GT(whole, 1.0);
  EXPECT_LE(whole, std::numbers::pi / 2 + 1e-6);
  const double near = compare(corner_at(0.5), corner_at(0.501), false).distance;
  const double far = compare(corner_at(0.5), corner_at(0.7), false).distance;
  EXPECT_LT(near, 0.2 * far);
}

}  // namespace
}  // namespace keyline::library
