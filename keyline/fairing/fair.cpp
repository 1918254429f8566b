#include "keyline/fairing/fair.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "keyline/core/polygon.h"
#include "keyline/core/text.h"
#include "keyline/fairing/asked.h"
#include "keyline/fairing/assemble.h"
#include "keyline/fairing/corner_points.h"
#include "keyline/fairing/corners.h"
#include "keyline/fairing/free_ends.h"
#include "keyline/fairing/joint_rates.h"
#include "keyline/fairing/reading.h"
#include "keyline/fairing/runs.h"
#include "keyline/fairing/shortest_run.h"
#include "keyline/fairing/solve_runs.h"
#include "keyline/fairing/symmetric_run.h"
#include "keyline/fairing/turned_start.h"
#include "keyline/fairing/until_fair.h"
#include "keyline/lac/chain/chain_graph.h"

namespace keyline::fairing {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;

using Splines = std::vector<curve::BSpline2>;

constexpr double kPlainShare = 0.6;  // of the time, where a symmetric answer is looked for too
constexpr double kAlike = 0.98;      // of a limit: as good as on it

/// The whole of one key-line.
class Job {
 public:
  Job(const acquire::KeyLine& line, const FairOptions& options,
      detail::FoundBefore* found = nullptr, const FairResult* before = nullptr)
      : line_(line), options_(options), found_(found), before_(options.region ? nullptr : before) {
    size_ = core::polygon_length(line.points, line.closed);
    if (line.length > 0) size_ = std::min(size_, line.length);
    result_.noise = line.noise;
    result_.tolerance = options.tolerance > 0 ? options.tolerance
                        : options.sigmas      ? *options.sigmas * line.noise
                                         : default_tolerance(line.noise, size_, line.points.size());
    result_.closed = line.closed || line.ends_meet;
    result_.smoothness = options.smoothness.value_or(detail::kNearAsNoise);
    result_.notes = line.report.notes;
  }

  Result<FairResult> run() {
    if (options_.region) return run_region();
    runs_ = detail::runs_of(line_, options_);
    detail::meet_between_points(runs_, result_.tolerance, line_.closed);
    if (auto sound = detail::bound_runs(runs_, line_, options_, result_.tolerance); !sound)
      return std::unexpected(sound.error());
    const auto mirror = asked_mirror();
    if (!mirror) return std::unexpected(mirror.error());
    const bool exactly = *mirror && options_.symmetric.mode != SymmetricMode::off;
    if (exactly) share_ = kPlainShare;
    if (auto done = fair_all(before_ ? before_->splines : Splines{}); !done)
      return std::unexpected(done.error());
    detail::tie_corners(runs_, solved_, result_.splines, options_of_runs(), result_.closed);
    detail::make_rates_one(result_, solved_, runs_, options_of_runs());
    for (std::size_t k = 0; k < runs_.size(); ++k)
      detail::place_free_ends(solved_[k], runs_[k], run_options(k));
    if (*mirror) tell_symmetry(**mirror);
    if (exactly) {
      if (auto done = mirror_answer(**mirror); !done) return std::unexpected(done.error());
    }
    return finish();
  }

 private:
  core::Progress progress_of(std::size_t k) const {
    const double n = static_cast<double>(runs_.size());
    return core::part_of(options_.progress, share_ * static_cast<double>(k) / n,
                         share_ * static_cast<double>(k + 1) / n);
  }

  detail::OptionsOf options_of_runs() const {
    return [this](std::size_t k) { return run_options(k); };
  }

  detail::RunOptions run_options(std::size_t k) const {
    const core::Progress whole = progress_of(k);
    const double share = runs_[k].length / size_;
    const int wanted = static_cast<int>(std::lround(options_.pieces * share));
    const int pieces = options_.pieces == 0 ? 0 : std::max(1, wanted);
    return {.tolerance = result_.tolerance,
            .noise = line_.noise,
            .pieces = pieces,
            .criterion = options_.criterion,
            .smoothness = result_.smoothness,
            .waves = options_.waves,
            .max_rate = options_.max_rate,
            .slopes = options_.slopes,
            .joints = options_.joints,
            .before = found_,
            .threads = options_.threads,
            .progress = core::part_of(whole, 0.4, 1)};
  }

