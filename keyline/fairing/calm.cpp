#include "keyline/fairing/calm.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "keyline/analysis/comb_figures.h"
#include "keyline/numeric/parallel.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kTurn = 1e-3;   // of the range: what counts as a turn at all
constexpr double kLevel = 0.01;  // of the range over the length: rates that count as none
constexpr int kRounds = 4;       // in which an extremum may move on
constexpr double kHopeless = 4;  // tolerances: a wave twice as wide as the band cannot be taken out
constexpr int kTrialSteps = 40;  // of a trial: one that does not come within the band by then fails
constexpr double kTrialGap = 0.03;  // of the energy, all of which a wave less may cost again
constexpr int kPatience = 4;  // steps: what is possible at all takes back its extra width sooner
// Single waves that are tried. In a row that all stay, least first, twice as many as stood before
// one that went on any measured profile: wider ones stay too. Of one curve, three times as many as
// on any: more have only curves that follow their points' errors.
constexpr int kInRow = 24;
constexpr int kTries = 100;

std::vector<double> curvatures(const DenseCurve& curve) {
  std::vector<double> k;
  for (const FitJoint& joint : curve.joints) k.push_back(joint.curvature);
  return k;
}

double range_of(const DenseCurve& curve) {
  const std::vector<double> k = curvatures(curve);
  const auto [low, high] = std::minmax_element(k.begin(), k.end());
  return *high - *low;
}

/// A swing of curvature that may go: which extrema bound it.
struct Removal {
  double sideways = HUGE_VAL;  ///< how far a wave of this swing and width departs from its middle
  double share = 0;            ///< of the length
  std::size_t first = 0;
  std::size_t count = 0;  ///< 1 at an end, else 2
};

/// Amplitude of a wave whose curvature swings by so much over half a wave's length: of
/// swing/2 * sin(pi s / half), integrated twice.
double sideways(double swing, double half) {
  return 0.5 * std::abs(swing) * half * half / (std::numbers::pi * std::numbers::pi);
}

std::vector<Removal> removals(const DenseCurve& curve, const std::vector<int>& extrema) {
  std::vector<Removal> all;
  const std::size_t n = extrema.size();
  const auto add = [&](int a, int b, double lap, std::size_t first, std::size_t count) {
    const double swing = (curve.joints[b].curvature - curve.joints[a].curvature) / curve.length;
    const double half = std::abs(curve.at[b] - curve.at[a] + lap) * curve.length;
    all.push_back({sideways(swing, half), half / curve.length, first, count});
  };
  for (std::size_t i = 0; i + 1 < n; ++i) add(extrema[i], extrema[i + 1], 0, i, 2);
  if (curve.closed) {
    if (n > 2) add(extrema[n - 1], extrema[0], 1, n - 1, 2);
  } else if (n > 0) {
    add(0, extrema[0], 0, 0, 1);
    add(extrema[n - 1], static_cast<int>(curve.joints.size()) - 1, 0, n - 1, 1);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Removal& a, const Removal& b) { return a.sideways < b.sideways; });
  return all;
}

std::vector<int> without(const std::vector<int>& extrema, const std::vector<Removal>& gone) {
  std::vector<char> stays(extrema.size(), 1);
  for (const Removal& r : gone)
    for (std::size_t i = 0; i < r.count; ++i) stays[(r.first + i) % extrema.size()] = 0;
  std::vector<int> left;
  for (std::size_t i = 0; i < extrema.size(); ++i)
    if (stays[i]) left.push_back(extrema[i]);
  return left;
}

/// Senses of the cells for extrema at these nodes, alternately as the curve has them.
void set_senses(DenseCurve& curve, const std::vector<int>& extrema) {
  const std::size_t cells = curve.joints.size() - 1;
  curve.sense.assign(cells, 0);
  const auto k = [&](int node) { return curve.joints[node].curvature; };
  const auto mark = [&](int from, int to, double rise) {
    for (int c = from; c < to; ++c) curve.sense[c] = rise < 0 ? -1 : 1;
  };
  const int last = static_cast<int>(cells);
  if (extrema.empty()) {
    if (!curve.closed) mark(0, last, k(last) - k(0));
    return;
  }
  for (std::size_t i = 0; i + 1 < extrema.size(); ++i)
    mark(extrema[i], extrema[i + 1], k(extrema[i + 1]) - k(extrema[i]));
  if (extrema.size() == 1) {
    // One turn: up to it what is lower, or down to it what is higher, than the ends' mean.
    const double ends = 0.5 * (k(0) + k(last));
    mark(0, extrema[0], k(extrema[0]) - ends);
    mark(extrema[0], last, ends - k(extrema[0]));
    return;
  }
  const double first = k(extrema[1]) - k(extrema[0]);
  const double end = k(extrema.back()) - k(extrema[extrema.size() - 2]);
  mark(0, extrema.front(), -first);
  mark(extrema.back(), last, -end);
}

