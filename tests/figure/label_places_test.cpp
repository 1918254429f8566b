#include "keyline/figure/label_places.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace keyline::figure {
namespace {

using core::Point2;

bool overlap(const LabelPlaces::Place& a, const LabelPlaces::Place& b, double w, double h) {
  return std::abs(a.middle.x - b.middle.x) < w && std::abs(a.middle.y - b.middle.y) < h;
}

TEST(LabelPlaces, CoverEachOtherNowhereAndStayOnThePage) {
  // two dozen things in a heap, at a corner of the page
  LabelPlaces places(600, 400);
  std::vector<LabelPlaces::Place> taken;
  for (int i = 0; i < 24; ++i)
    taken.push_back(places.take({{5.0 + 3 * (i % 7), 4.0 + 4 * (i % 5)}}, 30, 11));
  for (std::size_t i = 0; i < taken.size(); ++i) {
    EXPECT_FALSE(taken[i].covered) << i;
    EXPECT_GE(taken[i].middle.x, 15 - 1e-9);
    EXPECT_GE(taken[i].middle.y, 5.5 - 1e-9);
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(taken[i], taken[j], 30, 11)) << i;
  }
  EXPECT_FALSE(taken.front().away);
  EXPECT_TRUE(taken.back().away) << "no leader for what stands far off";
}

TEST(LabelPlaces, LeaveLinesFree) {
  LabelPlaces places(400, 400);
  std::vector<Point2> line;  // along which a label is asked for, and one above it
  for (int i = 0; i <= 40; ++i) line.push_back({10.0 * i, 200});
  places.avoid(line);
  places.avoid({{0, 190}, {400, 190}});
  const auto place = places.take({{200, 200}}, 40, 12);
  EXPECT_GT(place.middle.y, 206) << "neither on the line nor on the other";
  EXPECT_LT(place.middle.y, 212);
  EXPECT_FALSE(place.away);
}

TEST(LabelPlaces, GoOnAlongTheLineBeforeTheyGoAway) {
  LabelPlaces places(1000, 100);
  const std::vector<Point2> beside = {{500, 50}, {200, 50}, {800, 50}};
  for (int i = 0; i < 12; ++i) EXPECT_FALSE(places.take(beside, 60, 12).away) << i;
}

TEST(LabelPlaces, SayWhereThereIsNoRoom) {
  LabelPlaces places(60, 30);
  bool covered = false;
  for (int i = 0; i < 12; ++i) covered = places.take({{30, 15}}, 20, 10).covered;
  EXPECT_TRUE(covered);
}

}  // namespace
}  // namespace keyline::figure
