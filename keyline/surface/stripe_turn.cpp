#include "keyline/surface/stripe_turn.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"

namespace keyline::surface {
namespace {

constexpr double kBelowOne = 1 - 1e-16;
constexpr double kStill = 1e-9;  ///< of the curvature across the joint: rounding would tell

/// Over the directions phi of the zebra's slope on the sphere of normals, from the one along which
/// it changes fastest on the joint (phi = 0), a stripe leaves the joint at the angle
/// atan(a + b tan phi) from the line across it, and stripes cross as cos phi.
struct Side {
  double a = 0;
  double b = 0;
};

/// The integral over phi of 1 / (l1 cos^2 + l2 sin^2) times sin phi: from its axes, turned by
/// `axis`.
double sine_over(double l1, double l2, double axis, double phi) {
  const double d = l1 - l2;  // l1 >= l2 > 0
  const double u = std::cos(phi - axis);
  const double w = std::sin(phi - axis);
  const bool round = d < 1e-12 * l1;
  const double of_sine = round ? -u / l2 : -std::atan(u * std::sqrt(d / l2)) / std::sqrt(d * l2);
  const double inside = std::clamp(w * std::sqrt(d / l1), -kBelowOne, kBelowOne);
  const double of_cosine = round ? w / l1 : std::atanh(inside) / std::sqrt(d * l1);
  return of_sine * std::cos(axis) + of_cosine * std::sin(axis);
}

/// An antiderivative by phi of the angle times cos phi, by parts.
double moment(const Side& s, double phi) {
  const double c = std::cos(phi);
  const double sine = std::sin(phi);
  const double whole = sine * std::atan2(s.a * c + s.b * sine, c);
  if (s.b == 0) return whole;
  const double sum = 1 + s.a * s.a + s.b * s.b;  // of the axes; their product is b^2
  const double difference = std::hypot(1 + s.a * s.a - s.b * s.b, 2 * s.a * s.b);
  const double l1 = 0.5 * (sum + difference);
  const double axis = 0.5 * std::atan2(2 * s.a * s.b, 1 + s.a * s.a - s.b * s.b);
  return whole - s.b * sine_over(l1, s.b * s.b / l1, axis, phi);
}

}  // namespace

double stripe_density(const CurvatureForm& first, const CurvatureForm& second) {
  return std::hypot(0.5 * (first.xy + second.xy), 0.5 * (first.yy + second.yy));
}

double stripe_turn(const CurvatureForm& first, const CurvatureForm& second) {
  const double p = 0.5 * (first.yy + second.yy);
  const double q = 0.5 * (first.xy + second.xy);
  const double square = p * p + q * q;
  const double across = std::max(std::abs(first.xx), std::abs(second.xx));
  if (!(std::sqrt(square) > kStill * across) || first.xx == second.xx) return 0;
  const auto side = [&](double c) { return Side{q * (c + p) / square, (c * p - q * q) / square}; };
  const Side one = side(first.xx);
  const Side two = side(second.xx);
  const auto turned = [&](double from, double to) {
    return std::abs(moment(two, to) - moment(two, from) - moment(one, to) + moment(one, from));
  };
  const double right = 0.5 * core::kPi;
  const double alike = p == 0 ? right : std::atan(-q / p);  // there both leave at one angle
  return std::min(0.5 * (turned(-right, alike) + turned(alike, right)), core::kPi);
}

}  // namespace keyline::surface
