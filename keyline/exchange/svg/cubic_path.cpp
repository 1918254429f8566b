#include "keyline/exchange/svg/cubic_path.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "keyline/curve/conversion.h"
#include "keyline/curve/piecewise_bezier.h"

namespace keyline::exchange {
namespace {

constexpr double kMeeting = 1e-9;  // of the size: ends this near are one

double size_of(const std::vector<curve::Bezier2>& pieces) {
  double size = 0;
  for (const curve::Bezier2& piece : pieces)
    for (const core::Point2 p : piece.control)
      size = std::max(size, core::distance(p, pieces.front().control.front()));
  return size;
}

/// Ends that all but meet are made to meet.
void close(SvgPath& path) {
  if (path.pieces.empty()) return;
  const core::Point2 start = path.pieces.front().control.front();
  core::Point2& end = path.pieces.back().control.back();
  if (core::distance(start, end) > kMeeting * size_of(path.pieces)) return;
  end = start;
  path.closed = true;
}

/// Ends of neighbours that rounding has parted are made one, so that the pen stays down.
void join(std::vector<curve::Bezier2>& pieces) {
  const double reach = kMeeting * size_of(pieces);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const core::Point2 end = pieces[i - 1].control.back();
    core::Point2& start = pieces[i].control.front();
    if (core::distance(start, end) <= reach) start = end;
  }
}

bool is_svg_piece(const curve::Bezier2& c) {
  return c.weights.empty() && c.control.size() >= 2 && c.control.size() <= 4;
}

curve::PiecewiseBezier pieces_of(const document::PlanarCurve& c, double tolerance) {
  if (const auto* bezier = std::get_if<curve::Bezier2>(&c.value); bezier && is_svg_piece(*bezier))
    return {{*bezier}, 0};
  if (const auto* line = std::get_if<curve::Polyline2>(&c.value)) {
    curve::PiecewiseBezier lines;
    for (std::size_t i = 1; i < line->points.size(); ++i)
      if (line->points[i] != line->points[i - 1])
        lines.pieces.push_back({{line->points[i - 1], line->points[i]}, {}});
    return lines;
  }
  return std::visit([&](const auto& v) { return curve::approximate_by_cubics(v, tolerance); },
                    c.value);
}

}  // namespace

CubicPath cubic_path(const document::Path& path, const std::string& name, double tolerance) {
  CubicPath made;
  made.path.name = name;
  for (const document::PlanarCurve& c : path.curves) {
    curve::PiecewiseBezier part = pieces_of(c, tolerance);
    made.deviation = std::max(made.deviation, part.deviation);
    std::move(part.pieces.begin(), part.pieces.end(), std::back_inserter(made.path.pieces));
  }
  join(made.path.pieces);
  const bool loop = path.curves.size() == 1 &&
                    std::holds_alternative<lac::Chain>(path.curves[0].value) &&
                    std::get<lac::Chain>(path.curves[0].value).closed;
  if (path.closed || loop) close(made.path);
  return made;
}

}  // namespace keyline::exchange
