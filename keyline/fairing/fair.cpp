#include "keyline/fairing/fair.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyline/core/polygon.h"
#include "keyline/core/text.h"
#include "keyline/fairing/assemble.h"
#include "keyline/fairing/free_ends.h"
#include "keyline/fairing/reading.h"
#include "keyline/fairing/runs.h"

namespace keyline::fairing {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;

constexpr double kCornerRoom =
    0.9;  // of the tolerance: how far chains may meet from a corner's point

constexpr double kOutside = 1e-9;  // of the length: farther out is no matter of rounding

Result<void> check(const acquire::KeyLine& line, const FairOptions& options) {
  if (line.points.size() < 2)
    return fail(ErrorCode::bad_input, "a key-line needs at least two points", "give more points");
  if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
    return fail(ErrorCode::bad_input, "the tolerance is not a length",
                "give a number greater than 0", "tolerance");
  if (options.sigmas && options.tolerance > 0)
    return fail(ErrorCode::bad_input, "the tolerance is given twice",
                "give either \"tolerance\" or \"sigmas\"", "sigmas");
  if (options.sigmas && !(line.noise > 0))
    return fail(ErrorCode::bad_input, "these points have no noise to count the tolerance in",
                "give \"tolerance\", or the \"noise\"", "sigmas");
  if (options.spline.order < 4 || options.spline.order > 6)
    return fail(ErrorCode::bad_input, "the order of the spline is out of range", "give 4, 5 or 6",
                "order");
  if (options.waves && *options.waves < 0)
    return fail(ErrorCode::bad_input, "the number of waves is negative", "give 0 or more", "waves");
  if (options.pieces < 0)
    return fail(ErrorCode::bad_input, "the number of pieces is negative", "give 1 or more",
                "pieces");
  for (const std::size_t index : options.must_pass)
    if (index >= line.points.size())
      return fail(ErrorCode::bad_input, "a point to be passed does not exist",
                  fmt::format("give indices below {}", line.points.size()), "must_pass");
  if (const auto& r = options.region; r && !(r->low >= 0 && r->low < r->high && r->high <= 1))
    return fail(ErrorCode::bad_input, "the region is not a part of the key-line",
                "give a:b with 0 <= a < b <= 1", "region");
  return {};
}

void note_run(FairResult& result, const detail::RunResult& run, std::size_t index) {
  const std::string where = fmt::format("run {}", index);
  const std::string pieces = core::counted(run.chain.pieces.size(), "piece");
  if (!run.dense.joints.empty())
    result.notes.push_back(fmt::format("{}: {}, read off the graph of curvature", where, pieces));
  else
    result.notes.push_back(fmt::format("{}: {}, merged from {}", where, pieces, run.start_pieces));
  if (run.exact)
    result.notes.push_back(where +
                           ": the points are reproduced to rounding, so the chain that "
                           "does so is given rather than a shorter one");
  if (run.calm_missed)
    result.notes.push_back(
        where +
        ": the calmest chain did not come out within the tolerance, or wandered off "
        "between points, so the shortest one is given");
  if (run.straightened > 0)
    result.notes.push_back(where + ": " +
                           core::counted(run.straightened, "piece is an exact line or arc",
                                         "pieces are exact lines or arcs"));
}

/// The whole of one key-line.
class Job {
 public:
  Job(const acquire::KeyLine& line, const FairOptions& options) : line_(line), options_(options) {
    result_.length = core::polygon_length(line.points, line.closed);
    if (line.length > 0) result_.length = std::min(result_.length, line.length);
    result_.noise = line.noise;
    result_.tolerance = options.tolerance > 0 ? options.tolerance
                        : options.sigmas
                            ? *options.sigmas * line.noise
                            : default_tolerance(line.noise, result_.length, line.points.size());
    result_.closed = line.closed || line.ends_meet;
    result_.notes = line.report.notes;
  }

  Result<FairResult> run() {
    if (options_.region) return run_region();
    runs_ = detail::runs_of(line_, options_);
    if (auto sound = bound_runs(); !sound) return std::unexpected(sound.error());
    for (std::size_t k = 0; k < runs_.size(); ++k)
      if (auto done = fair_one(k, {}); !done) return std::unexpected(done.error());
    tie_corners();
    return finish();
  }

 private:
  core::Progress progress_of(std::size_t k) const {
    const double n = static_cast<double>(runs_.size());
    return core::part_of(options_.progress, static_cast<double>(k) / n,
                         static_cast<double>(k + 1) / n);
  }

  detail::RunOptions run_options(std::size_t k) const {
    const core::Progress whole = progress_of(k);
    const double share = runs_[k].length / result_.length;
    const int pieces = options_.pieces == 0
                           ? 0
                           : std::max(1, static_cast<int>(std::lround(options_.pieces * share)));
    return {.tolerance = result_.tolerance,
            .noise = line_.noise,
            .pieces = pieces,
            .criterion = options_.criterion,
            .smoothness = options_.smoothness,
            .waves = options_.waves,
            .slopes = options_.slopes,
            .asked = asked_.empty() ? std::vector<int>{} : asked_[k],
            .threads = options_.threads,
            .progress = core::part_of(whole, 0.4, 1)};
  }

