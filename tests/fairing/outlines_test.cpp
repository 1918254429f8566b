#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "keyline/acquire/acquire.h"
#include "keyline/analysis/comb_figures.h"
#include "keyline/core/angle.h"
#include "keyline/core/polygon.h"
#include "keyline/exchange/points/points_reader.h"
#include "keyline/fairing/fair.h"
#include "keyline/lac/chain/chain_graph.h"

#include "truth.h"

/// Outlines whose curvature jumps: rounded corners, traced pixels.
namespace keyline::fairing {
namespace {

using testing::line_through;

/// Where a mean line runs: how high, and how fast it rises.
struct Mean {
  double height = 0;
  double rise = 0;
};

/// NACA aerofoil of that thickness about a mean line (of x), at an angle from the leading edge, -pi
/// (lower trailing edge) to pi. Source: Jacobs, Ward and Pinkerton, NACA Report 460 (1933).
template <class MeanLine>
core::Point2 naca(double angle, double thickness, const MeanLine& mean_line) {
  const double x = 0.5 * (1 - std::cos(angle));
  const double side = angle < 0 ? -1 : 1;
  const double even = x * (-0.1260 + x * (-0.3516 + x * (0.2843 - 0.1015 * x)));
  const double half = 5 * thickness * (0.2969 * std::sin(angle / 2) + side * even);
  const Mean mean = mean_line(x);
  const double slope = std::atan(mean.rise);
  return {x - half * std::sin(slope), mean.height + half * std::cos(slope)};
}

/// Source of the mean line: Jacobs and Pinkerton, NACA Report 537 (1935).
core::Point2 naca_23012(double angle) {
  return naca(angle, 0.12, [](double x) {
    constexpr double r = 0.2025;
    constexpr double kCamber = 15.957 / 6;
    const bool fore = x < r;
    const double mean =
        fore ? x * x * x - 3 * r * x * x + r * r * (3 - r) * x : r * r * r * (1 - x);
    const double rise = fore ? 3 * x * x - 6 * r * x + r * r * (3 - r) : -r * r * r;
    return Mean{kCamber * mean, kCamber * rise};
  });
}

core::Point2 naca_6406(double angle) {
  return naca(angle, 0.06, [](double x) {
    constexpr double kCamber = 0.06;
    constexpr double kCrest = 0.4;
    const double part = x < kCrest ? kCrest : 1 - kCrest;
    const double away = (x - kCrest) / part;
    return Mean{kCamber * (1 - away * away), -2 * kCamber * away / part};
  });
}

/// L^3 times the integral of (d curvature / ds)^2 of the aerofoil, by differences.
double energy_of_naca_23012() {
  constexpr int kSteps = 40000;
  std::vector<core::Point2> p;
  for (int i = 0; i <= kSteps; ++i) p.push_back(naca_23012(core::kPi * (2.0 * i / kSteps - 1)));
  double length = 0;
  double sum = 0;
  double before = 0;
  for (int i = 1; i < kSteps; ++i) {
    const core::Vector2 in = p[i] - p[i - 1];
    const core::Vector2 out = p[i + 1] - p[i];
    const double step = 0.5 * (core::norm(in) + core::norm(out));
    const double bend = core::angle_between(in, out) / step;
    if (i > 1) sum += (bend - before) * (bend - before) / core::norm(in);
    before = bend;
    length += core::norm(in);
  }
  return length * length * length * sum;
}

/// Corners rounded by the radius given, the polygon closed, in `count` steps of one length.
std::vector<core::Point2> rounded_polygon(const std::vector<core::Point2>& corners, double radius,
                                          int count) {
  std::vector<core::Point2> outline;
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const core::Point2 b = corners[i];
    const core::Vector2 in = b - corners[(i + n - 1) % n];
    const core::Vector2 out = corners[(i + 1) % n] - b;
    const double turn = core::angle_between(in, out);
    const core::Vector2 along = in / core::norm(in);
    core::Point2 at = b - radius * std::tan(turn / 2) * along;
    for (int k = 0; k < 12; ++k) {
      outline.push_back(at);
      const double chord = 2 * radius * std::sin(turn / 24);
      at = at + chord * core::rotate_ccw(along, turn * (k + 0.5) / 12);
    }
    outline.push_back(at);
  }
  outline.push_back(outline.front());
  std::vector<core::Point2> points;
  const double whole = core::polygon_length(outline, false);
  double gone = 0;
  std::size_t at = 0;
  for (int i = 0; i < count; ++i) {
    const double s = whole * i / count;
    while (gone + core::distance(outline[at], outline[at + 1]) < s) {
      gone += core::distance(outline[at], outline[at + 1]);
      ++at;
    }
    const double step = core::distance(outline[at], outline[at + 1]);
    points.push_back(outline[at] + (s - gone) / step * (outline[at + 1] - outline[at]));
  }
  return points;
}

/// Long straights between tight roundings: slopes that lose all bend at one end of a piece would
/// leave the seam unclosed.
TEST(FairOutlines, RoundedPolygonsClose) {
  const FairResult result = fair(line_through(rounded_polygon({{78.832748, 13.026724},
                                                               {-26.965108, 93.988084},
                                                               {-77.779475, 6.007919},
                                                               {13.653516, -97.257194}},
                                                              5, 700)))
                                .value();
  EXPECT_TRUE(result.within_tolerance);
  EXPECT_LE(result.pieces.size(), 32U);
  for (const auto& joint : result.joints) EXPECT_LE(joint.gap, 1e-9 * result.length);
}

/// A flat flank beside a nose of four hundred times its curvature. The curve itself lies within the
/// tolerance of its points, so the calmest is no wilder.
TEST(FairOutlines, FlatFlanksBesideATightNoseStayCalm) {
  const double most = energy_of_naca_23012();
  for (const int side : {30, 45, 60, 75, 90}) {
    std::vector<core::Point2> points;
    for (int i = -side; i <= side; ++i) {
      const core::Point2 p = naca_23012(core::kPi * i / side);
      points.push_back({std::round(1e6 * p.x) / 1e6, std::round(1e6 * p.y) / 1e6});
    }
    const FairResult result = fair(line_through(points)).value();
    EXPECT_TRUE(result.within_tolerance) << side;
    EXPECT_THAT(result.notes, ::testing::Contains(::testing::HasSubstr("read off the graph")))
        << side;
    const auto comb =
        analysis::comb_figures(lac::curvature_graph(std::get<lac::Chain>(result.curves.at(0))));
    EXPECT_LT(comb.energy, 1.1 * most) << side;
    EXPECT_EQ(comb.waves, 1) << side;
  }
}

/// Where the lower side of a thin aerofoil turns from round to hollow its points may be a line's
/// for all their errors say. Bent into the line at both ends, the side would have needles that
/// count for nothing beside the nose: the curvature of its hollow is 0.3 to 0.4.
TEST(FairOutlines, FlanksBecomeNoLinesWithNeedlesAtTheirEnds) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> error(0, 2e-4);
    std::vector<core::Point2> points;
    for (int i = -59; i <= 59; ++i) {
      const core::Point2 p = naca_6406(-core::kPi * i / 59);
      points.push_back({p.x + error(engine), p.y + error(engine)});
    }
    const FairResult result = fair(line_through(points)).value();
    ASSERT_EQ(result.curves.size(), 1U) << seed;
    const curve::CurvatureGraph graph =
        lac::curvature_graph(std::get<lac::Chain>(result.curves.at(0)));
    double most = 0;
    for (std::size_t i = 0; i < graph.arc_length.size(); ++i) {
      const double at = graph.arc_length[i] / result.length;
      if (at > 0.6 && at < 0.95) most = std::max(most, std::abs(graph.curvature[i]));
    }
    EXPECT_LT(most, 1.5) << seed;
  }
}

