#include "keyline/surface/edit_as_one.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <numeric>
#include <utility>

#include "keyline/numeric/parallel.h"
#include "keyline/surface/class_a_together.h"
#include "keyline/surface/departure.h"
#include "keyline/surface/hold_joints.h"

namespace keyline::surface::detail {
namespace {

/// The edits' nets, of the degrees given; what was not edited stays.
std::vector<BezierSurface> nets_of(std::span<const BezierSurface> given,
                                   const std::vector<PatchEdit>& edits) {
  std::vector<BezierSurface> all;
  for (std::size_t i = 0; i < given.size(); ++i) {
    all.push_back(edits[i].result ? edits[i].result->surface : given[i]);
    Net& net = all.back().net;
    const Net& as = given[i].net;
    if (net.rows != as.rows || net.columns != as.columns)
      all.back() = elevate_degree(all.back(), as.rows - net.rows, as.columns - net.columns);
  }
  return all;
}

/// Control points that the edit's options or its failure leave where they are.
std::vector<std::vector<bool>> fixed_points(std::span<const BezierSurface> patches,
                                            const std::vector<PatchEdit>& edits, Keep keep) {
  std::vector<std::vector<bool>> fixed;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const Net& net = patches[p].net;
    fixed.emplace_back(net.points.size(), !edits[p].result);
    for (int i = 0; i < net.rows; ++i)
      for (int j = 0; j < net.columns; ++j) {
        const bool rim_u = i == 0 || i + 1 == net.rows;
        const bool rim_v = j == 0 || j + 1 == net.columns;
        const bool kept = keep == Keep::start      ? i == 0 && j == 0
                          : keep == Keep::boundary ? rim_u || rim_v
                                                   : rim_u && rim_v;
        if (kept) fixed[p][net.index(i, j)] = true;
      }
  }
  return fixed;
}

/// Corners in which edges of joints end may move with them.
void free_shared_corners(std::span<const BezierSurface> patches, std::span<const PatchJoint> joints,
                         std::vector<std::vector<bool>>& fixed) {
  for (const PatchJoint& joint : joints)
    for (const auto& [p, edge] :
         {std::pair{joint.first, joint.edges[0]}, std::pair{joint.second, joint.edges[1]}}) {
      const Net& net = patches[p].net;
      for (const double along : {0.0, 1.0}) {
        const auto [u, v] = edge_parameters(edge, along);
        fixed[p][net.index(u > 0.5 ? net.rows - 1 : 0, v > 0.5 ? net.columns - 1 : 0)] = false;
      }
    }
}

/// Editing of all patches with their joints held.
class AsOne {
 public:
  AsOne(const AsOneTask& task, PatchesEdit& all)
      : given_(task.given),
        options_(task.options),
        task_(task),
        all_(all),
        joints_(all.joints),
        fixed_(fixed_points(given_, all.patches, options_.keep)),
        stiff_(joints_.size(), false),
        best_(given_.begin(), given_.end()),
        least_(all.sav_before),
        most_(order_of(task.hold)) {
    for (const int order : joint_orders(joints_, given_, task.tolerance))
      orders_.push_back(std::min(order, most_));
  }

  /// The least SAV of what rounds of editing and holding come to, and of nets whose curves take one
  /// matrix together.
  void run() {
    edit_in_rounds();
    if (options_.conditions.empty()) {
      take_one_matrix(fixed_);
      if (options_.keep == Keep::joints) {
        auto loose = fixed_;
        free_shared_corners(given_, joints_, loose);
        take_one_matrix(loose);
      }
    }
    finish();
  }

 private:
  static constexpr int kRounds = 4;
  static constexpr double kWorthIt = 1e-3;  ///< of SAV that a round has to gain
  static constexpr int kTries = 4;
  static constexpr int kHalvings = 10;  ///< towards the limit

