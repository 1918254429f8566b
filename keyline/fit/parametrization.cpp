#include "keyline/fit/parametrization.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "keyline/core/quantile.h"

namespace keyline::fit {
namespace {

using core::Point2;
using core::Vector2;

/// Standard deviation of the points across the curve, from fourth differences.
double noise_across(std::span<const Point2> p) {
  std::vector<double> sizes;
  for (std::size_t i = 2; i + 2 < p.size(); ++i) {
    const Vector2 along = p[i + 2] - p[i - 2];
    const Vector2 d =
        (p[i - 2] - p[i]) + (p[i + 2] - p[i]) - 4 * (p[i - 1] - p[i]) - 4 * (p[i + 1] - p[i]);
    const double length = norm(along);
    if (length > 0) sizes.push_back(std::abs(cross(along, d)) / length);
  }
  // sqrt(70): the root of the summed squares of 1, -4, 6, -4, 1.
  return sizes.empty() ? 0 : core::quantile(std::move(sizes)) / (0.6745 * std::sqrt(70.0));
}

/// Half the number of neighbours to average over; 0: none.
std::size_t half_window(std::span<const Point2> p) {
  const std::size_t most = p.size() / 40;
  if (most < 3) return 0;
  const std::size_t reach = std::max<std::size_t>(4, p.size() / 64);
  std::vector<double> steps;
  for (std::size_t i = 0; i + reach < p.size(); ++i) {
    steps.push_back(distance(p[i], p[i + reach]) / static_cast<double>(reach));
  }
  const double step = core::quantile(std::move(steps));
  if (!(step > 0)) return 0;
  const double wanted = 50 * noise_across(p) / step;
  if (!(wanted > 3)) return 0;
  return static_cast<std::size_t>(std::min(wanted, static_cast<double>(most)) / 2);
}

/// Running average; near the ends the line of the outermost full window.
std::vector<Point2> averaged(std::span<const Point2> p, std::size_t half) {
  const std::size_t n = p.size();
  const std::size_t width = 2 * half + 1;
  const auto mean_of = [&](std::size_t first) {
    Vector2 sum;
    for (std::size_t i = 0; i < width; ++i) sum = sum + (p[first + i] - p[first + half]);
    return p[first + half] + sum / static_cast<double>(width);
  };
  const auto slope_of = [&](std::size_t first) {
    Vector2 sum;
    double squares = 0;
    for (std::size_t i = 0; i < width; ++i) {
      const double u = static_cast<double>(i) - static_cast<double>(half);
      sum = sum + u * (p[first + i] - p[first + half]);
      squares += u * u;
    }
    return sum / squares;
  };
  std::vector<Point2> q(n);
  for (std::size_t i = half; i + half < n; ++i) q[i] = mean_of(i - half);
  const Vector2 start = slope_of(0);
  const Vector2 end = slope_of(n - width);
  for (std::size_t i = 1; i <= half; ++i) {
    q[half - i] = q[half] + -static_cast<double>(i) * start;
    q[n - 1 - half + i] = q[n - 1 - half] + static_cast<double>(i) * end;
  }
  return q;
}

std::vector<double> cumulative(std::span<const Point2> points, bool square_roots) {
  std::vector<double> t(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double chord = distance(points[i - 1], points[i]);
    t[i] = t[i - 1] + (square_roots ? std::sqrt(chord) : chord);
  }
  return t;
}

/// Lengths along the averaged points, each moved to the foot of its own point.
std::vector<double> smooth_lengths(std::span<const Point2> p, std::size_t half) {
  const std::vector<Point2> q = averaged(p, half);
  std::vector<double> t = cumulative(q, false);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::size_t before = i > half ? i - half : 0;
    const std::size_t after = std::min(p.size() - 1, i + half);
    const Vector2 along = q[after] - q[before];
    const double length = norm(along);
    if (length > 0) t[i] += dot(along, p[i] - q[i]) / length;
  }
  return t;
}

}  // namespace

std::vector<double> parametrize(std::span<const Point2> points, Parametrization kind) {
  if (points.size() < 2) return {};
  const std::size_t half = kind == Parametrization::smooth_chord ? half_window(points) : 0;
  std::vector<double> t = half > 0 ? smooth_lengths(points, half)
                                   : cumulative(points, kind == Parametrization::centripetal);
  const auto [low, high] = std::minmax_element(t.begin(), t.end());
  const double first = *low;
  const double total = *high - *low;
  if (!(total > 0) || !std::isfinite(total)) return {};
  for (double& v : t) v = std::clamp((v - first) / total, 0.0, 1.0);
  return t;
}

}  // namespace keyline::fit
