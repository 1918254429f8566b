#include "keyline/sketch/trace.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "keyline/core/polygon.h"
#include "keyline/fit/quintic_chain.h"
#include "keyline/sketch/join_strokes.h"
#include "keyline/sketch/morphology.h"
#include "keyline/sketch/quintics.h"
#include "keyline/sketch/refine_stroke.h"
#include "keyline/sketch/segments.h"
#include "keyline/sketch/stroke_graph.h"
#include "keyline/sketch/thinning.h"

namespace keyline::sketch {
namespace {

using core::Point2;

/// Usual width of the ink's lines: twice the ink over its border.
double usual_width(const Binary& ink) {
  double area = 0;
  double border = 0;
  for (int y = 0; y < ink.height; ++y)
    for (int x = 0; x < ink.width; ++x) {
      if (!ink.at(x, y)) continue;
      ++area;
      if (x == 0 || y == 0 || x + 1 == ink.width || y + 1 == ink.height || !ink.at(x - 1, y) ||
          !ink.at(x + 1, y) || !ink.at(x, y - 1) || !ink.at(x, y + 1))
        ++border;
    }
  return border > 0 ? std::max(1.0, 2 * area / border) : 1;
}

/// Points of a run; its ends are those of its line segments (the corners).
std::vector<Point2> points_of(const SegmentRun& run, const std::vector<Point2>& points) {
  std::vector<Point2> part;
  for (std::size_t i = run.first; i <= run.last; ++i) part.push_back(points[i % points.size()]);
  if (run.closed) return part;
  part.front() = run.vertices.front();
  part.back() = run.vertices.back();
  const auto too_near = [](Point2 p, Point2 end) { return core::distance(p, end) < 0.5; };
  while (part.size() > 2 && too_near(part[1], part.front())) part.erase(part.begin() + 1);
  while (part.size() > 2 && too_near(part[part.size() - 2], part.back()))
    part.erase(part.end() - 2);
  return part;
}

/// Quintics of a run: [Sketch] section 5 as it stands, or as few as follow the points.
std::vector<curve::Bezier2> quintics_of(const SegmentRun& run, const FineStroke& fine,
                                        const TraceOptions& options) {
  std::vector<curve::Bezier2> pieces = elevated(quadratics(run.vertices, run.closed));
  make_curvature_continuous(pieces, run.closed);
  if (options.tolerance <= 0) return pieces;
  const auto part = points_of(run, fine.points);
  if (part.size() < 4) return pieces;
  const double tolerance = std::max(options.tolerance, 0.1 * fine.width);
  fit::QuinticChain chain = fit::fit_quintic_chain(part, run.closed, {tolerance, 48});
  return chain.within_tolerance ? chain.pieces : pieces;
}

/// The curve of a refined stroke: line segments, quadratics, quintics, joints.
Stroke curve_of(const FineStroke& fine, const TraceOptions& options) {
  Stroke stroke;
  stroke.points = fine.points;
  stroke.closed = fine.closed;
  stroke.width = fine.width;
  const auto runs = fit_segments(fine.points, fine.closed,
                                 {options.straightness, options.corner_angle, fine.width});
  for (const SegmentRun& run : runs) {
    const std::vector<curve::Bezier2> pieces = quintics_of(run, fine, options);
    if (!stroke.curve.empty()) stroke.corners.push_back(stroke.curve.size());
    if (stroke.curve.empty() && fine.closed && !run.closed) stroke.corners.push_back(0);
    stroke.curve.insert(stroke.curve.end(), pieces.begin(), pieces.end());
    const std::size_t skip = stroke.segments.empty() ? 0 : 1;
    stroke.segments.insert(stroke.segments.end(), run.vertices.begin() + static_cast<long>(skip),
                           run.vertices.end());
  }
  if (!runs.front().closed && fine.closed) stroke.segments.pop_back();
  return stroke;
}

/// Pixels with y down to y up.
void turn_up(Stroke& stroke, double height) {
  const auto turn = [height](Point2& p) { p.y = height - p.y; };
  std::for_each(stroke.points.begin(), stroke.points.end(), turn);
  std::for_each(stroke.segments.begin(), stroke.segments.end(), turn);
  for (curve::Bezier2& piece : stroke.curve)
    std::for_each(piece.control.begin(), piece.control.end(), turn);
}

core::Result<TraceResult> nothing_found() {
  return core::fail(core::ErrorCode::undrawable, "nothing in the picture looks like a line",
                    "give --threshold, or a picture with more contrast");
}

}  // namespace

core::Result<TraceResult> trace(Image image, const TraceOptions& options) {
  TraceResult result{image.width(), image.height(), {}, {}};
  const auto cancelled = [&] { return options.progress.stop_requested(); };
  options.progress.report(0, "reading grey values");
  const Tone tone = transform_intensity(image, options.tone);
  image = {};
  options.progress.report(0.3, "telling ink from paper");
  Binary ink = binarize(tone, options.binarize).ink;
  const double width = usual_width(ink);
  smooth_edges(ink, options.smoothing);
  const int specks =
      options.specks.value_or(static_cast<int>(std::lround(6 + 1.5 * width * width)));
  remove_specks(ink, specks, static_cast<int>(std::lround(1 + width)));
  if (cancelled()) return core::fail(core::ErrorCode::cancelled, "cancelled");
  options.progress.report(0.5, "thinning");
  const StrokeGraph graph = build_graph(thin(ink), ink);
  options.progress.report(0.7, "following lines");
  const auto raw = join_strokes(graph, {options.gap.value_or(3 * width + 3), 1.05});
  const Refiner refiner(tone);
  for (const RawStroke& line : raw) {
    if (cancelled()) return core::fail(core::ErrorCode::cancelled, "cancelled");
    if (core::polygon_length(line.points, line.closed) < std::max(3.0, 0.7 * width)) continue;
    const FineStroke fine = refiner.refine(line);
    if (core::polygon_length(fine.points, fine.closed) < 2) continue;
    result.strokes.push_back(curve_of(fine, options));
    turn_up(result.strokes.back(), result.height);
  }
  if (result.strokes.empty()) return nothing_found();
  std::stable_sort(result.strokes.begin(), result.strokes.end(),
                   [](const auto& a, const auto& b) { return a.points.size() > b.points.size(); });
  return result;
}

}  // namespace keyline::sketch
