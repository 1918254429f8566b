#include "keyline/acquire/going_on.h"

#include <algorithm>
#include <cmath>

#include "keyline/acquire/local_fit.h"

namespace keyline::acquire {
namespace {

constexpr std::size_t kFewest = 6;  // points: of fewer a line alone tells, which bends leave
constexpr int kMostDegree = 3;
constexpr double kTells = 10.13;  // F of 1 and 3 degrees of freedom that chance passes in one of 20
constexpr double kReach = 2;      // of the gap between two sides: how far a corner in it may be
constexpr int kSteps = 20;        // of Newton
constexpr double kMet = 1e-12;    // of the gap
constexpr double kLeastSine = 0.1;    // of the angle at which sides meet: others touch anywhere
constexpr double kDifference = 1e-4;  // of the gap: for slopes

/// A polynomial through twice as many of the last points as it has terms.
std::optional<detail::LocalFit> fit_last(std::span<const core::Point2> points, int degree) {
  const auto count = static_cast<std::size_t>(2 * (degree + 1));
  if (points.size() < std::max(count, kFewest)) return std::nullopt;
  return detail::LocalFit::make(points.last(count), degree);
}

/// A line through the last six points, or a parabola where these tell its bend.
std::optional<detail::LocalFit> going_on(std::span<const core::Point2> points) {
  if (points.size() < kFewest) return std::nullopt;
  const auto line = detail::LocalFit::make(points.last(kFewest), 1);
  const auto parabola = detail::LocalFit::make(points.last(kFewest), 2);
  if (!line || !parabola) return line;
  const double left = parabola->squared_residuals() / (kFewest - 3);
  return line->squared_residuals() - parabola->squared_residuals() > kTells * left ? parabola
                                                                                   : line;
}

/// Where both are 0, from a place on.
std::optional<core::Point2> crossing(const detail::LocalFit& one, const detail::LocalFit& other,
                                     core::Point2 from, double gap) {
  const double h = kDifference * gap;
  const auto slope = [h](const detail::LocalFit& fit, core::Point2 p) {
    return core::Vector2{
               fit.residual(p + core::Vector2{h, 0}) - fit.residual(p - core::Vector2{h, 0}),
               fit.residual(p + core::Vector2{0, h}) - fit.residual(p - core::Vector2{0, h})} /
           (2 * h);
  };
  for (int step = 0; step < kSteps; ++step) {
    const double f = one.residual(from);
    const double g = other.residual(from);
    if (std::max(std::abs(f), std::abs(g)) <= kMet * gap) return from;
    const core::Vector2 u = slope(one, from);
    const core::Vector2 v = slope(other, from);
    const double det = core::cross(u, v);
    if (!(std::abs(det) >= kLeastSine * core::norm(u) * core::norm(v))) return std::nullopt;
    from = from + core::Vector2{g * u.y - f * v.y, f * v.x - g * u.x} / det;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> distance_beyond(std::span<const core::Point2> points, core::Point2 p) {
  std::optional<double> least;
  for (int degree = 1; degree <= kMostDegree; ++degree) {
    const auto fit = fit_last(points, degree);
    if (!fit) continue;
    const double off = std::abs(fit->residual(p));
    least = std::min(least.value_or(off), off);
  }
  return least;
}

std::optional<double> distance_of_last(std::span<const core::Point2> points) {
  return distance_beyond(points.first(points.size() - 1), points.back());
}

std::optional<core::Point2> corner_beyond(std::span<const core::Point2> one,
                                          std::span<const core::Point2> other) {
  const auto before = going_on(one);
  const auto after = going_on(other);
  if (!before || !after) return std::nullopt;
  const double gap = core::distance(one.back(), other.back());
  const auto met = crossing(*before, *after, one.back() + (other.back() - one.back()) / 2, gap);
  if (!met) return std::nullopt;
  for (const auto& side : {one, other}) {
    const core::Vector2 on = *met - side.back();
    const core::Vector2 way = side.back() - side[side.size() - 2];
    if (core::dot(on, way) < 0 || core::norm(on) > kReach * gap) return std::nullopt;
  }
  return met;
}

}  // namespace keyline::acquire
