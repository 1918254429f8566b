#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/lac/hermite/one_signed.h"
#include "keyline/lac/segment/arm.h"
#include "keyline/lac/segment/lambda.h"
#include "keyline/lac/segment/slope.h"
#include "keyline/numeric/roots.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Pose2;
using core::Vector2;

/// Curves of slope alpha < 0 and given net turning that bend right before and left behind their
/// inflection, one for each value of the smaller of the two angles. A larger one lowers the tangent
/// everywhere inside, and with it the chord. The angle enters by its logarithm: for slopes close to
/// 0 an arm of any length may turn by less than a double can tell.
class InflectingFamily {
 public:
  InflectingFamily(double alpha, double from, double to)
      : alpha_(alpha), power_(1 - 1 / alpha), from_(from), turning_(to - from) {}

  /// Logarithm of an angle that cannot be told from 0, the turning or else `scale` given.
  double least(double scale) const {
    return std::log(turning_ == 0 ? scale : std::abs(turning_)) - 40 * power_;
  }

  /// Share of the length of the arm that turns less; arms go as the roots of their angles.
  double minor_share(double log_minor) const {
    const double major = std::exp(log_minor) + std::abs(turning_);
    return 1 / (1 + std::exp((std::log(major) - log_minor) / power_));
  }

  /// Chord for unit length, the end tangents being as wanted.
  Vector2 chord(double log_minor) const {
    const double minor = std::exp(log_minor);
    const double share = minor_share(log_minor);
    const Vector2 v = share * arm(minor) + (1 - share) * arm(minor + std::abs(turning_));
    return core::rotate_ccw(v, from_ - minor - std::max(0.0, -turning_));
  }

  /// Angle of the chord, zero being wanted.
  double chord_angle(double log_minor) const {
    const double angle = core::direction_of(chord(log_minor));
    return std::abs(angle) < 4e-16 ? 0 : angle;
  }

  /// The curve's two arms, from the start to the inflection and on to the end.
  std::array<Piece, 2> arms(double log_minor, double length) const {
    const double minor = std::exp(log_minor);
    const double share = minor_share(log_minor);
    const double minor_bend = minor * power_ / (share * length);
    const double major_bend = (minor + std::abs(turning_)) * power_ / ((1 - share) * length);
    const bool right_minor = turning_ >= 0;
    const double before = right_minor ? share : 1 - share;
    const double after = right_minor ? 1 - share : share;
    return {Piece{alpha_, before * length, right_minor ? -minor_bend : -major_bend, 0},
            Piece{alpha_, after * length, 0, right_minor ? major_bend : minor_bend}};
  }

 private:
  /// Of unit length from the inflection, in the frame of its tangent.
  Vector2 arm(double turned) const {
    if (turned < detail::kLargestSeriesTurning) return detail::inflection_arm(turned, power_).chord;
    detail::Arm whole;
    whole.a = -alpha_;
    whole.b = 1 - alpha_;
    whole.range = std::numeric_limits<double>::infinity();
    whole.length = 1;
    whole.turning = -turned;
    whole.arc_total = 1 / whole.a;
    whole.angle_total = 1 / whole.b;
    return core::rotate_ccw(detail::arm_vector(whole, whole.range), turned);
  }

  double alpha_;
  double power_;  ///< of the distance from the inflection with which the tangent turns
  double from_;
  double turning_;
};

/// The least angle (its logarithm) at which the chord lies along the x axis, followed without
/// jumping over the cut at +-pi: the curve of fewest windings.
std::optional<double> search_minor_angle(const InflectingFamily& family, double from, double to) {
  const double step = std::min(0.25 * (std::abs(from) + std::abs(to)), 0.4);
  double before = family.least(step);
  double angle = family.chord_angle(before);
  if (angle < 0 && from + to > 0) angle += 2 * core::kPi;  // the chord has to come down
  if (angle == 0) return before;
  for (int i = 1; i <= 200; ++i) {
    const double here = std::log(i * step);
    const double next = angle + core::wrap_angle(family.chord_angle(here) - angle);
    if (std::isnan(next)) return std::nullopt;
    if (next <= 0)
      return numeric::bracketed_root([&](double x) { return family.chord_angle(x); }, before, here,
                                     0);
    before = here;
    angle = next;
  }
  return std::nullopt;
}

