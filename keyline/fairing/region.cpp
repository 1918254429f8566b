#include "keyline/fairing/region.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "keyline/core/polygon.h"
#include "keyline/curve/concept.h"
#include "keyline/curve/length.h"
#include "keyline/fairing/runs.h"
#include "keyline/fairing/solve_runs.h"

namespace keyline::fairing::detail {
namespace {

constexpr int kPerSpan = 32;  // places of a kept spline's span that are looked at

/// Parameter of the spline's point nearest to p, within a twentieth of the guess.
double foot_near(const curve::BSpline2& spline, core::Point2 p, double guess) {
  double best = guess;
  double reach = 0.05;
  while (reach > 1e-9) {
    double least = HUGE_VAL;
    const double middle = best;
    for (int k = -20; k <= 20; ++k) {
      const double t = std::clamp(middle + reach * k / 20, 0.0, 1.0);
      const double away = core::distance(evaluate(spline, t), p);
      if (away >= least) continue;
      least = away;
      best = t;
    }
    reach /= 10;
  }
  return best;
}

}  // namespace

RegionPoints points_in_region(const std::vector<core::Point2>& points, bool closed,
                              core::Interval region, const curve::BSpline2& spline) {
  std::vector<double> at(points.size(), 0);
  for (std::size_t i = 1; i < points.size(); ++i)
    at[i] = at[i - 1] + core::distance(points[i - 1], points[i]);
  RegionPoints found;
  const double total = at.back() + (closed ? core::distance(points.back(), points.front()) : 0.0);
  const auto first = std::lower_bound(at.begin(), at.end(), region.low * total);
  const auto last = std::upper_bound(at.begin(), at.end(), region.high * total);
  found.first = static_cast<std::size_t>(first - at.begin());
  found.last = static_cast<std::size_t>(last - at.begin()) - 1;
  const std::size_t end = points.size() - 1;
  if (found.first > 0)
    found.t_first = foot_near(spline, points[found.first], at[found.first] / total);
  if (found.last < end || closed)
    found.t_last = foot_near(spline, points[found.last], at[found.last] / total);
  return found;
}

namespace {

/// A run between corners, how far along the key-line it begins, the length of the way through its
/// points, and its spline.
struct Stretch {
  Run run;
  double from = 0;
  double length = 0;
  curve::BSpline2 spline;
};

/// Which ends of an open run are corners, where the next begins.
struct Corners {
  bool start = false;
  bool end = false;
};

class Planning {
 public:
  Planning(const acquire::KeyLine& line, const FairOptions& options)
      : line_(line), options_(options) {
    total_ = core::polygon_length(line.points, line.closed);
  }

  core::Result<void> add(Stretch stretch, Corners corners, const fit::SplineFitOptions& options) {
    Run& run = stretch.run;
    const std::size_t last = run.points.size() - 1;
    fit::SplineFitOptions fit = fit_of(run, options);
    if (corners.start) fit.must_pass.insert(fit.must_pass.begin(), 0);
    if (corners.end) fit.must_pass.push_back(last);
    const auto found = fit::fit_spline(run.points, run.weights, fit);
    if (!found) return std::unexpected(found.error());
    plan_.bic += found->bic;
    stretch.spline = found->curve;
    if (corners.start) stretch.spline.control.front() = run.points.front();
    if (corners.end) stretch.spline.control.back() = run.points.back();
    cut(stretch, corners);
    return {};
  }

  RegionPlan&& take() { return std::move(plan_); }

 private:
  /// Parts of the region within the stretch, in its order: where the key-line is closed it may come
  /// round to it again.
  std::vector<RegionPoints> parts_of(const Stretch& stretch) const {
    std::vector<RegionPoints> parts;
    for (const double round : {0.0, total_}) {
      const auto along = [&](double share) {
        return (share * total_ + round - stretch.from) / stretch.length;
      };
      const core::Interval region{along(options_.region->low), along(options_.region->high)};
      if (region.high <= 0 || region.low >= 1) continue;
      const RegionPoints part =
          points_in_region(stretch.run.points, stretch.run.closed, region, stretch.spline);
      if (part.last < part.first + 4) continue;
      parts.push_back(part);
    }
    return parts;
  }

  void cut(const Stretch& stretch, Corners corners) {
    const Run& whole = stretch.run;
    const std::size_t end = whole.points.size() - 1;
    std::vector<bool> faired(whole.points.size(), false);
    double kept_from = 0;
    for (const RegionPoints& part : parts_of(stretch)) {
      if (part.t_first > kept_from) keep(stretch.spline, kept_from, part.t_first);
      Run run = run_between(line_, whole.index[part.first],
                            whole.index[part.first] + (part.last - part.first));
      const bool from_start = part.first == 0 && !whole.closed;
      const bool to_end = part.last == end && !whole.closed;
      hold(run, from_start, to_end, corners);
      plan_.runs.push_back(std::move(run));
      plan_.splines.push_back(subcurve(stretch.spline, part.t_first, part.t_last));
      plan_.members.emplace_back();
      kept_from = part.t_last;
      std::fill(faired.begin() + static_cast<std::ptrdiff_t>(part.first),
                faired.begin() + static_cast<std::ptrdiff_t>(part.last) + 1, true);
    }
    if (kept_from < 1) keep(stretch.spline, kept_from, 1);
    measure(stretch, faired);
  }

