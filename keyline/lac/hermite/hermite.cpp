#include <algorithm>
#include <cmath>
#include <string>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/lac/hermite/chord_kernel.h"
#include "keyline/lac/hermite/one_signed.h"
#include "keyline/lac/hermite/quick_search.h"
#include "keyline/lac/hermite/region.h"
#include "keyline/lac/segment/arm.h"
#include "keyline/lac/segment/slope.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point2;
using core::Vector2;

/// Below this turning a curve differs from its chord by less than rounding.
constexpr double kStraight = 4e-16;

std::string number(double x) { return core::number_text(x, 9); }

std::unexpected<core::Failure> undrawable(double alpha, double theta, double psi, double sign) {
  const double limit = detail::limit_chord_angle(alpha, theta);
  const core::Interval region{theta - limit, limit};
  const NearestDrawable nearest = nearest_drawable(alpha, theta, psi);
  const double low = sign > 0 ? region.low : -region.high;
  const double high = sign > 0 ? region.high : -region.low;
  return core::fail(ErrorCode::undrawable,
                    "no curve of slope " + number(alpha) + " turning by " + number(sign * theta) +
                        " rad has its chord at " + number(sign * psi) +
                        " rad from the start tangent; it must lie between " + number(low) +
                        " and " + number(high),
                    "nearest chord angle " + number(sign * nearest.chord_angle) +
                        " rad, or slope " + number(nearest.alpha));
}

std::unexpected<core::Failure> beyond_doubles(double alpha) {
  return core::fail(ErrorCode::undrawable,
                    "the curvatures at the ends would differ by more than double precision holds",
                    alpha < 0.5 ? "move the slope away from 0" : "move the slope away from 1");
}

/// Lambda of the standard form is dtheta/dlambda integrated from the reference point, over theta.
detail::UnitCurve unit_curve(double alpha, double theta, const detail::ChordSolution& found) {
  const double q = found.range;
  const double lambda = detail::decay_integral(std::abs(1 - alpha), q) / theta;
  if (q == 0) return {found.chord_length, theta, theta, lambda, found.iterations};
  const detail::Decays d = detail::decays_of(alpha);
  const double heavy = theta * (detail::decay_integral(d.a, q) / detail::decay_integral(d.b, q));
  if (alpha < 0) {
    return {found.chord_length, heavy, heavy * std::exp(-q), lambda, found.iterations};
  }
  return {found.chord_length, heavy * std::exp(q), heavy, lambda, found.iterations};
}

SegmentSolution straight(const HandleAngles& angles, double alpha) {
  SegmentSolution solution;
  solution.segment = {{}, alpha, 1, 0, 0};
  solution.turning = angles.turning;
  solution.chord_angle = angles.chord_angle;
  return solution;
}

/// Over a chord of length 1; swapped: run from its flat to its sharp end.
SegmentSolution placed(const detail::UnitCurve& curve, const HandleAngles& angles, double alpha,
                       bool swapped) {
  const double unit = angles.turning < 0 ? -curve.chord_length : curve.chord_length;
  SegmentSolution solution;
  solution.segment = {{{0, 0}, -angles.chord_angle},
                      alpha,
                      1 / curve.chord_length,
                      unit * (swapped ? curve.flat : curve.sharp),
                      unit * (swapped ? curve.sharp : curve.flat)};
  solution.reversed = swapped;
  solution.lambda = curve.lambda;
  solution.turning = angles.turning;
  solution.chord_angle = angles.chord_angle;
  solution.iterations = curve.iterations;
  return solution;
}

}  // namespace