  /// Runs learn what they stay inside; those whose outer ends stand on a border, or beyond it by
  /// their noise, end on it. bad_input where a point lies farther out than the tolerance.
  Result<void> bound_runs() {
    const std::vector<core::HalfPlane> inside = half_planes(options_.keep_inside);
    for (const core::HalfPlane& half : inside)
      for (const core::Point2 p : line_.points)
        if (core::depth(half, p) < -result_.tolerance)
          return fail(ErrorCode::bad_input,
                      fmt::format("the point ({:.6g}, {:.6g}) lies {:.3g} outside", p.x, p.y,
                                  -core::depth(half, p)),
                      "correct it, or give a wider bound", "keep_inside");
    const auto tie = [&](std::optional<core::Point2>& place, core::Point2 end) {
      for (const core::HalfPlane& half : inside)
        if (const double depth = core::depth(half, end); depth <= 0)
          place = end = end - depth * half.normal;
    };
    for (detail::Run& run : runs_) run.inside = inside;
    if (runs_.front().closed || line_.closed) return {};
    if (runs_.front().clamp_start == Clamp::none)
      tie(runs_.front().tie_start, line_.points.front());
    if (runs_.back().clamp_end == Clamp::none) tie(runs_.back().tie_end, line_.points.back());
    return {};
  }

  /// The place, or the nearest to it that leaves the corner's own point inside the tolerance.
  core::Point2 near_corner(core::Point2 place, core::Point2 corner) const {
    const double most = kCornerRoom * result_.tolerance;
    const double far = core::distance(place, corner);
    return far <= most ? place : corner + (most / far) * (place - corner);
  }

  /// Neighbouring chains end in one place at a corner: half way between their ends.
  void tie_corners() {
    const std::size_t n = runs_.size();
    if (runs_.front().closed) return;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t next = (k + 1) % n;
      if (next == 0 && !result_.closed) break;
      if (runs_[k].clamp_end != Clamp::none || runs_[next].clamp_start != Clamp::none) continue;
      const core::Point2 from = lac::end_pose(solved_[k].chain).position;
      const core::Point2 to = solved_[next].chain.start.position;
      core::Point2 place = near_corner(from + 0.5 * (to - from), runs_[k].points.back());
      for (const core::HalfPlane& half : runs_[k].inside)
        place = place - std::min(0.0, core::depth(half, place)) * half.normal;
      runs_[k].tie_end = runs_[next].tie_start = place;
    }
    for (std::size_t k = 0; k < n; ++k)
      if (runs_[k].tie_start || runs_[k].tie_end)
        detail::tie_ends(solved_[k], runs_[k], result_.splines[k], run_options(k));
  }

  Result<curve::BSpline2> spline_of(std::size_t k) {
    const detail::Run& run = runs_[k];
    fit::SplineFitOptions fit = options_.spline;
    fit.order = std::min<int>(fit.order, static_cast<int>(run.points.size()));
    fit.seed = options_.seed;
    fit.threads = options_.threads;
    fit.closed = run.closed && run.points.size() > 8;
    fit.must_pass = run.must_pass;
    fit.rounding = line_.rounding;
    fit.progress = core::part_of(progress_of(k), 0, 0.4);
    const auto found = fit::fit_spline(run.points, run.weights, fit);
    if (!found) return std::unexpected(found.error());
    result_.spline_bic += found->bic;
    return found->curve;
  }

  Result<void> fair_one(std::size_t k, const curve::BSpline2& given) {
    if (options_.progress.stop_requested() && solved_.empty())
      return fail(ErrorCode::cancelled, "cancelled before there was a result", "");
    curve::BSpline2 spline = given;
    if (spline.control.empty()) {
      auto own = spline_of(k);
      if (!own) return std::unexpected(own.error());
      spline = std::move(*own);
    }
    split(spline, k);
    solved_.push_back(detail::fair_run(runs_[k], spline, run_options(k)));
    note_run(result_, solved_.back(), k);
    if (options_.waves && solved_.back().turns > *options_.waves)
      result_.notes.push_back(fmt::format("run {}: {} wanted, {} stay: fewer leave the tolerance",
                                          k, core::counted(std::size_t(*options_.waves), "wave"),
                                          solved_.back().turns));
    result_.splines.push_back(std::move(spline));
    return {};
  }

  void split(const curve::BSpline2& spline, std::size_t k) {
    analysis::SplitOptions options;
    options.noise = std::max(line_.noise, 0.1 * result_.tolerance);
    const analysis::Split found = analysis::split_monotone(spline, options);
    if (!found.merged.empty())
      result_.notes.push_back(fmt::format(
          "run {}: {} in the spline's curvature, of less than {:.3g} sideways, taken for noise", k,
          core::counted(found.merged.size(), "wave"), found.threshold));
    for (const auto& piece : found.pieces) {
      result_.monotone.push_back(piece);
      result_.monotone_spline.push_back(static_cast<int>(k));
    }
  }