  void keep(const curve::BSpline2& spline, double from, double to) {
    plan_.members.emplace_back(from == 0 && to == 1 ? spline : subcurve(spline, from, to));
  }

  /// Inside a stretch the run goes on as its spline does; at a corner it ends on its point.
  void hold(Run& run, bool from_start, bool to_end, Corners corners) const {
    run.clamp_start = !from_start ? Clamp::g2 : corners.start ? Clamp::none : options_.clamp.start;
    run.clamp_end = !to_end ? Clamp::g2 : corners.end ? Clamp::none : options_.clamp.end;
    if (from_start && corners.start) run.tie_start = run.points.front();
    if (to_end && corners.end) run.tie_end = run.points.back();
  }

  void measure(const Stretch& stretch, const std::vector<bool>& faired) {
    double along = 0;
    for (std::size_t k = 0; k < faired.size(); ++k) {
      const core::Point2 p = stretch.run.points[k];
      if (k > 0) along += core::distance(stretch.run.points[k - 1], p);
      if (faired[k]) continue;
      const double foot = foot_near(stretch.spline, p, along / stretch.length);
      const double off = core::distance(evaluate(stretch.spline, foot), p);
      plan_.kept_deviation = std::max(plan_.kept_deviation, off);
    }
  }

  const acquire::KeyLine& line_;
  const FairOptions& options_;
  double total_ = 0;
  RegionPlan plan_;
};

/// How far the kept members reach out of the half-planes; 0 where they stay inside.
double kept_outside(const AnswerMembers& members, const std::vector<core::HalfPlane>& inside) {
  double most = 0;
  for (const auto& kept : members) {
    if (!kept) continue;
    const int places = kPerSpan * static_cast<int>(kept->control.size());
    for (int k = 0; k <= places; ++k)
      for (const core::HalfPlane& half : inside)
        most = std::max(most, -core::depth(half, evaluate(*kept, double(k) / places)));
  }
  return most;
}

}  // namespace

core::Result<RegionPlan> plan_region(const acquire::KeyLine& line, const FairOptions& options,
                                     const fit::SplineFitOptions& fit) {
  std::vector<Run> runs = smooth_runs(line, options.keep_corners);
  pass_through(runs, options.must_pass);
  Planning planning(line, options);
  const core::Progress progress = fit.progress;
  double from =
      core::polygon_length(std::span(line.points).first(runs.front().index.front() + 1), false);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const double part = 1.0 / static_cast<double>(runs.size());
    fit::SplineFitOptions one = fit;
    one.progress =
        core::part_of(progress, static_cast<double>(k) * part, static_cast<double>(k + 1) * part);
    const bool round = line.closed && !runs[k].closed;
    const bool meets_at_start = line.ends_meet && options.clamp.start == Clamp::none;
    const bool meets_at_end = line.ends_meet && options.clamp.end == Clamp::none;
    const Corners corners{k > 0 || round || meets_at_start,
                          k + 1 < runs.size() || round || meets_at_end};
    const double length = core::polygon_length(runs[k].points, runs[k].closed);
    if (auto added = planning.add({runs[k], from, length, {}}, corners, one); !added)
      return std::unexpected(added.error());
    from += length;
  }
  RegionPlan plan = planning.take();
  if (plan.runs.empty())
    return core::fail(core::ErrorCode::bad_input, "the region holds fewer than five points",
                      "choose a larger region", "region");
  pass_through(plan.runs, options.must_pass);
  return plan;
}

std::vector<double> kept_before(const AnswerMembers& members, std::size_t runs) {
  std::vector<double> lengths(runs, 0);
  std::size_t next = 0;
  for (const auto& kept : members)
    if (!kept)
      ++next;
    else if (next < runs)
      lengths[next] += curve::arc_length(*kept);
  return lengths;
}

std::string note_of_kept(const RegionPlan& plan, const std::vector<core::HalfPlane>& inside,
                         double tolerance) {
  const double passed = kept_outside(plan.members, inside);
  return fmt::format("outside the region the points' spline stays, up to {:.4g} from them{}{}",
                     plan.kept_deviation,
                     plan.kept_deviation > tolerance ? ", more than the tolerance" : "",
                     passed > 0 ? fmt::format("; it passes a bound by {:.3g}", passed) : "");
}

}  // namespace keyline::fairing::detail