/// For a chord of length 1 along x; alpha < 0: the arms on both sides of the inflection.
std::optional<std::array<Piece, 2>> inflecting_arms(double from, double to, double alpha) {
  // Mirrored, so that the chord of the circular arc lies above the one wanted.
  const bool mirror = from + to < 0;
  const double sign = mirror ? -1 : 1;
  const InflectingFamily family(alpha, sign * from, sign * to);
  const auto minor = search_minor_angle(family, sign * from, sign * to);
  if (!minor) return std::nullopt;
  const double length = 1 / norm(family.chord(*minor));
  if (!(length < 1e6)) return std::nullopt;
  auto arms = family.arms(*minor, length);
  if (mirror)
    for (Piece& arm : arms) arm = mirrored(arm);
  return arms;
}

/// Whether the end curvatures tell where the inflection lies.
bool within_doubles(const std::array<Piece, 2>& arms) {
  return std::abs(arms[0].curvature_start) > 1e-280 && std::abs(arms[1].curvature_end) > 1e-280;
}

std::optional<SegmentSolution> solve_inflecting(double from, double to, double alpha) {
  const auto arms = inflecting_arms(from, to, alpha);
  if (!arms || !within_doubles(*arms)) return std::nullopt;
  SegmentSolution solution;
  solution.segment = {{{0, 0}, from},
                      alpha,
                      (*arms)[0].length + (*arms)[1].length,
                      (*arms)[0].curvature_start,
                      (*arms)[1].curvature_end};
  const Segment& s = solution.segment;
  solution.reversed = std::abs(s.curvature_start) < std::abs(s.curvature_end);
  solution.lambda = lambda_of(piece_of(s));
  solution.turning = to - from;
  solution.chord_angle = -from;
  return solution;
}

std::unexpected<core::Failure> needs_inflection(double from, double to) {
  std::string hint = "use a slope below 0";
  for (const double slope : {-0.01, -0.1, -1.0}) {
    if (!solve_inflecting(from, to, slope)) continue;
    hint = "use a slope below 0, such as " + core::number_text(slope, 2);
    break;
  }
  return core::fail(ErrorCode::undrawable,
                    "these directions need an inflection, which a slope of 0 or more does not have",
                    hint);
}

core::Result<SegmentSolution> solve_unit(double from, double to, double alpha) {
  if (from == 0 && to == 0) {
    SegmentSolution line;
    line.segment = {{}, alpha, 1, 0, 0};
    return line;
  }
  const bool bends_one_way = (from < 0 && to > 0) || (from > 0 && to < 0);
  if (bends_one_way) {
    auto solution = detail::solve_one_signed({to - from, -from, 1, from}, alpha);
    if (solution || alpha >= 0) return solution;
  } else if (alpha >= 0) {
    return needs_inflection(from, to);
  }
  if (auto solution = solve_inflecting(from, to, alpha)) return *solution;
  return core::fail(ErrorCode::undrawable, "no curve of this slope without loops was found",
                    "turn the end directions towards the chord");
}

}  // namespace

std::optional<std::array<Piece, 2>> detail::solve_inflecting_arms(double from, double to,
                                                                  double alpha) {
  return inflecting_arms(from, to, alpha);
}

core::Result<SegmentSolution> solve_g1_directions(const Pose2& start, const Pose2& end,
                                                  double alpha) {
  if (!is_slope(alpha)) {
    return core::fail(ErrorCode::bad_input, kSlopeRule, {}, "alpha");
  }
  if (!is_finite(start.position) || !is_finite(end.position) || !std::isfinite(start.direction) ||
      !std::isfinite(end.direction)) {
    return core::fail(ErrorCode::bad_input, "a position or direction is not finite");
  }
  const Vector2 chord = end.position - start.position;
  const double length = norm(chord);
  if (!(length > 0)) {
    return core::fail(ErrorCode::bad_input, "start and end point coincide", "move one of them",
                      "end");
  }
  const double axis = core::direction_of(chord);
  auto solution = solve_unit(core::wrap_angle(start.direction - axis),
                             core::wrap_angle(end.direction - axis), alpha);
  if (!solution) return solution;
  Segment& s = solution->segment;
  s.start = start;
  s.length *= length;
  s.curvature_start /= length;
  s.curvature_end /= length;
  return solution;
}

}  // namespace keyline::lac