  fit::SplineFitOptions spline_options() const {
    fit::SplineFitOptions fit = options_.spline;
    fit.seed = options_.seed;
    fit.threads = options_.threads;
    fit.rounding = line_.rounding;
    return fit;
  }

  /// All runs, with their splines where these are known.
  Result<void> fair_all(const Splines& known) {
    if (options_.progress.stop_requested())
      return fail(ErrorCode::cancelled, "cancelled before there was a result", "");
    auto found = detail::solve_runs(runs_, known, spline_options(), options_of_runs(),
                                    core::part_of(options_.progress, 0, share_));
    if (!found) return std::unexpected(found.error());
    if (before_) result_.spline_bic = before_->spline_bic;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      detail::SolvedRun& one = (*found)[k];
      result_.spline_bic += one.bic;
      split(one.spline, k);
      solved_.push_back(std::move(one.chain));
      result_.splines.push_back(std::move(one.spline));
    }
    return {};
  }

  void note_of_run(std::size_t k, const std::string& text) {
    detail::note_of_run(result_, k, runs_.size(), text);
  }

  /// What came of every run in the end: where ends were tied, pieces may be others than at first.
  void note_runs() {
    for (std::size_t k = 0; k < solved_.size(); ++k) {
      detail::note_run(result_, solved_[k], k, solved_.size());
      const auto wanted = static_cast<std::size_t>(run_options(k).pieces);
      const std::size_t found = solved_[k].chain.pieces.size();
      if (wanted > 0 && found != wanted)
        note_of_run(k, fmt::format("{} wanted, {} found", core::counted(wanted, "piece"), found));
      if (!options_.waves) continue;
      const int stay = analysis::comb_figures(lac::curvature_graph(solved_[k].chain)).waves;
      if (stay > *options_.waves)
        note_of_run(k, fmt::format("{} wanted, {} stay: none with fewer was found within the "
                                   "tolerance",
                                   core::counted(std::size_t(*options_.waves), "wave"), stay));
    }
  }

  void split(const curve::BSpline2& spline, std::size_t k) {
    analysis::SplitOptions options;
    options.noise = std::max(line_.noise, 0.1 * result_.tolerance);
    const analysis::Split found = analysis::split_monotone(spline, options);
    if (!found.merged.empty())
      note_of_run(
          k,
          fmt::format("{} in the spline's curvature, of less than {:.3g} sideways, taken for noise",
                      core::counted(found.merged.size(), "wave"), found.threshold));
    for (const auto& piece : found.pieces) {
      result_.monotone.push_back(piece);
      result_.monotone_spline.push_back(static_cast<int>(k));
    }
  }

  /// The line in which the points mirror; none where they do not.
  Result<std::optional<Mirror>> asked_mirror() const {
    const Symmetric& asked = options_.symmetric;
    const std::string against = detail::against_symmetry(options_);
    if (asked.mode != SymmetricMode::off && !against.empty())
      return fail(ErrorCode::bad_input, "a symmetric answer does not go with " + against,
                  "leave one of them out", "symmetric");
    if (asked.mode != SymmetricMode::line)
      return detail::mirror_within_noise(line_, result_.tolerance);
    const Mirror found = detail::mirror_in({asked.point, asked.direction}, line_);
    if (found.largest > 2 * result_.tolerance)
      return fail(ErrorCode::bad_input,
                  fmt::format("the points are not symmetric about that line: their images lie up "
                              "to {:.3g} beside",
                              found.largest),
                  "give another line, or a larger tolerance", "symmetric");
    return std::optional<Mirror>{found};
  }

  void tell_symmetry(const Mirror& mirror) {
    result_.symmetry = {mirror.line.position, mirror.line.direction, mirror.rms, false};
    result_.notes.push_back(
        fmt::format("the points are symmetric about the line through {}, within {:.3g}{}",
                    detail::told(mirror.line), mirror.rms,
                    options_.symmetric.mode == SymmetricMode::off
                        ? "; symmetric: auto makes the answer symmetric too"
                        : ""));
  }

