#include "keyline/surface/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/core/axis.h"
#include "keyline/curve/length.h"
#include "keyline/surface/directions.h"
#include "keyline/surface/interpolate.h"
#include "keyline/surface/tensor.h"

namespace keyline::surface {

using core::cross;
using core::dot;
using core::ErrorCode;
using core::fail;
using core::norm;
using core::Point3;
using core::Result;
using core::Vector3;
using curve::BSpline3;

namespace {

constexpr int kMostPlaces = 513;  ///< on each part of the rail
constexpr std::size_t kMostParts = 64;
constexpr int kBetween = 4;   ///< places checked between two of the interpolation
constexpr int kSubsteps = 8;  ///< of the frame between two checked places

/// Rows of control points with the profile's knots along v.
BSplineSurface with_rows(const BSpline3& profile, int degree_u, std::vector<double> knots_u,
                         int rows) {
  BSplineSurface s;
  s.degree = {degree_u, profile.degree};
  s.knots = {std::move(knots_u), profile.knots};
  s.net = {rows, static_cast<int>(profile.control.size()), {}};
  s.net.points.reserve(static_cast<std::size_t>(rows) * profile.control.size());
  return s;
}

void repeat_weights(BSplineSurface& s, const std::vector<double>& weights) {
  if (weights.empty()) return;
  for (int i = 0; i < s.net.rows; ++i)
    s.weights.insert(s.weights.end(), weights.begin(), weights.end());
}

/// Position of the rail and a frame at it.
struct Station {
  Point3 position;
  Vector3 tangent, normal;
};

Result<Station> place_on(const BSpline3& rail, double t) {
  const auto j = curve::jet(rail, t);
  const double speed = norm(j.first);
  if (!(speed > 0))
    return fail(ErrorCode::unsupported, "the rail has a place without tangent",
                "remove repeated control points", "rail");
  return Station{j.point, j.first / speed, {}};
}

/// The normal of `from` carried to `to` without twist: two reflections.
void carry(const Station& from, Station& to) {
  const Vector3 v1 = to.position - from.position;
  const double c1 = dot(v1, v1);
  if (!(c1 > 0)) {
    to.normal = from.normal;
    return;
  }
  const Vector3 normal = from.normal - (2 / c1) * dot(v1, from.normal) * v1;
  const Vector3 tangent = from.tangent - (2 / c1) * dot(v1, from.tangent) * v1;
  const Vector3 v2 = to.tangent - tangent;
  const double c2 = dot(v2, v2);
  to.normal = c2 > 0 ? normal - (2 / c2) * dot(v2, normal) * v2 : normal;
}

/// The rail with its length as parameter, and the shares of it between which it is G2: where its
/// curvature jumps the frame turns at another rate, a kink in what it carries.
struct Rail {
  const BSpline3& curve;
  curve::ArcLengthMap map;
  std::vector<double> parts{0};
  double at(double share) const {
    return curve::parameter_at_length(curve, map, share * curve::total_length(map));
  }
};

Vector3 curvature_vector(const curve::Jet3& j) {
  const double squared = dot(j.first, j.first);
  return (j.second - (dot(j.second, j.first) / squared) * j.first) / squared;
}

Rail rail_of(const BSpline3& curve) {
  Rail rail{curve, curve::arc_length_map(curve, 1e-10)};
  const double length = curve::total_length(rail.map);
  for (const double t : curve::breakpoints(curve)) {
    if (t <= 0 || t >= 1) continue;
    const Vector3 before = curvature_vector(curve::jet(curve, std::nextafter(t, 0)));
    const Vector3 after = curvature_vector(curve::jet(curve, t));
    if (norm(after - before) * length > 1e-6)
      rail.parts.push_back(curve::length_at_parameter(curve, rail.map, t) / length);
  }
  rail.parts.push_back(1);
  return rail;
}

/// Frames at `count` equal steps of the rail's length from one share to another; the first is
/// `start`, carried on to the last.
Result<std::vector<Station>> stations(const Rail& rail, const Station& start, double from,
                                      double to, int count) {
  std::vector<Station> list{start};
  Station before = start;
  for (int i = 1; i < count; ++i) {
    for (int k = 1; k <= kSubsteps; ++k) {
      const double share = (i - 1 + static_cast<double>(k) / kSubsteps) / (count - 1);
      auto next = place_on(rail.curve, rail.at((1 - share) * from + share * to));
      if (!next) return std::unexpected(next.error());
      carry(before, *next);
      before = *next;
    }
    list.push_back(before);
  }
  return list;
}

Vector3 carried(const Station& start, const Station& here, const Point3& p) {
  const Vector3 d = p - start.position;
  const Vector3 b0 = cross(start.tangent, start.normal);
  const Vector3 b1 = cross(here.tangent, here.normal);
  return (here.position - Point3{}) + dot(d, start.tangent) * here.tangent +
         dot(d, start.normal) * here.normal + dot(d, b0) * b1;
}

std::vector<Vector3> carried_row(const BSpline3& profile, const Station& start,
                                 const Station& here) {
  std::vector<Vector3> row;
  for (const Point3& p : profile.control) row.push_back(carried(start, here, p));
  return row;
}

Result<void> check_corners(const BSpline3& rail) {
  const auto breaks = curve::breakpoints(rail);
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i) {
    const Vector3 a = curve::jet(rail, std::nextafter(breaks[i], 0)).first;
    const Vector3 b = curve::jet(rail, breaks[i]).first;
    if (core::angle_between(a, b) > 1e-3)
      return fail(ErrorCode::unsupported, "the rail has a corner",
                  "sweep along its smooth parts one by one", "rail");
  }
  return {};
}

/// Control values over one part of the rail with `count` places, and how far off between them.
struct SweptPart {
  std::vector<double> knots;  ///< over [0, 1]
  std::vector<std::vector<Vector3>> control;
  double deviation = 0;
};

SweptPart sweep_part(const BSpline3& profile, const Station& start,
                     const std::vector<Station>& all) {
  const int count = (static_cast<int>(all.size()) - 1) / kBetween + 1;
  std::vector<double> places;
  std::vector<std::vector<Vector3>> rows;
  for (int i = 0; i < count; ++i) {
    places.push_back(i / (count - 1.0));
    rows.push_back(carried_row(profile, start, all[static_cast<std::size_t>(i) * kBetween]));
  }
  SweptPart part;
  part.knots = detail::averaged_knots(places, 3);
  part.control = detail::interpolate(places, part.knots, 3, rows);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % kBetween == 0) continue;
    const auto basis =
        detail::spline_basis(3, part.knots, static_cast<double>(i) / (all.size() - 1));
    const auto exact = carried_row(profile, start, all[i]);
    for (std::size_t j = 0; j < exact.size(); ++j) {
      Vector3 here;
      for (int k = 0; k < basis.count; ++k)
        here = here + basis.values[0][k] * part.control[basis.first + k][j];
      part.deviation = std::max(part.deviation, norm(here - exact[j]));
    }
  }
  return part;
}

