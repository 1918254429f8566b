#include "keyline/fairing/graph_pieces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keyline/lac/segment/piece_curvature.h"

namespace keyline::fairing::detail {
namespace {

constexpr int kPlaces = 40;  // of a run between which it may be cut, besides its ends, at first
constexpr int kPlacesOfPiece = 4;  // at least: a piece that can end only at each third has to be
                                   // short where one of the right length would do
constexpr double kBendPower = 2.0 / 3;    // density of places for least squares of the rate
constexpr double kInflectionLow = -1;     // slopes of pieces through or into an inflection, whose
constexpr double kInflectionHigh = -0.3;  // variation is finite and whose rate is

constexpr int kTurnSteps = 6;  // chord steps between a slope that turns too much and one too little
constexpr double kBowPrice = 0.1;  // energies: a piece that departs sideways by the tolerance
constexpr double kDrift = 0.25;    // of a piece's end beside the curve, as part of a bow as large:
                                   // neighbours can make up for it
constexpr double kNearInflection = 1e-2;  // of the other end's curvature: less is an inflection's…
constexpr double kMaySink = 0.1;  // …and this where it is kept on its side of zero, for it may sink

/// The graph between two places, and how pieces between them depart from it.
class Stretch {
 public:
  Stretch(const DenseCurve& curve, int from, int to)
      : start_(curve.value[from]), end_(curve.value[to]) {
    const double length = curve.at[to] - curve.at[from];
    for (int i = from + 1; i <= to; ++i) {
      value_.push_back(curve.value[i]);
      step_.push_back(curve.at[i] - curve.at[i - 1]);
      share_.push_back((curve.at[i] - curve.at[from]) / length);
    }
    off_.resize(value_.size());
  }

  /// How much farther than the curve the piece of this slope turns.
  double turn(double alpha) {
    const lac::PieceCurvature piece(start_, end_, alpha);
    double turn = 0;
    double last = 0;
    for (std::size_t i = 0; i < off_.size(); ++i) {
      off_[i] = piece.curvature(share_[i]) - value_[i];
      turn += 0.5 * step_[i] * (off_[i] + last);
      last = off_[i];
    }
    alpha_ = alpha;
    return turn;
  }

  /// What the variation of the piece is more than the curve's, as it stands or once the others have
  /// given way to it: to first order the square of what it is off, which is the least it can cost.
  double excess(double alpha) {
    take(alpha);
    double square = 0;
    double along = 0;
    double off = 0;
    double value = start_;
    for (std::size_t i = 0; i < off_.size(); ++i) {
      const double more = off_[i] - off;
      square += more * more / step_[i];
      along += 2 * more * (value_[i] - value) / step_[i];
      off = off_[i];
      value = value_[i];
    }
    return square + std::max(along, 0.0);
  }

  /// How far it bows from the curve, about.
  double bow(double alpha) {
    take(alpha);
    std::vector<double> sideways;
    double away = 0;
    double turn = 0;
    double last = 0;
    for (std::size_t i = 0; i < off_.size(); ++i) {
      away = away + step_[i] * (turn + 0.25 * step_[i] * (off_[i] + last));
      turn += 0.5 * step_[i] * (off_[i] + last);
      last = off_[i];
      sideways.push_back(away);
    }
    double most = kDrift * std::abs(away);
    for (std::size_t i = 0; i < sideways.size(); ++i)
      most = std::max(most, std::abs(sideways[i] - share_[i] * away));
    return most;
  }

 private:
  void take(double alpha) {
    if (alpha != alpha_) turn(alpha);
  }

