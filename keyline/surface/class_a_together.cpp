#include "keyline/surface/class_a_together.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "keyline/surface/edit_curve.h"
#include "keyline/surface/edit_targets.h"
#include "keyline/surface/strands.h"

namespace keyline::surface::detail {
namespace {

constexpr double kMet = 1e-7;        ///< a tenth of what one ratio may differ from another by
constexpr double kGiven = 1e-6;      ///< a curve as given has one matrix, or is planar
constexpr double kServed = 1e-3;     ///< left over after the sum of misfits: worth to be asked for
constexpr double kFirm = 1e-4;       ///< growth this near to the wanted is made exact
constexpr double kLoose = 0.01;      ///< homing against misfits; 1 against what has to hold
constexpr double kDamping = 1e-4;    ///< of steps on the equations alone
constexpr int kSelecting = 30;       ///< steps on the sum of misfits
constexpr int kNearing = 12;         ///< steps towards the nearest net
constexpr double kSettled = 1e-5;    ///< of a strand, moved by a step: there
constexpr int kPolishing = 40;       ///< steps on the equations alone, at most
constexpr int kGivenUp = 60;         ///< rounds of giving up curves
constexpr std::size_t kAtOnce = 30;  ///< of so many curves one is given up at once
constexpr int kRestorings = 8;       ///< rounds of keeping types
constexpr double kGrowing[] = {0.03, 0.3, 3};  ///< weights of growth against nearness

class Search {
 public:
  explicit Search(const TogetherTask& task)
      : task_(task),
        system_(task.given, task.joints, task.fixed, task.multipliers),
        x_(system_.given()) {}

  std::vector<TogetherNets> run() {
    ask();
    const std::size_t all = count_asked();
    if (all == 0) return {};
    const std::vector<int> given = types();
    select();
    if (task_.most_or_none && 2 * count_asked() < all) return {};
    bool met = false;
    for (int round = 0; round < kRestorings; ++round) {
      met = meet(0);
      if (!met) break;
      keep("one matrix");
      if (!restore(given)) break;
    }
    for (const double weight : kGrowing) {
      if (!met || stopped()) break;
      grow_towards(weight);
    }
    return std::move(found_);
  }

 private:
  bool stopped() const { return task_.options.progress.stop_requested(); }

  std::size_t count_asked() const {
    return static_cast<std::size_t>(
        std::count_if(system_.strands().begin(), system_.strands().end(),
                      [](const Strand& s) { return s.asked == Asked::one_matrix; }));
  }

  void report(int round) const {
    task_.options.progress.report(static_cast<double>(round) / kGivenUp, "curves of one matrix");
  }

  void keep(const char* name) { found_.push_back({name, with_coordinates(task_.given, x_)}); }

  /// Every curve of an open patch that has edges is asked for one matrix.
  void ask() {
    for (Strand& s : system_.strands()) {
      flat_.push_back(false);
      held_.push_back(false);
      bool edges = true;
      for (std::size_t i = 1; i < s.points.size(); ++i)
        edges = edges && (x_.row(s.points[i]) - x_.row(s.points[i - 1])).norm() > 0;
      if (!task_.open[s.patch] || !edges || s.points.size() < 4) continue;
      s.asked = Asked::plane;
      flat_.back() = system_.misfit(s, x_) < kGiven;
      s.asked = Asked::one_matrix;
      held_.back() = system_.misfit(s, x_) < kGiven;
    }
  }

  StrandWeights holding() const {
    const auto count = system_.strands().size();
    return {std::vector<double>(count, kHolds), std::vector<double>(count, 0)};
  }

  /// With growth as a sum of misfits, those that are firm held.
  StrandWeights growing(double weight) const {
    StrandWeights w = holding();
    for (std::size_t k = 0; k < w.growth.size(); ++k) {
      const Strand& s = system_.strands()[k];
      if (!s.growth) continue;
      w.growth[k] =
          s.firm ? kHolds : weight / (std::abs(system_.growth(s, x_) - *s.growth) + kFirm);
    }
    return w;
  }

  /// Least sum of misfits (by reweighting): what is left of most is nothing, of some much.
  void select() {
    double blunt = 0.1;
    for (int i = 0; i < kSelecting && !stopped(); ++i, blunt = std::max(1e-5, 0.7 * blunt)) {
      StrandWeights w = holding();
      for (std::size_t k = 0; k < w.shape.size(); ++k)
        if (!held_[k]) w.shape[k] = 1 / (system_.misfit(system_.strands()[k], x_) + blunt);
      system_.step(x_, system_.given(), kLoose, w);
    }
    for (std::size_t k = 0; k < held_.size(); ++k)
      if (system_.misfit(system_.strands()[k], x_) > kServed) give_up(k);
  }

  void give_up(std::size_t k) {
    Strand& s = system_.strands()[k];
    if (s.asked == Asked::likeness) return;
    s.asked = s.asked == Asked::one_matrix && flat_[k] ? Asked::plane : Asked::nothing;
    s.growth.reset();
    s.firm = false;
  }

