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

/// Distances of what runs beside a stroke along it; none where that is less than half of it.
std::vector<double> beside(const StrokeGrid& grid, const std::vector<SampledStroke>& strokes,
                           std::size_t own, const PassModel& model) {
  const double reach = pass_distance(model, strokes[own].length);
  const std::size_t n = strokes[own].points.size();
  std::vector<double> apart;
  for (std::size_t k = 0; k < n; k += 2)
    if (const double d = nearest_beside(grid, strokes, own, k, reach, model); d <= reach)
      apart.push_back(d);
  if (2 * static_cast<double>(apart.size()) <= kBeside * static_cast<double>(n)) apart.clear();
  return apart;
}

}  // namespace

PassReach hand_seen(const std::vector<SampledStroke>& strokes, const PassModel& at_most) {
  double longest = 0;
  for (const SampledStroke& s : strokes) longest = std::max(longest, s.length);
  const StrokeGrid grid(strokes, pass_distance(at_most, longest));
  PassReach reach{at_most, at_most, {}};
  std::vector<double> shares;  // by stroke
  std::vector<double> places;  // of all strokes
  for (std::size_t a = 0; a < strokes.size(); ++a) {
    const std::vector<double> apart = beside(grid, strokes, a, at_most);
    const double usual = core::quantile(apart);
    reach.of_stroke.push_back(apart.empty() ? INFINITY : kSpread * usual);
    if (!apart.empty()) shares.push_back(usual / strokes[a].length);
    places.insert(places.end(), apart.begin(), apart.end());
  }
  if (shares.empty()) return reach;
  const double widths = kWidths * core::quantile(places) / at_most.width;
  reach.seen.apart = std::min(at_most.apart, std::max(kTouch, widths));
  reach.seen.hand = std::min(at_most.hand, kSpread * core::quantile(shares));
  for (double& far : reach.of_stroke) far = std::max(far, reach.seen.apart * at_most.width);
  return reach;
}

}  // namespace keyline::sketch
