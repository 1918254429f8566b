#include "keyline/document/planar_curve.h"

#include <gtest/gtest.h>

namespace keyline::document {
namespace {

Path two_lines() {
  return {{{curve::Polyline2{{{0, 0}, {1, 0}}}}, {curve::Polyline2{{{1, 0}, {1, 2}}}}}, false};
}

TEST(Path, MembersShareTheParameterEvenly) {
  const Path path = two_lines();
  EXPECT_EQ(evaluate(path, 0.25), (core::Point2{0.5, 0}));
  EXPECT_EQ(evaluate(path, 0.75), (core::Point2{1, 1}));
  EXPECT_EQ(evaluate(path, 1), (core::Point2{1, 2}));
  EXPECT_EQ(breakpoints(path), (std::vector<double>{0, 0.5, 1}));
}

TEST(Path, JetIsInThePathsParameter) {
  const curve::Jet2 at = jet(two_lines(), 0.75);
  EXPECT_EQ(at.first, (core::Vector2{0, 4}));
}

TEST(Path, ReverseRunsTheSameWayBack) {
  const Path back = reverse(two_lines());
  EXPECT_EQ(evaluate(back, 0.25), (core::Point2{1, 1}));
}

TEST(Path, ValidationNamesTheMember) {
  Path path = two_lines();
  path.curves[1] = {curve::Polyline2{{{1, 0}}}};
  const auto sound = validate(path);
  ASSERT_FALSE(sound);
  EXPECT_TRUE(sound.error().path.starts_with("curves[1]")) << sound.error().path;
  EXPECT_FALSE(validate(Path{}));
}

/// What views look at in a path's stead, and in that of each member.
TEST(PlacedPath, GivesTheSameToTheBit) {
  lac::Chain chain{{{1, 2}, 0.5}, {{-1, 3, 0, 1.5}, {1, 2, 1.5, 0.2}, {0, 1, 0.2, 0.7}}, false};
  Path path;
  path.curves.push_back({curve::Bezier2{{{0, 0}, {1, 1}, {1, 2}}, {}}});
  path.curves.push_back({chain});
  path.curves.push_back({curve::Polyline2{{{2, 2}, {4, 0}}}});
  const PlacedPath placed = prepared(path);
  for (int i = 0; i <= 300; ++i) {
    const double t = i / 300.0;
    EXPECT_EQ(evaluate(placed, t), evaluate(path, t));
    EXPECT_EQ(jet(placed, t).first, jet(path, t).first);
    EXPECT_EQ(jet(placed, t).third, jet(path, t).third);
  }
  EXPECT_EQ(breakpoints(placed), breakpoints(path));
  EXPECT_EQ(evaluate(prepared(path.curves[1]), 0.7), evaluate(path.curves[1], 0.7));
}

}  // namespace
}  // namespace keyline::document
