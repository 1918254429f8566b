#include "keyline/fairing/calm.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "keyline/fairing/counter_bends.h"
#include "keyline/fairing/turns.h"
#include "keyline/fairing/wave_choice.h"
#include "keyline/numeric/parallel.h"

namespace keyline::fairing::detail {
namespace {

constexpr int kRounds = 4;       // in which an extremum may move on
constexpr int kTrialSteps = 40;  // of a trial: one that does not come within the band by then fails
constexpr double kTrialGap = 0.03;    // of the energy, all of which a wave less may cost again
constexpr double kErrorsOfBends = 4;  // standard errors: points that a bend serves so well keep it
constexpr double kMostBend = 2;  // tolerances: in a band no line takes the place of a higher one
constexpr int kPatience = 4;     // steps: what is possible at all takes back its extra width sooner

BandReport solve_without(DenseCurve& curve, const std::vector<FitPoint>& points,
                         std::vector<int> extrema, double spring, const CalmOptions& options) {
  BandOptions band = options.band;
  band.warm = true;
  band.spring = spring;
  band.iterations = kTrialSteps;
  band.gap = kTrialGap;
  band.patience = kPatience;
  BandReport report;
  std::vector<std::vector<int>> tried;  // an extremum may move to and fro
  for (int round = 0; round < kRounds; ++round) {
    set_senses(curve, extrema);
    report = least_variation(curve, points, band);
    if (!report.within) return report;
    tried.push_back(std::move(extrema));
    extrema = moved_on(curve, tried.back());
    if (std::ranges::count(tried, extrema) > 0) break;
  }
  return report;
}

/// Bends that depart by less than that either way and were not refused, least first.
std::vector<CounterBend> low_bends(const DenseCurve& curve, double most, const Refusals& refused) {
  std::vector<CounterBend> low;
  for (const CounterBend& bend : counter_bends(curve))
    if (bend.sideways < most && !refused.hold({.sideways = bend.sideways})) low.push_back(bend);
  return low;
}

/// The search for waves to take out, and for bends to the other side.
class Calming {
 public:
  Calming(DenseCurve& curve, const std::vector<FitPoint>& points, const CalmOptions& options)
      : curve_(curve), points_(points), options_(options), most_rms_(options.most_rms) {}

  Calmed run() {
    report_ = least_variation(curve_, points_, options_.band);
    if (report_.within) take_waves();
    return {report_, {static_cast<int>(turns_of(curve_).size()), untried_}};
  }

 private:
  /// What a curve may cost.
  struct Price {
    double rms = HUGE_VAL;
    double energy = HUGE_VAL;
  };

  static bool worth(const BandReport& found, const Price& most) {
    return found.within && found.rms <= most.rms && found.energy <= most.energy;
  }

  /// A curve with some extrema alone, where it is worth it.
  struct Trial {
    DenseCurve curve;
    BandReport report;
  };

  void take_waves() {
    take(seen_turns_of(curve_), true);
    while (!options_.band.progress.stop_requested() && (together() || single()));
    if (options_.most_turns) keep_to(*options_.most_turns);
    straighten();
  }

  /// Takes bends to the other side out that the points do not ask for: all that are low at once, or
  /// else half as many, down to single ones, least first.
  void straighten() {
    const auto points = static_cast<double>(points_.size());
    const double asked = report_.rms * std::sqrt(1 + kErrorsOfBends * kErrorsOfBends / points);
    const Price most{std::max(most_rms_, asked), options_.bend_worth * report_.energy};
    while (!options_.band.progress.stop_requested()) {
      const std::vector<CounterBend> low =
          low_bends(curve_, kMostBend * options_.band.tolerance, bends_);
      const std::vector<CounterBend> together = apart(curve_, low);
      const bool some = bends_at_once_.try_together(together.size(), [&](std::size_t n) {
        return without_bends(std::span(together).first(n), most);
      });
      if (some) continue;
      if (!one_less(low, most)) return;
      bends_at_once_.one_went();
    }
  }

  bool one_less(const std::vector<CounterBend>& low, const Price& most) {
    for (std::size_t i = 0; i < low.size() && i < kInRow; ++i) {
      if (++bend_tries_ > kTries) return false;
      if (without_bends(std::span(low).subspan(i, 1), most)) return true;
      bends_.add({.sideways = low[i].sideways});
    }
    return false;
  }

  bool without_bends(std::span<const CounterBend> gone, const Price& most) {
    Trial trial{curve_, {}};
    for (const CounterBend& bend : gone) set_side(trial.curve, bend);
    const std::vector<int> extrema = turns_of(curve_);
    trial.report = solve_without(trial.curve, points_, extrema, report_.spring, options_);
    if (!worth(trial.report, most) || turns_of(trial.curve).size() > extrema.size() ||
        counter_bends(trial.curve).size() >= counter_bends(curve_).size())
      return false;
    accept(std::move(trial));
    return true;
  }

