#include "keyline/document/planar_edit.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/curve/arriving.h"
#include "keyline/curve/conversion.h"
#include "keyline/curve/view.h"
#include "keyline/document/cusped.h"
#include "keyline/document/smooth_members.h"

namespace keyline::document {
namespace {

using core::ErrorCode;
using core::fail;
using core::Point2;
using core::Result;
using core::Vector2;

constexpr int kChecks = 64;  // places of every smooth stretch where curvature is looked at

template <class Curve>
Curve part_of(const Curve& c, const core::Interval& t) {
  if constexpr (std::is_same_v<Curve, lac::Chain>) {
    return lac::part(c, t.low, t.high);
  } else if constexpr (std::is_same_v<Curve, curve::Polyline2>) {
    return subcurve(c, t.low, t.high);  // what is left has fewer edges, each as long in parameter
  } else {
    Curve rest = t.high < 1 ? split(c, t.high).first : c;
    return t.low > 0 ? split(rest, t.low / t.high).second : rest;
  }
}

Point2 image(Point2 p, const core::Pose2& axis) {
  const Vector2 along = core::unit_vector(axis.direction);
  const Vector2 v = p - axis.position;
  return axis.position + 2 * dot(v, along) * along - v;
}

lac::Chain image(lac::Chain chain, const core::Pose2& axis) {
  chain.start = {image(chain.start.position, axis), 2 * axis.direction - chain.start.direction};
  for (lac::Piece& piece : chain.pieces) {
    piece.curvature_start = -piece.curvature_start;
    piece.curvature_end = -piece.curvature_end;
  }
  return chain;
}
curve::Polyline2 image(curve::Polyline2 c, const core::Pose2& axis) {
  for (Point2& p : c.points) p = image(p, axis);
  return c;
}
template <class Curve>
Curve image(Curve c, const core::Pose2& axis) {
  for (Point2& p : c.control) p = image(p, axis);
  return c;
}

bool is_zero(const Vector2& v) { return v.x == 0 && v.y == 0; }

/// At a place where the parameter rests (two control points in one place): the point there, all
/// else from next to it, the direction continued from two places.
curve::Jet2 resting_jet(const PlacedCurve& c, double t, Point2 point) {
  constexpr double kBeside = 1e-5;
  const double inwards = t < 0.5 ? kBeside : -kBeside;
  curve::Jet2 beside = jet(c, t + inwards);
  const double near = curve::tangent_angle(beside);
  const double far = curve::tangent_angle(jet(c, t + 2 * inwards));
  beside.first = norm(beside.first) * core::unit_vector(near + core::wrap_angle(near - far));
  beside.point = point;
  return beside;
}

/// Places of a stretch to look at curvature, from inside its ends, where it may jump; farther from
/// one at which the parameter rests: nearest to that, curvature is rounding.
std::vector<double> places_to_check(const PlacedCurve& c, double low, double high) {
  const auto inset = [&](double end, double other) {
    const double moving = norm(jet(c, std::lerp(end, other, 0.01)).first);
    return norm(jet(c, std::lerp(end, other, 1e-9)).first) > 1e-5 * moving ? 1e-9 : 1e-4;
  };
  std::vector<double> places;
  const double least = inset(low, high), most = 1 - inset(high, low);
  for (int k = 0; k <= kChecks; ++k)
    places.push_back(
        std::lerp(low, high, std::clamp(static_cast<double>(k) / kChecks, least, most)));
  return places;
}

/// A member's offset as a planar curve of its own; the third derivative lacks the second derivative
/// of curvature, which no fit looks at.
struct OffsetView {
  const PlacedCurve* base;
  double distance;
};
curve::Jet2 jet(const OffsetView& c, double t) {
  curve::Jet2 j = document::jet(*c.base, t);
  if (is_zero(j.first)) j = resting_jet(*c.base, t, j.point);
  const double speed = norm(j.first);
  const double bend = cross(j.first, j.second) / std::pow(speed, 3);
  const double rate = cross(j.first, j.third) / std::pow(speed, 3) -
                      3 * bend * dot(j.first, j.second) / (speed * speed);
  const double scale = 1 - c.distance * bend;
  curve::Jet2 o = j;
  o.point = j.point + c.distance * perpendicular_left(j.first / speed);
  o.first = scale * j.first;
  o.second = scale * j.second - c.distance * rate * j.first;
  o.third = scale * j.third - 2 * c.distance * rate * j.second;
  return o;
}
Point2 evaluate(const OffsetView& c, double t) { return jet(c, t).point; }
std::vector<double> breakpoints(const OffsetView& c) { return document::breakpoints(*c.base); }

/// No distance is below the radius of curvature at a cusp on that side.
Result<void> cusp_within(const PlacedCurve& c, double distance) {
  const std::vector<curve::Stop> stops = stops_of(Path{{c.curve()}, false});
  const int side = distance > 0 ? 1 : -1;
  const auto cusp =
      std::ranges::find_if(stops, [&](const curve::Stop& stop) { return has_cusp({stop}, side); });
  if (distance == 0 || cusp == stops.end()) return {};
  const Point2 p = evaluate(c, cusp->t);
  return fail(ErrorCode::undrawable,
              "the curve has a cusp at (" + core::number_text(p.x, 6) + ", " +
                  core::number_text(p.y, 6) +
                  "), where the radius of curvature is 0, so that its offset turns back",
              has_cusp(stops, -side) ? "cut the curve before its cusps" : "take the other side",
              "distance");
}

/// The radius of curvature that the distance reaches, if any.
Result<void> room_for(const PlacedCurve& c, double distance) {
  if (auto clear = cusp_within(c, distance); !clear) return clear;
  const std::vector<double> breaks = breakpoints(c);
  double tightest = 0;
  double at = 0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (const double t : places_to_check(c, breaks[i], breaks[i + 1])) {
      const double bend = curve::curvature(document::jet(c, t));
      if (!(bend * distance > tightest * distance)) continue;
      tightest = bend;
      at = t;
    }
  if (tightest * distance < 1) return {};
  const Point2 p = evaluate(c, at);
  return fail(ErrorCode::undrawable,
              "the offset turns back where the radius of curvature is " +
                  core::number_text(1 / std::abs(tightest), 6) + ", at (" +
                  core::number_text(p.x, 6) + ", " + core::number_text(p.y, 6) + ")",
              "give a distance below that radius, or the other side", "distance");
}

/// Lines and arcs exactly.
std::optional<lac::Chain> exact_offset(const PlanarCurve& c, double distance) {
  const auto* chain = std::get_if<lac::Chain>(&c.value);
  if (!chain) return std::nullopt;
  lac::Chain moved = *chain;
  moved.start.position = moved.start.position +
                         distance * perpendicular_left(core::unit_vector(moved.start.direction));
  for (lac::Piece& p : moved.pieces) {
    if (p.curvature_start != p.curvature_end) return std::nullopt;
    const double scale = 1 - distance * p.curvature_start;
    p.length *= scale;
    p.curvature_start = p.curvature_end = p.curvature_start / scale;
  }
  return moved;
}

void append_offset(const PlacedCurve& c, double distance, double tolerance, Offset& to) {
  if (auto exact = exact_offset(c.curve(), distance)) {
    to.path.curves.push_back({std::move(*exact)});
    return;
  }
  const OffsetView view{&c, distance};
  auto pieces = curve::approximate_by_cubics(curve::PlanarView(view), tolerance);
  to.deviation = std::max(to.deviation, pieces.deviation);
  for (curve::Bezier2& piece : pieces.pieces) to.path.curves.push_back({std::move(piece)});
}

/// The arc about a corner from the end of one offset to the start of the next; nothing where there
/// is no corner, or only one that parts the offsets by no more than `slack`.
Result<void> turn_corner(const PlanarCurve& before, const PlanarCurve& after, double distance,
                         double slack, Offset& to) {
  const double in = curve::arriving_angle(jet(before, 1));
  const double out = curve::tangent_angle(jet(after, 0));
  double turn = core::wrap_angle(out - in);
  if (core::kPi - std::abs(turn) < kCorner) turn = -std::copysign(turn, distance);  // opens on both
  if (std::abs(turn) < kCorner || std::abs(turn * distance) <= slack) return {};
  const Point2 corner = evaluate(after, 0);
  if (turn * distance > 0)
    return fail(ErrorCode::undrawable,
                "the offset crosses itself at the corner (" + core::number_text(corner.x, 6) +
                    ", " + core::number_text(corner.y, 6) + ")",
                "split the path there and trim the parts, or give the other side", "distance");
  const Point2 start = corner + distance * perpendicular_left(core::unit_vector(in));
  const double bend = turn > 0 ? 1 / std::abs(distance) : -1 / std::abs(distance);
  const lac::Piece arc{-1, std::abs(turn * distance), bend, bend};
  to.path.curves.push_back({lac::Chain{{start, in}, {arc}, false}});
  ++to.arcs;
  return {};
}

}  // namespace

PlanarCurve part(const PlanarCurve& c, const core::Interval& t) {
  return std::visit([&](const auto& v) { return PlanarCurve{part_of(v, t)}; }, c.value);
}

Path part(const Path& path, const core::Interval& t) {
  Path result;
  const auto count = static_cast<double>(path.curves.size());
  for (std::size_t i = 0; i < path.curves.size(); ++i) {
    const double low = std::max(t.low * count - static_cast<double>(i), 0.0);
    const double high = std::min(t.high * count - static_cast<double>(i), 1.0);
    if (!(low < high)) continue;
    const bool whole = low == 0 && high == 1;
    result.curves.push_back(whole ? path.curves[i] : part(path.curves[i], {low, high}));
    if (auto* chain = std::get_if<lac::Chain>(&result.curves.back().value); chain)
      chain->closed = false;
  }
  return result;
}

namespace {

/// Puts what follows to the end of a curve where both are one polyline, or one chain without a
/// corner between them; false where they stay two.
bool went_on(PlanarCurve& curve, const PlanarCurve& next) {
  auto* line = std::get_if<curve::Polyline2>(&curve.value);
  const auto* more = std::get_if<curve::Polyline2>(&next.value);
  if (line && more) {
    line->points.insert(line->points.end(), more->points.begin() + 1, more->points.end());
    return true;
  }
  auto* chain = std::get_if<lac::Chain>(&curve.value);
  const auto* rest = std::get_if<lac::Chain>(&next.value);
  if (!chain || !rest) return false;
  const double turn = core::wrap_angle(rest->start.direction - end_pose(*chain).direction);
  if (std::abs(turn) > kCorner) return false;
  chain->pieces.insert(chain->pieces.end(), rest->pieces.begin(), rest->pieces.end());
  return true;
}

}  // namespace

Path part_over_seam(const Path& path, double from, double to) {
  if (from >= 1) return part(path, {0, to});
  Path whole = part(path, {from, 1});
  if (to <= 0) return whole;
  const Path rest = part(path, {0, to});
  auto next = rest.curves.begin();
  if (path.curves.size() == 1 && went_on(whole.curves.back(), *next)) ++next;
  whole.curves.insert(whole.curves.end(), next, rest.curves.end());
  return whole;
}

PlanarCurve mirrored(const PlanarCurve& c, const core::Pose2& axis) {
  return std::visit([&](const auto& v) { return PlanarCurve{image(v, axis)}; }, c.value);
}

Path mirrored(const Path& path, const core::Pose2& axis) {
  Path result{{}, path.closed};
  for (const PlanarCurve& c : path.curves) result.curves.push_back(mirrored(c, axis));
  return result;
}

Result<Offset> offset(const Path& path, double distance, double tolerance, double one_end) {
  if (distance == 0) return Offset{path, 0, 0};
  const std::vector<PlanarCurve> members = smooth_members(path);
  if (members.empty())
    return fail(ErrorCode::undrawable, "a curve without length has no side", "", "curve");
  Offset made;
  made.path.closed = path.closed || core::distance(evaluate(path, 0), evaluate(path, 1)) <= one_end;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (i > 0)
      if (auto done = turn_corner(members[i - 1], members[i], distance, 0, made); !done)
        return std::unexpected(done.error());
    const PlacedCurve member(members[i]);
    if (auto room = room_for(member, distance); !room) return std::unexpected(room.error());
    append_offset(member, distance, tolerance, made);
  }
  if (made.path.closed)
    if (auto done = turn_corner(members.back(), members.front(), distance, one_end, made); !done)
      return std::unexpected(done.error());
  const bool alone = made.path.curves.size() == 1;
  for (PlanarCurve& c : made.path.curves)
    if (auto* chain = std::get_if<lac::Chain>(&c.value); chain)
      chain->closed = alone && made.path.closed;
  return made;
}

}  // namespace keyline::document
