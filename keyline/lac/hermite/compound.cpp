#include "keyline/lac/hermite/compound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/lac/hermite/compound_family.h"
#include "keyline/lac/segment/slope.h"
#include "keyline/numeric/roots.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Vector2;
using detail::CompoundFamily;

bool is_valid(const CompoundRhythm& r) {
  return is_slope(r.alpha0) && is_slope(r.alpha1) && r.turning_share > 0 && r.turning_share < 1;
}

std::string number(double x) { return core::number_text(x, 9); }

/// The rhythm on the way from the given one to a full region (sharp slope at most 1, flat one in
/// [0, 1]) that first holds the chord angle psi >= theta/2.
CompoundRhythm nearest_rhythm(const CompoundRhythm& r, double theta, double psi) {
  const double by0 = std::min(r.alpha0, 1.0) - r.alpha0;
  const double by1 = std::clamp(r.alpha1, 0.0, 1.0) - r.alpha1;
  const auto moved = [&](double way) {
    return CompoundRhythm{r.alpha0 + way * by0, r.alpha1 + way * by1, r.turning_share};
  };
  const auto excess = [&](double way) {
    return CompoundFamily(moved(way), theta).limit_chord_angle() - psi;
  };
  // As of one slope: next to the full region borders are reached only in the limit.
  const double last = 1 - 1.0 / 16 / std::max(std::abs(by0), std::abs(by1));
  if (!(last > 0 && excess(last) > 0)) return moved(1);
  const auto root = numeric::bracketed_root(excess, 0, last, 1e-9);
  return moved(root ? *root + 1e-6 * (1 - *root) : last);
}

std::unexpected<core::Failure> undrawable(const CompoundRhythm& r, double theta, double psi) {
  const core::Interval region = drawable_region(r, theta);
  const double margin = 1e-6 * (region.high - region.low);
  const double nearest = std::clamp(psi, region.low + margin, region.high - margin);
  const CompoundRhythm other = nearest_rhythm(r, theta, std::max(psi, theta - psi));
  return core::fail(ErrorCode::undrawable,
                    "no compound curve of slopes " + number(r.alpha0) + ", " + number(r.alpha1) +
                        " turning by " + number(theta) + " rad has its chord at " + number(psi) +
                        " rad from the start tangent; it must lie between " + number(region.low) +
                        " and " + number(region.high),
                    "nearest chord angle " + number(nearest) + " rad, or slopes " +
                        number(other.alpha0) + ", " + number(other.alpha1));
}

core::Result<void> check(const HandleAngles& angles, const CompoundRhythm& rhythm) {
  if (!is_slope(rhythm.alpha0) || !is_slope(rhythm.alpha1)) {
    return core::fail(ErrorCode::bad_input, "both slopes must lie between -1e100 and 1e100");
  }
  if (!is_valid(rhythm)) {
    return core::fail(ErrorCode::bad_input, "the share of the turning must lie between 0 and 1");
  }
  if (std::isnan(angles.turning) || std::isnan(angles.chord_angle)) {
    return core::fail(ErrorCode::bad_input, "an angle is not a number");
  }
  const double theta = std::abs(angles.turning);
  const double psi = angles.turning < 0 ? -angles.chord_angle : angles.chord_angle;
  const bool straight = theta == 0 && psi == 0;
  if (!straight && !(theta < core::kPi - 1e-15 && psi > 0 && psi < theta)) {
    return core::fail(ErrorCode::undrawable,
                      "the middle point does not lie between the ends: the curve would turn back",
                      "put it nearer to the chord's middle");
  }
  return {};
}

/// e^x, or the largest double.
double bounded_exp(double x) { return std::min(std::exp(x), std::numeric_limits<double>::max()); }

/// The chain for a chord of length 1 along x, turning left, radius growing.
void set_curve(CompoundSolution& solution, const CompoundFamily& family, double q) {
  const detail::CompoundShape s = family.shape(q);
  detail::CompoundPieces p = family.pieces(q);
  solution.clamped = p.clamped;
  solution.joint_piece = p.sharp.size();
  solution.chain.pieces = std::move(p.sharp);
  solution.chain.pieces.insert(solution.chain.pieces.end(), p.flat.begin(), p.flat.end());
  const double at_start = std::isinf(s.q0) || family.sharp().alpha > 1 ? 0 : s.q0;
  solution.lambda0 = bounded_exp(s.log_rate + family.sharp().angle * at_start);
  solution.lambda1 = bounded_exp(s.log_rate - family.flat().angle * at_start);
}

