#include "keyline/sketch/double_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "keyline/core/quantile.h"

namespace keyline::sketch {
namespace {

constexpr double kLong = 30;     ///< widths: shorter strokes run evenly by chance
constexpr double kPaper = 1.5;   ///< widths from middle to middle: there is paper between
constexpr double kEven = 0.125;  ///< of the usual distance
constexpr double kMost = 0.75;   ///< of the stroke

/// Distances, by the other stroke, of what is nearest to a stroke's samples on either side.
std::map<std::size_t, std::vector<double>> next_to(std::size_t own,
                                                   const std::vector<SampledStroke>& strokes,
                                                   const StrokeGrid& grid, double reach,
                                                   double angle) {
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t stroke = 0;
  };
  std::map<std::size_t, std::vector<double>> all;
  for (std::size_t k = 0; k < strokes[own].points.size(); ++k) {
    const core::Point2 p = strokes[own].points[k];
    const core::Vector2 along = strokes[own].tangents[k];
    std::array<Nearest, 2> sides;
    grid.visit_others(p, reach, own, [&](std::size_t s, std::size_t i) {
      if (std::abs(dot(along, strokes[s].tangents[i])) < std::cos(angle)) return;
      const core::Vector2 way = strokes[s].points[i] - p;
      Nearest& side = sides[cross(along, way) > 0 ? 1 : 0];
      if (core::norm(way) < side.distance) side = {core::norm(way), s};
    });
    for (const Nearest& side : sides)
      if (std::isfinite(side.distance)) all[side.stroke].push_back(side.distance);
  }
  return all;
}

/// True if the distances, of so many samples, are those of two edges.
bool is_even(const std::vector<double>& apart, std::size_t samples, double width) {
  const double usual = core::quantile(apart);
  const auto even =
      std::ranges::count_if(apart, [&](double d) { return std::abs(d - usual) <= kEven * usual; });
  return usual >= kPaper * width &&
         static_cast<double>(even) >= kMost * static_cast<double>(samples);
}

}  // namespace

std::vector<TwoLines> double_edges(const std::vector<SampledStroke>& strokes,
                                   const std::vector<std::vector<std::size_t>>& groups,
                                   const PassModel& at_most) {
  const double reach = at_most.apart * at_most.width;
  std::vector<TwoLines> found;
  for (const auto& group : groups) {
    std::vector<SampledStroke> some;
    for (const std::size_t s : group) some.push_back(strokes[s]);
    const StrokeGrid grid(some, reach);
    for (std::size_t a = 0; a < some.size(); ++a) {
      if (some[a].length < kLong * at_most.width) continue;
      for (const auto& [b, apart] : next_to(a, some, grid, reach, at_most.angle))
        if (is_even(apart, some[a].points.size(), at_most.width))
          found.push_back({{group[a]}, {group[b]}});
    }
  }
  return found;
}

}  // namespace keyline::sketch