/// A roof that is nearly an arc: the variation of its curvature is so small that a curve which has
/// to come a twentieth of the noise nearer to the points has thirty times as much. Truth: 21 mm of
/// an arc, then clothoids of 250 and 200 mm (examples/make_examples.py).
TEST(FairOutlines, GentleSweepsDoNotChaseTheNoise) {
  const double first = 1 / 700.0 - 1 / 2600.0;
  const double second = 1 / 2600.0 - 1 / 1200.0;
  const double truth = std::pow(471.0, 3) * (first * first / 250 + second * second / 200);
  const auto curves = exchange::read_points(KEYLINE_SOURCE_DIR "/examples/roof.csv").value();
  const FairResult result = fair(acquire::acquire_key_line(curves.at(0)).value()).value();
  const auto comb =
      analysis::comb_figures(lac::curvature_graph(std::get<lac::Chain>(result.curves.at(0))));
  EXPECT_LT(comb.energy, 1.5 * truth);
  EXPECT_EQ(comb.waves, 1);
}

/// A thin ring about a neck, traced in whole pixels: a bump of two points on either side.
TEST(FairOutlines, BumpsOfTracedOutlinesAreMet) {
  std::vector<core::Point2> points;
  const auto trace = [&](double x0, double y0, double x1, double y1) {
    const int steps = std::max(1, static_cast<int>(std::hypot(x1 - x0, y1 - y0) / 12));
    for (int i = 0; i < steps; ++i)
      points.push_back({std::floor(x0 + (x1 - x0) * i / steps + 0.3),
                        std::floor(y0 + (y1 - y0) * i / steps + 0.7)});
  };
  trace(60, 330, 60, 60), trace(60, 60, 100, 30), trace(100, 30, 240, 30);
  trace(240, 30, 280, 60), trace(280, 60, 280, 400), trace(280, 400, 210, 520);
  trace(210, 520, 207, 630), trace(212, 640, 212, 652), trace(207, 664, 190, 680);
  trace(190, 680, 150, 680), trace(150, 680, 133, 664), trace(128, 652, 128, 640);
  trace(133, 630, 130, 520), trace(130, 520, 60, 400), trace(60, 400, 60, 330);
  const FairResult result = fair(line_through(points)).value();
  EXPECT_TRUE(result.within_tolerance);
  EXPECT_LE(result.pieces.size(), points.size() / 2);
}

}  // namespace
}  // namespace keyline::fairing
