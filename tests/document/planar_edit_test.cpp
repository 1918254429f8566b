#include "keyline/document/planar_edit.h"

#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::document {
namespace {

// Three edges: both cuts lie inside one, inside two, at a vertex.
TEST(Part, OfAPolylineBeginsAndEndsWhereItIsCut) {
  using Points = std::vector<core::Point2>;
  const Path line{{{curve::Polyline2{{{0, 0}, {3, 0}, {3, 3}, {0, 3}}}}}, false};
  const auto points = [&](double low, double high) {
    return std::get<curve::Polyline2>(part(line, {low / 12, high / 12}).curves.at(0).value).points;
  };
  const auto expect = [&](double low, double high, const Points& wanted) {
    const Points got = points(low, high);
    ASSERT_EQ(got.size(), wanted.size());
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_LT(distance(got[i], wanted[i]), 1e-14);
  };
  expect(1, 3, {{0.75, 0}, {2.25, 0}});
  expect(2, 7, {{1.5, 0}, {3, 0}, {3, 2.25}});
  expect(6, 11, {{3, 1.5}, {3, 3}, {0.75, 3}});
  expect(4, 10, {{3, 0}, {3, 3}, {1.5, 3}});
}

// Both begin at the origin: the path begins with the first of them, from its end.
TEST(Joined, TurnsTheFirstRoundWhereItsStartMeetsAnother) {
  const Path first{{{curve::Polyline2{{{0, 0}, {1, 0}}}}}, false};
  const Path second{{{curve::Polyline2{{{0, 0}, {0, 2}}}}}, false};
  const auto made = joined({first, second}, 1e-6);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->reversed, std::vector<std::size_t>{0});
  EXPECT_EQ(evaluate(made->path, 0), (core::Point2{1, 0}));
  EXPECT_EQ(evaluate(made->path, 0.5), (core::Point2{0, 0}));
  EXPECT_EQ(evaluate(made->path, 1), (core::Point2{0, 2}));
  EXPECT_FALSE(joined({first, {{{curve::Polyline2{{{3, 3}, {4, 4}}}}}, false}}, 1e-6));
}

// A circle of radius 2 from its lowest point on; from 0.8 to 0.3 of it are its half.
TEST(PartOverSeam, OfACircleIsAnArcOfOneChain) {
  const double half = 2 * std::numbers::pi;
  const lac::Chain circle{{{0, -2}, 0}, {{-1, half, 0.5, 0.5}, {-1, half, 0.5, 0.5}}, true};
  const Path part = part_over_seam({{{circle}}, true}, 0.8, 0.3);
  EXPECT_FALSE(part.closed);
  ASSERT_EQ(part.curves.size(), 1U);
  const auto& arc = std::get<lac::Chain>(part.curves[0].value);
  EXPECT_NEAR(lac::arc_length(arc), half, 1e-14);
  for (const auto& [t, turn] : {std::pair{0.0, 0.8}, {1.0, 0.3}}) {
    const double angle = 2 * std::numbers::pi * turn;
    EXPECT_LT(distance(evaluate(part, t), {2 * std::sin(angle), -2 * std::cos(angle)}), 1e-13);
  }
  const Path beginning = part_over_seam({{{circle}}, true}, 1, 0.25);
  ASSERT_EQ(beginning.curves.size(), 1U);
  EXPECT_NEAR(lac::arc_length(std::get<lac::Chain>(beginning.curves[0].value)), half / 2, 1e-14);
}

// A drop: three quarters of a circle round, its straight sides meet at right angles at the seam.
TEST(PartOverSeam, LeavesACornerAtTheSeam) {
  const double turn = 1.5 * std::numbers::pi;
  const lac::Chain drop{
      {{0, 0}, -std::numbers::pi / 4}, {{-1, 1, 0, 0}, {-1, turn, 1, 1}, {-1, 1, 0, 0}}, true};
  const Path closed{{{drop}}, true};
  ASSERT_LT(distance(evaluate(closed, 0), evaluate(closed, 1)), 1e-15);
  const Path part = part_over_seam(closed, 0.9, 0.1);
  ASSERT_EQ(part.curves.size(), 2U);
  EXPECT_LT(distance(evaluate(part.curves[0], 1), {0, 0}), 1e-15);
  EXPECT_LT(distance(evaluate(part.curves[1], 0), {0, 0}), 1e-15);
}

TEST(PartOverSeam, KeepsTheMembersOfAPath) {
  const Path triangle{{{curve::Bezier2{{{0, 0}, {4, 0}}, {}}},
                       {curve::Bezier2{{{4, 0}, {0, 3}}, {}}},
                       {curve::Bezier2{{{0, 3}, {0, 0}}, {}}}},
                      true};
  const Path part = part_over_seam(triangle, 0.5, 1.0 / 6);
  ASSERT_EQ(part.curves.size(), 3U);
  EXPECT_LT(distance(evaluate(part, 0), {2, 1.5}), 1e-15);
  EXPECT_LT(distance(evaluate(part, 1), {2, 0}), 1e-15);
  EXPECT_EQ(part_over_seam(triangle, 1, 0.5).curves.size(), 2U);
  EXPECT_EQ(part_over_seam(triangle, 0.5, 0).curves.size(), 2U);
  const Path square{{{curve::Polyline2{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}}}}, true};
  const Path line = part_over_seam(square, 0.875, 0.125);
  ASSERT_EQ(line.curves.size(), 1U);
  EXPECT_EQ(std::get<curve::Polyline2>(line.curves[0].value).points,
            (std::vector<core::Point2>{{0, 0.5}, {0, 0}, {0.5, 0}}));
  const Path halves{
      {{curve::Polyline2{{{0, 0}, {1, 0}, {1, 1}}}}, {curve::Polyline2{{{1, 1}, {0, 1}, {0, 0}}}}},
      true};
  EXPECT_EQ(part_over_seam(halves, 0.75, 0.25).curves.size(), 2U);
}

}  // namespace
}  // namespace keyline::document
