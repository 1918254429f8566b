#include "keyline/fairing/guides.h"

#include "keyline/fairing/between_points.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kSlack = 0.1;  // of the gap: how far the chain may pass from a guide

}  // namespace

std::vector<FitPoint> with_guides(const std::vector<FitPoint>& points, bool closed,
                                  double tolerance) {
  std::vector<FitPoint> result;
  const std::size_t n = points.size();
  std::vector<core::Point2> position;
  for (const FitPoint& p : points) position.push_back(p.position);
  for (std::size_t i = 0; i < n; ++i) {
    result.push_back(points[i]);
    if (!closed && i + 1 == n) break;
    const double gap = core::distance(position[i], position[(i + 1) % n]);
    const double share = tolerance / (kSlack * gap);
    if (!(share < 0.5)) continue;
    for (const double u : {1.0 / 3, 2.0 / 3})
      result.push_back(
          {.position = between_points(position, closed, i, u), .count = 0, .share = share});
  }
  return result;
}

}  // namespace keyline::fairing::detail
