#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/core/angle.h"
#include "keyline/fairing/fair.h"
#include "keyline/lac/chain/chain.h"

#include "truth.h"

/// No bend to the other side that the points do not ask for.
namespace keyline::fairing {
namespace {

using testing::line_through;

/// Points of a superellipse, evenly in its angle, to two digits.
std::vector<core::Point2> superellipse(double width, double height, double power, int count) {
  const auto raised = [&](double v) { return std::copysign(std::pow(std::abs(v), 2 / power), v); };
  std::vector<core::Point2> points;
  for (int i = 0; i <= count; ++i) {
    const double angle = 2 * core::kPi * (i % count) / count;
    points.push_back({std::round(100 * width * raised(std::cos(angle))) / 100,
                      std::round(100 * height * raised(std::sin(angle))) / 100});
  }
  return points;
}

/// A circle with a dent of that share of its radius.
std::vector<core::Point2> dented(double depth, int count) {
  std::vector<core::Point2> points;
  for (int i = 0; i <= count; ++i) {
    const double angle = 2 * core::kPi * (i % count) / count;
    const double away = std::remainder(angle - core::kPi, 2 * core::kPi) / 0.5;
    const double radius = 60 * (1 - depth * std::exp(-away * away));
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return points;
}

/// How often curvature changes its sign along a chain, over the seam of a closed one too.
int inflections(const lac::Chain& chain) {
  std::vector<double> ends;
  for (const lac::Piece& piece : chain.pieces)
    ends.insert(ends.end(), {piece.curvature_start, piece.curvature_end});
  int count = 0;
  double last = 0;
  if (chain.closed) last = ends.back();
  for (const double k : ends) {
    if (k * last < 0) ++count;
    if (k != 0) last = k;
  }
  return count;
}

int inflections_of_fair(const std::vector<core::Point2>& points, const FairOptions& options = {}) {
  const FairResult result = fair(line_through(points), options).value();
  EXPECT_TRUE(result.within_tolerance);
  EXPECT_EQ(result.curves.size(), 1U);
  return inflections(std::get<lac::Chain>(result.curves.at(0)));
}

// Flat sides between tight corners: within the tolerance the calmest curve of all bends inwards
// there, and varies hardly less for it.
TEST(Convex, OutlinesStayConvex) {
  for (const double power : {3.0, 4.5, 5.7, 8.0})
    for (const int count : {60, 160})
      EXPECT_EQ(inflections_of_fair(superellipse(36, 75, power, count)), 0)
          << power << ", " << count;
}

TEST(Convex, SymmetricAnswersToo) {
  FairOptions options;
  options.symmetric = *Symmetric::from_text("x=0");
  EXPECT_EQ(inflections_of_fair(superellipse(36, 75, 5.7, 160), options), 0);
}

TEST(Convex, WithJointsOfOneRateToo) {
  FairOptions options;
  options.joints = JointOrder::g3;
  EXPECT_EQ(inflections_of_fair(superellipse(36, 75, 5.7, 160), options), 0);
}

// Far deeper than the tolerance: it stays, and nothing bends beside it.
TEST(Convex, HollowsThatPointsAskForStay) {
  for (const double depth : {0.25, 0.4})
    for (const int count : {80, 200}) EXPECT_EQ(inflections_of_fair(dented(depth, count)), 2);
}

// From the middle of a flat side round a corner to that of the next: at free ends nothing bends
// inwards, either.
TEST(Convex, FreeEndsDoNotBendBack) {
  for (const double power : {4.5, 5.7, 8.0}) {
    std::vector<core::Point2> points = superellipse(36, 75, power, 320);
    points.resize(81);
    EXPECT_EQ(inflections_of_fair(points), 0) << power;
  }
}

}  // namespace
}  // namespace keyline::fairing
