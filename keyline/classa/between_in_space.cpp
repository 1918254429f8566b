#include "keyline/classa/between_in_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "keyline/classa/farin.h"
#include "keyline/core/angle.h"
#include "keyline/core/axis.h"

namespace keyline::classa {
namespace {

using core::Vector3;

constexpr double kPlane = 1e-12;  ///< volume that unit tangents and chord span in a plane
constexpr double kMet = 1e-11;    ///< radians by which the chord may miss its direction
constexpr double kLeastTurn = 1e-9;

Vector3 unit(Vector3 v) { return v / norm(v); }

/// Unit tangents at both ends and the chord, with what follows from them.
struct Frame {
  Vector3 first, last, chord;
  Vector3 middle;  ///< between the tangents
  Vector3 normal;  ///< of both
  double length = 0;
};

/// Empty where the ends coincide or the tangents turn by nothing or by half a turn.
std::optional<Frame> frame_of(const SpaceEndTangents& ends) {
  Frame f;
  const Vector3 chord = ends.end - ends.start;
  f.length = norm(chord);
  if (!(f.length > 0)) return std::nullopt;
  f.first = unit(ends.start_tangent);
  f.last = unit(ends.end_tangent);
  f.chord = chord / f.length;
  const Vector3 across = cross(f.first, f.last);
  if (!(norm(across) > kLeastTurn)) return std::nullopt;
  f.normal = unit(across);
  f.middle = unit(f.first + f.last);
  return f;
}

/// Rotation by `angle` about a unit axis (Rodrigues).
Vector3 rotated(Vector3 v, Vector3 axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
         ((1 - std::cos(angle)) * dot(axis, v)) * axis;
}

/// A matrix that takes the first tangent's direction to the last's in degree - 1 steps.
struct Member {
  Vector3 axis;
  double alpha = 0;
  double s = 1;

  std::vector<Vector3> edges(Vector3 first, int degree) const {
    std::vector<Vector3> all;
    double scale = 1;
    for (int i = 0; i < degree; ++i, scale *= s)
      all.push_back(scale * rotated(first, axis, i * alpha));
    return all;
  }
};

/// The axis leans by `lean` from the common normal towards the middle of the tangents.
Member member(const Frame& f, int degree, double lean, double log_s) {
  const Vector3 axis = std::cos(lean) * f.normal + std::sin(lean) * f.middle;
  const auto across = [&](Vector3 v) { return v - dot(v, axis) * axis; };
  const Vector3 from = across(f.first), to = across(f.last);
  const double turn = std::atan2(dot(axis, cross(from, to)), dot(from, to));
  return {axis, turn / (degree - 1), std::exp(log_s)};
}

Vector3 sum(const std::vector<Vector3>& edges) {
  Vector3 v;
  for (const Vector3& e : edges) v = v + e;
  return v;
}

/// Newton's method for lean and scale on the direction of the chord.
class Search {
 public:
  Search(const Frame& f, int degree) : f_(f), degree_(degree) {
    p_ = core::any_normal(f.chord);
    q_ = cross(f.chord, p_);
  }

  std::optional<Member> from(double lean, double log_s) const {
    Miss miss = at(lean, log_s);
    for (int i = 0; i < 40 && size(miss) > 1e-15; ++i) {
      constexpr double h = 1e-6;
      const Miss a = at(lean + h, log_s), b = at(lean - h, log_s);
      const Miss c = at(lean, log_s + h), d = at(lean, log_s - h);
      const Miss dl{(a[0] - b[0]) / (2 * h), (a[1] - b[1]) / (2 * h)};
      const Miss ds{(c[0] - d[0]) / (2 * h), (c[1] - d[1]) / (2 * h)};
      const double determinant = dl[0] * ds[1] - dl[1] * ds[0];
      if (!(std::abs(determinant) > 1e-14)) return std::nullopt;
      const double step_l = (miss[0] * ds[1] - miss[1] * ds[0]) / determinant;
      const double step_s = (dl[0] * miss[1] - dl[1] * miss[0]) / determinant;
      double share = std::min({1.0, 0.3 / std::abs(step_l), 0.7 / std::abs(step_s)});
      Miss next = at(lean - share * step_l, log_s - share * step_s);
      for (; share > 1e-3 && !(size(next) < size(miss)); share /= 2)
        next = at(lean - 0.5 * share * step_l, log_s - 0.5 * share * step_s);
      if (!(size(next) < size(miss))) break;
      lean -= share * step_l;
      log_s -= share * step_s;
      miss = at(lean, log_s);
    }
    if (!(size(miss) < kMet) || !(std::abs(lean) < core::kPi / 2)) return std::nullopt;
    return member(f_, degree_, lean, log_s);
  }