/// The part's rows and knots after what is there; joined where the rail is G1, with triple knots.
void append(BSplineSurface& s, const SweptPart& part, double from, double to) {
  std::vector<double>& knots = s.knots[0];
  const bool first = knots.empty();
  if (!first) knots.pop_back();
  for (std::size_t i = first ? 0 : 4; i < part.knots.size(); ++i)
    knots.push_back((1 - part.knots[i]) * from + part.knots[i] * to);
  for (std::size_t i = first ? 0 : 1; i < part.control.size(); ++i, ++s.net.rows)
    for (const Vector3& v : part.control[i]) s.net.points.push_back(Point3{} + v);
}

/// Swept surface with `count` places of interpolation on each part.
Result<MadeSurface> sweep_with(const BSpline3& profile, const Rail& rail, int count) {
  auto start = place_on(rail.curve, 0);
  if (!start) return std::unexpected(start.error());
  start->normal = detail::any_across(start->tangent);
  MadeSurface made{with_rows(profile, 3, {}, 0), 0};
  Station here = *start;
  for (std::size_t i = 1; i < rail.parts.size(); ++i) {
    const auto all =
        stations(rail, here, rail.parts[i - 1], rail.parts[i], (count - 1) * kBetween + 1);
    if (!all) return std::unexpected(all.error());
    const SweptPart part = sweep_part(profile, *start, *all);
    append(made.surface, part, rail.parts[i - 1], rail.parts[i]);
    made.deviation = std::max(made.deviation, part.deviation);
    here = all->back();
  }
  repeat_weights(made.surface, profile.weights);
  return made;
}

