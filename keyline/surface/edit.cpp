#include "keyline/surface/edit.h"

#include <algorithm>
#include <cmath>

#include "keyline/surface/closest_point.h"
#include "keyline/surface/edit_targets.h"

namespace keyline::surface {

using core::ErrorCode;
using core::fail;
using core::Result;

namespace {

struct Candidate {
  TradeOff tradeoff;
  Net net;
};

classa::CavOptions cav_options(const EditOptions& o) {
  classa::CavOptions cav;
  cav.alpha_max = o.alpha_max;
  cav.end_tolerance = o.end_tolerance;
  return cav;
}

Result<void> check(const BezierSurface& s, const EditOptions& o) {
  if (!(o.amount >= 0 && o.amount <= 1))
    return fail(ErrorCode::bad_input, "the amount is out of range", "give a number from 0 to 1",
                "amount");
  if (o.limit && !(*o.limit >= 0 && std::isfinite(*o.limit)))
    return fail(ErrorCode::bad_input, "the limit is negative or not finite",
                "give a length of 0 or more", "limit");
  const double size = extent(s.net);
  for (const NetworkCurve& c : network_curves(s.net))
    for (std::size_t i = 1; i < c.control.size(); ++i)
      if (!(core::distance(c.control[i - 1], c.control[i]) > 1e-9 * size))
        return fail(ErrorCode::bad_input, "an edge of " + c.name + " has no length",
                    "edit a patch without collapsed edges", c.name);
  return {};
}

BezierSurface blend(const BezierSurface& s, const Net& target, double amount) {
  BezierSurface between = s;
  for (std::size_t i = 0; i < s.net.points.size(); ++i)
    between.net.points[i] = core::mix(s.net.points[i], target.points[i], amount);
  return between;
}

/// Less SAV wins, the nearer one of (nearly) equals.
const Candidate* best_of(const std::vector<Candidate>& all, std::optional<double> limit) {
  const Candidate* best = nullptr;
  for (const Candidate& c : all) {
    if (limit && c.tradeoff.departure > *limit) continue;
    const bool better = !best || c.tradeoff.sav < best->tradeoff.sav - 1e-6;
    if (better) best = &c;  // candidates come by growing departure
  }
  return best;
}

/// Largest amount up to `most` at which the blend stays within the limit.
double amount_within(const BezierSurface& s, const Net& target, double limit, double most) {
  if (departure(s, blend(s, target, most)) <= limit) return most;
  double low = 0;
  double high = most;
  for (int i = 0; i < 30 && high - low > 1e-6; ++i) {
    const double middle = 0.5 * (low + high);
    (departure(s, blend(s, target, middle)) <= limit ? low : high) = middle;
  }
  return low;
}

std::vector<Candidate> candidates_of(const BezierSurface& s, const EditOptions& options) {
  std::vector<Candidate> all;
  const auto targets = detail::edit_targets(s.net, options);
  for (const detail::Target& target : targets) {
    const BezierSurface moved{target.net, {}};
    const auto value = sav(moved, cav_options(options));
    if (!value) continue;
    all.push_back({{target.name, departure(s, moved), value->sav}, target.net});
    options.progress.report(0.5 + 0.5 * all.size() / targets.size(), "trade-off");
  }
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return a.tradeoff.departure < b.tradeoff.departure;
  });
  return all;
}

}  // namespace

Result<EditResult> edit(const BezierSurface& s, const EditOptions& options) {
  auto before = sav(s, cav_options(options));
  if (!before) return std::unexpected(before.error());
  if (auto sound = check(s, options); !sound) return std::unexpected(sound.error());
  const auto all = candidates_of(s, options);
  if (options.progress.stop_requested()) return fail(ErrorCode::cancelled, "cancelled");
  EditResult result{s, *before, *before, 0, options.amount, "", {}};
  for (const Candidate& c : all) result.tradeoff.push_back(c.tradeoff);
  if (all.empty())
    return fail(ErrorCode::undrawable, "no Class A net meets the conditions",
                "keep less (\"start\"), or straighten rows and columns that turn by more than a "
                "right angle",
                "surface");
  const Candidate* best = best_of(all, options.limit);
  const bool within = best != nullptr;
  if (!within) best = &all.front();
  if (best->tradeoff.sav >= before->sav) {
    result.target = "as given";
    return result;
  }
  result.target = best->tradeoff.name;
  if (options.limit) result.amount = amount_within(s, best->net, *options.limit, options.amount);
  result.surface = blend(s, best->net, result.amount);
  auto after = sav(result.surface, cav_options(options));
  if (!after) return std::unexpected(after.error());
  result.after = std::move(*after);
  result.departure = departure(s, result.surface);
  return result;
}

}  // namespace keyline::surface
