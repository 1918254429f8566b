#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "keyline/analysis/profile.h"
#include "keyline/core/pose.h"
#include "keyline/curve/jet.h"

namespace keyline::analysis::testing {

/// A curve given by curvature, its rate and its turning as functions of arc length; an oracle of
/// its own, integrated in small steps.
struct SpiralCurve {
  core::Pose2 start;
  double length = 1;
  std::vector<double> breaks = {0, 1};
  std::function<double(double)> curvature, rate, turning;
  std::vector<core::Point2> points = {};  // at equal steps
};

inline core::Point2 advance(const SpiralCurve& c, core::Point2 p, double a, double b) {
  constexpr double node = 0.77459666924148337704;
  const auto at = [&](double u) {
    const double s = (a + b) / 2 + u * (b - a) / 2;
    return core::unit_vector(c.start.direction + c.turning(s));
  };
  return p + ((b - a) / 18) * (5 * at(-node) + 8 * at(0) + 5 * at(node));
}

inline SpiralCurve finish(SpiralCurve c) {
  constexpr int steps = 2000;
  c.points = {c.start.position};
  for (int i = 0; i < steps; ++i)
    c.points.push_back(
        advance(c, c.points.back(), c.length * i / steps, c.length * (i + 1) / steps));
  return c;
}

inline curve::Jet2 jet(const SpiralCurve& c, double t) {
  const double s = std::clamp(t, 0.0, 1.0) * c.length;
  const double step = c.length / static_cast<double>(c.points.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(s / step), c.points.size() - 2);
  const core::Vector2 along = core::unit_vector(c.start.direction + c.turning(s));
  const core::Vector2 left = core::perpendicular_left(along);
  const double k = c.curvature(s);
  return {advance(c, c.points[i], step * static_cast<double>(i), s), c.length * along,
          c.length * c.length * k * left,
          std::pow(c.length, 3) * (c.rate(s) * left - k * k * along)};
}
inline core::Point2 evaluate(const SpiralCurve& c, double t) { return jet(c, t).point; }
inline std::vector<double> breakpoints(const SpiralCurve& c) { return c.breaks; }

/// Clothoid kappa = k0 + (k1 - k0) s / length.
inline SpiralCurve clothoid(double k0, double k1, double length, core::Pose2 start = {}) {
  const double r = (k1 - k0) / length;
  return finish({start,
                 length,
                 {0, 1},
                 [=](double s) { return k0 + r * s; },
                 [=](double) { return r; },
                 [=](double s) { return k0 * s + r * s * s / 2; }});
}

/// Nielsen's spiral kappa = k0 e^(r s).
inline SpiralCurve nielsen(double k0, double r, double length, core::Pose2 start = {}) {
  return finish({start,
                 length,
                 {0, 1},
                 [=](double s) { return k0 * std::exp(r * s); },
                 [=](double s) { return r * k0 * std::exp(r * s); },
                 [=](double s) { return k0 * std::expm1(r * s) / r; }});
}

/// Logarithmic spiral rho = rho0 + c s.
inline SpiralCurve logarithmic(double rho0, double c, double length, core::Pose2 start = {}) {
  return finish({start,
                 length,
                 {0, 1},
                 [=](double s) { return 1 / (rho0 + c * s); },
                 [=](double s) { return -c / ((rho0 + c * s) * (rho0 + c * s)); },
                 [=](double s) { return std::log1p(c * s / rho0) / c; }});
}

/// Involute of a circle rho^2 = rho0^2 + 2 a s.
inline SpiralCurve involute(double rho0, double a, double length, core::Pose2 start = {}) {
  const auto rho = [=](double s) { return std::sqrt(rho0 * rho0 + 2 * a * s); };
  return finish({start,
                 length,
                 {0, 1},
                 [=](double s) { return 1 / rho(s); },
                 [=](double s) { return -a / std::pow(rho(s), 3); },
                 [=](double s) { return (rho(s) - rho0) / a; }});
}

/// kappa(s) = km (1 - alpha lambda (s - b))^(-1/alpha): any slope, km and relative rate lambda at
/// b.
inline double power_curvature(double km, double lambda, double alpha, double x) {
  if (std::abs(alpha) < 1e-12) return km * std::exp(lambda * x);
  return km * std::pow(1 - alpha * lambda * x, -1 / alpha);
}

/// Two slopes (alpha0 before b, alpha1 after), joined with equal curvature km and rate km lambda.
inline SpiralCurve compound(double km, double lambda, double b, double alpha0, double alpha1,
                            double length, core::Pose2 start = {}) {
  const auto kappa = [=](double s) {
    return power_curvature(km, lambda, s < b ? alpha0 : alpha1, s - b);
  };
  const auto rate = [=](double s) {
    const double a = s < b ? alpha0 : alpha1;
    return kappa(s) * lambda / (1 - a * lambda * (s - b));
  };
  constexpr int steps = 4000;
  std::vector<double> turned = {0};
  const double h = length / steps;
  for (int i = 0; i < steps; ++i)
    turned.push_back(turned.back() +
                     h / 6 * (kappa(i * h) + 4 * kappa((i + 0.5) * h) + kappa((i + 1) * h)));
  const auto turning = [=](double s) {
    const auto i = std::min(static_cast<std::size_t>(std::max(0.0, s / h)), turned.size() - 2);
    const double a = h * static_cast<double>(i);
    return turned[i] + (s - a) / 6 * (kappa(a) + 4 * kappa((a + s) / 2) + kappa(s));
  };
  return finish({start, length, {0, b / length, 1}, kappa, rate, turning});
}

/// Curvature constant on each part; ends are arc lengths, the last one the length.
inline SpiralCurve arcs(const std::vector<double>& kappas, const std::vector<double>& ends,
                        core::Pose2 start = {}) {
  const double length = ends.back();
  const auto part = [=](double s) {
    std::size_t i = 0;
    while (i + 1 < ends.size() && s >= ends[i]) ++i;
    return i;
  };
  std::vector<double> breaks = {0};
  for (double e : ends) breaks.push_back(e / length);
  const auto turning = [=](double s) {
    double angle = 0;
    double from = 0;
    for (std::size_t i = 0; i <= part(s); ++i) {
      const double to = i == part(s) ? s : ends[i];
      angle += kappas[i] * (to - from);
      from = to;
    }
    return angle;
  };
  return finish({start, length, breaks, [=](double s) { return kappas[part(s)]; },
                 [](double) { return 0.0; }, turning});
}

/// kappa = mean + amplitude cos(2 pi s / wavelength) on top of a clothoid.
inline SpiralCurve wavy(double k0, double k1, double amplitude, double wavelength, double length,
                        core::Pose2 start = {}) {
  const double w = 2 * core::kPi / wavelength;
  const double r = (k1 - k0) / length;
  return finish(
      {start,
       length,
       {0, 1},
       [=](double s) { return k0 + r * s + amplitude * std::cos(w * s); },
       [=](double s) { return r - amplitude * w * std::sin(w * s); },
       [=](double s) { return k0 * s + r * s * s / 2 + amplitude / w * std::sin(w * s); }});
}

}  // namespace keyline::analysis::testing
