#include "keyline/acquire/ends.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"

namespace keyline::acquire {
namespace {

constexpr double kAcross = 0.8;      // radians
constexpr double kSeamCorner = 0.9;  // radians; less is no corner at the seam of an outline

double polygon_length(std::span<const core::Point2> points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += core::distance(points[i - 1], points[i]);
  return sum;
}

/// Largest of the steps near both ends.
double spacing_at_ends(std::span<const core::Point2> points, std::size_t stride) {
  double most = 0;
  const std::size_t n = points.size();
  for (std::size_t k = 0; k < 3 && (k + 1) * stride < n; ++k) {
    most = std::max(most, core::distance(points[k * stride], points[(k + 1) * stride]));
    most = std::max(most,
                    core::distance(points[n - 1 - k * stride], points[n - 1 - (k + 1) * stride]));
  }
  return most;
}

/// Turn of the polygon from step a-b to step c-d.
double turn(core::Point2 a, core::Point2 b, core::Point2 c, core::Point2 d) {
  return core::angle_between(b - a, d - c);
}

/// True where the chord between the ends goes on from the last step and into the first.
bool runs_across(std::span<const core::Point2> points, std::size_t s) {
  const std::size_t n = points.size();
  const core::Point2 last = points[n - 1];
  return std::abs(turn(points[n - 1 - s], last, last, points[0])) < kAcross &&
         std::abs(turn(last, points[0], points[0], points[s])) < kAcross;
}

}  // namespace

Ends recognise_ends(std::span<const core::Point2> points, std::size_t stride) {
  const std::size_t n = points.size();
  const std::size_t s = std::max<std::size_t>(stride, 1);
  if (n < 4 || n <= 6 * s) return Ends::apart;
  const double length = polygon_length(points);
  const double gap = core::distance(points.front(), points.back());
  const bool repeated = gap <= 1e-9 * length;
  const double spacing = spacing_at_ends(points, s);
  const bool near = n >= 8 && gap <= 1.75 * spacing && gap <= 0.2 * length;
  // A wider gap still belongs to an outline if the curve runs straight across it.
  const bool facing =
      n >= 8 && gap <= 4 * spacing && gap <= 0.05 * length && runs_across(points, s);
  if (!repeated && !near && !facing) return Ends::apart;

  const auto at = [&](std::size_t k) { return points[k * s]; };
  const auto back = [&](std::size_t k) { return points[n - 1 - k * s]; };
  const double seam = turn(back(1), back(0), at(0), at(1));
  const double beside = std::max(std::abs(turn(at(0), at(1), at(1), at(2))),
                                 std::abs(turn(back(2), back(1), back(1), back(0))));
  const bool corner = std::abs(seam) >= kSeamCorner && std::abs(seam) >= 3 * beside;
  if (repeated) return corner ? Ends::corner_repeated : Ends::closed_repeated;
  if (!corner) return Ends::closed;
  const double at_last = std::abs(turn(back(1), back(0), back(0), at(0)));
  const double at_first = std::abs(turn(back(0), at(0), at(0), at(1)));
  if (std::min(at_last, at_first) >= 0.3 * std::max(at_last, at_first)) return Ends::blunt;
  return at_first > at_last ? Ends::corner_at_first : Ends::corner_at_last;
}

}  // namespace keyline::acquire
