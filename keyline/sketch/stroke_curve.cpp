#include "keyline/sketch/stroke_curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keyline/curve/piecewise_bezier.h"
#include "keyline/fit/quintic_chain.h"
#include "keyline/sketch/calm_quintics.h"
#include "keyline/sketch/quintics.h"
#include "keyline/sketch/segments.h"

namespace keyline::sketch {
namespace {

using core::Point2;

constexpr double kPerWave = 3;  ///< points, of the shortest; two would do for a sine

/// Points along the straight line from p to q, a pixel apart, q left out.
void add_line(std::vector<Point2>& points, Point2 p, Point2 q) {
  const int steps = std::max(1, static_cast<int>(core::distance(p, q)));
  for (int k = 0; k < steps; ++k) points.push_back(core::mix(p, q, k / static_cast<double>(steps)));
}

/// Points of a run. A corner is where the line segments have it: near it, where the ink is rounded,
/// the line goes straight on.
std::vector<Point2> points_of(const SegmentRun& run, const FineStroke& fine) {
  const std::size_t n = fine.points.size();
  std::vector<Point2> part;
  for (std::size_t i = run.first; i <= run.last; ++i) part.push_back(fine.points[i % n]);
  if (run.closed) return part;
  const bool corner_first = fine.closed || run.first > 0;
  const bool corner_last = fine.closed || run.last + 1 < n;
  const double at_start = corner_first ? run.round_first : 0.5;
  const double at_end = corner_last ? run.round_last : 0.5;
  if (corner_first) part.front() = run.vertices.front();
  if (corner_last) part.back() = run.vertices.back();
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

/// Of points in one place, as where a corner's vertex lies on a point, the last.
std::vector<Point2> apart(const std::vector<Point2>& points, bool closed, double reach) {
  std::vector<Point2> kept;
  for (const Point2 p : points) {
    if (!kept.empty() && core::distance(kept.back(), p) <= reach) kept.pop_back();
    kept.push_back(p);
  }
  while (closed && kept.size() > 1 && core::distance(kept.front(), kept.back()) <= reach)
    kept.pop_back();
  return kept;
}

/// Quintics of a run: [Sketch] section 5 as it stands, or as few as follow the points.
std::vector<curve::Bezier2> quintics_of(const SegmentRun& run, const FineStroke& fine,
                                        const std::vector<curve::Bezier2>& quadratic,
                                        const StrokeCurveOptions& options) {
  std::vector<curve::Bezier2> pieces = elevated(quadratic);
  make_curvature_continuous(pieces, run.closed);
  if (options.tolerance <= 0) return pieces;
  constexpr double kOnePlace = 1e-6;  // of the width
  const auto part = apart(points_of(run, fine), run.closed, kOnePlace * fine.width);
  if (part.size() < 4) return pieces;
  const double tolerance = std::max(options.tolerance, options.width_share * fine.width);
  const bool starts = run.first == 0 && !fine.closed;
  const bool ends = run.last + 1 == fine.points.size() && !fine.closed;
  fit::QuinticChain chain =
      fit::fit_quintic_chain(part, run.closed,
                             {.tolerance = tolerance,
                              .calm = true,
                              .free_start = starts && fine.free_start,
                              .free_end = ends && fine.free_end,
                              .every = static_cast<std::size_t>(fine.wave / kPerWave)});
  return chain.within_tolerance ? std::move(chain.pieces) : pieces;
}

/// How far driving may take a curve: so many tolerances (a hand's wobble of a pixel and what the
/// tracing errs goes then), or that share of the width.
constexpr double kDriveTolerances = 3;
constexpr double kDriveShare = 0.3;
constexpr std::size_t kFewestDriven = 8;  ///< points: fewer have no waves to take out
constexpr double kDriveGain = 0.9;        ///< of the error is left at most, or the curve stays
constexpr int kDriveSteps = 15;           ///< of the optimiser at most
constexpr std::size_t kDrivePieces = 20;  ///< driven at once: the work grows with their cube

/// What driving did to pieces in a row: targets have t over them.
struct DrivenRun {
  std::size_t pieces = 0;
  std::vector<fit::CurvatureTarget> target;
  double before = 0;
  double after = 0;
  std::size_t straight_ended = 0;  ///< stretches: see fit::RhythmTarget
};

/// Root mean square of the curvature less its target.
double off_target(const curve::PiecewiseBezier& chain,
                  const std::vector<fit::CurvatureTarget>& target) {
  double sum = 0;
  for (const fit::CurvatureTarget& t : target) {
    const double d = curvature(jet(chain, t.t)) - t.curvature;
    sum += std::isfinite(d) ? d * d : 0;
  }
  return std::sqrt(sum / static_cast<double>(target.size()));
}

/// Drives the pieces from `first` up to `last` of a chain to the targets there (t over the chain),
/// ends held, within the ink; what gains little stays.
DrivenRun drive_part(const std::vector<curve::Bezier2>& all, std::size_t first, std::size_t last,
                     const std::vector<fit::CurvatureTarget>& targets, double max_deviation,
                     bool closed, std::vector<curve::Bezier2>& driven_pieces) {
  const auto from = static_cast<std::ptrdiff_t>(first);
  const auto to = static_cast<std::ptrdiff_t>(last);
  const curve::PiecewiseBezier chain{{all.begin() + from, all.begin() + to}, 0};
  std::vector<fit::CurvatureTarget> target;
  for (const fit::CurvatureTarget& t : targets) {
    const double at = t.t * static_cast<double>(all.size()) - static_cast<double>(first);
    const double share = at / static_cast<double>(last - first);
    if (share >= 0 && share < 1) target.push_back({share, t.curvature});
  }
  const auto driven = fit::drive_curvature(chain, target,
                                           {.closed = closed,
                                            .hold_end = true,
                                            .hold_curvature = last - first < all.size(),
                                            .max_deviation = max_deviation,
                                            .max_iterations = kDriveSteps});
  const bool good = driven && driven->after <= kDriveGain * driven->before;
  const std::vector<curve::Bezier2>& pieces = good ? driven->chain.pieces : chain.pieces;
  driven_pieces.insert(driven_pieces.end(), pieces.begin(), pieces.end());
  if (good) return {pieces.size(), driven->target, driven->before, driven->after, 0};
  const double off = off_target(chain, target);
  return {pieces.size(), target, off, off, 0};
}

/// Of the circle through three points, positive where they turn left.
double curvature_through(Point2 a, Point2 b, Point2 c) {
  const double sides = core::distance(a, b) * core::distance(b, c) * core::distance(c, a);
  return sides > 0 ? 2 * core::cross(b - a, c - b) / sides : 0;
}

/// The curvature that a line of points has beside even places of a chain that follows it.
std::vector<fit::CurvatureTarget> targets_beside(const std::vector<curve::Bezier2>& pieces,
                                                 const std::vector<Point2>& line, bool closed) {
  constexpr std::size_t kTargets = 16;  // of a piece
  constexpr std::size_t kReach = 3;     // points either way that a curvature is read from
  const curve::PiecewiseBezier chain{pieces, 0};
  const std::size_t n = line.size();
  const std::size_t count = kTargets * pieces.size();
  const auto nearer = [](Point2 p) {
    return [p](Point2 a, Point2 b) { return core::distance(a, p) < core::distance(b, p); };
  };
  const Point2 start = evaluate(chain, 0.5 / static_cast<double>(count));
  auto at = static_cast<std::size_t>(std::ranges::min_element(line, nearer(start)) - line.begin());
  std::vector<fit::CurvatureTarget> targets;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    const Point2 p = evaluate(chain, t);
    while ((closed || at + 1 < n) && nearer(p)(line[(at + 1) % n], line[at])) at = (at + 1) % n;
    const std::size_t i = closed ? at : std::clamp(at, kReach, n - 1 - kReach);
    targets.push_back(
        {t, curvature_through(line[(i + n - kReach) % n], line[i], line[(i + kReach) % n])});
  }
  return targets;
}

/// Drives the quintics to a target, long runs part by part: their joints stay as they are.
std::vector<DrivenRun> drive_to(const std::vector<fit::CurvatureTarget>& target, bool closed,
                                double most, std::vector<curve::Bezier2>& pieces) {
  std::vector<DrivenRun> runs;
  std::vector<curve::Bezier2> driven;
  const std::size_t parts = (pieces.size() + kDrivePieces - 1) / kDrivePieces;
  for (std::size_t k = 0; k < parts; ++k)
    runs.push_back(drive_part(pieces, k * pieces.size() / parts, (k + 1) * pieces.size() / parts,
                              target, most, closed && parts == 1, driven));
  pieces = std::move(driven);
  return runs;
}

/// What a chain's targets come to at points that it follows, by shares of the length.
std::vector<double> target_at_points(const std::vector<fit::CurvatureTarget>& target,
                                     const std::vector<curve::Bezier2>& pieces,
                                     const std::vector<Point2>& points) {
  const curve::PiecewiseBezier chain{pieces, 0};
  std::vector<Point2> places;
  for (const fit::CurvatureTarget& t : target) places.push_back(evaluate(chain, t.t));
  const auto lengths = [](const std::vector<Point2>& line, double before) {
    std::vector<double> run{before};
    for (std::size_t i = 1; i < line.size(); ++i)
      run.push_back(run.back() + core::distance(line[i - 1], line[i]));
    return run;
  };
  std::vector<double> at = lengths(places, core::distance(evaluate(chain, 0), places.front()));
  const double whole = at.back() + core::distance(places.back(), evaluate(chain, 1));
  const std::vector<double> own = lengths(points, 0);
  std::vector<double> wanted;
  std::size_t k = 0;
  for (const double run : own) {
    const double s = run / own.back() * whole;
    while (k + 2 < at.size() && at[k + 1] < s) ++k;
    const double u = std::clamp((s - at[k]) / (at[k + 1] - at[k]), 0.0, 1.0);
    wanted.push_back(std::lerp(target[k].curvature, target[k + 1].curvature, u));
  }
  return wanted;
}

/// Gives a run the rhythm asked for, as far as `most` lets its points move.
DrivenRun give_rhythm(const std::vector<Point2>& points, bool closed, double most,
                      fit::WantedRhythm wanted, std::vector<curve::Bezier2>& pieces) {
  const CalmQuintics calm = calm_quintics(points, closed, most, pieces);
  const auto& from = calm.pieces.empty() ? pieces : calm.pieces;
  const fit::RhythmTarget target = fit::rhythm_target({from, 0}, closed, wanted);
  CalmQuintics given =
      quintics_towards(points, closed, most, target_at_points(target.places, from, points));
  const double before = off_target({pieces, 0}, target.places);
  const double after = given.pieces.empty() ? before : off_target({given.pieces, 0}, target.places);
  if (after < before) pieces = std::move(given.pieces);
  return {pieces.size(), target.places, before, std::min(before, after), target.straight_ended};
}

/// How far driving may take the curve of a line; in a picture, on its ink.
double drive_room(double width, const StrokeCurveOptions& options, bool in_picture) {
  const double room = kDriveTolerances * options.tolerance;
  const double on_ink = in_picture ? std::max(options.tolerance, 0.5 * width) : room;
  return std::max(std::min(room, on_ink), kDriveShare * width);
}

/// Takes the waves out of a run's curvature; where asked for, gives what is left its rhythm, unless
/// that brings waves back.
void drive(const std::vector<Point2>& points, bool closed, double most,
           const StrokeCurveOptions& options, std::vector<curve::Bezier2>& pieces,
           std::vector<DrivenRun>& runs) {
  if (points.size() < kFewestDriven) {
    runs.push_back({pieces.size(), {}, 0, 0, 0});
    return;
  }
  const bool rhythm = options.aim == CurvatureAim::rhythm;
  if (rhythm && options.rhythm != fit::WantedRhythm::own && options.tolerance > 0) {
    runs.push_back(give_rhythm(points, closed, most, options.rhythm, pieces));
    return;
  }
  const double calming = rhythm ? 0.5 * most : most;
  CalmQuintics calm;
  if (options.tolerance > 0) calm = calm_quintics(points, closed, calming, pieces);
  const curve::PiecewiseBezier given{pieces, 0};
  if (!calm.pieces.empty()) pieces = calm.pieces;
  if (rhythm || options.tolerance <= 0) {
    const curve::PiecewiseBezier chain{pieces, 0};
    auto driven = pieces;
    const fit::RhythmTarget target = rhythm ? fit::rhythm_target(chain, closed, options.rhythm)
                                            : fit::RhythmTarget{fit::smooth_target(chain, closed)};
    auto done = drive_to(target.places, closed, calming, driven);
    if (options.tolerance <= 0 || waves_of(driven) <= waves_of(pieces)) {
      pieces = std::move(driven);
      done.front().straight_ended = target.straight_ended;
      runs.insert(runs.end(), done.begin(), done.end());
      return;
    }
  }
  const std::vector<Point2>& line = calm.pieces.empty() ? points : calm.line;
  const auto target = targets_beside(pieces, line, closed);
  const double after = off_target({pieces, 0}, target);
  const double before =
      calm.pieces.empty() ? after : off_target(given, targets_beside(given.pieces, line, closed));
  runs.push_back({pieces.size(), target, before, after, 0});
}

/// Targets and errors of all parts as those of the whole stroke.
void report_drive(const std::vector<DrivenRun>& runs, Stroke& stroke) {
  double offset = 0;
  double before = 0;
  double after = 0;
  for (const DrivenRun& run : runs) {
    const auto count = static_cast<double>(run.pieces);
    for (const fit::CurvatureTarget& t : run.target)
      stroke.target.push_back(
          {(offset + t.t * count) / static_cast<double>(stroke.curve.size()), t.curvature});
    offset += count;
    stroke.straight_ended += run.straight_ended;
    before += static_cast<double>(run.target.size()) * run.before * run.before;
    after += static_cast<double>(run.target.size()) * run.after * run.after;
  }
  if (stroke.target.empty()) return;
  const auto all = static_cast<double>(stroke.target.size());
  stroke.driven = {std::sqrt(before / all), std::sqrt(after / all)};
}

/// The part of an axis that its group's points took.
std::array<Point2, 2> extent(const Axis& axis, double half_length) {
  return {axis.centre - half_length * axis.direction, axis.centre + half_length * axis.direction};
}

}  // namespace

Stroke curve_of(const FineStroke& fine, const StrokeCurveOptions& options, const Refiner* picture) {
  Stroke stroke;
  stroke.points = fine.points;
  stroke.closed = fine.closed;
  stroke.width = fine.width;
  stroke.widths = fine.widths;
  stroke.members = fine.members;
  SegmentOptions segments{options.straightness, options.corner_angle, fine.width};
  if (picture)
    segments.ink = [&](Point2 from, core::Vector2 out, double near) {
      return picture->ink_ahead(from, out, near, fine.width);
    };
  const auto runs = fit_segments(fine.points, fine.closed, segments);
  std::vector<DrivenRun> driven;
  const double room = drive_room(fine.width, options, picture != nullptr);
  for (const SegmentRun& run : runs) {
    const std::vector<curve::Bezier2> quadratic = quadratics(run.vertices, run.closed);
    std::vector<curve::Bezier2> pieces = quintics_of(run, fine, quadratic, options);
    if (options.aim != CurvatureAim::none)
      drive(points_of(run, fine), run.closed, room, options, pieces, driven);
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
  report_drive(driven, stroke);
  if (!runs.front().closed && fine.closed) stroke.segments.pop_back();
  return stroke;
}

void scale(Stroke& stroke, double across, double down) {
  const double times = std::sqrt(across * down);
  const auto grow = [across, down](Point2& p) { p = {across * p.x, down * p.y}; };
  std::ranges::for_each(stroke.points, grow);
  std::ranges::for_each(stroke.segments, grow);
  for (auto& axis : stroke.axes) std::ranges::for_each(axis, grow);
  for (auto* pieces : {&stroke.quadratics, &stroke.curve})
    for (curve::Bezier2& piece : *pieces) std::ranges::for_each(piece.control, grow);
  for (fit::CurvatureTarget& target : stroke.target) target.curvature /= times;
  if (stroke.driven)
    stroke.driven = DriveReport{stroke.driven->before / times, stroke.driven->after / times};
  stroke.width *= times;
  for (double& width : stroke.widths) width *= times;
}

}  // namespace keyline::sketch
