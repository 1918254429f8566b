#include "keyline/lac/g2/spline.h"

#include <cmath>
#include <string>

#include "keyline/core/angle.h"
#include "keyline/lac/g2/spline_forward.h"
#include "keyline/lac/g2/spline_local.h"
#include "keyline/lac/segment/slope.h"

namespace keyline::lac {
namespace {

using core::ErrorCode;
using core::Point2;
using detail::SplineStart;

std::string item(const char* list, std::size_t i) {
  return std::string(list) + "[" + std::to_string(i) + "]";
}

core::Result<void> check_points(std::span<const Point2> points, bool closed) {
  const std::size_t least = closed ? 3 : 2;
  if (points.size() < least) {
    return core::fail(ErrorCode::bad_input,
                      closed ? "a closed spline needs at least three points"
                             : "a spline needs at least two points",
                      {}, "points");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) {
      return core::fail(ErrorCode::bad_input, "a coordinate is not finite", {}, item("points", i));
    }
    const bool wraps = i + 1 == points.size();
    if (wraps && !closed) break;
    const double chord = distance(points[i], points[wraps ? 0 : i + 1]);
    if (!(chord > 0) || std::isinf(chord)) {
      return core::fail(ErrorCode::bad_input, "neighbouring points coincide or lie too far apart",
                        "remove one of them", item("points", wraps ? 0 : i + 1));
    }
  }
  return {};
}

core::Result<void> check_options(const SplineOptions& options, std::size_t spans) {
  if (options.alpha.size() > 1 && options.alpha.size() != spans) {
    return core::fail(ErrorCode::bad_input,
                      "give one slope, or one for each span: " + std::to_string(spans), {},
                      "alpha");
  }
  for (std::size_t i = 0; i < options.alpha.size(); ++i) {
    if (!is_slope(options.alpha[i])) {
      return core::fail(ErrorCode::bad_input, kSlopeRule, {},
                        options.alpha.size() > 1 ? item("alpha", i) : "alpha");
    }
  }
  for (const SplineEnd* end : {&options.start, &options.end}) {
    if (options.closed && (end->direction || end->curvature)) {
      return core::fail(ErrorCode::bad_input, "a closed spline has no ends to set conditions at",
                        "leave out the end directions and curvatures");
    }
    if (!std::isfinite(end->direction.value_or(0)) || !std::isfinite(end->curvature.value_or(0))) {
      return core::fail(ErrorCode::bad_input, "an end direction or curvature is not finite");
    }
  }
  return {};
}

core::Result<SplineSolution> solve_on(std::span<const Point2> points, const SplineOptions& options,
                                      const SplineStart& way) {
  const auto found =
      detail::solve_spline_forward(travelled(points, way), travelled(options, way), way);
  if (!found || (!way.backwards && way.point == 0)) return found;
  SplineSolution solution = as_asked(*found, way);
  detail::put_at(points[0], core::direction_of(points[1] - points[0]), solution);
  solution.deviation = detail::deviation_of(points, solution);
  return solution;
}

}  // namespace

core::Result<SplineSolution> solve_spline(std::span<const Point2> points,
                                          const SplineOptions& options) {
  if (options.closed && points.size() > 1 && points.front() == points.back())
    points = points.first(points.size() - 1);
  if (const auto ok = check_points(points, options.closed); !ok) return std::unexpected(ok.error());
  const std::size_t spans = options.closed ? points.size() : points.size() - 1;
  if (const auto ok = check_options(options, spans); !ok) return std::unexpected(ok.error());
  const SplineStart way = detail::spline_start(points, options);
  auto solution = solve_on(points, options, way);
  if (solution) return solution;
  auto other = solve_on(points, options, way.other_way(options.closed));
  // Of two reasons the one found in the direction of travel.
  return other || way.backwards ? other : solution;
}

}  // namespace keyline::lac
