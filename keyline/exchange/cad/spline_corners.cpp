#include "keyline/exchange/cad/spline_corners.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "keyline/core/angle.h"

namespace keyline::exchange::detail {
namespace {

using curve::Bezier2;
using curve::BSpline2;

constexpr double kSmooth = 1e-6;  // rad

/// The line a curve without weights draws: its control points stand on it in order.
std::optional<Bezier2> as_line(const Bezier2& c) {
  const core::Point2 from = c.control.front();
  const core::Vector2 side = c.control.back() - from;
  const double length = norm(side);
  if (!c.weights.empty() || !(length > 0)) return std::nullopt;
  double last = 0;
  for (const core::Point2 p : c.control) {
    const double along = dot(p - from, side) / length;
    if (std::abs(cross(side, p - from)) > 1e-12 * length * length || along < last)
      return std::nullopt;
    last = along;
  }
  return Bezier2{{from, c.control.back()}, {}};
}

bool is_corner(const Bezier2& a, const Bezier2& b) {
  const core::Vector2 out = jet(a, 1).first;
  const core::Vector2 in = jet(b, 0).first;
  return norm(out) > 0 && norm(in) > 0 && std::abs(core::angle_between(out, in)) > kSmooth;
}

}  // namespace

std::vector<document::PlanarCurve> parted_at_corners(const BSpline2& spline) {
  if (spline.degree == 1 && spline.weights.empty()) return {{curve::Polyline2{spline.control}}};
  const std::vector<double> ends = breakpoints(spline);
  const std::vector<Bezier2> spans = to_beziers(spline);
  if (spans.size() + 1 != ends.size()) return {{spline}};
  std::vector<document::PlanarCurve> parts;
  std::size_t from = 0;
  for (std::size_t i = 1; i <= spans.size(); ++i) {
    if (i < spans.size() && !is_corner(spans[i - 1], spans[i])) continue;
    const auto line = i == from + 1 ? as_line(spans[from]) : std::nullopt;
    if (line)
      parts.push_back({*line});
    else if (i - from == spans.size())
      parts.push_back({spline});
    else
      parts.push_back({subcurve(spline, ends[from], ends[i])});
    from = i;
  }
  return parts;
}

}  // namespace keyline::exchange::detail
