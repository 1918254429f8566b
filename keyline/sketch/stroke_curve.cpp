#include "keyline/sketch/stroke_curve.h"

#include <algorithm>

#include "keyline/fit/curvature_target.h"
#include "keyline/fit/quintic_chain.h"
#include "keyline/sketch/quintics.h"
#include "keyline/sketch/segments.h"

namespace keyline::sketch {
namespace {

using core::Point2;

/// Points along the straight line from p to q, a pixel apart, q left out.
void add_line(std::vector<Point2>& points, Point2 p, Point2 q) {
  const int steps = std::max(1, static_cast<int>(core::distance(p, q)));
  for (int k = 0; k < steps; ++k) points.push_back(core::mix(p, q, k / static_cast<double>(steps)));
}

/// Points of a run; its ends are those of its line segments. Near a corner, which the ink rounds,
/// the line goes straight on.
std::vector<Point2> points_of(const SegmentRun& run, const FineStroke& fine) {
  const std::size_t n = fine.points.size();
  std::vector<Point2> part;
  for (std::size_t i = run.first; i <= run.last; ++i) part.push_back(fine.points[i % n]);
  if (run.closed) return part;
  const double rounding = 2 + 0.6 * fine.width;
  const double at_start = fine.closed || run.first > 0 ? rounding : 0.5;
  const double at_end = fine.closed || run.last + 1 < n ? rounding : 0.5;
  part.front() = run.vertices.front();
  part.back() = run.vertices.back();
  const auto near = [](Point2 p, Point2 end, double reach) {
    return core::distance(p, end) < reach;
  };
  std::size_t from = 1;
  while (from + 1 < part.size() && near(part[from], part.front(), at_start)) ++from;
  std::size_t to = part.size() - 1;
  while (to > from && near(part[to - 1], part.back(), at_end)) --to;
  std::vector<Point2> kept;
  if (from >= to) {  // nothing but corners
    add_line(kept, part.front(), part.back());
  } else {
    add_line(kept, part.front(), part[from]);
    kept.insert(kept.end(), part.begin() + static_cast<long>(from),
                part.begin() + static_cast<long>(to) - 1);
    add_line(kept, part[to - 1], part.back());
  }
  kept.push_back(part.back());
  return kept;
}

/// Quintics of a run: [Sketch] section 5 as it stands, or as few as follow the points.
std::vector<curve::Bezier2> quintics_of(const SegmentRun& run, const FineStroke& fine,
                                        const std::vector<curve::Bezier2>& quadratic,
                                        const StrokeCurveOptions& options) {
  std::vector<curve::Bezier2> pieces = elevated(quadratic);
  make_curvature_continuous(pieces, run.closed);
  if (options.tolerance <= 0) return pieces;
  const auto part = points_of(run, fine);
  if (part.size() < 4) return pieces;
  const double tolerance = std::max(options.tolerance, options.width_share * fine.width);
  fit::QuinticChain chain = fit::fit_quintic_chain(part, run.closed, {tolerance, 48});
  return chain.within_tolerance ? chain.pieces : pieces;
}

/// Drives quintics to the curvature aimed at, ends held; what cannot be driven stays.
void drive(std::vector<curve::Bezier2>& pieces, bool closed, CurvatureAim aim, Stroke& stroke) {
  const curve::PiecewiseBezier chain{pieces, 0};
  const auto target = aim == CurvatureAim::smooth ? fit::smooth_target(chain, closed)
                                                  : fit::rhythm_target(chain, closed);
  const auto driven = fit::drive_curvature(chain, target, {.closed = closed, .hold_end = true});
  if (!driven || !(driven->after <= driven->before)) return;
  stroke.target = target;
  pieces = driven->chain.pieces;
}

/// The part of an axis that its group's points took.
std::array<Point2, 2> extent(const Axis& axis, double half_length) {
  return {axis.centre - half_length * axis.direction, axis.centre + half_length * axis.direction};
}

}  // namespace

Stroke curve_of(const FineStroke& fine, const StrokeCurveOptions& options) {
  Stroke stroke;
  stroke.points = fine.points;
  stroke.closed = fine.closed;
  stroke.width = fine.width;
  stroke.widths = fine.widths;
  const auto runs = fit_segments(fine.points, fine.closed,
                                 {options.straightness, options.corner_angle, fine.width});
  for (const SegmentRun& run : runs) {
    const std::vector<curve::Bezier2> quadratic = quadratics(run.vertices, run.closed);
    std::vector<curve::Bezier2> pieces = quintics_of(run, fine, quadratic, options);
    if (options.aim != CurvatureAim::none) drive(pieces, run.closed, options.aim, stroke);
    if (!stroke.curve.empty()) stroke.corners.push_back(stroke.curve.size());
    if (stroke.curve.empty() && fine.closed && !run.closed) stroke.corners.push_back(0);
    stroke.curve.insert(stroke.curve.end(), pieces.begin(), pieces.end());
    stroke.quadratics.insert(stroke.quadratics.end(), quadratic.begin(), quadratic.end());
    const double half =
        0.5 * static_cast<double>(run.last - run.first) / static_cast<double>(run.axes.size());
    for (const Axis& axis : run.axes) stroke.axes.push_back(extent(axis, half));
    const std::size_t skip = stroke.segments.empty() ? 0 : 1;
    stroke.segments.insert(stroke.segments.end(), run.vertices.begin() + static_cast<long>(skip),
                           run.vertices.end());
  }
  if (runs.size() > 1) stroke.target.clear();  // of one run only
  if (!runs.front().closed && fine.closed) stroke.segments.pop_back();
  return stroke;
}

}  // namespace keyline::sketch