  double start_;
  double end_;
  std::vector<double> value_;  ///< after the start
  std::vector<double> step_;
  std::vector<double> share_;
  std::vector<double> off_;  ///< of the piece of slope
  double alpha_ = HUGE_VAL;
};

/// The slope whose piece turns as far as the curve, or comes nearest to it: the flatter the slope,
/// the longer curvature stays near its lesser end.
double best_slope(Stretch& stretch, core::Interval range) {
  struct End {
    double alpha;
    double turn;
  };
  const auto at = [&](double alpha) { return End{alpha, stretch.turn(alpha)}; };
  End middle = at(std::clamp(-1.0, range.low, range.high));
  if (range.high <= range.low || middle.turn == 0) return middle.alpha;
  End low = at(range.low);
  End high = at(range.high);
  if (low.turn * high.turn >= 0)
    return std::abs(low.turn) < std::abs(high.turn) ? low.alpha : high.alpha;
  for (int step = 0; step < kTurnSteps; ++step) {
    (middle.turn * low.turn > 0 ? low : high) = middle;
    const bool near = std::abs(low.turn - high.turn) < 1e-12;
    const double share = near ? 0.5 : low.turn / (low.turn - high.turn);
    middle = at(std::lerp(low.alpha, high.alpha, std::clamp(share, 0.1, 0.9)));
  }
  return middle.alpha;
}

}  // namespace

GraphPieces::GraphPieces(const DenseCurve& curve, const std::vector<int>& turns,
                         core::Interval slopes, double energy, double tolerance)
    : slopes_(slopes), energy_(energy), tolerance_(tolerance / curve.length) {
  const int cells = static_cast<int>(curve.joints.size()) - 1;
  // What the ends of runs are by node: 1 a turn or an end, 2 where a line begins.
  std::vector<char> mark(cells + 1, 0);
  for (const int turn : turns) mark[turn] = 1;
  for (std::size_t p = 0; p < curve.alpha.size(); ++p) {
    if (curve.kind.empty() || curve.kind[p] != PieceKind::line) continue;
    for (int node = curve.cut[p]; node <= curve.cut[p + 1]; ++node) mark[node] = 0;
    mark[curve.cut[p]] = 2;
    if (mark[curve.cut[p + 1] % cells] == 0) mark[curve.cut[p + 1]] = 1;
  }
  int start = 0;
  if (curve.closed)
    while (start < cells && mark[start] == 0) ++start;
  start %= cells;
  curve_ = begun_at(curve, start);
  curve_.kind.clear();
  set_free(curve_);
  std::vector<int> ends{0};
  for (int i = 1; i < cells; ++i)
    if (mark[(start + i) % cells] != 0) ends.push_back(i);
  ends.push_back(cells);
  for (std::size_t r = 0; r + 1 < ends.size(); ++r)
    add_run(ends[r], ends[r + 1], mark[(start + ends[r]) % cells] == 2);
}

void GraphPieces::add_run(int from, int to, bool line) {
  if (line) {
    runs_.push_back({.place = {from, to},
                     .fit = {2, std::vector<Fit>(2)},
                     .loss = {0},
                     .from = {{0, 0}},
                     .line = true});
    return;
  }
  runs_.push_back(make_run(from, to, kPlaces));
  tabulate(runs_.back());
}

GraphPieces::Run GraphPieces::make_run(int from, int to, int places) const {
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
  if (mean == 0) mean = 1;  // nothing bends: places spread evenly
  const double length = curve_.at[to] - curve_.at[from];
  for (int i = from + 1; i < to; ++i) {
    const double width = 0.5 * (curve_.at[i + 1] - curve_.at[i - 1]);
    weight.push_back(weight.back() + bend[i - from - 1] + 0.25 * mean * width / length);
  }
  Run run;
  run.place = {from};
  run.places = places;
  double next = weight.back() / (places + 1);
  for (int i = from + 1; i < to; ++i) {
    if (to - from - 1 > places && weight[i - from] < next) continue;
    run.place.push_back(i);
    while (next <= weight[i - from]) next += weight.back() / (places + 1);
  }
  run.place.push_back(to);
  return run;
}

core::Interval GraphPieces::slopes_of(int from, int to) const {
  const double a = curve_.value[from];
  const double b = curve_.value[to];
  const double big = std::max(std::abs(a), std::abs(b));
  const double small = a * b <= 0 ? 0 : std::min(std::abs(a), std::abs(b));
  const bool inflected = small <= kNearInflection * big;
  const int low_end = std::abs(a) < std::abs(b) ? from : to;
  const bool keeps = !curve_.side.empty() && curve_.side[low_end] != 0;
  if (!inflected && !(keeps && small <= kMaySink * big)) return slopes_;
  const double low = std::max(slopes_.low, kInflectionLow);
  const double high = std::min(slopes_.high, kInflectionHigh);
  // No others pass an inflection.
  if (low > high) return inflected ? core::Interval{kInflectionLow, kInflectionHigh} : slopes_;
  return {low, high};
}

GraphPieces::Fit GraphPieces::best_fit(int from, int to) const {
  const core::Interval range = slopes_of(from, to);
  Stretch stretch(curve_, from, to);
  const auto fit = [&](double alpha) {
    const double bow = kBowPrice * std::pow(stretch.bow(alpha) / tolerance_, 2);
    return Fit{alpha, stretch.excess(alpha) / energy_ + bow};
  };
  const Fit even = fit(std::clamp(-1.0, range.low, range.high));
  if (to - from < 2) return even;
  const Fit matching = fit(best_slope(stretch, range));
  return matching.loss < even.loss ? matching : even;
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
        const double sum = least[i] + run.fit[i][j].loss;
        if (sum >= next[j]) continue;
        next[j] = sum;
        from[j] = i;
      }
    least = next;
    run.loss.push_back(least[n - 1]);
    run.from.push_back(std::move(from));
  }
}

