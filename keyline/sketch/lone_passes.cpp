#include "keyline/sketch/lone_passes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>

#include "keyline/sketch/stroke_grid.h"

namespace keyline::sketch {
namespace {

constexpr double kMostOff = 1.5;  ///< widths of the pen
constexpr double kAllAlong = 0.9;
constexpr double kStep = 0.5;  ///< widths between samples

/// By line, how many samples of one lie beside it.
std::map<std::size_t, std::size_t> beside(std::size_t one, const std::vector<SampledStroke>& lines,
                                          const StrokeGrid& grid, double reach, double angle) {
  std::map<std::size_t, std::size_t> count;
  for (std::size_t k = 0; k < lines[one].points.size(); ++k) {
    std::set<std::size_t> here;
    grid.visit_others(lines[one].points[k], reach, one, [&](std::size_t j, std::size_t m) {
      if (std::abs(core::dot(lines[one].tangents[k], lines[j].tangents[m])) > std::cos(angle))
        here.insert(j);
    });
    for (const std::size_t j : here) ++count[j];
  }
  return count;
}

}  // namespace

void take_lone_passes(std::vector<MeantLine>& lines, double width, double angle,
                      const std::function<bool(std::size_t, const MeantLine&)>& may) {
  const double reach = kMostOff * width;
  std::vector<SampledStroke> sampled;
  for (const MeantLine& line : lines)
    sampled.push_back(sample_stroke(line.points, line.closed, std::max(kStep * width, 1e-12)));
  const StrokeGrid grid(sampled, reach);
  std::vector<bool> several;
  for (const MeantLine& line : lines) several.push_back(line.members.size() > 1);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (several[i]) continue;
    const std::size_t stroke = lines[i].members.front();
    std::size_t taken_by = i;
    double most = kAllAlong * static_cast<double>(sampled[i].points.size());
    for (const auto& [j, count] : beside(i, sampled, grid, reach, angle)) {
      if (static_cast<double>(count) < most || !several[j] || !may(stroke, lines[j])) continue;
      most = static_cast<double>(count);
      taken_by = j;
    }
    if (taken_by == i) continue;
    lines[taken_by].members.push_back(stroke);
    lines[taken_by].explained += lines[i].explained;
    lines[i].members.clear();
  }
  std::erase_if(lines, [](const MeantLine& line) { return line.members.empty(); });
  for (MeantLine& line : lines) std::ranges::sort(line.members);
}

}  // namespace keyline::sketch