/// p turned about the axis.
Point3 turned(const Axis3& axis, Vector3 direction, const Point3& p, double angle) {
  const Vector3 d = p - axis.point;
  const Vector3 along = dot(d, direction) * direction;
  const Vector3 across = d - along;
  return axis.point + along + std::cos(angle) * across + std::sin(angle) * cross(direction, across);
}

/// Where the tangents at the ends of an arc of 2 half about the axis meet.
Point3 shoulder(const Axis3& axis, Vector3 direction, const Point3& middle, double half) {
  const Vector3 d = middle - axis.point;
  const Vector3 along = dot(d, direction) * direction;
  return axis.point + along + (d - along) / std::cos(half);
}

}  // namespace

Result<BSplineSurface> extrude(const BSpline3& profile, Vector3 by) {
  if (!core::is_finite(by) || !(norm(by) > 0))
    return fail(ErrorCode::bad_input, "the direction has no length or is not finite",
                "give a vector [x, y, z] that is not zero", "rail");
  BSplineSurface s = with_rows(profile, 1, {0, 0, 1, 1}, 2);
  for (const double share : {0.0, 1.0})
    for (const Point3& p : profile.control) s.net.points.push_back(p + share * by);
  repeat_weights(s, profile.weights);
  return s;
}

Result<BSplineSurface> translate(const BSpline3& profile, const BSpline3& rail) {
  if (is_rational(rail))
    return fail(ErrorCode::unsupported, "the rail is rational",
                "sweep with a moving frame, or give a polynomial rail", "rail");
  const Point3 start = curve::evaluate(rail, 0);
  BSplineSurface s =
      with_rows(profile, rail.degree, rail.knots, static_cast<int>(rail.control.size()));
  for (const Point3& q : rail.control)
    for (const Point3& p : profile.control) s.net.points.push_back(p + (q - start));
  repeat_weights(s, profile.weights);
  return s;
}

Result<MadeSurface> sweep(const BSpline3& profile, const BSpline3& rail, double tolerance) {
  if (!(tolerance > 0))
    return fail(ErrorCode::bad_input, "the tolerance is not greater than zero",
                "give a length greater than zero", "tolerance");
  if (auto sound = check_corners(rail); !sound) return std::unexpected(sound.error());
  const Rail way = rail_of(rail);
  if (way.parts.size() > kMostParts)
    return fail(ErrorCode::unsupported, "the curvature of the rail jumps at too many places",
                "smooth the rail, or split it", "rail");
  for (int count = 5; count <= kMostPlaces; count = 2 * count - 1) {
    auto made = sweep_with(profile, way, count);
    if (!made || made->deviation <= tolerance) return made;
  }
  return fail(ErrorCode::not_converged, "the sweep is not within the tolerance",
              "allow a larger tolerance, or split the rail", "tolerance");
}

Result<BSplineSurface> revolve(const BSpline3& profile, const Axis3& axis, double angle) {
  const double length = norm(axis.direction);
  if (!core::is_finite(axis.point) || !core::is_finite(axis.direction) || !(length > 0))
    return fail(ErrorCode::bad_input, "the axis has no direction or is not finite",
                "give a point and a direction that is not zero", "axis");
  if (!(std::abs(angle) <= 2 * core::kPi * (1 + 1e-15)) || angle == 0)
    return fail(ErrorCode::bad_input, "the angle is out of range",
                "give radians from -2 pi to 2 pi, not 0", "angle");
  const Vector3 direction = axis.direction / length;
  const int arcs =
      std::max(1, static_cast<int>(std::ceil(std::abs(angle) / (core::kPi / 2) - 1e-9)));
  std::vector<double> knots{0, 0, 0};
  for (int i = 1; i < arcs; ++i) knots.insert(knots.end(), 2, static_cast<double>(i) / arcs);
  knots.insert(knots.end(), 3, 1.0);
  BSplineSurface s = with_rows(profile, 2, std::move(knots), 2 * arcs + 1);
  const double half = angle / (2 * arcs);
  for (int i = 0; i <= 2 * arcs; ++i) {
    const bool between = i % 2 == 1;
    for (std::size_t j = 0; j < profile.control.size(); ++j) {
      const Point3 p = turned(axis, direction, profile.control[j], i * half);
      s.net.points.push_back(between ? shoulder(axis, direction, p, half) : p);
      const double w = is_rational(profile) ? profile.weights[j] : 1;
      s.weights.push_back(between ? w * std::cos(half) : w);
    }
  }
  return s;
}

}  // namespace keyline::surface
