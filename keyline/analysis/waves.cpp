#include "keyline/analysis/waves.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "keyline/core/angle.h"

namespace keyline::analysis::detail {
namespace {

// Curvature a sin(2 pi s / w) moves the line by a (w / 2 pi)^2: a wave that swings by 2a over its
// length w by swing * w^2 / (8 pi^2), a lobe of height a and length w / 2 by a * length^2 / pi^2.
constexpr double kWaveFactor = 8 * core::kPi * core::kPi;
constexpr double kLobeFactor = core::kPi * core::kPi;
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// The turning points as a linked list, with the smallest wave always at hand.
class Waves {
 public:
  Waves(const std::vector<Sample>& samples, const Rounding& rounding,
        std::vector<std::size_t> turns)
      : samples_(samples), rounding_(rounding), turns_(std::move(turns)) {
    const std::size_t n = turns_.size();
    before_.resize(n);
    after_.resize(n);
    rank_.assign(n, -1);
    for (std::size_t i = 0; i < n; ++i) {
      before_[i] = i == 0 ? kNone : i - 1;
      after_[i] = i + 1 < n ? i + 1 : kNone;
    }
    for (std::size_t i = 0; i < n; ++i) rate(i);
  }

  void merge(double noise, std::vector<MergedWave>& merged) {
    while (count_ > 1 && queue_.begin()->first <= noise) {
      const std::size_t left = queue_.begin()->second;
      const MergedWave wave = measure(left);
      if (wave.swing > rounding_at(left)) merged.push_back(wave);
      remove(left);
    }
  }

  std::vector<std::size_t> left_over() const {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i != kNone; i = after_[i]) result.push_back(turns_[i]);
    return result;
  }

 private:
  double value(std::size_t node) const { return samples_[turns_[node]].curvature; }

  double rounding_at(std::size_t left) const {
    return rounding_.of(value(left), value(after_[left]));
  }

  /// Sample nearest `start` towards `stop` where curvature has crossed the level.
  std::size_t crossing(std::size_t start, std::size_t stop, double level, bool above) const {
    std::size_t i = start;
    while (i != stop && (samples_[i].curvature > level) == above) i = stop > start ? i + 1 : i - 1;
    return i;
  }

  /// The wave that the swing from node `left` to the next one belongs to.
  MergedWave measure(std::size_t left) const {
    const std::size_t right = after_[left];
    const double level = (value(left) + value(right)) / 2;
    std::size_t from = turns_[left];
    std::size_t to = turns_[right];
    const bool at_start = before_[left] == kNone;
    const bool at_end = after_[right] == kNone;
    if (!at_start) from = crossing(from, turns_[before_[left]], level, value(left) > level);
    if (!at_end) to = crossing(to, turns_[after_[right]], level, value(right) > level);
    MergedWave wave;
    wave.t = {samples_[from].t, samples_[to].t};
    wave.swing = std::abs(value(right) - value(left));
    // A wave cut off by an end shows three quarters of its length.
    wave.wavelength = (samples_[to].s - samples_[from].s) * (at_start || at_end ? 4.0 / 3 : 1.0);
    wave.displacement = wave.swing * wave.wavelength * wave.wavelength / kWaveFactor;
    return wave;
  }

  /// (Re)enters the swing that begins at this node into the queue.
  void rate(std::size_t node) {
    if (node == kNone) return;
    forget(node);
    if (after_[node] == kNone) return;
    const MergedWave wave = measure(node);
    rank_[node] = wave.swing <= rounding_at(node) ? 0 : wave.displacement;
    queue_.insert({rank_[node], node});
    ++count_;
  }

  void forget(std::size_t node) {
    if (rank_[node] < 0) return;
    queue_.erase({rank_[node], node});
    rank_[node] = -1;
    --count_;
  }

  void unlink(std::size_t node) {
    forget(node);
    after_[before_[node]] = after_[node];
    before_[after_[node]] = before_[node];
  }

