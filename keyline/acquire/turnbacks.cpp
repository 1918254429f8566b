#include "keyline/acquire/turnbacks.h"

#include <cmath>
#include <limits>
#include <vector>

#include "keyline/core/angle.h"
#include "keyline/core/quantile.h"

namespace keyline::acquire::detail {
namespace {

constexpr double kSharp = core::kPi / 3;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

double turn_at(const std::vector<core::Point2>& points, std::size_t i) {
  return std::abs(core::angle_between(points[i] - points[i - 1], points[i + 1] - points[i]));
}

/// The shortest step below `usual` with sharp turns at both ends; kNone where there is none.
std::size_t shortest_turnback(const std::vector<core::Point2>& points, double usual) {
  std::size_t best = kNone;
  double least = usual;
  for (std::size_t i = 1; i + 2 < points.size(); ++i) {
    const double step = core::distance(points[i], points[i + 1]);
    if (!(step < least) || turn_at(points, i) < kSharp || turn_at(points, i + 1) < kSharp) continue;
    least = step;
    best = i;
  }
  return best;
}

void average_next(Working& work, std::size_t i) {
  double share = 0.5;
  if (!work.weights.empty()) {
    const double both = work.weights[i] + work.weights[i + 1];
    share = both > 0 ? work.weights[i + 1] / both : 0.5;
    work.weights[i] = both;
  }
  work.points[i] = work.points[i] + share * (work.points[i + 1] - work.points[i]);
  remove_points(work, {i + 1});
}

}  // namespace

std::size_t average_turnbacks(Working& work) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < work.points.size(); ++i)
    steps.push_back(core::distance(work.points[i - 1], work.points[i]));
  const double usual = core::quantile(steps);
  std::size_t gone = 0;
  for (std::size_t i = shortest_turnback(work.points, usual); i != kNone && 4 * gone < steps.size();
       i = shortest_turnback(work.points, usual)) {
    average_next(work, i);
    ++gone;
  }
  return gone;
}

std::size_t sharp_turns(const Working& work) {
  std::size_t count = 0;
  for (std::size_t i = 1; i + 1 < work.points.size(); ++i)
    if (turn_at(work.points, i) > kSharp) ++count;
  return count;
}

}  // namespace keyline::acquire::detail
