#include "keyline/classa/edit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keyline/classa/plane_of.h"
#include "keyline/classa/space_reading.h"
#include "keyline/core/angle.h"
#include "keyline/core/text.h"

namespace keyline::classa {

using core::ErrorCode;
using core::fail;
using core::Point2;
using core::Vector2;

namespace {

constexpr core::Interval kScales = {1e-3, 1e3};

/// A place of the plane with the chord that goes with it.
struct Station {
  ControlMatrix matrix;  // alpha >= 0
  Vector2 chord;
};

/// The reading mirrored where needed so that the curve turns left.
struct Bench {
  CurveReading reading;
  double side = 1;  // -1: turns right
  int degree = 3;

  const EnergyConditions& conditions() const { return reading.conditions; }
  /// Angle from the start tangent, positive to the side the curve turns to, in [0, 2 pi) but for
  /// a few degrees to the other side.
  double angle_of(Vector2 chord) const {
    const double angle = side * core::angle_between(conditions().tangent, chord);
    return angle < -0.3 ? angle + 2 * core::kPi : angle;
  }
};

/// A one-matrix curve from the start along the tangent; `beta` times the tangent is its first edge.
std::vector<Point2> along_tangent(const Bench& b, const ControlMatrix& m, double beta) {
  const MatrixCurve c{
      b.reading.control.front(), b.conditions().tangent, beta, {b.side * m.alpha, m.s}, b.degree};
  return to_bezier(c).control;
}

/// The one-matrix curve that ends at the chord's end, whatever its tangent.
std::vector<Point2> between_ends(const Bench& b, const ControlMatrix& m, Vector2 chord) {
  const Vector2 reach = end_in_frame({b.side * m.alpha, m.s}, b.degree);
  const double squared = dot(reach, reach);
  const Vector2 edge{dot(reach, chord) / squared, cross(reach, chord) / squared};
  const MatrixCurve c{b.reading.control.front(), edge, 1, {b.side * m.alpha, m.s}, b.degree};
  std::vector<Point2> control = to_bezier(c).control;
  control.back() = b.reading.control.front() + chord;
  return control;
}

/// Start and tangent kept, the end as near to the chord's end as the tangent's ray allows.
std::vector<Point2> from_start(const Bench& b, const ControlMatrix& m, Vector2 chord) {
  const double off = end_angle(m, b.degree) - b.angle_of(chord);
  const double length = std::cos(off) > 0.1 ? norm(chord) * std::cos(off) : norm(chord);
  const double unit = norm(b.conditions().tangent) * norm(end_in_frame(m, b.degree));
  return along_tangent(b, m, length / unit);
}

std::vector<Point2> make(const Bench& b, const Station& at, Hold hold) {
  if (hold == Hold::start) return from_start(b, at.matrix, at.chord);
  return between_ends(b, at.matrix, at.chord);
}

/// Which winding of the allowed end the end angle belongs to: the angle nearest to it.
double angle_near(const Bench& b, Vector2 chord, double near) {
  const double angle = b.angle_of(chord);
  return angle + 2 * core::kPi * std::round((near - angle) / (2 * core::kPi));
}

/// The place with this alpha whose curve along the tangent meets the chord's end; end_angle is
/// solved on the side of `near`.
Station station_at(const Bench& b, double alpha, Vector2 chord, double angle) {
  return {{alpha, scale_at_end_angle(alpha, angle, b.degree, kScales)}, chord};
}

bool meets(const Bench& b, const Station& at, double angle) {
  return std::abs(end_angle(at.matrix, b.degree) - angle) < 1e-9;
}

/// The place nearest to the target among those whose curve keeps the tangent and ends there, within
/// the end tolerance where one is given.
core::Result<Station> nearest_station(const Bench& b, const ControlMatrix& target,
                                      const CavOptions& o) {
  const Vector2 chord = b.conditions().chord;
  const double slack = std::min(o.end_tolerance.value_or(0) / norm(chord), 1.0);
  const double middle = angle_near(b, chord, end_angle(target, b.degree));
  const double off = end_angle(target, b.degree) - middle;
  const double turn = std::clamp(off, -std::asin(slack), std::asin(slack));
  // The nearest end on the ray in that direction.
  const Vector2 end = std::cos(turn) * core::rotate_ccw(chord, b.side * turn);
  if (turn == off) return Station{target, end};
  Station best;
  double least = HUGE_VAL;
  const auto probe = [&](double alpha) {
    const Station at = station_at(b, alpha, end, middle + turn);
    const double distance = plane_distance(at.matrix, target);
    if (!contains(o.s, at.matrix.s) || !meets(b, at, middle + turn) || distance >= least) return;
    best = at;
    least = distance;
  };
  constexpr int kSteps = 256;
  for (int i = 0; i <= kSteps; ++i) probe(o.alpha_max * i / kSteps);
  for (double step = o.alpha_max / kSteps; step > 1e-12 && std::isfinite(least); step /= 2)
    for (const double side : {-1.0, 1.0})
      probe(std::clamp(best.matrix.alpha + side * step, 0.0, o.alpha_max));
  if (!std::isfinite(least))
    return fail(ErrorCode::undrawable,
                "no curve of degree " + std::to_string(b.degree) +
                    " with one matrix keeps the start tangent and the ends",
                "hold the ends or the start alone, or raise the degree", "target");
  return best;
}

core::Result<Station> destination(const Bench& b, const EditOptions& o, const CurveValue& before) {
  if (!o.target) {
    if (!before.minimum)
      return fail(ErrorCode::undrawable, before.no_minimum, "give a target by hand", "curve");
    return Station{{before.minimum->alpha, before.minimum->s}, before.minimum->chord};
  }
  const ControlMatrix& t = *o.target;
  if (!(t.alpha >= 0 && t.alpha <= o.cav.alpha_max))
    return fail(ErrorCode::bad_input, "the target's alpha has to lie between 0 and alpha_max",
                "give radians up to " + core::number_text(o.cav.alpha_max, 6), "target");
  if (!contains(o.cav.s, t.s))
    return fail(ErrorCode::bad_input, "the target's s lies outside the range of s",
                "give a number from " + core::number_text(o.cav.s.low, 6) + " to " +
                    core::number_text(o.cav.s.high, 6),
                "target");
  if (o.hold == Hold::ends_and_tangent) return nearest_station(b, t, o.cav);
  return Station{t, b.conditions().chord};
}

/// The place a share of the way from the given one to the destination; empty where no s meets the
/// end there, which happens only to curves that wind.
std::optional<Station> between(const Bench& b, const Station& from, const Station& to, double u,
                               Hold hold) {
  const Station at{{std::lerp(from.matrix.alpha, to.matrix.alpha, u),
                    from.matrix.s * std::pow(to.matrix.s / from.matrix.s, u)},
                   (1 - u) * from.chord + u * to.chord};
  if (hold != Hold::ends_and_tangent || u == 0 || u == 1) return at;
  const double angle = angle_near(
      b, at.chord, std::lerp(end_angle(from.matrix, b.degree), end_angle(to.matrix, b.degree), u));
  const Station solved = station_at(b, at.matrix.alpha, at.chord, angle);
  if (!meets(b, solved, angle)) return std::nullopt;
  return solved;
}

std::vector<Point2> blend(const std::vector<Point2>& a, const std::vector<Point2>& b, double u) {
  std::vector<Point2> points;
  for (std::size_t i = 0; i < a.size(); ++i) points.push_back(a[i] + u * (b[i] - a[i]));
  return points;
}

/// Slides and notes the way; the control points in the direction of reading.
std::vector<Point2> slide(const Bench& b, const Station& to, const EditOptions& o,
                          std::vector<Point2>& path) {
  const Hold hold = o.target ? o.hold : Hold::ends_and_tangent;
  const MatrixReading& m = b.reading.matrix;
  if (m.type != 3) {
    path = {{to.matrix.alpha, to.matrix.s}};
    return blend(b.reading.control, make(b, to, hold), o.amount);
  }
  const Station from{{std::abs(m.matrix.alpha), m.matrix.s}, b.conditions().chord};
  constexpr int kPathSteps = 32;
  bool whole = true;
  for (int i = 0; i <= kPathSteps; ++i) {
    const auto at = between(b, from, to, i / static_cast<double>(kPathSteps), hold);
    whole = whole && at;
    if (at) path.push_back({at->matrix.alpha, at->matrix.s});
  }
  if (o.amount == 0) return b.reading.control;
  const auto at = between(b, from, to, o.amount, hold);
  if (!whole || !at) return blend(b.reading.control, make(b, to, hold), o.amount);
  return make(b, *at, hold);
}

}  // namespace

core::Result<EditResult> edit(const curve::Bezier2& c, const EditOptions& options) {
  if (!(options.amount >= 0 && options.amount <= 1))
    return fail(ErrorCode::bad_input, "the amount has to lie between 0 and 1", {}, "amount");
  auto before = cav(c, options.cav);
  if (!before) return std::unexpected(std::move(before.error()));
  auto reading = read_curve(c, options.cav);
  if (!reading) return std::unexpected(std::move(reading.error()));
  EditResult result{c, *before, *before, {}, {}};
  if (curve::degree(c) < 2) return result;  // straight already, and nothing to move
  const Bench bench{std::move(*reading), before->left ? 1.0 : -1.0, curve::degree(c)};
  const auto to = destination(bench, options, *before);
  if (!to) return std::unexpected(to.error());
  result.target = to->matrix;
  result.curve.control = slide(bench, *to, options, result.path);
  if (before->reversed) std::reverse(result.curve.control.begin(), result.curve.control.end());
  CavOptions again = options.cav;
  again.minimum = before->minimum;
  auto after = cav(result.curve, again);
  if (!after) return std::unexpected(std::move(after.error()));
  result.after = std::move(*after);
  return result;
}

namespace {

/// A curve that lies in no plane slides by its control points to the plane curve of its conditions.
core::Result<SpaceEditResult> edit_off_plane(const curve::Bezier3& c, const EditOptions& options) {
  auto before = cav(c, options.cav);
  if (!before) return std::unexpected(std::move(before.error()));
  const detail::SpaceReading reading = detail::read_in_space(c.control, options.cav);
  const Bench bench{{{core::Point2{}}, false, {}, reading.conditions}, 1, curve::degree(c)};
  const auto to = destination(bench, options, *before);
  if (!to) return std::unexpected(to.error());
  SpaceEditResult result;
  result.flat.curve.control =
      make(bench, *to, options.target ? options.hold : Hold::ends_and_tangent);
  result.flat.target = to->matrix;
  result.flat.path = {{to->matrix.alpha, to->matrix.s}};
  for (std::size_t i = 0; i < c.control.size(); ++i) {
    const core::Point3 from = reading.control[i];
    const core::Point3 there = reading.lifted(result.flat.curve.control[i]);
    result.curve.control.push_back(from + options.amount * (there - from));
  }
  if (reading.reversed) std::reverse(result.curve.control.begin(), result.curve.control.end());
  CavOptions again = options.cav;
  again.minimum = before->minimum;
  auto after = cav(result.curve, again);
  if (!after) return std::unexpected(std::move(after.error()));
  result.flat.before = std::move(*before);
  result.flat.after = std::move(*after);
  return result;
}

}  // namespace

core::Result<SpaceEditResult> edit(const curve::Bezier3& c, const EditOptions& options) {
  if (!(options.amount >= 0 && options.amount <= 1))
    return fail(ErrorCode::bad_input, "the amount has to lie between 0 and 1", {}, "amount");
  if (auto sound = validate(c); !sound) return std::unexpected(sound.error());
  if (is_rational(c))
    return fail(ErrorCode::unsupported, "a rational curve has no control matrix",
                "approximate it by a polynomial Bezier curve", "weights");
  const detail::Flattened flat = detail::flatten(c.control);
  if (flat.off_plane > options.cav.tolerance * flat.size) return edit_off_plane(c, options);
  auto edited = edit(curve::Bezier2{flat.points, {}}, options);
  if (!edited) return std::unexpected(std::move(edited.error()));
  SpaceEditResult result;
  const auto& control = edited->curve.control;
  for (std::size_t i = 0; i < control.size(); ++i)
    result.curve.control.push_back(control[i] == flat.points[i] ? c.control[i]
                                                                : flat.lifted(control[i]));
  result.flat = std::move(*edited);
  return result;
}

}  // namespace keyline::classa
