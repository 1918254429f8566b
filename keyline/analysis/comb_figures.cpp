#include "keyline/analysis/comb_figures.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "keyline/core/quantile.h"

namespace keyline::analysis {
namespace {

constexpr int kGrid = 4000;       // even steps along the curve
constexpr int kWithin = 20;       // steps of the grid: 0.5 % of the length
constexpr double kTail = 0.005;   // of the steps at either end: a range without single spikes
constexpr double kPace = 0.25;    // of the range within 0.5 %: all of it within 2 %
constexpr double kNoTurn = 1e-8;  // radian that a range turns the curve by, and of its own turning

double length_of(const curve::CurvatureGraph& graph) {
  return graph.arc_length.back() - graph.arc_length.front();
}

/// Curvature at even steps of the length.
std::vector<double> resampled(const curve::CurvatureGraph& graph) {
  const double from = graph.arc_length.front();
  const double length = length_of(graph);
  std::vector<double> grid;
  std::size_t i = 1;
  for (int step = 0; step <= kGrid; ++step) {
    const double s = from + length * step / kGrid;
    while (i + 1 < graph.arc_length.size() && graph.arc_length[i] < s) ++i;
    const double width = graph.arc_length[i] - graph.arc_length[i - 1];
    const double t = width > 0 ? (s - graph.arc_length[i - 1]) / width : 1;
    grid.push_back(std::lerp(graph.curvature[i - 1], graph.curvature[i], std::clamp(t, 0.0, 1.0)));
  }
  return grid;
}

/// 0 where it is rounding alone, as along an arc given as a rational Bézier.
double range_of(std::vector<double> grid, double length) {
  const double high = core::value_at(grid, 1 - kTail);
  const double low = core::value_at(grid, kTail);
  const double turning = length * std::max(std::abs(low), std::abs(high));
  return (high - low) * length > kNoTurn * std::max(1.0, turning) ? high - low : 0;
}

/// Extrema, each followed by a swing of at least so much.
int extrema(const std::vector<double>& grid, double swing) {
  int found = 0;
  int way = 0;
  double low = grid.front();
  double high = grid.front();
  for (const double k : grid) {
    low = std::min(low, k);
    high = std::max(high, k);
    if (way >= 0 && k < high - swing) {
      found += way > 0 ? 1 : 0;
      way = -1;
      low = high = k;
    } else if (way <= 0 && k > low + swing) {
      found += way < 0 ? 1 : 0;
      way = 1;
      low = high = k;
    }
  }
  return found;
}

/// Places where curvature turns that quickly on both sides.
std::vector<CombMark> needles(const std::vector<double>& grid, double range) {
  std::vector<CombMark> found;
  for (std::size_t i = kWithin; i + kWithin < grid.size(); ++i) {
    const double before = (grid[i] - grid[i - kWithin]) / range;
    const double after = (grid[i] - grid[i + kWithin]) / range;
    const double change = std::min(std::abs(before), std::abs(after));
    if (before * after > 0 && change >= kPace)
      found.push_back({true, static_cast<double>(i), change});
  }
  return found;
}

std::vector<CombMark> near_steps(const std::vector<double>& grid, double range) {
  std::vector<CombMark> found;
  for (std::size_t i = kWithin; i < grid.size(); ++i) {
    const double change = std::abs(grid[i] - grid[i - kWithin]) / range;
    if (change >= kPace) found.push_back({false, i - 0.5 * kWithin, change});
  }
  return found;
}

/// Of marks at neighbouring places the sharpest.
void keep_sharpest(std::vector<CombMark>& marks) {
  std::vector<CombMark> kept;
  double last = 0;
  for (const CombMark& mark : marks) {
    if (kept.empty() || mark.at > last + 1)
      kept.push_back(mark);
    else if (mark.change > kept.back().change)
      kept.back() = mark;
    last = mark.at;
  }
  marks = std::move(kept);
}

}  // namespace

CombFigures comb_figures(const curve::CurvatureGraph& graph) {
  const std::vector<double> grid = resampled(graph);
  const double range = range_of(grid, length_of(graph));
  CombFigures figures;
  if (!(range > 0)) return figures;
  figures.waves = extrema(grid, kSeenWave * range);
  for (std::size_t i = kWithin; i < grid.size(); ++i)
    figures.jolt = std::max(figures.jolt, std::abs(grid[i] - grid[i - kWithin]) / range);
  figures.energy = curve::variation(graph);
  return figures;
}

std::vector<CombMark> comb_marks(const curve::CurvatureGraph& graph) {
  const std::vector<double> grid = resampled(graph);
  const double range = range_of(grid, length_of(graph));
  if (!(range > 0)) return {};
  std::vector<CombMark> marks = needles(grid, range);
  keep_sharpest(marks);
  std::vector<CombMark> steps = near_steps(grid, range);
  keep_sharpest(steps);
  const std::size_t sharp = marks.size();
  for (const CombMark& step : steps) {
    const auto beside = [&](const CombMark& needle) {
      return std::abs(needle.at - step.at) <= 2 * kWithin;
    };
    if (std::none_of(marks.begin(), marks.begin() + static_cast<std::ptrdiff_t>(sharp), beside))
      marks.push_back(step);
  }
  std::sort(marks.begin(), marks.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
  const double from = graph.arc_length.front();
  for (CombMark& mark : marks) mark.at = from + (graph.arc_length.back() - from) * mark.at / kGrid;
  return marks;
}

}  // namespace keyline::analysis