/// Cells beside an extremum along which curvature stays as it is, `way` from it, up to `most`.
int level_cells(const DenseCurve& curve, int node, int way, int most, double least_rate) {
  int count = 0;
  for (; count < most; ++count) {
    const int c = way > 0 ? node + count : node - count - 1;
    const double rise = curve.joints[c + 1].curvature - curve.joints[c].curvature;
    if (std::abs(rise) > least_rate * (curve.at[c + 1] - curve.at[c])) break;
  }
  return count;
}

}  // namespace

std::vector<int> moved_on(const DenseCurve& curve, const std::vector<int>& extrema) {
  std::vector<int> now = extrema;
  const double least_rate = kLevel * range_of(curve);
  const int last = static_cast<int>(curve.joints.size()) - 1;
  for (std::size_t i = 0; i < extrema.size(); ++i) {
    const int before = i == 0 ? 0 : extrema[i - 1];
    const int after = i + 1 == extrema.size() ? last : extrema[i + 1];
    const int back = level_cells(curve, extrema[i], -1, extrema[i] - before - 1, least_rate);
    const int on = level_cells(curve, extrema[i], 1, after - extrema[i] - 1, least_rate);
    if (back == 0 && on > 0) now[i] += on;
    if (on == 0 && back > 0) now[i] -= back;
  }
  return now;
}