  /// The symmetric answer in place of the plain one, where it keeps the tolerance or the line was
  /// given.
  Result<void> mirror_answer(const Mirror& mirror) {
    const bool given = options_.symmetric.mode == SymmetricMode::line;
    const double from = std::exchange(share_, 1.0);
    const auto options = [this, from](std::size_t) {
      detail::RunOptions half = run_options(0);
      half.progress = core::part_of(options_.progress, from, 1);
      return half;
    };
    auto found = detail::solve_symmetric(line_, mirror.line, runs_, options);
    if (!found && given)
      return fail(ErrorCode::undrawable, found.error().message, found.error().hint, "symmetric");
    const double off = found ? detail::largest_of(*found, runs_) : 0;
    if (!found || (off > result_.tolerance && !given)) {
      result_.notes.push_back(
          "the answer is not symmetric: " +
          (found ? fmt::format("it would leave the tolerance by {:.3g}", off - result_.tolerance)
                 : found.error().message));
      return {};
    }
    const int more = detail::waves_of(*found) - detail::waves_of(solved_);
    solved_ = std::move(*found);
    result_.symmetry->exact = true;
    result_.notes.push_back(
        "the answer is exactly symmetric" +
        (more > 0 ? ", which takes " + core::counted(std::size_t(more), "more wave") : ""));
    return {};
  }

  Result<FairResult> run_region() {
    fit::SplineFitOptions of_whole = spline_options();
    of_whole.progress = core::part_of(options_.progress, 0, 0.4);
    auto plan = detail::plan_region(line_, options_, of_whole);
    if (!plan) return std::unexpected(plan.error());
    result_.spline_bic += plan->bic;
    runs_ = std::move(plan->runs);
    if (auto sound = detail::bound_runs(runs_, line_, options_, result_.tolerance); !sound)
      return std::unexpected(sound.error());
    if (auto done = fair_all(plan->splines); !done) return std::unexpected(done.error());
    detail::make_rates_one(result_, solved_, runs_, options_of_runs());
    for (std::size_t k = 0; k < runs_.size(); ++k)
      detail::place_free_ends(solved_[k], runs_[k], run_options(k));
    if (plan->members.size() > runs_.size())
      result_.notes.push_back(detail::note_of_kept(*plan, runs_.front().inside, result_.tolerance));
    kept_ = std::move(*plan);
    return finish();
  }

  Result<FairResult> finish() {
    note_runs();
    measure_all();
    if (auto done = reinterpret(); !done) return std::unexpected(done.error());
    note_outside();
    if (auto kept = limit_rate(); !kept) return std::unexpected(kept.error());
    note_limits();
    detail::assemble(result_, solved_, kept_.members);
    result_.cancelled = options_.progress.stop_requested();
    return std::move(result_);
  }

  /// The fastest rate; undrawable where a limit on it is not kept within the tolerance.
  Result<void> limit_rate() {
    for (const detail::RunResult& one : solved_)
      result_.rate = std::max(result_.rate, lac::fastest_rate(one.chain));
    if (!options_.max_rate || options_.progress.stop_requested()) return {};
    if (result_.within_tolerance && result_.rate <= *options_.max_rate) return {};
    FairOptions without = options_;
    without.max_rate.reset();
    const auto plain = Job(line_, without).run();
    return fail(
        ErrorCode::undrawable,
        fmt::format("no curve within {:.4g} of the points was found whose curvature changes "
                    "by at most {:.4g}{}",
                    result_.tolerance, *options_.max_rate,
                    plain ? fmt::format("; without a limit it is {:.4g}", plain->rate) : ""),
        "give a larger limit or a larger tolerance", "max_rate");
  }

