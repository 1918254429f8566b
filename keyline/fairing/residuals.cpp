#include "keyline/fairing/residuals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "keyline/acquire/noise.h"
#include "keyline/fairing/fair.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kLeastRms = 0.01;  // of the tolerance: nearer than that is no matter

/// Noise of the points as they are fitted: what the measured points' leaves in means of several, or
/// what those show themselves where neighbours err alike.
double noise_of(const std::vector<FitPoint>& points, bool closed, std::size_t n, double noise) {
  if (n <= points.size()) return noise;
  std::vector<core::Point2> at;
  for (const FitPoint& p : points) at.push_back(p.position);
  const double share = static_cast<double>(points.size()) / static_cast<double>(n);
  return std::max(noise * std::sqrt(share), acquire::estimate_noise(at, closed));
}

/// Of measured points whose offsets have this root of their mean square: that of their means.
double of_means(double rms, double scatter) {
  return scatter > 0 ? std::sqrt(std::max(0.0, rms * rms - scatter * scatter)) : rms;
}

}  // namespace

double Residuals::most(double errors) const {
  const double all = scatter > 0 ? std::hypot(rms, scatter) : rms;
  return rms > 0 ? of_means(all * (1 + errors * standard_error), scatter) : HUGE_VAL;
}

Residuals allowed_residuals(const std::vector<FitPoint>& points, bool closed, std::size_t n,
                            double noise, double tolerance, double smoothness) {
  const double own = noise_of(points, closed, n, noise);
  const bool means = n > points.size() && noise > own;
  const double all = means ? noise : own;
  const double scatter = means ? std::sqrt(noise * noise - own * own) : 0;
  // As many errors as their means tell: fewer than points where neighbours err alike.
  const double error = own / all / std::sqrt(2.0 * static_cast<double>(points.size()));
  const double left = std::max(0.0, tolerance - noise_factor(n) * noise);
  const double calm = std::min(1.0, 2 * smoothness);
  // Offsets spread evenly over the tolerance have this root of their mean square.
  const double most = tolerance / std::numbers::sqrt3;
  const double allowed = of_means(std::hypot(all * (1 + calm * error), calm * left), scatter);
  double rms = std::max(allowed, kLeastRms * tolerance);
  if (smoothness > 0.5 && rms < most) rms *= std::pow(most / rms, 2 * smoothness - 1);
  if (rms >= most) return {0, own, scatter, left, 0};
  return {rms, own, scatter, left, error};
}

}  // namespace keyline::fairing::detail
