#include "keyline/fairing/graph_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "keyline/core/angle.h"

namespace keyline::fairing::detail {
namespace {

constexpr int kPlaces = 20;               // of a run between which it may be cut, besides its ends
constexpr double kBendPower = 2.0 / 3;    // density of places for least squares of the rate
constexpr double kInflectionLow = -1;     // slopes of pieces through or into an inflection, whose
constexpr double kInflectionHigh = -0.3;  // variation is finite and whose rate is

constexpr double kNearInflection = 1e-2;

double power_mean(double a, double b, double p, double v) {
  if (v <= 0) return a;
  if (v >= 1) return b;
  if (a * b <= 0) {
    const auto sp = [](double x, double e) { return std::copysign(std::pow(std::abs(x), e), x); };
    return sp((1 - v) * sp(a, p) + v * sp(b, p), 1 / p);
  }
  const double l = std::log(b / a);
  if (std::abs(p * l) < 1e-7) return a * std::exp(v * l);
  return a * std::exp(std::log1p(v * std::expm1(p * l)) / p);
}

}  // namespace

GraphPieces::GraphPieces(const DenseCurve& curve, const std::vector<int>& turns,
                         core::Interval slopes)
    : curve_(curve.closed && !turns.empty() ? begun_at(curve, turns.front()) : curve),
      slopes_(slopes) {
  const int cells = static_cast<int>(curve.joints.size()) - 1;
  const int start = curve.closed && !turns.empty() ? turns.front() : 0;
  std::vector<int> ends{0};
  for (const int turn : turns)
    if (turn > start) ends.push_back(turn - start);
  if (ends.back() != cells) ends.push_back(cells);
  for (std::size_t r = 0; r + 1 < ends.size(); ++r) {
    runs_.push_back(make_run(ends[r], ends[r + 1]));
    tabulate(runs_.back());
  }
}

GraphPieces::Run GraphPieces::make_run(int from, int to) const {
  std::vector<double> weight{0};
  double mean = 0;
  std::vector<double> bend;
  for (int i = from + 1; i < to; ++i) {
    const double before =
        (curve_.value[i] - curve_.value[i - 1]) / (curve_.at[i] - curve_.at[i - 1]);
    const double after =
        (curve_.value[i + 1] - curve_.value[i]) / (curve_.at[i + 1] - curve_.at[i]);
    const double width = 0.5 * (curve_.at[i + 1] - curve_.at[i - 1]);
    bend.push_back(width * std::pow(std::abs(after - before) / width, kBendPower));
    mean += bend.back();
  }
  const double length = curve_.at[to] - curve_.at[from];
  for (int i = from + 1; i < to; ++i) {
    const double width = 0.5 * (curve_.at[i + 1] - curve_.at[i - 1]);
    weight.push_back(weight.back() + bend[i - from - 1] + 0.25 * mean * width / length);
  }
  Run run{{from}, {}, {}, {}};
  double next = weight.back() / (kPlaces + 1);
  for (int i = from + 1; i < to; ++i) {
    if (to - from - 1 > kPlaces && weight[i - from] < next) continue;
    run.place.push_back(i);
    while (next <= weight[i - from]) next += weight.back() / (kPlaces + 1);
  }
  run.place.push_back(to);
  return run;
}

double GraphPieces::excess_of(int from, int to, double alpha) const {
  const double a = curve_.value[from];
  const double b = curve_.value[to];
  double sum = 0;
  double last = a;
  for (int i = from + 1; i <= to; ++i) {
    const double v = (curve_.at[i] - curve_.at[from]) / (curve_.at[to] - curve_.at[from]);
    const double k = power_mean(a, b, -alpha, v);
    const double off = (k - last) - (curve_.value[i] - curve_.value[i - 1]);
    sum += off * off / (curve_.at[i] - curve_.at[i - 1]);
    last = k;
  }
  return sum;
}

core::Interval GraphPieces::slopes_of(int from, int to) const {
  const double a = curve_.value[from];
  const double b = curve_.value[to];
  const bool inflected = a * b <= 0 || std::min(std::abs(a), std::abs(b)) <
                                           kNearInflection * std::max(std::abs(a), std::abs(b));
  if (!inflected) return slopes_;
  return {std::max(slopes_.low, kInflectionLow), std::min(slopes_.high, kInflectionHigh)};
}

GraphPieces::Fit GraphPieces::best_fit(int from, int to) const {
  const core::Interval range = slopes_of(from, to);
  Fit best{std::clamp(-1.0, range.low, range.high), 0};
  best.excess = excess_of(from, to, best.alpha);
  if (to - from < 2 || range.high <= range.low) return best;
  // Golden section; the excess has one least value in the slopes of interest.
  constexpr double kGolden = 0.6180339887498949;
  double low = range.low;
  double high = range.high;
  double x1 = high - kGolden * (high - low);
  double x2 = low + kGolden * (high - low);
  double f1 = excess_of(from, to, x1);
  double f2 = excess_of(from, to, x2);
  for (int step = 0; step < 9; ++step) {
    if (f1 < f2) {
      high = x2;
      x2 = x1;
      f2 = f1;
      x1 = high - kGolden * (high - low);
      f1 = excess_of(from, to, x1);
    } else {
      low = x1;
      x1 = x2;
      f1 = f2;
      x2 = low + kGolden * (high - low);
      f2 = excess_of(from, to, x2);
    }
  }
  if (std::min(f1, f2) < best.excess) best = f1 < f2 ? Fit{x1, f1} : Fit{x2, f2};
  return best;
}

void GraphPieces::tabulate(Run& run) const {
  const int n = static_cast<int>(run.place.size());
  run.fit.assign(n, std::vector<Fit>(n));
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) run.fit[i][j] = best_fit(run.place[i], run.place[j]);
  std::vector<double> least(n, HUGE_VAL);
  least[0] = 0;
  for (int pieces = 1; pieces < n; ++pieces) {
    std::vector<double> next(n, HUGE_VAL);
    std::vector<int> from(n, 0);
    for (int j = 1; j < n; ++j)
      for (int i = 0; i < j; ++i) {
        const double sum = least[i] + run.fit[i][j].excess;
        if (sum >= next[j]) continue;
        next[j] = sum;
        from[j] = i;
      }
    least = next;
    run.excess.push_back(least[n - 1]);
    run.from.push_back(std::move(from));
  }
}

