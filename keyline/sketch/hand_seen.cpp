#include "keyline/sketch/hand_seen.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keyline/core/quantile.h"

namespace keyline::sketch {
namespace {

constexpr double kWidths = 5;   ///< farthest passes lie so many times as far apart as nearest ones,
constexpr double kSpread = 10;  ///< and so many times as shares of their length
constexpr double kTouch = 1;    ///< widths: nearer, the ink touches
constexpr double kBeside = 0.5;  ///< of a stroke: less beside others says nothing
constexpr double kAhead = 2;     ///< pens along the stroke: what is farther on lies not beside it

/// How far from a place of a stroke the next other one runs along it, as far as `reach`; more where
/// none does.
double nearest_beside(const StrokeGrid& grid, const std::vector<SampledStroke>& strokes,
                      std::size_t own, std::size_t k, double reach, const PassModel& model) {
  const core::Point2 p = strokes[own].points[k];
  const core::Vector2 along = strokes[own].tangents[k];
  const double least_turn = std::cos(model.angle);
  double nearest = std::numeric_limits<double>::infinity();
  grid.visit_others(p, reach, own, [&](std::size_t s, std::size_t i) {
    const core::Vector2 way = strokes[s].points[i] - p;
    if (std::abs(dot(along, way)) > kAhead * model.width ||
        std::abs(dot(along, strokes[s].tangents[i])) < least_turn)
      return;
    nearest = std::min(nearest, std::abs(cross(along, way)));
  });
  return nearest;
}

}  // namespace

PassModel hand_seen(const std::vector<SampledStroke>& strokes, const PassModel& most) {
  double longest = 0;
  for (const SampledStroke& s : strokes) longest = std::max(longest, s.length);
  const StrokeGrid grid(strokes, pass_distance(most, longest));
  std::vector<double> shares;   // by stroke
  std::vector<double> spacing;  // by place of a stroke
  std::vector<double> apart;
  for (std::size_t a = 0; a < strokes.size(); ++a) {
    const double reach = pass_distance(most, strokes[a].length);
    apart.clear();
    for (std::size_t k = 0; k < strokes[a].points.size(); k += 2)
      if (const double d = nearest_beside(grid, strokes, a, k, reach, most); d <= reach)
        apart.push_back(d);
    if (2 * static_cast<double>(apart.size()) <=
        kBeside * static_cast<double>(strokes[a].points.size()))
      continue;
    shares.push_back(core::quantile(apart) / strokes[a].length);
    spacing.insert(spacing.end(), apart.begin(), apart.end());
  }
  PassModel seen = most;
  if (shares.empty()) return seen;
  const double widths = kWidths * core::quantile(spacing) / most.width;
  seen.apart = std::min(most.apart, std::max(kTouch, widths));
  seen.hand = std::min(most.hand, kSpread * core::quantile(shares));
  return seen;
}

}  // namespace keyline::sketch
