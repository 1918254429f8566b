#include "keyline/lac/hermite/clamped.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/chord_kernel.h"
#include "keyline/lac/hermite/clamping.h"
#include "keyline/lac/hermite/one_signed.h"
#include "keyline/lac/segment/arm.h"
#include "keyline/lac/segment/lambda.h"

namespace keyline::lac {
namespace {

using Complex = std::complex<double>;

using detail::kFar;
using detail::kKept;

/// A curve of unit chord from its sharp to its flat end, turning left.
struct Clamped {
  std::array<Piece, 2> pieces;
  double range = 0;  ///< ln of the curvatures' ratio
};

/// (e^{k x} - 1) / k.
double growth(double k, double x) { return detail::decay_integral(-k, x); }

/// The x with growth(k, x) = value; infinite past its limit.
double growth_inverse(double k, double value) {
  if (k == 0) return value;
  return k * value > -1 ? std::log1p(k * value) / k : HUGE_VAL;
}

/// Slope near 0: all the turning lies next to the sharp end. With l = ln(kappa_sharp / kappa) the
/// arc length goes as S(l) = (e^{alpha l} - 1) / alpha, and for large ranges the chord is
/// e^{i theta} (1 + G / S) with G = integral of e^{alpha l} (e^{-i theta e^{-(1 - alpha) l}} - 1)
/// over all l > 0, so that the chord's direction gives S at once.
Clamped next_to_zero(double alpha, double theta, double delta) {
  Complex g = 0;
  Complex power = 1;
  for (int k = 1; k < 60; ++k) {
    power *= Complex(0, -theta) / double(k);
    g += power / (k * (1 - alpha) - alpha);
  }
  const double per_arc = -std::sin(delta) / std::imag(g * std::polar(1.0, delta));  // 1 / S
  const double length = 1 / std::abs(1.0 + per_arc * g);
  const double sharp = theta * (1 - alpha) / (per_arc * length);
  const double flat = sharp * std::exp(-kKept);
  const double kept = std::min(1.0, growth(alpha, kKept) * per_arc);
  return {{Piece{alpha, kept * length, sharp, flat}, {alpha, (1 - kept) * length, flat, flat}},
          growth_inverse(alpha, 1 / per_arc)};
}

/// Slope near 1: all the length lies next to the flat end. With l = ln(kappa / kappa_flat) the
/// angle from there is tau T(l), T(l) = (e^{(1 - alpha) l} - 1) / (1 - alpha), and the chord
/// integral of alpha e^{-alpha l} e^{i tau T(l)} = sum of (i tau)^k / product of
/// (alpha - j (1 - alpha)), j = 1 ... k.
Clamped next_to_one(double alpha, double theta, double delta) {
  double tau = delta * (2 * alpha - 1);
  Complex chord;
  for (int i = 0; i < 50; ++i) {
    Complex term = 1;
    Complex slope = 0;
    chord = 1;
    for (int k = 1; k < 200 && std::abs(term) > 1e-18; ++k) {
      term *= Complex(0, 1) / (alpha - k * (1 - alpha));
      slope += double(k) * term;
      term *= tau;
      chord += term;
    }
    const double step = (std::arg(chord) - delta) / std::imag(slope / chord);
    tau -= step;
    if (std::abs(step) < 1e-16 * tau) break;
  }
  const double length = 1 / std::abs(chord);
  const double flat = tau / (length * alpha);
  const double sharp = flat * std::exp(kKept);
  const double rest = theta - tau * growth(1 - alpha, kKept);
  return {{Piece{alpha, rest / sharp, sharp, sharp}, {alpha, length, sharp, flat}},
          growth_inverse(1 - alpha, theta / tau)};
}

/// In (-0.13, 0.13) or within 0.13 of 1; elsewhere a range of kFar cannot be told from infinity.
bool may_be_far(double alpha) { return std::min(std::abs(alpha), std::abs(alpha - 1)) < 0.13; }

/// Empty where the request is not drawable or its range is not beyond `least` >= kFar.
std::optional<G1Chain> clamped(const HandleAngles& angles, double alpha, double least = kFar) {
  const double sign = angles.turning < 0 ? -1 : 1;
  const double theta = sign * angles.turning;
  const double psi = sign * angles.chord_angle;
  if (!may_be_far(alpha) || !(psi > 0 && psi < theta && theta < 2 * core::kPi)) return {};
  const bool reversed = psi < theta / 2;
  const double delta = reversed ? psi : theta - psi;
  const detail::ChordSolution found = detail::solve_chord_angle(alpha, theta, theta - delta);
  const bool solved = found.status == detail::ChordStatus::solved;
  if (found.status == detail::ChordStatus::beyond_region) return {};
  if (solved && !(found.range > least && std::isfinite(found.range))) return {};
  const Clamped curve =
      alpha < 0.5 ? next_to_zero(alpha, theta, delta) : next_to_one(alpha, theta, delta);
  G1Chain answer;
  answer.chain.start = {{0, 0}, -angles.chord_angle};
  for (int i = 0; i < 2; ++i) {
    Piece piece = curve.pieces[reversed ? 1 - i : i];
    piece.curvature_start *= sign;
    piece.curvature_end *= sign;
    if (reversed) std::swap(piece.curvature_start, piece.curvature_end);
    if (piece.length > 0) answer.chain.pieces.push_back(piece);
  }
  answer.reversed = reversed;
  answer.lambda = detail::decay_integral(std::abs(1 - alpha), curve.range) / theta;
  answer.turning = angles.turning;
  answer.chord_angle = angles.chord_angle;
  answer.clamped = true;
  return answer;
}

/// Two parts that meet in the inflection, one of them straight to 280 digits: as end curvatures of
/// one piece they would not tell where the inflection lies.
std::optional<G1Chain> clamped_at_inflection(double from, double to, double alpha) {
  const auto arms = detail::solve_inflecting_arms(from, to, alpha);
  if (!arms) return {};
  G1Chain answer;
  answer.chain.pieces.assign(arms->begin(), arms->end());
  for (Piece& piece : answer.chain.pieces) {
    if (std::abs(piece.curvature_start) < 1e-280) piece.curvature_start = 0;
    if (std::abs(piece.curvature_end) < 1e-280) piece.curvature_end = 0;
  }
  const auto& [first, last] = *arms;
  answer.reversed = std::abs(first.curvature_start) < std::abs(last.curvature_end);
  answer.lambda = lambda_of(answer.reversed ? last : first);
  answer.turning = to - from;
  answer.chord_angle = -from;
  answer.clamped = true;
  return answer;
}

G1Chain chain_of(const SegmentSolution& s) {
  return {lac::chain_of(s.segment), s.reversed, s.lambda, s.turning, s.chord_angle, false};
}

/// The chain of unit chord moved to its place.
G1Chain placed(G1Chain answer, const core::Pose2& start, double chord) {
  answer.chain.start = start;
  for (Piece& piece : answer.chain.pieces) {
    piece.length *= chord;
    piece.curvature_start /= chord;
    piece.curvature_end /= chord;
  }
  return answer;
}

}  // namespace

core::Result<G1Chain> solve_g1_chain(const HandleAngles& angles, double alpha) {
  const auto one = solve_g1(angles, alpha);
  if (one) return chain_of(*one);
  if (std::abs(angles.turning) < core::kPi - 1e-15) {
    if (auto answer = clamped(angles, alpha)) return *std::move(answer);
  }
  return std::unexpected(one.error());
}

core::Result<G1Chain> solve_g1_chain(core::Point2 p0, core::Point2 p1, core::Point2 p2,
                                     double alpha) {
  const auto one = solve_g1(p0, p1, p2, alpha);
  if (one) return chain_of(*one);
  const auto angles = handle_angles(p0, p1, p2);
  if (angles && std::abs(angles->turning) < core::kPi - 1e-15) {
    if (auto answer = clamped(*angles, alpha))
      return placed(*std::move(answer), {p0, angles->direction}, angles->chord);
  }
  return std::unexpected(one.error());
}

core::Result<G1Chain> solve_g1_directions_chain(const core::Pose2& start, const core::Pose2& end,
                                                double alpha) {
  const core::Vector2 across = end.position - start.position;
  const double chord = norm(across);
  if (may_be_far(alpha) && chord > 0) {
    const double axis = core::direction_of(across);
    const double from = core::wrap_angle(start.direction - axis);
    const double to = core::wrap_angle(end.direction - axis);
    const double least = std::max(kFar, detail::kLargestRange - std::abs(std::log(chord)));
    if (auto answer = clamped({to - from, -from, 1, from}, alpha, least))
      return placed(*std::move(answer), start, chord);
  }
  const auto one = solve_g1_directions(start, end, alpha);
  if (one) return chain_of(*one);
  if (may_be_far(alpha) && alpha < 0 && chord > 0) {
    const double axis = core::direction_of(across);
    const double from = core::wrap_angle(start.direction - axis);
    const double to = core::wrap_angle(end.direction - axis);
    if (auto answer = clamped_at_inflection(from, to, alpha))
      return placed(*std::move(answer), start, chord);
  }
  return std::unexpected(one.error());
}

}  // namespace keyline::lac