  void edit_in_rounds() {
    std::vector<PatchEdit> edits = all_.patches;
    for (int round = 0; round < kRounds && !options_.progress.stop_requested(); ++round) {
      const auto held = hold(nets_of(given_, edits));
      bool better = false;
      for (const double share : {1.0, 0.6, 0.3}) {
        auto moved = within_limit(held, share);
        const double sav = total(moved);
        if (sav >= least_ * (1 - kWorthIt) || loses_a_joint(moved)) continue;
        accept("", std::move(moved), sav);
        better = true;
        break;
      }
      if (!better || round + 1 == kRounds) break;
      EditOptions farther = options_;  // the limit is measured from what was given
      farther.limit.reset();
      edits = edit_each(best_, farther, task_.threads);
    }
  }

  /// Nets of one matrix per curve; joints that lose their order are made stiff once.
  void take_one_matrix(const std::vector<std::vector<bool>>& fixed) {
    for (int attempt = 0; attempt < 2 && !options_.progress.stop_requested(); ++attempt) {
      TogetherTask task{{given_.begin(), given_.end()}, held_joints(), fixed, {}, options_};
      for (const PatchEdit& p : all_.patches) task.open.push_back(p.result.has_value());
      bool lost = false;
      for (TogetherNets& nets : class_a_together(task)) {
        auto moved = blend(nets.surfaces, options_.amount);
        if (stiffen(moved)) {
          lost = true;
          continue;
        }
        if (loses_a_joint(moved)) continue;  // stiff ones cannot be held by less
        const double away = farthest(moved);
        const double sav = total(moved);
        all_.tradeoff.push_back({nets.name, away, sav});
        if (options_.limit && away > *options_.limit) continue;
        if (sav < least_) accept(nets.name, std::move(moved), sav);
      }
      if (!lost) return;
    }
  }

  void accept(const std::string& name, std::vector<BezierSurface> moved, double sav) {
    least_ = sav;
    best_ = std::move(moved);
    name_ = name;
  }

  std::vector<HeldJoint> held_joints() const {
    std::vector<HeldJoint> held;
    for (std::size_t i = 0; i < joints_.size(); ++i)
      if (orders_[i] >= 0) held.push_back({joints_[i], orders_[i], stiff_[i]});
    return held;
  }

  /// Makes joints stiff that lose their order; whether there is one that was not.
  bool stiffen(const std::vector<BezierSurface>& moved) {
    const auto now = joint_orders(joints_, moved, task_.tolerance);
    bool any = false;
    for (std::size_t i = 0; i < joints_.size(); ++i)
      if (now[i] < orders_[i] && !stiff_[i]) any = stiff_[i] = true;
    return any;
  }

  bool loses_a_joint(const std::vector<BezierSurface>& moved) const {
    const auto now = joint_orders(joints_, moved, task_.tolerance);
    return !std::ranges::equal(now, orders_, std::greater_equal<>());
  }

  /// Nets nearest to the wanted ones that hold the joints; those that fail are made stiff.
  std::vector<BezierSurface> hold(const std::vector<BezierSurface>& wanted) {
    for (int attempt = 0;; ++attempt) {
      auto moved = hold_joints(given_, wanted, held_joints(), fixed_);
      if (!stiffen(moved) || attempt + 1 == kTries) return moved;
    }
  }

  /// That share of the moves, or what of it the limit allows.
  std::vector<BezierSurface> within_limit(const std::vector<BezierSurface>& held,
                                          double share) const {
    auto moved = blend(held, share);
    if (!options_.limit) return moved;
    double low = 0;
    double high = share;
    if (farthest(moved) <= *options_.limit) return moved;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (farthest(blend(held, middle)) <= *options_.limit ? low : high) = middle;
    }
    return blend(held, low);
  }

  std::vector<BezierSurface> blend(const std::vector<BezierSurface>& held, double share) const {
    std::vector<BezierSurface> moved(given_.begin(), given_.end());
    for (std::size_t p = 0; p < moved.size(); ++p)
      for (std::size_t i = 0; i < moved[p].net.points.size(); ++i)
        moved[p].net.points[i] = core::mix(given_[p].net.points[i], held[p].net.points[i], share);
    return moved;
  }