std::vector<int> extrema_of(const DenseCurve& curve, double least) {
  const std::vector<double> k = curvatures(curve);
  const int n = static_cast<int>(k.size());
  std::vector<int> found;
  // A closed curve is read from its highest node on.
  const int start =
      curve.closed ? static_cast<int>(std::max_element(k.begin(), k.end()) - k.begin()) : 0;
  const auto node = [&](int i) { return curve.closed ? (start + i) % (n - 1) : i; };
  int low = node(0);
  int high = node(0);
  int way = curve.closed ? -1 : 0;
  if (curve.closed) found.push_back(node(0));
  for (int i = 0; i < n; ++i) {
    const int at = node(i);
    if (k[at] < k[low]) low = at;
    if (k[at] > k[high]) high = at;
    if (way >= 0 && k[at] < k[high] - least) {
      if (way > 0) found.push_back(high);
      way = -1;
      low = at;
    } else if (way <= 0 && k[at] > k[low] + least) {
      if (way < 0) found.push_back(low);
      way = 1;
      high = at;
    }
    if (way > 0) low = at;
    if (way < 0) high = at;
  }
  if (curve.closed && found.size() == 1) found.clear();
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<int> turns_of(const DenseCurve& curve) {
  return extrema_of(curve, kTurn * range_of(curve));
}

int seen_waves(const DenseCurve& curve) {
  return analysis::comb_figures({curve.at, curvatures(curve)}).waves;
}

namespace {

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

/// The search for waves to take out.
class Calming {
 public:
  Calming(DenseCurve& curve, const std::vector<FitPoint>& points, const CalmOptions& options)
      : curve_(curve), points_(points), options_(options) {}

  Calmed run() {
    report_ = least_variation(curve_, points_, options_.band);
    if (report_.within) take_waves();
    return {report_, {static_cast<int>(turns_of(curve_).size()), untried_}};
  }

 private:
  void take_waves() {
    take(extrema_of(curve_, analysis::kSeenWave * range_of(curve_)), true);
    while (!options_.band.progress.stop_requested() && (together() || single()));
    if (options_.most_turns) keep_to(*options_.most_turns);
  }

  /// Further waves go for the asking, while the tolerance holds.
  void keep_to(int turns) {
    options_.most_rms = options_.worth = HUGE_VAL;
    refusals_.clear();
    in_vain_.clear();
    const auto left = [&] { return static_cast<int>(turns_of(curve_).size()); };
    while (!options_.band.progress.stop_requested() && left() > turns && single());
  }

  /// A curve with some extrema alone, where it is worth it.
  struct Trial {
    DenseCurve curve;
    BandReport report;
  };

  /// Solves with these extrema alone.
  std::optional<Trial> attempt(const std::vector<int>& extrema, bool any_count) const {
    Trial trial{curve_, {}};
    trial.report = solve_without(trial.curve, points_, extrema, report_.spring, options_);
    const BandReport& found = trial.report;
    if (!found.within || found.rms > options_.most_rms ||
        found.energy > options_.worth * report_.energy)
      return {};
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

  /// As many waves at once as should fit into the band and the mean square; where that fails, half
  /// as many, and where it succeeds, twice as many the next time.
  bool together() {
    const std::vector<int> extrema = turns_of(curve_);
    std::vector<Removal> small = hopeful(extrema);
    small.resize(std::min(small.size(), most_at_once_));
    while (small.size() > 1) {
      if (take(without(extrema, small))) {
        most_at_once_ = 2 * small.size();
        return true;
      }
      small.resize(small.size() / 2);
      most_at_once_ = small.size();
    }
    return false;
  }

  /// Waves that share no extremum, least first, until their departures fill what is left.
  std::vector<Removal> hopeful(const std::vector<int>& extrema) const {
    std::vector<char> gone(extrema.size(), 0);
    std::vector<Removal> small;
    const double spare = std::pow(options_.most_rms, 2) - std::pow(report_.rms, 2);
    double sum = 0;
    for (const Removal& r : removals(curve_, extrema)) {
      sum += 0.5 * r.sideways * r.sideways * r.share;
      if (r.sideways > options_.band.tolerance || sum > spare) break;
      const std::size_t next = (r.first + r.count - 1) % extrema.size();
      if (gone[r.first] || gone[next] || refused(r)) continue;
      gone[r.first] = gone[next] = 1;
      small.push_back(r);
    }
    return small;
  }

  /// The least wave that is worth it; as many as there are threads are tried at a time.
  bool single() {
    const std::vector<int> extrema = turns_of(curve_);
    const std::vector<Removal> all = removals(curve_, extrema);
    int in_row = 0;
    untried_ = false;
    for (std::size_t next = 0;;) {
      const std::vector<Removal> few = following(all, next, in_row);
      if (few.empty()) return false;
      std::vector<std::optional<Trial>> trials = attempts(extrema, few);
      for (std::size_t i = 0; i < few.size(); ++i) {
        ++in_row;
        ++tries_;
        if (trials[i]) {
          accept(std::move(*trials[i]));
          untried_ = false;
          most_at_once_ = std::max<std::size_t>(most_at_once_, 2);
          return true;
        }
        refusals_.push_back(few[i].sideways);
      }
    }
  }

  /// The next ones to be tried, as if each of them were refused.
  std::vector<Removal> following(const std::vector<Removal>& all, std::size_t& next, int in_row) {
    const auto most = static_cast<std::size_t>(numeric::thread_count(options_.threads));
    const std::size_t refused_before = refusals_.size();
    std::vector<Removal> few;
    for (; next < all.size() && few.size() < most; ++next) {
      const Removal& r = all[next];
      const int tried = static_cast<int>(few.size());
      const bool hopeless = r.sideways > kHopeless * options_.band.tolerance;
      if (!hopeless && refused(r)) continue;
      untried_ = !hopeless && (in_row + tried == kInRow || tries_ + tried == kTries);
      if (hopeless || untried_) {
        next = all.size();
        break;
      }
      few.push_back(r);
      refusals_.push_back(r.sideways);
    }
    refusals_.resize(refused_before);
    return few;
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

  /// The same swing again: it was tried and is not worth it.
  bool refused(const Removal& r) const {
    return std::any_of(refusals_.begin(), refusals_.end(),
                       [&](double s) { return std::abs(s - r.sideways) < 1e-3 * s; });
  }

  DenseCurve& curve_;
  const std::vector<FitPoint>& points_;
  CalmOptions options_;
  BandReport report_;
  std::vector<double> refusals_;
  std::vector<std::vector<int>> in_vain_;  ///< extrema that were tried with the curve as it is
  std::size_t most_at_once_ = 1'000'000;
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
