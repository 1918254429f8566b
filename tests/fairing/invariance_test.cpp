#include <cmath>

#include <gtest/gtest.h>

#include "keyline/core/similarity.h"

#include "truth.h"

/// Moving, turning, scaling and reversing the points changes nothing but their chain's place.
namespace keyline::fairing {
namespace {

constexpr double kScale = 3.7;

core::Point2 moved(core::Point2 p) {
  const core::Vector2 v = core::rotate_ccw({kScale * p.x, kScale * p.y}, 1.234);
  return {v.x + 17, v.y - 250};
}

std::vector<core::Point2> oval() {
  std::vector<core::Point2> points;
  for (int i = 0; i < 150; ++i) {
    const double t = 2 * 3.14159265358979 * i / 150;
    points.push_back(
        {3 * std::cos(t) + 0.3 * std::cos(2 * t), 1.5 * std::sin(t) + 0.2 * std::sin(2 * t + 0.5)});
  }
  return points;
}

std::vector<lac::Piece> pieces_of(const FairResult& result) {
  std::vector<lac::Piece> pieces;
  for (const FairCurve& c : result.curves)
    for (const lac::Piece& p : std::get<lac::Chain>(c).pieces) pieces.push_back(p);
  return pieces;
}

void expect_same(const std::vector<core::Point2>& points, const char* name) {
  SCOPED_TRACE(name);
  const FairResult plain = fair(testing::line_through(points)).value();
  std::vector<core::Point2> other;
  for (const core::Point2 p : points) other.push_back(moved(p));
  const FairResult turned = fair(testing::line_through(other)).value();
  const auto a = pieces_of(plain);
  const auto b = pieces_of(turned);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(plain.pieces[i].rhythm, turned.pieces[i].rhythm);
    EXPECT_NEAR(a[i].alpha, b[i].alpha, 1e-3 * (1 + std::abs(a[i].alpha)));
    EXPECT_NEAR(kScale * a[i].length, b[i].length, 1e-4 * turned.length);
  }
  EXPECT_NEAR(kScale * plain.max_deviation, turned.max_deviation, 1e-2 * turned.tolerance);
}

void expect_same_reversed(std::vector<core::Point2> points, bool closed) {
  const FairResult plain = fair(testing::line_through(points)).value();
  std::reverse(points.begin() + (closed ? 1 : 0), points.end());
  const FairResult back = fair(testing::line_through(points)).value();
  const auto a = pieces_of(plain);
  auto b = pieces_of(back);
  ASSERT_EQ(a.size(), b.size());
  if (closed) return;
  std::reverse(b.begin(), b.end());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].alpha, b[i].alpha, 1e-3 * (1 + std::abs(a[i].alpha)));
    EXPECT_NEAR(a[i].length, b[i].length, 1e-4 * plain.length);
  }
}

TEST(Invariance, MovedTurnedScaled) {
  expect_same(testing::measure(testing::random_chain(4), 250, 0, 1), "exact");
  expect_same(testing::measure(testing::random_chain(4), 250, 3e-4, 1), "noisy");
  expect_same(oval(), "closed");
}

TEST(Invariance, Reversed) {
  expect_same_reversed(testing::measure(testing::random_chain(6), 250, 0, 1), false);
  expect_same_reversed(testing::measure(testing::random_chain(6), 250, 3e-4, 1), false);
  expect_same_reversed(oval(), true);
}

TEST(Invariance, ThreadsChangeNoBit) {
  for (const auto& points : {testing::measure(testing::random_chain(7), 250, 2e-4, 1), oval()}) {
    const acquire::KeyLine line = testing::line_through(points);
    FairOptions options;
    options.threads = 1;
    const FairResult one = fair(line, options).value();
    options.threads = 2;
    const FairResult two = fair(line, options).value();
    EXPECT_EQ(pieces_of(one), pieces_of(two));
    EXPECT_EQ(one.offsets, two.offsets);
    EXPECT_EQ(one.splines[0].control, two.splines[0].control);
  }
}

}  // namespace
}  // namespace keyline::fairing