core::Result<HandleAngles> handle_angles(Point2 p0, Point2 p1, Point2 p2) {
  if (!is_finite(p0) || !is_finite(p1) || !is_finite(p2)) {
    return core::fail(ErrorCode::bad_input, "a point is not finite");
  }
  const double scale = std::max(
      {std::abs(p1.x - p0.x), std::abs(p1.y - p0.y), std::abs(p2.x - p0.x), std::abs(p2.y - p0.y)});
  if (std::isinf(scale)) {
    return core::fail(ErrorCode::bad_input, "the points lie too far apart for double precision",
                      "scale them to below 1e307", "points");
  }
  const Vector2 chord = (p2 - p0) / scale;
  const auto size = [](Vector2 v) { return std::sqrt(dot(v, v)); };  // scaled: no overflow
  if (!(size(chord) > 0)) {
    return core::fail(ErrorCode::bad_input, "start and end point coincide", "move one of them",
                      "points[2]");
  }
  const Vector2 first = (p1 - p0) / scale;
  const Vector2 second = (p2 - p1) / scale;
  HandleAngles angles{0, 0, size(chord) * scale, 0};
  const bool distinct = size(first) > 0 && size(second) > 0;
  if (!distinct) {
    angles.direction = core::direction_of(chord);
    return angles;
  }
  angles.turning = core::angle_between(first, second);
  angles.chord_angle = core::angle_between(first, chord);
  if (std::abs(angles.turning) < kStraight) {
    angles.turning = angles.chord_angle = 0;
    angles.direction = core::direction_of(chord);
    return angles;
  }
  angles.direction = core::direction_of(first);
  return angles;
}

core::Result<SegmentSolution> solve_g1(const HandleAngles& angles, double alpha) {
  if (std::abs(angles.turning) >= core::kPi - 1e-15) {
    return core::fail(ErrorCode::undrawable,
                      "the middle point does not lie between the ends: the curve would turn back",
                      "put it nearer to the chord's middle");
  }
  return detail::solve_one_signed(angles, alpha);
}

namespace detail {

core::Result<SegmentSolution> solve_one_signed(const HandleAngles& angles, double alpha) {
  if (!is_slope(alpha)) {
    return core::fail(ErrorCode::bad_input, kSlopeRule, {}, "alpha");
  }
  const double sign = angles.turning < 0 ? -1 : 1;
  const double theta = sign * angles.turning;
  const double psi = sign * angles.chord_angle;
  if (std::isnan(theta) || std::isnan(psi)) {
    return core::fail(ErrorCode::bad_input, "an angle is not a number");
  }
  if (theta < kStraight && std::abs(psi) < kStraight) return straight(angles, alpha);
  if (!(psi > 0 && psi < theta && theta < 2 * core::kPi)) {
    return core::fail(ErrorCode::undrawable,
                      "the middle point does not lie between the ends: the curve would turn back",
                      "put it nearer to the chord's middle");
  }
  const bool swapped = psi < theta / 2;
  const double grown = swapped ? theta - psi : psi;
  if (alpha == -1) {
    const auto clothoid = quick_clothoid(theta, std::max(grown - theta / 2, 0.0));
    if (clothoid) return placed(*clothoid, angles, alpha, swapped);
  }
  const ChordSolution chord = solve_chord_angle(alpha, theta, grown);
  if (chord.status == detail::ChordStatus::beyond_precision) return beyond_doubles(alpha);
  if (chord.status != detail::ChordStatus::solved) return undrawable(alpha, theta, psi, sign);
  return placed(unit_curve(alpha, theta, chord), angles, alpha, swapped);
}

}  // namespace detail

core::Result<SegmentSolution> solve_g1(Point2 p0, Point2 p1, Point2 p2, double alpha) {
  const auto angles = handle_angles(p0, p1, p2);
  if (!angles) return std::unexpected(angles.error());
  auto solution = solve_g1(*angles, alpha);
  if (!solution) return solution;
  Segment& s = solution->segment;
  const double chord = angles->chord;
  s.start = {p0, angles->direction};
  s.length *= chord;
  s.curvature_start /= chord;
  s.curvature_end /= chord;
  const auto lost = [](double k) { return std::isinf(k) || std::abs(k) < 1e-307; };
  const bool curved = solution->turning != 0;
  if (curved && alpha >= 0 && alpha <= 1 && (lost(s.curvature_start) || lost(s.curvature_end))) {
    return beyond_doubles(alpha);
  }
  return solution;
}

}  // namespace keyline::lac