  bool is_end(std::size_t node) const { return before_[node] == kNone || after_[node] == kNone; }

  /// Removes a node that is no turning point any more.
  bool drop_if_passed(std::size_t node) {
    if (node == kNone || is_end(node)) return false;
    const double in = value(node) - value(before_[node]);
    const double out = value(after_[node]) - value(node);
    if (in * out < 0) return false;
    unlink(node);
    return true;
  }

  void remove(std::size_t left) {
    const std::size_t right = after_[left];
    std::size_t a = before_[left] == kNone ? left : before_[left];
    std::size_t d = after_[right] == kNone ? right : after_[right];
    if (!is_end(left)) unlink(left);
    if (!is_end(right)) unlink(right);
    std::size_t outer = before_[a];
    if (drop_if_passed(a)) a = outer;
    outer = after_[d];
    if (drop_if_passed(d)) d = outer;
    if (before_[a] != kNone) rate(before_[a]);
    for (std::size_t i = a; i != kNone; i = after_[i]) {
      rate(i);
      if (i == d) break;
    }
  }

  const std::vector<Sample>& samples_;
  Rounding rounding_;
  std::vector<std::size_t> turns_;
  std::vector<std::size_t> before_, after_;
  std::vector<double> rank_;  // the key in the queue, -1 where not in it
  std::set<std::pair<double, std::size_t>> queue_;
  std::size_t count_ = 0;
};

std::vector<std::size_t> all_turns(const std::vector<Sample>& samples, std::size_t from,
                                   std::size_t to) {
  std::vector<std::size_t> turns = {from};
  double way = 0;
  for (std::size_t i = from + 1; i <= to; ++i) {
    const double step = samples[i].curvature - samples[i - 1].curvature;
    if (step == 0) continue;
    if (way * step < 0) turns.push_back(i - 1);
    way = step > 0 ? 1 : -1;
  }
  if (to > from) turns.push_back(to);
  return turns;
}

}  // namespace

std::vector<std::size_t> significant_turns(const std::vector<Sample>& samples, std::size_t from,
                                           std::size_t to, double noise, const Rounding& rounding,
                                           std::vector<MergedWave>& merged) {
  Waves waves(samples, rounding, all_turns(samples, from, to));
  waves.merge(noise, merged);
  return waves.left_over();
}

std::vector<std::size_t> significant_crossings(const std::vector<Sample>& samples, std::size_t from,
                                               std::size_t to, std::vector<std::size_t> crossings,
                                               double noise, const Rounding& rounding,
                                               std::vector<MergedWave>& merged) {
  const auto lobe = [&](std::size_t k) {  // before crossing k
    const std::size_t first = k == 0 ? from : crossings[k - 1] + 1;
    const std::size_t last = k == crossings.size() ? to : crossings[k];
    MergedWave wave;
    wave.t = {samples[first].t, samples[last].t};
    for (std::size_t i = first; i <= last; ++i)
      wave.swing = std::max(wave.swing, std::abs(samples[i].curvature));
    const double length = samples[last].s - samples[first].s;
    wave.wavelength = 2 * length;
    wave.displacement = wave.swing * length * length / kLobeFactor;
    return wave;
  };
  while (!crossings.empty()) {
    std::size_t smallest = 0;
    MergedWave least = lobe(0);
    for (std::size_t k = 1; k <= crossings.size(); ++k) {
      const MergedWave wave = lobe(k);
      if (wave.displacement < least.displacement) {
        smallest = k;
        least = wave;
      }
    }
    if (least.displacement > noise && least.swing > rounding.least) break;
    if (least.swing > rounding.least) merged.push_back(least);
    const auto at = crossings.begin() + static_cast<std::ptrdiff_t>(smallest);
    if (smallest == 0) {
      crossings.erase(at);
    } else if (smallest == crossings.size()) {
      crossings.pop_back();
    } else {
      crossings.erase(at - 1, at + 1);
    }
  }
  return crossings;
}

}  // namespace keyline::analysis::detail