  double farthest(const std::vector<BezierSurface>& moved) const {
    std::vector<double> away(moved.size());
    numeric::parallel_for(moved.size(), task_.threads, [&](std::size_t i) {
      away[i] = moved[i] == given_[i] ? 0 : departure_bound(given_[i], moved[i]);
    });
    return *std::max_element(away.begin(), away.end());
  }

  double total(const std::vector<BezierSurface>& moved) const {
    std::vector<double> values(moved.size(), 0);
    numeric::parallel_for(moved.size(), task_.threads, [&](std::size_t i) {
      const auto value = sav(moved[i], value_options(options_));
      values[i] = value ? value->sav : 0;
    });
    return std::accumulate(values.begin(), values.end(), 0.0);
  }

  static classa::CavOptions value_options(const EditOptions& options) {
    classa::CavOptions general;
    general.alpha_max = options.alpha_max;
    general.end_tolerance = options.end_tolerance;
    return general;
  }

  /// Leaves out of the trade-off what is no choice: twice as far as another of no higher SAV.
  void drop_poor() {
    const std::vector<TradeOff> others = all_.tradeoff;
    std::erase_if(all_.tradeoff, [&](const TradeOff& t) {
      return t.sav > all_.sav_before || std::ranges::any_of(others, [&](const TradeOff& o) {
               return o.sav <= t.sav && 2 * o.departure < t.departure;
             });
    });
  }

  /// What the patches came to.
  void finish() {
    drop_poor();
    std::stable_sort(
        all_.tradeoff.begin(), all_.tradeoff.end(),
        [](const TradeOff& a, const TradeOff& b) { return a.departure < b.departure; });
    numeric::parallel_for(best_.size(), task_.threads, [&](std::size_t i) {
      auto& [result, why] = all_.patches[i];
      if (!result) return;
      if (best_[i] == given_[i]) {
        result->target = "as given";
        result->amount = 0;
      } else {
        result->target = (name_.empty() ? result->target : name_) + ", joints held";
      }
      if (auto done = move_edit(given_[i], best_[i], options_, *result); !done) {
        why = std::move(done.error());
        result.reset();
      }
    });
    all_.surfaces = best_;
    all_.lost = lost_orders(joints_, given_, best_, most_, task_.tolerance);
  }

  std::span<const BezierSurface> given_;
  const EditOptions& options_;
  const AsOneTask& task_;
  PatchesEdit& all_;
  const std::vector<PatchJoint>& joints_;
  std::vector<std::vector<bool>> fixed_;
  std::vector<int> orders_;  ///< to be held, by joint
  std::vector<bool> stiff_;
  std::vector<BezierSurface> best_;
  double least_ = 0;  ///< SAV of the best
  int most_ = 1;      ///< order that is held
  std::string name_;  ///< of the best among nets of one matrix; empty: of a round
};

}  // namespace

std::vector<PatchEdit> edit_each(std::span<const BezierSurface> patches, const EditOptions& options,
                                 int threads) {
  std::vector<PatchEdit> all(patches.size());
  std::atomic<std::size_t> done = 0;
  std::mutex reporting;
  EditOptions quiet = options;
  quiet.progress.sink = nullptr;
  numeric::parallel_for(patches.size(), threads, [&](std::size_t i) {
    if (options.progress.stop_requested()) return;
    auto edited = edit(patches[i], quiet);
    if (edited)
      all[i].result = std::move(*edited);
    else
      all[i].why = std::move(edited.error());
    const std::size_t count = ++done;
    const std::lock_guard lock(reporting);
    options.progress.report(static_cast<double>(count) / patches.size(), "patches");
  });
  return all;
}

void edit_as_one(const AsOneTask& task, PatchesEdit& all) { AsOne(task, all).run(); }

}  // namespace keyline::surface::detail
