#include "keyline/surface/edit.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/text.h"
#include "keyline/numeric/halving.h"
#include "keyline/surface/departure.h"
#include "keyline/surface/edit_targets.h"
#include "keyline/surface/reduce.h"
#include "keyline/surface/turn_over.h"

namespace keyline::surface {

using core::ErrorCode;
using core::fail;
using core::Result;

namespace {

struct Candidate {
  TradeOff tradeoff;
  BezierSurface surface;  ///< maybe of lower degree than the given one
};

/// The value under the conditions of its curves.
Result<SurfaceValue> value_of(const BezierSurface& s, const detail::EditTask& task) {
  classa::CavOptions general;
  general.alpha_max = task.options.alpha_max;
  general.end_tolerance = task.options.end_tolerance;
  return sav(s, [&](const NetworkCurve& c) {
    const CurveCondition& condition = task.conditions[task.index_of(c)];
    classa::CavOptions own = cav_options(condition, general);
    if (!condition.alpha && !condition.s) return own;
    const auto value = classa::cav(std::span<const core::Point3>(c.control), own);
    if (value || value.error().code != ErrorCode::undrawable) return own;
    own.alpha.reset();
    own.s = general.s;
    return own;
  });
}

/// Conditions that the net does not meet.
std::vector<MissedTarget> unmet_by(const Net& net, const detail::EditTask& task,
                                   const std::string& target) {
  std::vector<MissedTarget> all;
  const auto given = network_curves(task.net);
  const auto curves = network_curves(net);
  for (std::size_t i = 0; i < curves.size(); ++i)
    if (auto why = unmet(curves[i], given[i], task.conditions[i], task.options.alpha_max))
      all.push_back({target, curves[i].name, *why + " (" + ranges_text(task.conditions[i]) + ")"});
  return all;
}

Result<void> check(const BezierSurface& s, const EditOptions& o) {
  if (!(o.amount >= 0 && o.amount <= 1))
    return fail(ErrorCode::bad_input, "the amount is out of range", "give a number from 0 to 1",
                "amount");
  if (o.limit && !(*o.limit >= 0 && std::isfinite(*o.limit)))
    return fail(ErrorCode::bad_input, "the limit is negative or not finite",
                "give a length of 0 or more", "limit");
  if (auto sound = validate(o.conditions, s.net, o.alpha_max); !sound) return sound;
  const double size = extent(s.net);
  for (const NetworkCurve& c : network_curves(s.net))
    for (std::size_t i = 1; i < c.control.size(); ++i)
      if (!(core::distance(c.control[i - 1], c.control[i]) > 1e-9 * size))
        return fail(ErrorCode::bad_input, "an edge of " + c.name + " has no length",
                    "edit a patch without collapsed edges", c.name);
  return {};
}

/// The target itself at the end of the way, which keeps its degree.
BezierSurface blend(const BezierSurface& s, const BezierSurface& whole, double amount) {
  if (amount == 1) return whole;
  BezierSurface between = s;
  const Net target =
      elevate_degree(whole, s.net.rows - whole.net.rows, s.net.columns - whole.net.columns).net;
  for (std::size_t i = 0; i < s.net.points.size(); ++i)
    between.net.points[i] = core::mix(s.net.points[i], target.points[i], amount);
  return between;
}

/// SAV that differs by less is the same.
constexpr double kSameSav = 1e-6;

/// Less SAV wins, the nearer one of (nearly) equals.
const Candidate* best_of(const std::vector<Candidate>& all, std::optional<double> limit) {
  const Candidate* best = nullptr;
  for (const Candidate& c : all) {
    if (limit && c.tradeoff.departure > *limit) continue;
    const bool better = !best || c.tradeoff.sav < best->tradeoff.sav - kSameSav;
    if (better) best = &c;  // candidates come by growing departure
  }
  return best;
}

/// Largest amount up to `most` at which the blend stays within the limit.
double amount_within(const BezierSurface& s, const BezierSurface& target, double limit,
                     double most) {
  constexpr int kHalvings = 10;  // to a thousandth of it
  return numeric::largest_share_that_holds(
      [&](double amount) { return departure_bound(s, blend(s, target, amount), limit) <= limit; },
      most, kHalvings);
}

/// Sorts by departure and leaves out what is no choice: the same as another, or twice as far away
/// as one of no higher SAV.
void drop_poor(std::vector<Candidate>& all) {
  std::ranges::stable_sort(all, {}, [](const Candidate& c) { return c.tradeoff.departure; });
  const auto same = [](const Candidate& a, const Candidate& b) { return a.surface == b.surface; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  const std::vector<Candidate> others = all;
  std::erase_if(all, [&](const Candidate& c) {
    return std::any_of(others.begin(), others.end(), [&](const Candidate& o) {
      return o.tradeoff.sav <= c.tradeoff.sav && 2 * o.tradeoff.departure < c.tradeoff.departure;
    });
  });
}

/// Targets that meet the conditions of a task, as far from `given` as they are.
void add_candidates(const BezierSurface& given, const detail::EditTask& task,
                    const std::string& prefix, detail::TargetSet found, std::vector<Candidate>& all,
                    std::vector<MissedTarget>& missed) {
  for (MissedTarget& m : found.missed) {
    m.target = prefix + m.target;
    missed.push_back(std::move(m));
  }
  for (const detail::Target& target : found.targets) {
    auto unmet = unmet_by(target.net, task, prefix + target.name);
    if (!unmet.empty()) {
      missed.push_back(std::move(unmet.front()));
      continue;
    }
    BezierSurface moved{target.net, {}};
    if (turns_over(given, moved)) {
      missed.push_back({prefix + target.name, "the patch", "its normal would turn over"});
      continue;
    }
    const auto value = value_of(moved, task);
    if (!value) continue;
    const double away = departure_bound(given, moved);
    all.push_back({{prefix + target.name, away, value->sav}, std::move(moved)});
    task.options.progress.report(0.5 + 0.5 * all.size() / found.targets.size(), "trade-off");
  }
}

/// Where its own degree leaves more equations than freedoms: the targets of the nearest bicubic
/// patch with the same corners. Curves are numbered anew there, so that none may have conditions.
void add_bicubic(const BezierSurface& s, const EditOptions& options, std::vector<Candidate>& all,
                 std::vector<MissedTarget>& missed) {
  if (options.keep != Keep::corners || !options.conditions.empty()) return;
  if (detail::solvable(s.net)) return;
  const BezierSurface lower =
      reduced_degree(s, std::min(s.net.rows - 1, 3), std::min(s.net.columns - 1, 3));
  const detail::EditTask task{lower.net, options, conditions_by_curve({}, lower.net)};
  add_candidates(s, task, "bicubic, ", detail::edit_targets(task), all, missed);
}

std::vector<Candidate> candidates_of(const BezierSurface& s, const detail::EditTask& task,
                                     std::vector<MissedTarget>& missed) {
  std::vector<Candidate> all;
  add_candidates(s, task, "", detail::edit_targets(task), all, missed);
  if (all.empty() && !task.options.conditions.empty()) {
    detail::TargetSet conditioned;
    detail::add_conditions(task, conditioned);
    add_candidates(s, task, "", std::move(conditioned), all, missed);
  }
  add_bicubic(s, task.options, all, missed);
  drop_poor(all);
  return all;
}

std::unexpected<core::Failure> nothing_found(const EditResult& result, bool conditions) {
  std::string message =
      conditions ? "no net was found that meets the conditions" : "no Class A net was found";
  for (std::size_t i = 0; i < result.missed.size(); ++i) {
    const MissedTarget& m = result.missed[i];
    message += (i == 0 ? ": " : "; ") + m.target + ", " + m.curve + ": " + m.why;
  }
  return fail(ErrorCode::undrawable, std::move(message),
              conditions ? "widen the ranges of the curves named, or keep less"
                         : "keep less (\"start\"), or straighten rows and columns that turn by "
                           "more than a right angle",
              conditions ? "conditions" : "surface");
}

/// Slides to the target, as far as the limit allows.
Result<void> slide(const BezierSurface& s, const Candidate& target, const detail::EditTask& task,
                   EditResult& result) {
  const EditOptions& options = task.options;
  result.target = target.tradeoff.name;
  if (options.limit)
    result.amount = amount_within(s, target.surface, *options.limit, options.amount);
  result.surface = blend(s, target.surface, result.amount);
  if (turns_over(s, result.surface))
    return fail(ErrorCode::undrawable, "the patch would turn over on the way to its target",
                "go the whole way, or keep less", "amount");
  const Net& net = result.surface.net;
  const bool lower = net.rows != s.net.rows || net.columns != s.net.columns;
  auto after = lower ? value_of(result.surface, {net, options, conditions_by_curve({}, net)})
                     : value_of(result.surface, task);
  if (!after) return std::unexpected(after.error());
  result.after = std::move(*after);
  result.departure = departure_bound(s, result.surface);
  if (!lower) result.unmet = unmet_by(net, task, result.target);
  return {};
}

/// Towards the nearest target on the way to which, as far as the limit allows, SAV does not rise;
/// `result` as it is where there is none. One that has to be left goes the way to the first.
Result<EditResult> go_part_of_the_way(const BezierSurface& s, const std::vector<Candidate>& all,
                                      const detail::EditTask& task, bool given_will_do,
                                      EditResult result) {
  for (const Candidate& c : all) {
    EditResult part = result;
    if (auto done = slide(s, c, task, part); !done) return std::unexpected(done.error());
    const double rise = part.after.sav - part.before.sav;
    if (!given_will_do || rise <= kSameSav) return part;
    result.missed.push_back({c.tradeoff.name, "the patch",
                             "SAV would rise by " + core::number_text(rise, 4) +
                                 " on the part of the way that the limit allows"});
  }
  result.amount = 0;
  return result;
}

BezierSurface moved_by(BezierSurface s, core::Vector3 by) {
  for (core::Point3& p : s.net.points) p = p + by;
  return s;
}

Result<EditResult> edit_here(const BezierSurface& s, const EditOptions& options) {
  if (auto sound = sav(s, classa::CavOptions{.alpha_max = options.alpha_max}); !sound)
    return std::unexpected(sound.error());
  if (auto sound = check(s, options); !sound) return std::unexpected(sound.error());
  const detail::EditTask task{s.net, options, conditions_by_curve(options.conditions, s.net)};
  auto before = value_of(s, task);
  if (!before) return std::unexpected(before.error());
  EditResult result{s, *before, *before, 0, options.amount, "as given", {}, {}, {}};
  const auto all = candidates_of(s, task, result.missed);
  if (options.progress.stop_requested()) return fail(ErrorCode::cancelled, "cancelled");
  for (const Candidate& c : all) result.tradeoff.push_back(c.tradeoff);
  const bool given_will_do = unmet_by(s.net, task, {}).empty();
  if (all.empty() && (options.conditions.empty() || !given_will_do))
    return nothing_found(result, !options.conditions.empty());
  const Candidate* best = best_of(all, options.limit);
  if (!best && !all.empty() && options.part_of_the_way)
    return go_part_of_the_way(s, all, task, given_will_do, std::move(result));
  if (!best && !given_will_do)
    return fail(ErrorCode::undrawable, "no net that meets the conditions lies within the limit",
                "allow a departure of " + core::number_text(all.front().tradeoff.departure, 4),
                "limit");
  if (!best || (given_will_do && best->tradeoff.sav >= before->sav)) return result;
  if (auto done = slide(s, *best, task, result); !done) return std::unexpected(done.error());
  return result;
}

/// Put back where it was: points that did not move keep their last digits.
BezierSurface put_back(const BezierSurface& s, const BezierSurface& here, BezierSurface edited,
                       core::Vector3 by) {
  const bool alike = edited.net.points.size() == here.net.points.size();
  for (std::size_t i = 0; i < edited.net.points.size(); ++i) {
    core::Point3& p = edited.net.points[i];
    p = alike && p == here.net.points[i] ? s.net.points[i] : p + by;
  }
  return edited;
}

}  // namespace

/// About its first corner: far from the origin rounding of the places is more than nearly dependent
/// equations bear.
Result<EditResult> edit(const BezierSurface& s, const EditOptions& options) {
  if (s.net.points.empty()) return edit_here(s, options);
  const core::Vector3 away = s.net.points[0] - core::Point3{};
  const BezierSurface here = moved_by(s, -away);
  auto result = edit_here(here, options);
  if (result) result->surface = put_back(s, here, std::move(result->surface), away);
  return result;
}

Result<void> move_edit(const BezierSurface& s, const BezierSurface& moved,
                       const EditOptions& options, EditResult& result) {
  const detail::EditTask task{s.net, options, conditions_by_curve(options.conditions, s.net)};
  auto after = value_of(moved, task);
  if (!after) return std::unexpected(after.error());
  result.after = std::move(*after);
  result.surface = moved;
  result.departure = departure_bound(s, moved);
  result.unmet = unmet_by(moved.net, task, result.target);
  return {};
}

}  // namespace keyline::surface
