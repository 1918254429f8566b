#include "keyline/fairing/counter_bends.h"

#include <algorithm>

#include "keyline/fairing/sideways.h"

namespace keyline::fairing::detail {
namespace {

/// Nodes first to last - 1 with curvature of one sign.
struct SignRun {
  int first = 0;
  int last = 0;
  int sign = 0;
};

int cells_of(const DenseCurve& curve) { return static_cast<int>(curve.joints.size()) - 1; }

/// A node of any lap as it stands among the joints.
int node_at(const DenseCurve& curve, int node) {
  return curve.closed ? node % cells_of(curve) : node;
}

double curvature_at(const DenseCurve& curve, int node) {
  return curve.joints[node_at(curve, node)].curvature;
}

int sign_at(const DenseCurve& curve, int node) {
  const double k = curvature_at(curve, node);
  return k > 0 ? 1 : k < 0 ? -1 : 0;
}

/// Of a closed curve from where its sign changes first, beyond its last node on the next lap. Nodes
/// without curvature belong to the run before them.
std::vector<SignRun> sign_runs(const DenseCurve& curve) {
  const int nodes = cells_of(curve) + (curve.closed ? 0 : 1);
  int start = 0;
  if (curve.closed)
    while (start < nodes && sign_at(curve, start) == sign_at(curve, start + nodes - 1)) ++start;
  start %= nodes;
  std::vector<SignRun> runs{{start, start, sign_at(curve, start)}};
  for (int i = start; i < start + nodes; ++i) {
    const int sign = sign_at(curve, i);
    SignRun& run = runs.back();
    if (run.sign == 0) run.sign = sign;
    if (sign == 0 || sign == run.sign)
      run.last = i + 1;
    else
      runs.push_back({i, i + 1, sign});
  }
  if (curve.closed && runs.size() > 1 && runs.front().sign == runs.back().sign) {
    runs.back().last = runs.front().last + nodes;  // it had begun at a node without curvature
    runs.erase(runs.begin());
  }
  return runs;
}

int peak_of(const DenseCurve& curve, const SignRun& run) {
  int peak = run.first;
  for (int i = run.first; i < run.last; ++i)
    if (std::abs(curvature_at(curve, i)) > std::abs(curvature_at(curve, peak))) peak = i;
  return peak;
}

/// What an open curve's end may do to bends there.
enum class End { held, free, mirrored };

End end_of(const DenseCurve& curve, bool at_start) {
  const Hold hold = at_start ? curve.hold_start : curve.hold_end;
  if (hold == Hold::free) return End::free;
  const bool slides = at_start ? curve.slides_start : curve.slides_end;
  return slides && hold >= Hold::direction ? End::mirrored : End::held;
}

/// See CounterBend.
double sideways(const DenseCurve& curve, const SignRun& run) {
  std::vector<CellMean> cells = means_of(curve, run.first, run.last - 1);
  const bool starts = !curve.closed && run.first == 0;
  const bool ends = !curve.closed && run.last == cells_of(curve) + 1;
  if (starts && end_of(curve, true) == End::mirrored)
    cells.insert(cells.begin(), cells.rbegin(), cells.rend());
  else if (ends && end_of(curve, false) == End::mirrored)
    cells.insert(cells.end(), cells.rbegin(), cells.rend());
  return cells.empty() ? 0 : sideways(cells, 0) * curve.length;
}

}  // namespace

std::vector<CounterBend> counter_bends(const DenseCurve& curve) {
  const std::vector<SignRun> runs = sign_runs(curve);
  const int count = cells_of(curve);
  const int n = static_cast<int>(runs.size());
  std::vector<CounterBend> all;
  if (n < 2) return all;
  const auto peak = [&](int r) {
    if (r < 0) return curve.closed ? peak_of(curve, runs[n - 1]) - count : 0;
    if (r == n) return curve.closed ? peak_of(curve, runs[0]) + count : count;
    return peak_of(curve, runs[r]);
  };
  const int first = curve.closed || end_of(curve, true) != End::held ? 0 : 1;
  const int last = curve.closed || end_of(curve, false) != End::held ? n : n - 1;
  for (int r = first; r < last; ++r) {
    const int before = peak(r - 1);
    const int lap = before < 0 ? count : 0;
    all.push_back({sideways(curve, runs[r]), before + lap, peak(r + 1) + lap,
                   static_cast<signed char>(-runs[r].sign)});
  }
  std::stable_sort(all.begin(), all.end(), [](const CounterBend& a, const CounterBend& b) {
    return a.sideways < b.sideways;
  });
  return all;
}

std::vector<CounterBend> apart(const DenseCurve& curve, const std::vector<CounterBend>& bends) {
  std::vector<CounterBend> taken;
  std::vector<signed char> side(curve.joints.size(), 0);
  for (const CounterBend& bend : bends) {
    bool free = true;
    for (int i = bend.first; i <= bend.last; ++i) free &= side[node_at(curve, i)] * bend.side >= 0;
    if (!free) continue;
    for (int i = bend.first; i <= bend.last; ++i) side[node_at(curve, i)] = bend.side;
    taken.push_back(bend);
  }
  return taken;
}

void set_side(DenseCurve& curve, const CounterBend& bend) {
  if (curve.side.empty()) curve.side.assign(curve.joints.size(), 0);
  for (int i = bend.first; i <= bend.last; ++i) curve.side[node_at(curve, i)] = bend.side;
  if (curve.closed) curve.side.back() = curve.side.front();
}

void loosen_side(DenseCurve& curve, bool at_start) {
  const std::size_t n = curve.side.size();
  const auto from_end = [&](std::size_t i) { return at_start ? i : n - 1 - i; };
  const auto bend = [&](std::size_t i) { return std::abs(curve.value[from_end(i)]); };
  const int side = n > 0 ? curve.side[from_end(0)] : 0;
  for (std::size_t i = 0; i < n && curve.side[from_end(i)] == side; ++i) {
    if (i > 0 && bend(i) < bend(i - 1)) break;
    curve.side[from_end(i)] = 0;
  }
}

}  // namespace keyline::fairing::detail
