#include "keyline/document/planar_curve.h"

#include <algorithm>
#include <cmath>

#include "keyline/curve/arriving.h"
#include "keyline/curve/stops.h"

namespace keyline::document {
namespace {

using core::Vector2;

/// Whether a jet has no direction.
bool rests(const curve::Jet2& j) {
  return j.first == Vector2{} && j.second == Vector2{} && j.third == Vector2{};
}

/// Direction of travel at a place where the jet has none: of a stop, else of the next part that
/// has length, at the end of the last.
template <class Curve>
Vector2 way_at_rest(const Curve& c, double t) {
  for (const curve::Stop& stop : curve::stops_of(c))
    if (stop.t == t && (t < 1 ? stop.after : stop.before))
      return (t < 1 ? stop.after : stop.before)->tangent;
  const std::vector<double> breaks = breakpoints(c);
  for (const double b : breaks)
    if (b > t && b < 1)
      if (const auto j = jet(c, b); !rests(j)) return curve::unit_tangent(j);
  for (auto b = breaks.rbegin(); b != breaks.rend(); ++b)
    if (*b <= t && *b > 0)
      if (const auto j = jet(c, std::nextafter(*b, 0.0)); !rests(j))
        return curve::arriving_tangent(j);
  return {};
}

/// The jet, where it has no direction with one as its third derivative (see curve::Polyline).
template <class Curve>
curve::Jet2 with_way(const Curve& c, double t, curve::Jet2 j) {
  if constexpr (std::is_same_v<Curve, curve::Bezier2> || std::is_same_v<Curve, curve::BSpline2>)
    if (rests(j)) j.third = way_at_rest(c, t);
  return j;
}

/// Of a member without length: the direction of the next that has one, at the end of the last.
template <class Member>
curve::Jet2 with_way_of_others(const std::vector<Member>& members, std::size_t index,
                               curve::Jet2 j) {
  if (!rests(j)) return j;
  for (std::size_t i = index + 1; i < members.size(); ++i)
    if (const auto next = jet(members[i], 0); !rests(next)) {
      j.third = curve::unit_tangent(next);
      return j;
    }
  for (std::size_t i = index; i-- > 0;)
    if (const auto last = jet(members[i], 1); !rests(last)) {
      j.third = curve::arriving_tangent(last);
      return j;
    }
  return j;
}

}  // namespace

core::Point2 evaluate(const PlanarCurve& c, double t) {
  return std::visit([t](const auto& v) { return evaluate(v, t); }, c.value);
}

curve::Jet2 jet(const PlanarCurve& c, double t) {
  return std::visit([t](const auto& v) { return with_way(v, t, jet(v, t)); }, c.value);
}

std::vector<double> breakpoints(const PlanarCurve& c) {
  return std::visit([](const auto& v) { return breakpoints(v); }, c.value);
}

PlanarCurve reverse(const PlanarCurve& c) {
  return std::visit([](const auto& v) { return PlanarCurve{reverse(v)}; }, c.value);
}

PlanarCurve transform(const PlanarCurve& c, const core::Similarity2& map) {
  return std::visit([&](const auto& v) { return PlanarCurve{transform(v, map)}; }, c.value);
}

core::Result<void> validate(const PlanarCurve& c) {
  return std::visit([](const auto& v) { return validate(v); }, c.value);
}

core::Point2 evaluate(const Path& path, double t) {
  const curve::Share share = curve::share_of(path.curves.size(), t);
  return evaluate(path.curves[share.index], share.t);
}

curve::Jet2 jet(const Path& path, double t) {
  const curve::Share share = curve::share_of(path.curves.size(), t);
  const auto own =
      with_way_of_others(path.curves, share.index, jet(path.curves[share.index], share.t));
  return curve::rescaled(own, static_cast<double>(path.curves.size()));
}

PlacedCurve::PlacedCurve(const PlanarCurve& curve) : curve_(&curve) {
  if (const auto* chain = std::get_if<lac::Chain>(&curve.value)) chain_.emplace(*chain);
}

core::Point2 evaluate(const PlacedCurve& placed, double t) {
  return placed.chain() ? evaluate(*placed.chain(), t) : evaluate(placed.curve(), t);
}

curve::Jet2 jet(const PlacedCurve& placed, double t) {
  return placed.chain() ? jet(*placed.chain(), t) : jet(placed.curve(), t);
}

PlacedPath::PlacedPath(const Path& path)
    : path_(&path),
      members_(path.curves.begin(), path.curves.end()),
      breaks_(document::breakpoints(path)) {
  for (std::size_t i = 0; i < path.curves.size(); ++i) {
    const auto own = document::breakpoints(path.curves[i]);
    for (std::size_t k = 1; k < own.size(); ++k) stretches_.push_back({i, own[k - 1], own[k]});
  }
}

curve::Share PlacedPath::locate(double t) const {
  t = t >= 0 ? t : 0.0;  // 0 for NaN, too
  const auto after = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, t);
  const Stretch& s = stretches_[static_cast<std::size_t>(after - breaks_.begin()) - 1];
  const double n = static_cast<double>(members_.size());
  const double last = t < 1 ? std::nextafter(s.to, s.from) : s.to;
  return {s.member, std::clamp(t * n - static_cast<double>(s.member), s.from, last)};
}

core::Point2 evaluate(const PlacedPath& placed, double t) {
  const curve::Share share = placed.locate(t);
  return evaluate(placed.members()[share.index], share.t);
}

curve::Jet2 jet(const PlacedPath& placed, double t) {
  const curve::Share share = placed.locate(t);
  const auto& members = placed.members();
  const auto own = with_way_of_others(members, share.index, jet(members[share.index], share.t));
  return curve::rescaled(own, static_cast<double>(placed.path().curves.size()));
}

std::vector<double> breakpoints(const Path& path) {
  std::vector<double> all{0};
  const double n = static_cast<double>(path.curves.size());
  for (std::size_t i = 0; i < path.curves.size(); ++i) {
    const auto own = breakpoints(path.curves[i]);
    for (std::size_t k = 1; k < own.size(); ++k)
      all.push_back((static_cast<double>(i) + own[k]) / n);
  }
  all.back() = 1;
  return all;
}

Path reverse(const Path& path) {
  Path result{{}, path.closed};
  for (auto it = path.curves.rbegin(); it != path.curves.rend(); ++it)
    result.curves.push_back(reverse(*it));
  return result;
}

Path transform(const Path& path, const core::Similarity2& map) {
  Path result{{}, path.closed};
  for (const PlanarCurve& c : path.curves) result.curves.push_back(transform(c, map));
  return result;
}

core::Result<void> validate(const Path& path) {
  if (path.curves.empty())
    return core::fail(core::ErrorCode::bad_input, "a path without curves",
                      "give at least one curve", "curves");
  for (std::size_t i = 0; i < path.curves.size(); ++i) {
    auto own = validate(path.curves[i]);
    if (own) continue;
    own.error().path = "curves[" + std::to_string(i) + "]" +
                       (own.error().path.empty() ? "" : "." + own.error().path);
    return own;
  }
  return {};
}

}  // namespace keyline::document
