#include "keyline/sketch/whittaker.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "keyline/core/error.h"

namespace keyline::sketch {
namespace {

using core::Point2;
using core::Vector2;

/// Solves the symmetric system with bands d (diagonal), e and f (first and second above), in place.
std::vector<Point2> solve_bands(std::vector<double> d, std::vector<double> e, std::vector<double> f,
                                std::vector<Point2> b) {
  const std::size_t n = d.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (i + 1 < n) {
      const double l1 = e[i] / d[i];
      const double l2 = i + 2 < n ? f[i] / d[i] : 0;
      d[i + 1] -= l1 * e[i];
      b[i + 1] = b[i + 1] - l1 * (b[i] - Point2{});
      if (i + 2 < n) {
        e[i + 1] -= l1 * f[i];
        d[i + 2] -= l2 * f[i];
        b[i + 2] = b[i + 2] - l2 * (b[i] - Point2{});
      }
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    Vector2 v = b[i] - Point2{};
    if (i + 1 < n) v = v - e[i] * (b[i + 1] - Point2{});
    if (i + 2 < n) v = v - f[i] * (b[i + 2] - Point2{});
    b[i] = Point2{} + v / d[i];
  }
  return b;
}

std::vector<Point2> smooth_open(const std::vector<Point2>& points,
                                const std::vector<double>& weights, double lambda) {
  const std::size_t n = points.size();
  std::vector<double> d(weights);
  std::vector<double> e(n, 0);
  std::vector<double> f(n, 0);
  std::vector<Point2> b(n);
  for (std::size_t i = 0; i < n; ++i) b[i] = Point2{} + weights[i] * (points[i] - Point2{});
  for (std::size_t i = 1; i + 1 < n; ++i) {  // row 1, -2, 1 at i-1, i, i+1
    d[i - 1] += lambda;
    d[i] += 4 * lambda;
    d[i + 1] += lambda;
    e[i - 1] -= 2 * lambda;
    e[i] -= 2 * lambda;
    f[i - 1] += lambda;
  }
  return solve_bands(std::move(d), std::move(e), std::move(f), std::move(b));
}

}  // namespace

double lambda_of_wavelength(double wavelength) {
  return std::pow(wavelength / (2 * std::numbers::pi), 4);
}

std::vector<Point2> smooth_points(const std::vector<Point2>& points,
                                  const std::vector<double>& weights, double lambda, bool closed) {
  const std::size_t n = points.size();
  const auto positive =
      std::count_if(weights.begin(), weights.end(), [](double w) { return w > 0; });
  if (weights.size() != n || positive < 2)
    throw core::InvalidInput("smooth_points needs a weight for every point, two of them positive");
  if (!closed) return smooth_open(points, weights, lambda);
  // the seam's influence has died out after some ten wavelengths
  const double reach = 12 * std::pow(lambda, 0.25) * 2 * std::numbers::pi + 20;
  const std::size_t wrap = std::min(n, static_cast<std::size_t>(reach));
  std::vector<Point2> p;
  std::vector<double> w;
  for (std::size_t k = 0; k < n + 2 * wrap; ++k) {
    const std::size_t i = (k + n - wrap % n) % n;
    p.push_back(points[i]);
    w.push_back(weights[i]);
  }
  const std::vector<Point2> smooth = smooth_open(p, w, lambda);
  return {smooth.begin() + static_cast<long>(wrap), smooth.begin() + static_cast<long>(wrap + n)};
}

}  // namespace keyline::sketch
