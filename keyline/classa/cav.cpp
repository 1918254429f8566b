#include "keyline/classa/cav.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keyline/classa/farin.h"
#include "keyline/classa/plane_of.h"
#include "keyline/classa/space_reading.h"
#include "keyline/classa/strain_energy.h"
#include "keyline/core/angle.h"

namespace keyline::classa {

using core::ErrorCode;
using core::fail;
using core::Point2;

namespace {

core::Result<void> check(const CavOptions& o) {
  if (!(o.alpha_max > 0 && o.alpha_max < core::kPi / 2))
    return fail(ErrorCode::bad_input, "alpha_max has to lie between 0 and pi/2",
                "give radians, for example 1.0982", "alpha_max");
  if (!(o.tolerance >= 0 && std::isfinite(o.tolerance)))
    return fail(ErrorCode::bad_input, "the tolerance is negative or not finite", {}, "tolerance");
  if (o.end_tolerance && !(*o.end_tolerance >= 0 && std::isfinite(*o.end_tolerance)))
    return fail(ErrorCode::bad_input, "the end tolerance is negative or not finite",
                "give a length of 0 or more", "end_tolerance");
  return {};
}

template <class Points>
bool all_coincide(const Points& points) {
  return std::all_of(points.begin(), points.end(),
                     [&](const auto& p) { return distance(p, points.front()) == 0; });
}

EnergyConditions conditions_of(std::span<const Point2> control, const MatrixReading& reading,
                               const CavOptions& o) {
  EnergyConditions c;
  c.tangent = leaving_edge(control);
  c.chord = control.back() - control.front();
  c.degree = std::max<int>(static_cast<int>(control.size()) - 1, 2);
  c.end_tolerance = o.end_tolerance.value_or(0.01 * norm(c.chord));
  c.alpha = o.alpha.value_or(core::Interval{0, o.alpha_max});
  c.s = o.s;
  const bool falls = o.direction == Direction::as_given && edges_shrink(control);
  c.branch = o.branch.value_or(falls ? Branch::falling : Branch::growing);
  if (reading.type != 3 || reading.matrix.alpha != 0) c.left = reading.left;
  if (reading.type == 3) c.near_s = reading.matrix.s;
  return c;
}

/// Type and CAV of a curve with one matrix, its minimum known.
void place(CurveValue& value, const CavOptions& o) {
  const double distance = plane_distance(*value.matrix, {value.minimum->alpha, value.minimum->s});
  const ControlMatrix& m = *value.matrix;
  const double c = std::cos(m.alpha);
  // Literally s < 1 may belong to the branch of shrinking edges; read the growing way it may not.
  const bool class_a = is_class_a(m, o.tolerance) &&
                       (o.direction == Direction::as_given || m.s >= 1 / c - o.tolerance);
  if (class_a && distance <= o.tolerance) {
    value.type = 1;
    value.cav = 0;
  } else {
    value.type = class_a ? 2 : 3;
    value.cav = class_a ? distance : diagonals(o.alpha_max).boundary * (1 + distance);
  }
}

/// The minimum to measure from; what is wrong with tangent or chord is wrong with the points.
core::Result<EnergyMinimum> minimum_of(const EnergyConditions& conditions, const CavOptions& o) {
  if (o.minimum) return *o.minimum;
  auto minimum = minimum_energy(conditions);
  if (!minimum && (minimum.error().path == "tangent" || minimum.error().path == "chord"))
    minimum.error().path = "points";
  return minimum;
}

CurveReading read(std::vector<Point2> control, const CavOptions& o) {
  CurveReading r;
  r.control = std::move(control);
  r.reversed = o.direction == Direction::growing && edges_shrink(r.control);
  if (r.reversed) std::reverse(r.control.begin(), r.control.end());
  r.matrix = read_matrix(r.control, o.alpha_max, o.tolerance);
  r.conditions = conditions_of(r.control, r.matrix, o);
  return r;
}

core::Result<CurveValue> value_of(const curve::Bezier2& given, const CavOptions& o) {
  const CurveReading r = read(given.control, o);
  CurveValue value;
  value.degree = curve::degree(given);
  value.energy = strain_energy(given);
  value.monotone = curve::certify_monotone_curvature(given);
  value.reversed = r.reversed;
  value.type = r.matrix.type;
  value.left = r.matrix.left;
  if (value.type == 3)
    value.matrix = ControlMatrix{std::abs(r.matrix.matrix.alpha), r.matrix.matrix.s};
  auto minimum = minimum_of(r.conditions, o);
  if (minimum) {
    value.minimum = *minimum;
  } else if (value.type == 3 || minimum.error().code == ErrorCode::bad_input) {
    return std::unexpected(std::move(minimum.error()));
  } else {
    value.no_minimum = minimum.error().message;
  }
  const Diagonals d = diagonals(o.alpha_max);
  if (value.type == 3)
    place(value, o);
  else
    value.cav = std::pow(d.boundary * d.plane, value.type - 2);
  return value;
}

/// Type 5: a curve in no plane has no place in this one; its minimum lies in the plane of its start
/// tangent and its chord.
core::Result<CurveValue> value_in_space(const curve::Bezier3& given, const CavOptions& o) {
  const detail::SpaceReading r = detail::read_in_space(given.control, o);
  const Diagonals d = diagonals(o.alpha_max);
  CurveValue value;
  value.degree = curve::degree(given);
  value.cav = std::pow(d.boundary * d.plane, 3);
  value.energy = strain_energy(given);
  value.monotone = certify_monotone_curvature(given);
  value.reversed = r.reversed;
  auto minimum = minimum_of(r.conditions, o);
  if (minimum)
    value.minimum = *minimum;
  else if (minimum.error().code == ErrorCode::bad_input)
    return std::unexpected(std::move(minimum.error()));
  else
    value.no_minimum = minimum.error().message;
  return value;
}

/// A value of either curve type once numbers, weights and extent are in order.
template <class Curve>
core::Result<void> check_curve(const Curve& c, const CavOptions& options) {
  if (auto checked = check(options); !checked) return checked;
  if (auto checked = validate(c); !checked) return checked;
  if (is_rational(c))
    return fail(ErrorCode::unsupported, "a rational curve has no control matrix",
                "approximate it by a polynomial Bezier curve", "weights");
  if (all_coincide(c.control))
    return fail(ErrorCode::bad_input, "all control points coincide", "give a curve with a length",
                "points");
  return {};
}

}  // namespace

Diagonals diagonals(double alpha_max) {
  return {std::hypot(alpha_max, 1 / std::cos(alpha_max) - 1), std::hypot(alpha_max, 2)};
}

LargestValues largest_values(double alpha_max) {
  const Diagonals d = diagonals(alpha_max);
  // The boundary s = 1/cos(alpha) leaves the plane of Tab. 2 at s = 2.
  const double corner = std::min(alpha_max, std::acos(0.5));
  const double class_a = std::hypot(corner, 2 - 1);
  const double other = std::hypot(alpha_max, 2 - std::cos(alpha_max));
  return {class_a, d.boundary * (1 + other), std::pow(d.boundary * d.plane, 2),
          std::pow(d.boundary * d.plane, 3)};
}

MatrixReading read_matrix(std::span<const Point2> control, double alpha_max, double tolerance) {
  MatrixReading reading;
  double alpha = 0;
  double log_s = 0;
  bool on_plane = true;
  bool turns_left = false;
  bool turns_right = false;
  const auto all = ratios(control);
  for (const auto& r : all) {
    if (!r) {
      on_plane = false;
      continue;
    }
    alpha += r->alpha;
    log_s += std::log(r->s);
    turns_left = turns_left || r->alpha > tolerance;
    turns_right = turns_right || r->alpha < -tolerance;
    on_plane = on_plane && std::abs(r->alpha) <= alpha_max + tolerance;
  }
  reading.left = alpha >= 0;
  if (!on_plane || (turns_left && turns_right)) return reading;
  if (!all.empty()) reading.matrix = {alpha / all.size(), std::exp(log_s / all.size())};
  // Turning below rounding is none: the curve is straight.
  if (std::abs(reading.matrix.alpha) < 1e-13) reading.matrix.alpha = 0;
  const bool one = std::all_of(all.begin(), all.end(), [&](const auto& r) {
    return std::hypot(r->alpha - reading.matrix.alpha, r->s - reading.matrix.s) <=
           tolerance * std::max(1.0, reading.matrix.s);
  });
  reading.type = one ? 3 : 4;
  return reading;
}

core::Result<CurveReading> read_curve(const curve::Bezier2& c, const CavOptions& options) {
  if (auto checked = check_curve(c, options); !checked) return std::unexpected(checked.error());
  return read(c.control, options);
}

core::Result<CurveReading> read_curve(const curve::Bezier3& c, const CavOptions& options) {
  if (auto checked = check_curve(c, options); !checked) return std::unexpected(checked.error());
  detail::Flattened flat = detail::flatten(c.control);
  if (flat.off_plane <= options.tolerance * flat.size)
    return read_curve(curve::Bezier2{std::move(flat.points), {}}, options);
  const detail::SpaceReading r = detail::read_in_space(c.control, options);
  return CurveReading{{}, r.reversed, {}, r.conditions};
}

core::Result<CurveValue> cav(const curve::Bezier2& c, const CavOptions& options) {
  if (auto checked = check_curve(c, options); !checked) return std::unexpected(checked.error());
  return value_of(c, options);
}

core::Result<CurveValue> cav(std::span<const core::Point3> control, const CavOptions& options) {
  return cav(curve::Bezier3{{control.begin(), control.end()}, {}}, options);
}

core::Result<CurveValue> cav(const curve::Bezier3& c, const CavOptions& options) {
  if (auto checked = check_curve(c, options); !checked) return std::unexpected(checked.error());
  detail::Flattened flat = detail::flatten(c.control);
  if (flat.off_plane > options.tolerance * flat.size) return value_in_space(c, options);
  return value_of({std::move(flat.points), {}}, options);
}

core::Result<CurveValue> cav(const MatrixCurve& c, const CavOptions& options) {
  if (auto checked = validate(c); !checked) return std::unexpected(checked.error());
  auto value = cav(to_bezier(c), options);
  if (value && value->minimum && !value->reversed) value->minimum->beta *= c.beta;
  return value;
}

}  // namespace keyline::classa