double GraphPieces::total(const std::vector<int>& count) const {
  double sum = 0;
  for (std::size_t r = 0; r < runs_.size(); ++r) sum += runs_[r].excess[count[r] - 1];
  return sum;
}

/// One piece more where it helps most; false where every run has all it may.
bool GraphPieces::add_piece(std::vector<int>& count) const {
  double most = 0;
  std::size_t best = runs_.size();
  int by = 0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const auto& excess = runs_[r].excess;
    for (int more = 1; more <= 2 && count[r] + more <= static_cast<int>(excess.size()); ++more) {
      const double gain = (excess[count[r] - 1] - excess[count[r] + more - 1]) / more;
      if (gain <= most) continue;
      most = gain;
      best = r;
      by = more;
    }
  }
  if (best == runs_.size()) return false;
  count[best] += by;
  return true;
}

std::vector<int> GraphPieces::within(double excess) const {
  std::vector<int> count(runs_.size(), 1);
  while (total(count) > excess && add_piece(count));
  return count;
}

std::vector<int> GraphPieces::of_count(int pieces) const {
  std::vector<int> count(runs_.size(), 1);
  while (std::accumulate(count.begin(), count.end(), 0) < pieces && add_piece(count));
  return count;
}

bool GraphPieces::refine(std::vector<int>& count, const std::vector<double>& at) const {
  bool more = false;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const double from = curve_.at[runs_[r].place.front()];
    const double to = curve_.at[runs_[r].place.back()];
    const bool asked =
        std::any_of(at.begin(), at.end(), [&](double t) { return from <= t && t <= to; });
    if (!asked || count[r] >= static_cast<int>(runs_[r].excess.size())) continue;
    ++count[r];
    more = true;
  }
  return more;
}

DenseCurve GraphPieces::cut_by(const std::vector<int>& count) const {
  DenseCurve out = curve_;
  out.cut = {0};
  out.alpha.clear();
  out.sense.clear();
  out.value = {curve_.value.front()};
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const Run& run = runs_[r];
    std::vector<int> path{static_cast<int>(run.place.size()) - 1};
    for (int p = count[r] - 1; p >= 0; --p) path.push_back(run.from[p][path.back()]);
    std::reverse(path.begin(), path.end());
    for (std::size_t q = 1; q < path.size(); ++q) {
      const int to = run.place[path[q]];
      out.cut.push_back(to);
      out.alpha.push_back(run.fit[path[q - 1]][path[q]].alpha);
      out.value.push_back(curve_.value[to]);
      const double rise = curve_.value[run.place.back()] - curve_.value[run.place.front()];
      out.sense.push_back(rise < 0 ? -1 : 1);
    }
  }
  return out;
}

}  // namespace keyline::fairing::detail
