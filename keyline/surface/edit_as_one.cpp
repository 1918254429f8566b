#include "keyline/surface/edit_as_one.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <numeric>
#include <utility>

#include "keyline/numeric/halving.h"
#include "keyline/numeric/parallel.h"
#include "keyline/surface/class_a_together.h"
#include "keyline/surface/departure.h"
#include "keyline/surface/hold_joints.h"
#include "keyline/surface/turn_over.h"

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
        was_(joint_states(joints_, given_, task.tolerance)),
        stiff_(joints_.size(), false),
        still_(given_.size(), false),
        best_(given_.begin(), given_.end()),
        least_(all.sav_before),
        most_(order_of(task.hold)) {
    for (const JointState& state : was_) orders_.push_back(std::min(state.order, most_));
  }

  /// The least SAV of what rounds of editing and holding come to, and of nets whose curves take one
  /// matrix together.
  void run() {
    edit_in_rounds();
    if (options_.conditions.empty()) {
      // Part of the way would not hold the joints with other multipliers.
      if (options_.amount == 1) take_one_matrix(JointMultipliers::open);
      if (!(least_ < all_.sav_before)) take_one_matrix(JointMultipliers::given);
    }
    finish();
  }

 private:
  static constexpr int kRounds = 4;
  static constexpr double kWorthIt = 1e-3;   ///< of SAV that another net has to gain
  static constexpr double kSameTurn = 1e-6;  ///< radians of a zebra: no difference
  static constexpr int kTries = 4;
  static constexpr int kAttempts = 3;
  static constexpr int kHalvings = 10;  ///< towards the limit

  void edit_in_rounds() {
    std::vector<PatchEdit> edits = all_.patches;
    for (int round = 0; round < kRounds && !options_.progress.stop_requested(); ++round) {
      const auto held = hold(nets_of(given_, edits));
      bool better = false;
      for (const double share : {1.0, 0.6, 0.3}) {
        auto moved = within_limit(held, share);
        const double sav = total(moved);
        if (sav >= least_ * (1 - kWorthIt) || !is_sound(moved)) continue;
        const double away = farthest(moved);
        accept("", std::move(moved), sav, away);
        better = true;
        break;
      }
      if (!better || round + 1 == kRounds) break;
      EditOptions farther = options_;  // the limit is measured from what was given
      farther.limit.reset();
      edits = edit_each(best_, farther, task_.threads);
    }
  }

  void take_one_matrix(JointMultipliers multipliers) {
    take_one_matrix(fixed_, multipliers);
    if (options_.keep != Keep::joints) return;
    auto loose = fixed_;
    free_shared_corners(given_, joints_, loose);
    take_one_matrix(loose, multipliers);
  }

  /// Nets of one matrix per curve; what does not come out sound is held still and all tried again.
  void take_one_matrix(const std::vector<std::vector<bool>>& fixed, JointMultipliers multipliers) {
    stiff_.assign(stiff_.size(), false);
    still_.assign(still_.size(), false);
    for (int attempt = 0; attempt < kAttempts && !options_.progress.stop_requested(); ++attempt) {
      // With open multipliers a step costs several times as much.
      const bool most_or_none = multipliers == JointMultipliers::open && attempt == 0;
      TogetherTask task{{given_.begin(), given_.end()},
                        held_joints(),
                        with_still(fixed),
                        {},
                        options_,
                        multipliers,
                        most_or_none};
      for (std::size_t p = 0; p < given_.size(); ++p)
        task.open.push_back(all_.patches[p].result && !still_[p]);
      bool again = false;
      for (TogetherNets& nets : class_a_together(task)) {
        auto moved = blend(nets.surfaces, options_.amount);
        close_joints(given_, task.joints, moved);
        if (hold_more(moved)) {
          again = true;
          continue;
        }
        if (!is_sound(moved)) continue;  // nothing is left to hold
        const double away = farthest(moved);
        const double sav = total(moved);
        const ZebraBreaks zebra = measure_joints(joints_, moved, task_.tolerance).zebra;
        all_.tradeoff.push_back({nets.name, away, sav, zebra.mean_turn});
        if (options_.limit && away > *options_.limit) continue;
        const bool nearer = sav < least_ * (1 + kWorthIt) && away < away_;
        if (sav < least_ * (1 - kWorthIt) || nearer) accept(nets.name, std::move(moved), sav, away);
      }
      if (!again) return;
    }
  }

  void accept(const std::string& name, std::vector<BezierSurface> moved, double sav, double away) {
    least_ = sav;
    away_ = away;
    best_ = std::move(moved);
    name_ = name;
  }

  /// Joints that meet are held to their order; a crease is held as a tangent joint is, so that it
  /// keeps what it misses that by, and for the zebra's sake a jump of curvature likewise.
  std::vector<HeldJoint> held_joints() const {
    std::vector<HeldJoint> held;
    for (std::size_t i = 0; i < joints_.size(); ++i)
      if (orders_[i] >= 0) held.push_back({joints_[i], held_order(i), stiff_[i]});
    return held;
  }

  int held_order(std::size_t joint) const {
    const bool jump = task_.hold == HoldJoints::zebra && orders_[joint] == 1;
    return jump ? 2 : std::max(orders_[joint], 1);
  }

  /// With the control points of still patches and stiff joints, which many wishes beside them
  /// would else wear down.
  std::vector<std::vector<bool>> with_still(std::vector<std::vector<bool>> fixed) const {
    for (std::size_t p = 0; p < fixed.size(); ++p)
      if (still_[p]) fixed[p].assign(fixed[p].size(), true);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (!stiff_[i]) continue;
      const int deep = held_order(i);
      fix_beside(joints_[i].first, joints_[i].edges[0], deep, fixed);
      fix_beside(joints_[i].second, joints_[i].edges[1], deep, fixed);
    }
    return fixed;
  }

  /// The points of an edge and of so many rows inside it.
  void fix_beside(std::size_t patch, Edge edge, int deep,
                  std::vector<std::vector<bool>>& fixed) const {
    const Net& net = given_[patch].net;
    const bool u = edge == Edge::u0 || edge == Edge::u1;
    const bool far = edge == Edge::u1 || edge == Edge::v1;
    const int across = u ? net.rows : net.columns;
    for (int d = 0; d <= std::min(deep, across - 1); ++d)
      for (int k = 0; k < (u ? net.columns : net.rows); ++k) {
        const int at = far ? across - 1 - d : d;
        fixed[patch][u ? net.index(at, k) : net.index(k, at)] = true;
      }
  }

  /// A joint of lower order than it had, or of a sharper fold, or where a zebra turns farther.
  bool suffers(std::size_t joint, const JointState& now) const {
    return now.order < orders_[joint] ||
           (orders_[joint] >= 0 && now.angle > was_[joint].angle + task_.tolerance.angle) ||
           (task_.hold == HoldJoints::zebra && turns_farther(was_[joint], now, task_.tolerance));
  }

  /// Makes joints stiff that suffer and patches still that turn over; whether there is one that was
  /// not.
  bool hold_more(const std::vector<BezierSurface>& moved) {
    const auto now = joint_states(joints_, moved, task_.tolerance);
    bool any = false;
    for (std::size_t i = 0; i < joints_.size(); ++i)
      if (suffers(i, now[i]) && !stiff_[i]) any = stiff_[i] = true;
    for (std::size_t p = 0; p < given_.size(); ++p)
      if (!still_[p] && turns_over(given_[p], moved[p])) any = still_[p] = true;
    return any;
  }

  bool is_sound(const std::vector<BezierSurface>& moved) const {
    const auto now = joint_states(joints_, moved, task_.tolerance);
    for (std::size_t i = 0; i < joints_.size(); ++i)
      if (suffers(i, now[i])) return false;
    for (std::size_t p = 0; p < given_.size(); ++p)
      if (turns_over(given_[p], moved[p])) return false;
    return true;
  }

  /// Nets nearest to the wanted ones that hold the joints; what does not come out sound is held.
  std::vector<BezierSurface> hold(const std::vector<BezierSurface>& wanted) {
    for (int attempt = 0;; ++attempt) {
      const auto joints = held_joints();
      auto moved = hold_joints(given_, wanted, joints, with_still(fixed_));
      close_joints(given_, joints, moved);
      if (!hold_more(moved) || attempt + 1 == kTries) return moved;
    }
  }

  /// That share of the moves, or what of it the limit allows.
  std::vector<BezierSurface> within_limit(const std::vector<BezierSurface>& held,
                                          double share) const {
    if (!options_.limit) return blend(held, share);
    const auto is_within = [&](double part) {
      return farthest(blend(held, part)) <= *options_.limit;
    };
    return blend(held, numeric::largest_share_that_holds(is_within, share, kHalvings));
  }

  std::vector<BezierSurface> blend(const std::vector<BezierSurface>& held, double share) const {
    std::vector<BezierSurface> moved(given_.begin(), given_.end());
    for (std::size_t p = 0; p < moved.size(); ++p)
      for (std::size_t i = 0; i < moved[p].net.points.size() && held[p] != given_[p]; ++i)
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

  /// Sorts the trade-off, nearest first, and leaves out what is no choice: twice as far as another
  /// of no higher SAV, or farther than one that is as good by SAV and zebra, but for a thousandth.
  void drop_poor() {
    std::ranges::stable_sort(all_.tradeoff, {}, &TradeOff::departure);
    std::vector<TradeOff> kept;
    for (TradeOff& t : all_.tradeoff) {
      const bool poor = std::ranges::any_of(kept, [&](const TradeOff& o) {
        return o.sav * (1 - kWorthIt) <= t.sav &&
               (2 * o.departure < t.departure ||
                o.stripe_turn.value_or(0) <= t.stripe_turn.value_or(0) + kSameTurn);
      });
      if (!poor && t.sav <= all_.sav_before) kept.push_back(std::move(t));
    }
    all_.tradeoff = std::move(kept);
  }

  /// What the patches came to.
  void finish() {
    drop_poor();
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
  }

  std::span<const BezierSurface> given_;
  const EditOptions& options_;
  const AsOneTask& task_;
  PatchesEdit& all_;
  const std::vector<PatchJoint>& joints_;
  std::vector<std::vector<bool>> fixed_;
  std::vector<JointState> was_;  ///< by joint, as given
  std::vector<int> orders_;      ///< to be held, by joint
  std::vector<bool> stiff_;      ///< by joint: its control points stay
  std::vector<bool> still_;      ///< by patch: all of them do
  std::vector<BezierSurface> best_;
  double least_ = 0;  ///< SAV of the best
  double away_ = 0;   ///< its departure
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
