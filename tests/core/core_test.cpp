#include <array>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/core/disjoint_sets.h"
#include "keyline/core/error.h"
#include "keyline/core/nearest_word.h"
#include "keyline/core/polygon.h"
#include "keyline/core/pose.h"
#include "keyline/core/progress.h"
#include "keyline/core/quantile.h"
#include "keyline/core/similarity.h"
#include "keyline/core/text.h"

namespace keyline::core {
namespace {

TEST(Text, Counted) {
  EXPECT_EQ(counted(1, "piece"), "1 piece");
  EXPECT_EQ(counted(0, "piece"), "0 pieces");
  EXPECT_EQ(counted(2, "entity", "entities"), "2 entities");
  EXPECT_EQ(counted(1, "piece is", "pieces are"), "1 piece is");
}

// Changes counted by hand: kitten > sitten > sittin > sitting.
TEST(NearestWord, IsFewestLettersApart) {
  EXPECT_EQ(letters_apart("kitten", "sitting"), 3U);
  EXPECT_EQ(letters_apart("", "abc"), 3U);
  const auto nearest = [](std::string_view given) {
    constexpr std::string_view kWords[] = {"weights", "weight", "x", "y", "knots"};
    return nearest_word(given, kWords);
  };
  EXPECT_EQ(nearest("weihgts"), "weights");
  EXPECT_EQ(nearest("wieght"), "weight");
  EXPECT_EQ(nearest("knot"), "knots");
  EXPECT_EQ(nearest("z"), "");  // any letter is one apart
  EXPECT_EQ(nearest("points"), "");
}

TEST(Angle, WrapsIntoHalfOpenTurn) {
  EXPECT_DOUBLE_EQ(wrap_angle(3 * kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(-kPi), kPi);
  EXPECT_NEAR(wrap_angle(2 * kPi + 0.25), 0.25, 1e-15);
}

TEST(Angle, IsCounterClockwisePositive) {
  EXPECT_DOUBLE_EQ(angle_between(Vector2{1, 0}, {0, 2}), kPi / 2);
  EXPECT_DOUBLE_EQ(angle_between(Vector2{0, 1}, {1, 0}), -kPi / 2);
  EXPECT_EQ(angle_between(Vector2{0, 0}, {1, 0}), 0);
}

TEST(Pose, LocalFrameRoundTrip) {
  const Pose2 pose{{3, -2}, 0.7};
  const Point2 p{1.5, 4};
  EXPECT_LT(distance(p, to_local(pose, from_local(pose, p))), 1e-15 * 10);
}

TEST(Similarity, InverseUndoes) {
  const Similarity2 map{2.5, -1.1, {4, 7}};
  const Point2 p{-3, 0.5};
  EXPECT_LT(distance(p, apply(inverse(map), apply(map, p))), 1e-14);
}

TEST(Failure, CodesCarryTheirPublicNames) {
  EXPECT_STREQ(code_name(ErrorCode::bad_input), "bad-input");
  EXPECT_STREQ(code_name(ErrorCode::not_converged), "not-converged");
}

TEST(Progress, PartMapsToItsShareOfTheWhole) {
  double seen = -1;
  const Progress whole{[&](double f, std::string_view) { seen = f; }, {}};
  part_of(whole, 0.5, 0.7).report(0.5, "half");
  EXPECT_DOUBLE_EQ(seen, 0.6);
}

TEST(Progress, StopReachesEveryCopy) {
  const auto token = CancellationToken::make();
  const auto copy_stopped = [copy = token] { return copy.stop_requested(); };
  token.request_stop();
  EXPECT_TRUE(copy_stopped());
  EXPECT_FALSE(CancellationToken{}.stop_requested());
}

TEST(Polygon, LengthOpenAndClosed) {
  const std::vector<Point2> corner{{0, 0}, {3, 0}, {3, 4}};
  EXPECT_EQ(polygon_length(corner), 7);
  EXPECT_EQ(polygon_length(corner, true), 12);
  EXPECT_EQ(polygon_length(std::array<Point3, 2>{{{0, 0, 0}, {1, 2, 2}}}), 3);
}

TEST(Polygon, FewerThanTwoPointsHaveNoLength) {
  EXPECT_EQ(polygon_length(std::vector<Point2>{}, true), 0);
  EXPECT_EQ(polygon_length(std::vector<Point2>{{1, 2}}, true), 0);
}

TEST(Text, NumbersAreShort) {
  EXPECT_EQ(number_text(0.25, 9), "0.25");
  EXPECT_EQ(number_text(1.0 / 3, 4), "0.3333");
  EXPECT_EQ(number_text(-1.5e-9, 9), "-1.5e-09");
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity(), 3), "inf");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::max(), 99), "-1.7976931348623157e+308");
}

TEST(DisjointSets, JoinedThingsShareAMember) {
  DisjointSets sets(5);
  EXPECT_TRUE(sets.join(0, 1));
  EXPECT_TRUE(sets.join(1, 2));
  EXPECT_FALSE(sets.join(0, 2));
  EXPECT_EQ(sets.find(0), 2U);  // the set joined into gives the member
  EXPECT_EQ(sets.find(1), 2U);
  EXPECT_EQ(sets.find(3), 3U);
}

TEST(Quantile, IsTheValueSoManyStayBelow) {
  EXPECT_EQ(quantile(std::vector<int>{5, 1, 4, 2, 3}), 3);
  EXPECT_EQ(quantile(std::vector<double>{4, 1, 3, 2}), 3);  // the upper of the two in the middle
  EXPECT_EQ(quantile(std::vector<double>{4, 1, 3, 2}, 1, 4), 2);
  EXPECT_EQ(quantile(std::vector<double>{}), 0);
}

}  // namespace
}  // namespace keyline::core
