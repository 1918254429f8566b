#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "keyline/sketch/trace.h"

#include "drawing_generator.h"
#include "kinds_generator.h"

namespace keyline::sketch {
namespace {

using core::Point2;

std::vector<Point2> sampled(const Stroke& stroke) {
  std::vector<Point2> points;
  for (const curve::Bezier2& piece : stroke.curve) {
    const int n = std::max(4, static_cast<int>(core::distance(piece.control[0], piece.control[5])));
    for (int i = 0; i < n; ++i) points.push_back(evaluate(piece, (i + 0.5) / n));
  }
  return points;
}

/// Distance of p from the polygon through the points.
double distance_to(const std::vector<Point2>& points, Point2 p) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (core::distance(points[i], p) < core::distance(points[best], p)) best = i;
  double least = core::distance(points[best], p);
  for (const std::size_t k : {best, best + 1}) {
    if (k == 0 || k >= points.size()) continue;
    const core::Vector2 edge = points[k] - points[k - 1];
    const double u = core::dot(p - points[k - 1], edge) / core::dot(edge, edge);
    least = std::min(
        least, core::distance(core::mix(points[k - 1], points[k], std::clamp(u, 0.0, 1.0)), p));
  }
  return least;
}

struct Score {
  std::size_t wanted = 0;
  std::size_t found = 0;    ///< strokes of the answer
  std::size_t matched = 0;  ///< true strokes with one of the answer all along, and its only one
  double worst_ratio = 0;   ///< largest 95th percentile over what is allowed for the width
  double square = 0;        ///< sum and number of the squared distances of matching curves
  double count = 0;
};

double percentile95(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[static_cast<std::size_t>(0.95 * static_cast<double>(v.size() - 1))];
}

Score score_of(const testing::TrueDrawing& truth, const TraceResult& result) {
  Score score{truth.strokes.size(), result.strokes.size()};
  std::vector<std::vector<Point2>> answers;
  for (const Stroke& s : result.strokes) answers.push_back(sampled(s));
  for (const testing::TrueStroke& t : truth.strokes) {
    std::size_t mates = 0;
    bool whole = false;
    for (const auto& answer : answers) {
      std::vector<double> off;
      for (const Point2 p : answer) off.push_back(distance_to(t.points, p));
      const double far = percentile95(off);
      if (far > 0.75 * t.width + 1) continue;  // lines one and a half widths off are others
      ++mates;
      for (const double d : off) score.square += d * d;
      score.count += static_cast<double>(off.size());
      std::size_t covered = 0;
      for (const Point2 p : t.points)
        covered += distance_to(answer, p) < 0.5 * t.width + 1.5 ? 1 : 0;
      whole = static_cast<double>(covered) > 0.97 * static_cast<double>(t.points.size());
      const double allowed = t.width <= 6 ? 0.6 : 0.1 * t.width;
      score.worst_ratio = std::max(score.worst_ratio, far / allowed);
    }
    score.matched += mates == 1 && whole ? 1 : 0;
  }
  return score;
}

TEST(Truth, DrawingsComeBackStrokeByStroke) {
  const bool full = std::getenv("KEYLINE_FULL") != nullptr;
  const int count = full ? 60 : 12;
  int right = 0;
  std::size_t strokes = 0;
  std::size_t matched = 0;
  for (int seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const testing::TrueDrawing truth = testing::make_drawing(static_cast<std::uint64_t>(seed));
    const auto result = trace(truth.image);
    ASSERT_TRUE(result) << result.error().message;
    const Score score = score_of(truth, *result);
    const bool all = score.found == score.wanted && score.matched == score.wanted;
    right += all ? 1 : 0;
    strokes += score.wanted;
    matched += score.matched;
    EXPECT_LE(score.worst_ratio, 1) << "95th percentile over what is allowed";
    if (!all)
      std::printf("seed %d: %zu strokes, %zu found, %zu one to one\n", seed, score.wanted,
                  score.found, score.matched);
  }
  std::printf("%d of %d drawings, %zu of %zu strokes one to one\n", right, count, matched, strokes);
  EXPECT_GE(right, 0.95 * count);
}

// Drawings that came back wrong while such ends were cut as spurs (58, 91, 103, 112), not carried
// on (83), forks paired by directions alone (59, 77) and knots of more than ten exits given up.
TEST(Truth, LinesThatEndBesideCrossingsComeBack) {
  for (const std::uint64_t seed : {46, 58, 59, 77, 80, 83, 91, 103, 106, 112, 119}) {
    SCOPED_TRACE("tangle, seed " + std::to_string(seed));
    const auto truth = testing::make_kind("tangle", seed);
    const auto result = trace(truth.image);
    ASSERT_TRUE(result) << result.error().message;
    const Score score = score_of(truth, *result);
    EXPECT_EQ(score.found, score.wanted);
    EXPECT_EQ(score.matched, score.wanted);
  }
}

// Of 12 other drawings each, 1 and 3 came back before even gaps and changes of curvature counted.
TEST(Truth, DashesAndTouchingLinesMostlyComeBack) {
  const int count = std::getenv("KEYLINE_FULL") ? 20 : 4;
  for (const std::string& kind : testing::harder_kinds()) {
    int right = 0;
    for (int seed = 1; seed <= count; ++seed) {
      const auto truth = testing::make_kind(kind, static_cast<std::uint64_t>(seed));
      const auto result = trace(truth.image);
      ASSERT_TRUE(result) << kind << ", seed " << seed << ": " << result.error().message;
      const Score score = score_of(truth, *result);
      right += score.found == score.wanted && score.matched == score.wanted ? 1 : 0;
    }
    std::printf("%-12s %2d of %2d drawings\n", kind.c_str(), right, count);
    EXPECT_GE(right, 0.75 * count) << kind;
  }
}

TEST(Truth, EveryKindComesBackOneToOne) {
  const int count = std::getenv("KEYLINE_FULL") ? 20 : 4;
  double wanted = 0;
  double matched = 0;
  for (const std::string& kind : testing::drawing_kinds()) {
    Score all;
    int right = 0;
    for (int seed = 1; seed <= count; ++seed) {
      const auto truth = testing::make_kind(kind, static_cast<std::uint64_t>(seed));
      const auto result = trace(truth.image);
      ASSERT_TRUE(result) << kind << ", seed " << seed << ": " << result.error().message;
      const Score score = score_of(truth, *result);
      right += score.found == score.wanted && score.matched == score.wanted ? 1 : 0;
      all.wanted += score.wanted;
      all.matched += score.matched;
      all.square += score.square;
      all.count += score.count;
    }
    const double rms = std::sqrt(all.square / std::max(1.0, all.count));
    std::printf("%-12s %2d of %2d drawings, %3zu of %3zu lines, rms %.2f\n", kind.c_str(), right,
                count, all.matched, all.wanted, rms);
    wanted += static_cast<double>(all.wanted);
    matched += static_cast<double>(all.matched);
    EXPECT_GE(right, std::floor(0.9 * count)) << kind;
    EXPECT_LE(rms, 0.3) << kind;
  }
  std::printf("%.1f %% of the lines\n", 100 * matched / wanted);
  EXPECT_GE(matched, 0.98 * wanted);
}

}  // namespace
}  // namespace keyline::sketch