/// The range of the leading side at the wanted chord angle, or why there is none. Where rounding
/// hides what lies between the farthest curve that can be told and the border, that curve.
detail::ChordSolution search(const CompoundFamily& family, double wanted) {
  const Vector2 axis = core::unit_vector(wanted);
  auto found =
      detail::search_chord(family.setup(wanted), [&](double q) { return family.sample(q, axis); });
  if (found.status != detail::ChordStatus::beyond_precision) return found;
  if (std::abs(family.sample(found.range, axis).miss) < 1e-14)
    found.status = detail::ChordStatus::solved;
  return found;
}

/// Two arcs of one circle (chord angle half the turning) or a straight line.
void set_circle(CompoundSolution& solution, const CompoundRhythm& r, double theta) {
  const double h = theta / 2;
  const double length = h == 0 ? 1 : h / std::sin(h);
  const double k = theta / length;
  solution.chain.pieces = {{r.alpha0, length * r.turning_share, k, k},
                           {r.alpha1, length * (1 - r.turning_share), k, k}};
}

}  // namespace

core::Interval drawable_region(const CompoundRhythm& rhythm, double theta) {
  if (!is_valid(rhythm) || !(theta > 0 && theta < core::kPi)) {
    throw core::InvalidInput("drawable_region: a bad rhythm, or theta outside (0, pi)");
  }
  const double limit = CompoundFamily(rhythm, theta).limit_chord_angle();
  return {theta - limit, limit};
}

bool border_is_drawn(const CompoundRhythm& rhythm, double theta) {
  if (!is_valid(rhythm) || !(theta > 0 && theta < core::kPi)) {
    throw core::InvalidInput("border_is_drawn: a bad rhythm, or theta outside (0, pi)");
  }
  return CompoundFamily(rhythm, theta).limit_drawn();
}

core::Result<CompoundSolution> solve_compound(const HandleAngles& angles,
                                              const CompoundRhythm& rhythm) {
  if (const auto checked = check(angles, rhythm); !checked) return std::unexpected(checked.error());
  const double sign = angles.turning < 0 ? -1 : 1;
  const double theta = sign * angles.turning;
  const double psi = sign * angles.chord_angle;
  CompoundSolution solution;
  solution.turning = angles.turning;
  solution.chord_angle = angles.chord_angle;
  solution.reversed = psi < theta / 2;
  const double wanted = solution.reversed ? theta - psi : psi;
  if (wanted == theta / 2) {
    set_circle(solution, rhythm, theta);
  } else {
    const CompoundFamily family(rhythm, theta);
    const detail::ChordSolution found = search(family, wanted);
    if (found.status == detail::ChordStatus::beyond_region) return undrawable(rhythm, theta, psi);
    if (found.status == detail::ChordStatus::beyond_precision) {
      return core::fail(ErrorCode::undrawable,
                        "the curvatures would differ by more than double precision holds",
                        "move the slopes away from 0 and 1");
    }
    set_curve(solution, family, found.range);
    solution.iterations = found.iterations;
  }
  Chain& chain = solution.chain;
  if (solution.reversed) {
    for (Piece& piece : chain.pieces) piece = mirrored(reversed(piece));
    std::reverse(chain.pieces.begin(), chain.pieces.end());
    solution.joint_piece = chain.pieces.size() - solution.joint_piece;
  }
  if (sign < 0) {
    for (Piece& piece : chain.pieces) piece = mirrored(piece);
  }
  chain.start = {{0, 0}, -angles.chord_angle};
  solution.joint = segment_at(chain, solution.joint_piece).start.position;
  return solution;
}

core::Result<CompoundSolution> solve_compound(core::Point2 p0, core::Point2 p1, core::Point2 p2,
                                              const CompoundRhythm& rhythm) {
  const auto angles = handle_angles(p0, p1, p2);
  if (!angles) return std::unexpected(angles.error());
  auto solution = solve_compound(*angles, rhythm);
  if (!solution) return solution;
  Chain& chain = solution->chain;
  for (Piece& piece : chain.pieces) {
    piece.length *= angles->chord;
    piece.curvature_start /= angles->chord;
    piece.curvature_end /= angles->chord;
  }
  chain.start = {p0, angles->direction};
  solution->joint = segment_at(chain, solution->joint_piece).start.position;
  return solution;
}

}  // namespace keyline::lac
