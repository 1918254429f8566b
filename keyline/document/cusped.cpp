#include "keyline/document/cusped.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace keyline::document {
namespace {

using curve::Stop;
using curve::StopSide;

constexpr double kSame = 1e-15;  // of the parameter
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A chain's cusps; its direction there is that of its jets.
std::vector<Stop> cusps_of(const lac::Chain& chain) {
  std::vector<Stop> cusps;
  const lac::PlacedChain placed(chain);
  const double whole = placed.length();
  const auto side = [&](double t, double curvature) {
    const curve::Jet2 j = lac::jet(placed, t);
    return StopSide{j.first / norm(j.first), curvature};
  };
  double s = 0;
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const lac::Piece& piece = chain.pieces[i];
    if (std::isinf(piece.curvature_start)) {
      if (cusps.empty() || cusps.back().t != s / whole) cusps.push_back({s / whole, {}, {}});
      cusps.back().after = side(s / whole, piece.curvature_start);
    }
    s += piece.length;
    const double end = i + 1 == chain.pieces.size() ? 1 : s / whole;
    if (std::isinf(piece.curvature_end))
      cusps.push_back({end, side(std::nextafter(end, 0.0), piece.curvature_end), {}});
  }
  return cusps;
}

std::vector<Stop> stops_of(const PlanarCurve& c) {
  if (const auto* bezier = std::get_if<curve::Bezier2>(&c.value)) return curve::stops_of(*bezier);
  if (const auto* spline = std::get_if<curve::BSpline2>(&c.value)) return curve::stops_of(*spline);
  if (const auto* chain = std::get_if<lac::Chain>(&c.value)) return cusps_of(*chain);
  return {};
}

double sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Sign of the rate: curvature leaves an infinity; a finite limit is held against a place nearby.
std::array<double, 2> rates_of(const PlacedPath& path, const Stop& stop) {
  constexpr double kNearby = 1e-4;
  const double nearby = kNearby / static_cast<double>(path.path().curves.size());
  const auto grown = [&](const std::optional<StopSide>& side, double t) {
    if (!side) return 0.0;
    if (std::isinf(side->curvature)) return -sign_of(side->curvature);
    return sign_of(curve::curvature(jet(path, t)) - side->curvature);
  };
  return {-grown(stop.before, stop.t - nearby), grown(stop.after, stop.t + nearby)};
}

/// Infinite, but along an axis on which `direction` is 0.
core::Vector2 times(double factor, core::Vector2 direction) {
  const auto of = [factor](double x) { return x == 0 ? 0 : factor * x; };
  return {of(direction.x), of(direction.y)};
}

}  // namespace

std::vector<Stop> stops_of(const Path& path) {
  std::vector<Stop> all;
  const auto count = static_cast<double>(path.curves.size());
  for (std::size_t i = 0; i < path.curves.size(); ++i)
    for (Stop stop : stops_of(path.curves[i])) {
      stop.t = (static_cast<double>(i) + stop.t) / count;
      if (!all.empty() && all.back().t == stop.t)
        all.back().after = stop.after;
      else
        all.push_back(stop);
    }
  return all;
}

bool has_cusp(const std::vector<Stop>& stops, int sign) {
  const auto ends = [sign](const std::optional<StopSide>& side) {
    return side && side->curvature == sign * kInfinity;
  };
  return std::ranges::any_of(
      stops, [&](const Stop& stop) { return ends(stop.before) || ends(stop.after); });
}

bool has_cusp(const std::vector<Stop>& stops) { return has_cusp(stops, 1) || has_cusp(stops, -1); }

CuspedPath::CuspedPath(const Path& path)
    : placed_(path), stops_(document::stops_of(path)), breaks_(placed_.breakpoints()) {
  for (const Stop& stop : stops_) {
    rates_.push_back(rates_of(placed_, stop));
    const auto after = std::ranges::upper_bound(breaks_, stop.t - kSame);
    if (after == breaks_.end() || *after > stop.t + kSame) breaks_.insert(after, stop.t);
  }
}

curve::Jet2 jet(const CuspedPath& c, double t) {
  curve::Jet2 j = jet(c.placed(), t);
  const auto& stops = c.stops();
  const auto stop = std::ranges::lower_bound(stops, t - kSame, {}, &Stop::t);
  if (stop == stops.end() || stop->t > t + kSame) return j;
  const bool early = t < stop->t || stop->t == 1;
  const auto& side = early ? stop->before : stop->after;
  if (!side) return j;
  const double rate = c.rates(static_cast<std::size_t>(stop - stops.begin()))[early ? 0 : 1];
  const core::Vector2 normal = core::perpendicular_left(side->tangent);
  j.first = side->tangent;
  j.second = times(side->curvature, normal);
  j.third = rate == 0 ? core::Vector2{} : times(rate * kInfinity, normal);
  return j;
}

}  // namespace keyline::document
