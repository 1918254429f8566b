#include "keyline/document/smooth_members.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/curve/arriving.h"
#include "keyline/curve/stops.h"

namespace keyline::document {
namespace {

using curve::Bezier2;

bool has_length(const Bezier2& c) {
  return std::ranges::any_of(c.control, [&](core::Point2 p) { return p != c.control.front(); });
}

/// Cut at its stops, beside which the handles are drawn in: the cut is at the stop but for
/// rounding.
void append_parts(Bezier2 rest, std::vector<PlanarCurve>& to) {
  double done = 0;
  for (const curve::Stop& stop : curve::stops_of(rest)) {
    if (stop.t <= 0 || stop.t >= 1) continue;
    auto [part, next] = split(rest, (stop.t - done) / (1 - done));
    part.control.rbegin()[1] = part.control.back();
    next.control[1] = next.control.front();
    to.push_back({std::move(part)});
    rest = std::move(next);
    done = stop.t;
  }
  if (has_length(rest)) to.push_back({std::move(rest)});
}

void append_edges(const curve::Polyline2& line, std::vector<PlanarCurve>& to) {
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
    if (line.points[i] != line.points[i + 1])
      to.push_back({Bezier2{{line.points[i], line.points[i + 1]}, {}}});
}

bool turns(const Bezier2& before, const Bezier2& after) {
  const double in = curve::arriving_angle(jet(PlanarCurve{before}, 1));
  const double out = curve::tangent_angle(jet(PlanarCurve{after}, 0));
  return std::abs(core::wrap_angle(out - in)) > kCorner;
}

/// One without corners stays as it is.
void append_pieces(const curve::BSpline2& spline, std::vector<PlanarCurve>& to) {
  const std::vector<Bezier2> pieces = to_beziers(spline);
  const bool stops = std::ranges::any_of(
      curve::stops_of(spline), [](const curve::Stop& stop) { return stop.t > 0 && stop.t < 1; });
  if (!stops && std::ranges::all_of(pieces, has_length) &&
      std::adjacent_find(pieces.begin(), pieces.end(), turns) == pieces.end()) {
    to.push_back({spline});
    return;
  }
  for (const Bezier2& piece : pieces) append_parts(piece, to);
}

}  // namespace

std::vector<PlanarCurve> smooth_members(const Path& path) {
  std::vector<PlanarCurve> all;
  for (const PlanarCurve& c : path.curves)
    if (const auto* line = std::get_if<curve::Polyline2>(&c.value))
      append_edges(*line, all);
    else if (const auto* spline = std::get_if<curve::BSpline2>(&c.value))
      append_pieces(*spline, all);
    else if (const auto* bezier = std::get_if<Bezier2>(&c.value))
      append_parts(*bezier, all);
    else
      all.push_back(c);
  return all;
}

}  // namespace keyline::document