  /// Which limits bound, and a tolerance that asks for the points' errors.
  void note_limits() {
    if (result_.tolerance < result_.noise)
      result_.notes.push_back(
          fmt::format("the tolerance is smaller than the points' noise, {:.3g}: the curve follows "
                      "their errors",
                      result_.noise));
    result_.smoothness_counts =
        std::ranges::any_of(solved_, [](const detail::RunResult& one) { return one.spring > 0; });
    const auto lacs = [](const detail::RunResult& one) { return !one.dense.joints.empty(); };
    detail::note_slopes(result_, options_.slopes);
    if (!std::ranges::all_of(solved_, lacs)) return;
    const auto at_tolerance = std::ranges::count_if(
        result_.offsets, [&](double o) { return std::abs(o) > kAlike * result_.tolerance; });
    const auto at_slope = std::ranges::count_if(result_.pieces, [&](const FairPiece& p) {
      return std::ranges::any_of(p.slopes, [&](double slope) {
        return slope == options_.slopes.low || slope == options_.slopes.high;
      });
    });
    std::vector<std::string> bound;
    if (at_tolerance > 0)
      bound.push_back("the tolerance at " + core::counted(std::size_t(at_tolerance), "point"));
    if (at_slope > 0)
      bound.push_back("the range of slopes at " + core::counted(std::size_t(at_slope), "piece"));
    if (options_.max_rate && result_.rate > kAlike * *options_.max_rate)
      bound.emplace_back("how fast curvature may change");
    if (bound.empty()) bound.push_back(detail::held_from_within(solved_));
    result_.notes.push_back(
        fmt::format("what holds it from being calmer: {}", fmt::join(bound, ", ")));
  }

  void note_outside() {
    for (std::size_t k = 0; k < runs_.size(); ++k)
      for (const core::HalfPlane& half : runs_[k].inside)
        result_.outside = std::max(result_.outside, detail::outside(solved_[k].chain, half));
    if (result_.outside > 0)
      result_.notes.push_back(fmt::format("a bound is passed by {:.3g}", result_.outside));
  }

  /// Pieces, offsets and the deviation from the solved runs as they stand.
  void measure_all() {
    result_.pieces.clear();
    result_.offsets.assign(line_.points.size(), std::nan(""));
    result_.within_tolerance = true;
    std::vector<double> before = detail::kept_before(kept_.members, solved_.size());
    double start = 0;
    for (std::size_t k = 0; k < solved_.size(); ++k) {
      start += before[k];
      detail::add_run(result_, solved_[k], runs_[k], static_cast<int>(k), start,
                      asked_.empty() ? std::vector<int>{} : asked_[k]);
      start += lac::arc_length(solved_[k].chain);
    }
    detail::measure_deviation(result_);
  }

  Result<void> reinterpret() {
    if (options_.interpretations.empty()) return {};
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
    measure_all();
    return {};
  }

  const acquire::KeyLine& line_;
  const FairOptions& options_;
  detail::FoundBefore* found_;
  const FairResult* before_;  ///< the same with another smoothness, if there was one
  std::vector<detail::Run> runs_;
  std::vector<detail::RunResult> solved_;
  double share_ = 1;                     ///< of the progress that the runs as they are take
  std::vector<std::vector<int>> asked_;  ///< pieces of every run that read as asked; empty: none
  detail::RegionPlan kept_;              ///< what stays outside a region
  FairResult result_;
  double size_ = 0;  ///< length of the way through the points
};

}  // namespace

const char* impression(const FairPiece& piece) {
  return piece.told && piece.seen ? analysis::impression(piece.rhythm) : "";
}

Result<FairResult> fair(const acquire::KeyLine& line, const FairOptions& options) {
  if (auto sound = detail::check(line, options); !sound) return std::unexpected(sound.error());
  if (detail::runs_over_start(options)) {
    const detail::TurnedStart turned = detail::turn_start(line, options);
    auto result = fair(turned.line, turned.options);
    if (result) detail::turn_back(*result, turned.first);
    return result;
  }
  detail::FoundBefore found;
  auto result =
      detail::until_fair(line, options, [&](const FairOptions& o, const FairResult* before) {
        return Job(line, o, &found, before).run();
      });
  if (result) detail::read_pieces(*result, options.threads, options.progress);
  return result;
}

}  // namespace keyline::fairing