  /// Further waves go for the asking, while the tolerance holds.
  void keep_to(int turns) {
    options_.most_rms = options_.worth = HUGE_VAL;
    refusals_.clear();
    in_vain_.clear();
    const auto left = [&] { return static_cast<int>(turns_of(curve_).size()); };
    while (!options_.band.progress.stop_requested() && left() > turns && single());
  }

  /// Solves with these extrema alone.
  std::optional<Trial> attempt(const std::vector<int>& extrema, bool any_count) const {
    Trial trial{curve_, {}};
    trial.report = solve_without(trial.curve, points_, extrema, report_.spring, options_);
    if (!worth(trial.report, {options_.most_rms, options_.worth * report_.energy})) return {};
    if (!any_count && turns_of(trial.curve).size() >= turns_of(curve_).size()) return {};
    return trial;
  }

  void accept(Trial trial) {
    curve_ = std::move(trial.curve);
    report_ = trial.report;
    in_vain_.clear();
  }

  /// Whether these extrema are new with the curve as it is.
  bool untold(const std::vector<int>& extrema) {
    if (std::ranges::count(in_vain_, extrema) > 0) return false;
    in_vain_.push_back(extrema);
    return true;
  }

  bool take(const std::vector<int>& extrema, bool any_count = false) {
    if (!untold(extrema)) return false;
    auto trial = attempt(extrema, any_count);
    if (trial) accept(std::move(*trial));
    return trial.has_value();
  }

  /// As many waves at once as should fit into the band and the mean square.
  bool together() {
    const std::vector<int> extrema = turns_of(curve_);
    const double spare = std::pow(options_.most_rms, 2) - std::pow(report_.rms, 2);
    std::vector<Removal> small = small_waves(removals(curve_, extrema), extrema.size(),
                                             options_.band.tolerance, spare, refusals_);
    return at_once_.try_together(small.size(), [&](std::size_t n) {
      small.resize(n);
      return take(without(extrema, small));
    });
  }

  /// The least wave that is worth it; as many as there are threads are tried at a time.
  bool single() {
    const std::vector<int> extrema = turns_of(curve_);
    const auto most = static_cast<std::size_t>(numeric::thread_count(options_.threads));
    SingleWaves waves(removals(curve_, extrema), options_.band.tolerance, tries_, refusals_);
    untried_ = false;
    for (auto few = waves.next(most); !few.empty(); few = waves.next(most)) {
      std::vector<std::optional<Trial>> trials = attempts(extrema, few);
      for (std::size_t i = 0; i < few.size(); ++i) {
        ++tries_;
        if (trials[i]) {
          accept(std::move(*trials[i]));
          at_once_.one_went();
          return true;
        }
        refusals_.add(few[i]);
      }
    }
    untried_ = waves.too_many();
    return false;
  }

  /// With each of them gone; those after the first that is worth it may be left out.
  std::vector<std::optional<Trial>> attempts(const std::vector<int>& extrema,
                                             const std::vector<Removal>& few) {
    std::vector<std::vector<int>> left;
    for (const Removal& r : few) left.push_back(without(extrema, {r}));
    std::vector<char> fresh;
    for (const std::vector<int>& one : left) fresh.push_back(untold(one));
    std::vector<std::optional<Trial>> trials(few.size());
    std::atomic<std::size_t> first = few.size();  // that is worth it
    numeric::parallel_for(few.size(), options_.threads, [&](std::size_t i) {
      if (fresh[i] == 0 || first.load() < i) return;
      trials[i] = attempt(left[i], false);
      for (std::size_t now = first.load(); trials[i] && i < now;)
        if (first.compare_exchange_weak(now, i)) break;
    });
    return trials;
  }

  DenseCurve& curve_;
  const std::vector<FitPoint>& points_;
  CalmOptions options_;
  double most_rms_;  ///< as it was asked for
  BandReport report_;
  Refusals refusals_;
  Refusals bends_;  ///< to the other side that stay
  AtOnce bends_at_once_;
  int bend_tries_ = 0;                     ///< of single ones
  std::vector<std::vector<int>> in_vain_;  ///< extrema that were tried with the curve as it is
  AtOnce at_once_;
  int tries_ = 0;  ///< of single waves
  bool untried_ = false;
};

}  // namespace

Calmed calm(DenseCurve& curve, const std::vector<FitPoint>& points, const CalmOptions& options) {
  return Calming(curve, points, options).run();
}

BandReport calm_again(DenseCurve& curve, const std::vector<FitPoint>& points, double spring,
                      const CalmOptions& options) {
  return solve_without(curve, points, turns_of(curve), spring, options);
}

}  // namespace keyline::fairing::detail