double GraphPieces::total(const std::vector<int>& count) const {
  double sum = 0;
  for (std::size_t r = 0; r < runs_.size(); ++r) sum += runs_[r].loss[count[r] - 1];
  return sum;
}

/// One piece more where it helps most; false where every run has all it may.
bool GraphPieces::add_piece(std::vector<int>& count) const {
  double most = 0;
  std::size_t best = runs_.size();
  int by = 0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const auto& loss = runs_[r].loss;
    for (int more = 1; more <= 2 && count[r] + more <= static_cast<int>(loss.size()); ++more) {
      const double gain = (loss[count[r] - 1] - loss[count[r] + more - 1]) / more;
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

/// Runs with too few places for so many pieces get twice the places; false where none has.
bool GraphPieces::refine(const std::vector<int>& count) {
  bool refined = false;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    Run& run = runs_[r];
    const int nodes = run.place.back() - run.place.front() - 1;
    if (run.line || run.places >= nodes || run.places >= kPlacesOfPiece * count[r]) continue;
    run = make_run(run.place.front(), run.place.back(), 2 * run.places);
    tabulate(run);
    refined = true;
  }
  return refined;
}

std::vector<int> GraphPieces::within(double loss, int most) {
  std::vector<int> count;
  do {
    count.assign(runs_.size(), 1);
    int pieces = static_cast<int>(runs_.size());
    for (; pieces < most && total(count) > loss && add_piece(count); ++pieces);
  } while (refine(count));
  return count;
}

DenseCurve GraphPieces::cut_by(const std::vector<int>& count) const {
  DenseCurve out = curve_;
  out.cut = {0};
  out.alpha.clear();
  out.sense.clear();
  out.kind.clear();
  out.value = {curve_.value.front()};
  out.side.resize(std::min<std::size_t>(curve_.side.size(), 1));
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
      if (!curve_.side.empty()) out.side.push_back(curve_.side[to]);
      const double rise = curve_.value[run.place.back()] - curve_.value[run.place.front()];
      out.sense.push_back(rise < 0 ? -1 : 1);
      out.kind.push_back(run.line ? PieceKind::line : PieceKind::curve);
    }
  }
  return out;
}

}  // namespace keyline::fairing::detail