  /// Brings all to what is asked of them. Where that cannot be, wished growth gives way first, then
  /// the curves farthest off. False where nothing is left, or where wishes that give way do not
  /// help.
  bool meet(double weight) {
    for (int round = 0; round < kGivenUp && !stopped(); ++round) {
      report(round);
      for (int i = 0; i < kNearing; ++i)
        if (system_.step(x_, system_.given(), 1, growing(weight)) < kSettled) break;
      for (Strand& s : system_.strands())
        s.firm = s.growth && weight > 0 && std::abs(system_.growth(s, x_) - *s.growth) < kFirm;
      const std::vector<double> left = polish();
      const double worst = *std::max_element(left.begin(), left.end());
      if (worst < kMet) return count_asked() > 0;
      bool firm = false;
      for (Strand& s : system_.strands()) firm = std::exchange(s.firm, false) || firm;
      if (weight > 0 && round > 0) return false;
      if (!firm) give_up_worst(left, worst);
      if (count_asked() == 0) return false;
    }
    return false;
  }

  /// Steps on the equations alone as long as they help; what is left of each.
  std::vector<double> polish() {
    constexpr int kAlways = 6;
    double before = HUGE_VAL;
    for (int i = 0;; ++i) {
      std::vector<double> left;
      for (const Strand& s : system_.strands()) left.push_back(system_.misfit(s, x_));
      const double worst = *std::max_element(left.begin(), left.end());
      const double lacking = std::max(worst, system_.joint_misfit(x_));
      const bool stuck = i >= kAlways && lacking > 0.9 * before;
      if (lacking < 1e-5 * kMet || stuck || i == kPolishing || stopped()) return left;
      before = lacking;
      const Eigen::MatrixX3d here = x_;
      system_.step(x_, here, kDamping, growing(0));
    }
  }

  void give_up_worst(const std::vector<double>& left, double worst) {
    std::vector<double> sorted = left;
    const auto some = static_cast<std::ptrdiff_t>(
        std::clamp<std::size_t>(count_asked() / kAtOnce, 1, left.size() - 1));
    std::nth_element(sorted.begin(), sorted.begin() + some, sorted.end(), std::greater<>());
    const double bar =
        std::max(kMet, std::min(0.99 * worst, sorted[static_cast<std::size_t>(some)]));
    for (std::size_t k = 0; k < left.size(); ++k)
      if (left[k] > bar) give_up(k);
  }

  /// Type of every curve ([Oya] Tab. 1).
  std::vector<int> types() const {
    classa::CavOptions options;
    options.alpha_max = task_.options.alpha_max;
    options.end_tolerance = task_.options.end_tolerance;
    std::vector<int> all;
    for (const BezierSurface& s : with_coordinates(task_.given, x_)) {
      const auto value = sav(s, options);
      const int count = s.net.rows + s.net.columns;
      for (int i = 0; i < count; ++i)
        all.push_back(value ? value->curves[static_cast<std::size_t>(i)].value.type : 5);
    }
    return all;
  }

  /// Curves of a worse type than given are to stay as they were; false where there is none.
  bool restore(const std::vector<int>& given) {
    const std::vector<int> now = types();
    bool any = false;
    for (std::size_t k = 0; k < now.size(); ++k) {
      Strand& s = system_.strands()[k];
      if (now[k] <= given[k] || s.asked == Asked::likeness || s.points.size() < 4) continue;
      s.asked = Asked::likeness;
      s.growth.reset();
      any = true;
    }
    return any;
  }

  /// Curves towards their minimum; back where that tears a matrix.
  void grow_towards(double weight) {
    constexpr int kAsked = 3;
    constexpr int kSteps = 4;
    const Eigen::MatrixX3d before = x_;
    const std::vector<double> multipliers = system_.multipliers();
    for (int again = 0; again < kAsked; ++again) {
      wish_growth();
      for (int i = 0; i < kSteps; ++i) system_.step(x_, system_.given(), 1, growing(weight));
    }
    if (meet(weight)) return keep("towards least energy");
    x_ = before;
    system_.set_multipliers(multipliers);
  }

  /// Asks anew where the minimum of each curve is.
  void wish_growth() {
    std::size_t k = 0;
    for (const BezierSurface& patch : with_coordinates(task_.given, x_))
      for (const NetworkCurve& c : network_curves(patch.net)) {
        Strand& s = system_.strands()[k++];
        s.growth.reset();
        s.firm = false;
        if (s.asked != Asked::one_matrix) continue;
        const bool falls = own_sense(c).rows_from_end;
        const CurveTask own{
            c.control, falls, {}, task_.options.end_tolerance, task_.options.alpha_max};
        if (const auto m = minimum_of(own)) s.growth = (falls ? -1 : 1) * std::log(m->s);
      }
  }

  const TogetherTask& task_;
  StrandSystem system_;
  Eigen::MatrixX3d x_;
  std::vector<bool> flat_;  ///< by strand: planar as given
  std::vector<bool> held_;  ///< by strand: of one matrix as given
  std::vector<TogetherNets> found_;
};

}  // namespace

std::vector<TogetherNets> class_a_together(const TogetherTask& task) { return Search(task).run(); }

}  // namespace keyline::surface::detail