  Result<FairResult> run_region() {
    const core::Interval region = *options_.region;
    acquire::KeyLine smooth = line_;
    smooth.corners.clear();
    runs_ = {line_.closed ? detail::runs_of(smooth, {}).front()
                          : detail::run_between(smooth, 0, line_.points.size() - 1)};
    auto whole = spline_of(0);
    if (!whole) return std::unexpected(whole.error());
    const auto range = detail::points_in_region(line_.points, line_.closed, region, *whole);
    if (range.last < range.first + 4)
      return fail(ErrorCode::bad_input, "the region holds fewer than five points",
                  "choose a larger region", "region");
    const curve::BSpline2 inside = subcurve(*whole, range.t_first, range.t_last);
    runs_ = {detail::run_between(line_, range.first, range.last)};
    if (auto sound = bound_runs(); !sound) return std::unexpected(sound.error());
    const bool from_start = range.first == 0 && !line_.closed;
    const bool to_end = range.last + 1 == line_.points.size() && !line_.closed;
    runs_[0].clamp_start = from_start ? options_.clamp.start : Clamp::g2;
    runs_[0].clamp_end = to_end ? options_.clamp.end : Clamp::g2;
    if (auto done = fair_one(0, inside); !done) return std::unexpected(done.error());
    if (range.t_first > 0) kept_before_ = subcurve(*whole, 0, range.t_first);
    if (range.t_last < 1) kept_after_ = subcurve(*whole, range.t_last, 1);
    return finish();
  }

  Result<FairResult> finish() {
    for (std::size_t k = 0; k < runs_.size(); ++k)
      detail::place_free_ends(solved_[k], runs_[k], run_options(k));
    if (auto read = read_all(); !read) return std::unexpected(read.error());
    if (!options_.interpretations.empty()) {
      if (auto done = reinterpret(); !done) return std::unexpected(done.error());
    }
    note_outside();
    detail::assemble(result_, solved_, kept_before_, kept_after_);
    result_.cancelled = options_.progress.stop_requested();
    return std::move(result_);
  }

  void note_outside() {
    for (std::size_t k = 0; k < runs_.size(); ++k)
      for (const core::HalfPlane& half : runs_[k].inside)
        result_.outside = std::max(result_.outside, detail::outside(solved_[k].chain, half));
    if (result_.outside > kOutside * result_.length)
      result_.notes.push_back(fmt::format("a bound is passed by {:.3g}", result_.outside));
    else
      result_.outside = 0;
  }

  /// Pieces, offsets and the deviation from the solved runs as they stand.
  Result<void> read_all() {
    result_.pieces.clear();
    result_.offsets.assign(line_.points.size(), 0);
    result_.within_tolerance = true;
    double start = 0;
    for (std::size_t k = 0; k < solved_.size(); ++k) {
      detail::read_run(result_, solved_[k], runs_[k], static_cast<int>(k), start, run_options(k));
      start += lac::arc_length(solved_[k].chain);
    }
    detail::measure_deviation(result_);
    return {};
  }

  Result<void> reinterpret() {
    std::vector<std::vector<detail::PieceWish>> wishes(solved_.size());
    for (const InterpretationOverride& asked : options_.interpretations) {
      if (asked.piece < 0 || asked.piece >= static_cast<int>(result_.pieces.size()))
        return fail(ErrorCode::bad_input,
                    fmt::format("there is no piece {} to interpret", asked.piece),
                    fmt::format("the key-line has pieces 0 to {}", result_.pieces.size() - 1),
                    "interpretation");
      const FairPiece& piece = result_.pieces[asked.piece];
      auto wish = detail::wish_for(asked, piece.piece);
      if (!wish) return std::unexpected(wish.error());
      wishes[piece.curve].push_back(*wish);
    }
    asked_.resize(solved_.size());
    for (std::size_t k = 0; k < solved_.size(); ++k)
      if (!wishes[k].empty())
        asked_[k] =
            detail::apply_wishes(solved_[k], runs_[k], wishes[k], run_options(k), result_.notes);
    return read_all();
  }

  const acquire::KeyLine& line_;
  const FairOptions& options_;
  std::vector<detail::Run> runs_;
  std::vector<detail::RunResult> solved_;
  std::vector<std::vector<int>> asked_;  ///< pieces of every run that read as asked; empty: none
  std::optional<curve::BSpline2> kept_before_;
  std::optional<curve::BSpline2> kept_after_;
  FairResult result_;
};

}  // namespace

const char* impression(const FairPiece& piece) {
  return piece.told && piece.seen ? analysis::impression(piece.rhythm) : "";
}

Result<FairResult> fair(const acquire::KeyLine& line, const FairOptions& options) {
  if (auto sound = check(line, options); !sound) return std::unexpected(sound.error());
  return Job(line, options).run();
}

}  // namespace keyline::fairing
