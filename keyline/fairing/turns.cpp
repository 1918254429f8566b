#include "keyline/fairing/turns.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "keyline/analysis/comb_figures.h"
#include "keyline/fairing/pooled.h"
#include "keyline/fairing/sideways.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kTurn = 1e-3;   // of the range: what counts as a turn at all
constexpr double kLevel = 0.01;  // of the range over the length: rates that count as none

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

/// How far the curve departs from node a to b (of a closed curve perhaps on other laps) where
/// curvature becomes one that only runs that way; in the curve's unit. Of a wave that is a sine
/// this is its amplitude.
double departure(const DenseCurve& curve, int a, int b, double way) {
  const std::vector<CellMean> cells = means_of(curve, a, b);
  double most = 0;
  std::size_t first = 0;
  const double sign = way < 0 ? -1 : 1;
  const auto risen = [&](std::size_t i) { return sign * cells[i].curvature; };
  for (const Pool& pool :
       pooled(cells.size(), risen, [&](std::size_t i) { return cells[i].width; })) {
    most = std::max(most, sideways({&cells[first], pool.count}, sign * pool.mean));
    first += pool.count;
  }
  return most * curve.length;
}

/// Cells before or behind an extremum along which curvature stays as it is, up to `most`.
int level_cells(const DenseCurve& curve, int node, bool behind, int most, double least_rate) {
  int count = 0;
  for (; count < most; ++count) {
    const int c = behind ? node + count : node - count - 1;
    const double rise = curve.joints[c + 1].curvature - curve.joints[c].curvature;
    if (std::abs(rise) > least_rate * (curve.at[c + 1] - curve.at[c])) break;
  }
  return count;
}

}  // namespace

std::vector<int> extrema_of(const DenseCurve& curve, double least) {
  const std::vector<double> k = curvatures(curve);
  const int n = static_cast<int>(k.size());
  std::vector<int> found;
  // A closed curve is read from its highest node on.
  const int start = static_cast<int>(std::max_element(k.begin(), k.end()) - k.begin());
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

std::vector<int> seen_turns_of(const DenseCurve& curve) {
  return extrema_of(curve, analysis::kSeenWave * range_of(curve));
}

int seen_waves(const DenseCurve& curve) {
  return analysis::comb_figures({curve.at, curvatures(curve)}).waves;
}

std::vector<Removal> removals(const DenseCurve& curve, const std::vector<int>& extrema) {
  std::vector<Removal> all;
  const int n = static_cast<int>(extrema.size());
  const int last = static_cast<int>(curve.joints.size()) - 1;
  std::vector<std::size_t> before(curve.joints.size());  // feet in the cells before a node
  for (const Foot& foot : curve.feet) ++before[foot.piece + 1];
  std::partial_sum(before.begin(), before.end(), before.begin());
  // Node of an extremum; beyond the first and last an open curve's ends, or the next lap's.
  const auto node = [&](int i) {
    if (!curve.closed) return i < 0 ? 0 : i < n ? extrema[i] : last;
    return extrema[(i + n) % n] + (i < 0 ? -last : i < n ? 0 : last);
  };
  const auto add = [&](int from, int to, std::size_t first, std::size_t count) {
    const int a = node(from);
    const int b = node(to) - (node(to) > last ? last : 0);
    const int lap = b < a ? 1 : 0;
    // What goes runs against what stays on both sides of it.
    const double way = curve.joints[a].curvature - curve.joints[b].curvature;
    all.push_back({departure(curve, node(from - 1), node(to + 1), way),
                   curve.at[b] - curve.at[a] + lap, first, count,
                   before[b] - before[a] + lap * before.back()});
  };
  for (int i = 0; i + 1 < n; ++i) add(i, i + 1, i, 2);
  if (curve.closed) {
    if (n > 2) add(n - 1, n, n - 1, 2);
  } else if (n > 0) {
    add(-1, 0, 0, 1);
    add(n - 1, n, n - 1, 1);
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

std::vector<int> moved_on(const DenseCurve& curve, const std::vector<int>& extrema) {
  std::vector<int> now = extrema;
  const double least_rate = kLevel * range_of(curve);
  const int last = static_cast<int>(curve.joints.size()) - 1;
  for (std::size_t i = 0; i < extrema.size(); ++i) {
    const int before = i == 0 ? 0 : extrema[i - 1];
    const int after = i + 1 == extrema.size() ? last : extrema[i + 1];
    const int back = level_cells(curve, extrema[i], false, extrema[i] - before - 1, least_rate);
    const int on = level_cells(curve, extrema[i], true, after - extrema[i] - 1, least_rate);
    if (back == 0 && on > 0) now[i] += on;
    if (on == 0 && back > 0) now[i] -= back;
  }
  return now;
}

}  // namespace keyline::fairing::detail
