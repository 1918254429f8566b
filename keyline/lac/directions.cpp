#include <algorithm>
#include <cmath>
#include <optional>

#include "keyline/core/angle.h"
#include "keyline/lac/one_signed.h"
#include "keyline/numeric/power_mean.h"
#include "keyline/numeric/roots.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Pose2;
using core::Vector2;

/// Curves of slope alpha < 0, unit length and given turning, one for each start curvature. A larger
/// start curvature raises the tangent angle everywhere inside, and with it the chord's angle.
class InflectingFamily {
 public:
  InflectingFamily(double alpha, double from, double to)
      : alpha_(alpha), from_(from), turning_(to - from) {}

  /// The end curvature that goes with a start curvature; empty where the search fails.
  std::optional<double> end_curvature(double start) const {
    const auto excess = [&](double end) {
      const double e = numeric::signed_power_mean_integral(start, end, -alpha_, 1) - turning_;
      return std::abs(e) < 1e-16 * (std::abs(start) + std::abs(end)) ? 0 : e;
    };
    // The mean lies between the ends: the end is on the other side of the turning.
    const double side = start < turning_ ? 1 : -1;
    double reach = std::abs(start - turning_) + 1e-300;
    double near = turning_;
    double far = turning_ + side * reach;
    for (int i = 0; i < 200 && side * excess(far) < 0; ++i) {
      near = far;
      reach *= 2;
      far = turning_ + side * reach;
    }
    return numeric::bracketed_root(excess, std::min(near, far), std::max(near, far), 0);
  }

  /// The curve that starts with the given curvature.
  std::optional<Piece> piece(double start) const {
    const auto end = start == turning_ ? turning_ : end_curvature(start);
    if (!end) return std::nullopt;
    return Piece{alpha_, 1, start, *end};
  }

  /// Angle of the chord if the start tangent is at `from`: zero is wanted. NaN where there is none.
  double chord_angle(double start) const {
    const auto curve = piece(start);
    if (!curve) return std::nan("");
    const double angle = core::wrap_angle(from_ + core::direction_of(displacement(*curve, 1)));
    return std::abs(angle) < 4e-16 ? 0 : angle;
  }

 private:
  double alpha_;
  double from_;
  double turning_;
};

/// The start curvature nearest to the circular arc's at which the chord lies along the x axis.
std::optional<double> search_start_curvature(const InflectingFamily& family, double from,
                                             double to) {
  const double turning = to - from;
  double before = turning;
  double angle = core::wrap_angle((from + to) / 2);  // a circular arc's
  if (angle == 0) return before;
  const double side = angle > 0 ? -1 : 1;
  // For small angles a clothoid has -(4 from + 2 to): three times the sum away from the circle.
  const double step = std::max(0.75 * std::abs(from + to), 1e-3 * std::abs(angle));
  for (int i = 0; i < 120; ++i) {
    const double here = before + side * step;
    const double next = angle + core::wrap_angle(family.chord_angle(here) - angle);
    if (std::isnan(next)) return std::nullopt;
    if (side * next >= 0) {
      const double low = std::min(before, here);
      const double high = std::max(before, here);
      return numeric::bracketed_root([&](double k) { return family.chord_angle(k); }, low, high, 0);
    }
    before = here;
    angle = next;
  }
  return std::nullopt;
}

/// Lambda of the standard form at the end of larger curvature.
double lambda_of(const Piece& p) {
  const double k0 = std::abs(p.curvature_start);
  const double k1 = std::abs(p.curvature_end);
  const double sharp = std::max(k0, k1);
  return sharp == 0 ? 0 : std::abs(curvature_rate(p, k0 >= k1 ? 0 : 1)) / (sharp * sharp);
}

/// For a chord of length 1 along x; alpha < 0.
std::optional<SegmentSolution> solve_inflecting(double from, double to, double alpha) {
  const InflectingFamily family(alpha, from, to);
  const auto start = search_start_curvature(family, from, to);
  if (!start) return std::nullopt;
  const auto piece = family.piece(*start);
  if (!piece) return std::nullopt;
  const double length = 1 / norm(displacement(*piece, 1));
  if (!(length < 1e6)) return std::nullopt;
  SegmentSolution solution;
  solution.segment = {{{0, 0}, from},
                      alpha,
                      length,
                      piece->curvature_start / length,
                      piece->curvature_end / length};
  solution.reversed = std::abs(piece->curvature_start) < std::abs(piece->curvature_end);
  solution.lambda = lambda_of(piece_of(solution.segment));
  solution.turning = to - from;
  solution.chord_angle = -from;
  return solution;
}

std::unexpected<core::Failure> needs_inflection(double from, double to) {
  std::string hint = "use a slope below 0";
  for (const char* slope : {"-0.01", "-0.1", "-1"}) {
    if (!solve_inflecting(from, to, std::stod(slope))) continue;
    hint = std::string("use a slope below 0, such as ") + slope;
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

core::Result<SegmentSolution> solve_g1_directions(const Pose2& start, const Pose2& end,
                                                  double alpha) {
  if (!std::isfinite(alpha)) {
    return core::fail(ErrorCode::bad_input, "the slope alpha must be a finite number", {}, "alpha");
  }
  if (!is_finite(start.position) || !is_finite(end.position) || !std::isfinite(start.direction) ||
      !std::isfinite(end.direction)) {
    return core::fail(ErrorCode::bad_input, "a position or direction is not finite");
  }
  const Vector2 chord = end.position - start.position;
  const double length = norm(chord);
  if (!(length > 0)) {
    return core::fail(ErrorCode::bad_input, "start and end point coincide", "move one of them");
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