 private:
  using Miss = std::array<double, 2>;
  static double size(const Miss& m) { return std::hypot(m[0], m[1]); }

  /// Of the chord's direction; one that runs the other way counts as far off.
  Miss at(double lean, double log_s) const {
    const Vector3 d = unit(sum(member(f_, degree_, lean, log_s).edges(f_.first, degree_)));
    const Miss miss{dot(d, p_), dot(d, q_)};
    if (dot(d, f_.chord) > 0) return miss;
    const double along = std::max(size(miss), 1e-9);
    return {miss[0] * (2 - along) / along, miss[1] * (2 - along) / along};
  }

  const Frame& f_;
  int degree_;
  Vector3 p_, q_;
};

curve::Bezier3 polygon_of(const SpaceEndTangents& ends, const Frame& f, const Member& m,
                          int degree) {
  const std::vector<Vector3> edges = m.edges(f.first, degree);
  const double scale = f.length / norm(sum(edges));
  curve::Bezier3 c{{ends.start}, {}};
  for (const Vector3& e : edges) c.control.push_back(c.control.back() + scale * e);
  return c;
}

/// Starts from the common normal outwards, on either branch.
std::optional<curve::Bezier3> of_degree(const SpaceEndTangents& ends, const Frame& f, int degree,
                                        const BetweenRange& range) {
  const Search search(f, degree);
  for (const double lean : {0.0, 0.2, -0.2, 0.5, -0.5, 0.8, -0.8, 1.1, -1.1, 1.4, -1.4})
    for (const double log_s : {0.2, -0.2, 0.6, -0.6, 1.2, -1.2, 2.0, -2.0}) {
      const auto m = search.from(lean, log_s);
      if (!m || std::abs(m->alpha) > range.alpha_max) continue;
      if (!(m->s >= range.s.low && m->s <= range.s.high)) continue;
      curve::Bezier3 c = polygon_of(ends, f, *m, degree);
      if (certify_monotone_curvature(c).answer == curve::MonotoneVerdict::yes) return c;
    }
  return std::nullopt;
}

/// In the plane of the tangents.
std::optional<curve::Bezier3> in_plane(const SpaceEndTangents& ends, const Frame& f,
                                       const BetweenRange& range) {
  const Vector3 side = cross(f.normal, f.first);
  const auto flat = [&](Vector3 v) { return core::Vector2{dot(v, f.first), dot(v, side)}; };
  const core::Point2 end = core::Point2{} + f.length * flat(f.chord);
  const auto found = class_a_between({{}, {1, 0}, end, flat(f.last)}, range);
  if (!found) return std::nullopt;
  curve::Bezier3 c;
  for (const core::Point2& p : to_bezier(*found).control)
    c.control.push_back(ends.start + (p.x * f.first + p.y * side));
  return c;
}

}  // namespace

std::optional<curve::Bezier3> class_a_between(const SpaceEndTangents& ends,
                                              const BetweenRange& range) {
  const auto f = frame_of(ends);
  if (!f) return std::nullopt;
  if (std::abs(dot(f->chord, cross(f->first, f->last))) < kPlane) return in_plane(ends, *f, range);
  for (int degree = std::max(3, range.lowest_degree); degree <= range.highest_degree; ++degree)
    if (auto c = of_degree(ends, *f, degree, range)) return c;
  return std::nullopt;
}

}  // namespace keyline::classa
