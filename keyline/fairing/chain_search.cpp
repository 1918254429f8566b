#include "keyline/fairing/chain_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "keyline/core/angle.h"
#include "keyline/core/text.h"
#include "keyline/fairing/chain_edit.h"
#include "keyline/fairing/chain_weights.h"
#include "keyline/fairing/structure.h"
#include "keyline/numeric/parallel.h"

namespace keyline::fairing {
namespace {

// Cost of a joint that has to stay.
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kUnknown = -kNever;  // cost not found yet: less than any
constexpr int kReach = 4;             // pieces on either side that a merge may move
constexpr int kSqueezeRounds = 5;     // of Lawson's weights for each merge that is tried
constexpr int kStartRounds = 14;      // of Lawson's weights for the whole start, once
// The clothoid spline has as many pieces, and each of its joints is tried.
constexpr std::size_t kMostSplinePoints = 500;
// First numbers of pieces tried where the noise limits: short ones follow it.
constexpr std::array kNoisyStarts{4, 7, 11};
constexpr std::size_t kMostAlternatives = 14;  // pieces: longer chains are searched only once
constexpr double kTie = 1e-3;  // costs closer than this part of the squared tolerance are equal

constexpr double kBias = 0.3;  // of the noise: a bias that is let pass, however many points show it
constexpr double kChance = 3.5;  // standard errors of a mean that are chance

/// A trend over runs of about `run` points: mean offset beyond what noise explains.
bool has_trend(const std::vector<FitPoint>& points, const std::vector<double>& offsets,
               double noise, double run) {
  double sum = 0;
  double count = 0;
  std::size_t first = 0;
  for (std::size_t j = 0; j < points.size(); ++j) {
    sum += points[j].count * offsets[j];
    count += points[j].count;
    while (count - points[first].count >= run) {
      sum -= points[first].count * offsets[first];
      count -= points[first].count;
      ++first;
    }
    if (count >= run && std::abs(sum / count) > noise * (kBias + kChance / std::sqrt(count)))
      return true;
  }
  return false;
}

constexpr numeric::Push kGentle{0.6, 0.8};  // a whole dense chain swings if pushed harder
constexpr numeric::Push kHard{0.3, 2};      // a window of few pieces does not

struct Trial {
  FitChain chain;
  ChainFitReport fit;
  bool good = false;
  std::vector<double> weights;  // of the window's points, where they were changed
  std::vector<std::size_t> index;
};

class Merger {
 public:
  Merger(FitChain chain, ChainFitReport fit, std::vector<FitPoint> points,
         const ChainSearchOptions& options)
      : chain_(std::move(chain)), fit_(fit), points_(std::move(points)), options_(options) {}

  void run() {
    merge_all(false);
    if (!wanted_reached()) merge_all(true);
  }

  FitChain& chain() { return chain_; }
  const std::vector<FitPoint>& points() const { return points_; }
  int trials() const { return trials_; }

 private:
  int pieces() const { return static_cast<int>(chain_.pieces.size()); }
  bool wanted_reached() const {
    return options_.wanted_pieces > 0 && pieces() <= options_.wanted_pieces;
  }
  bool stop() const { return options_.progress.stop_requested() || wanted_reached(); }

  void merge_all(bool squeeze) {
    bool changed = true;
    while (changed && !stop()) {
      changed = sweep(squeeze);
      if (!chain_.closed || pieces() <= 2 || stop()) continue;
      // The joint at the start is never tried: move it to where it has been tried.
      detail::rotate_start(chain_, pieces() / 2);
      changed = sweep(squeeze) || changed;
    }
  }

  ChainFitOptions fit_options() const {
    ChainFitOptions fit;
    fit.iterations = 14;
    fit.gradient_tolerance = 1e-3;
    fit.scale = options_.accept.tolerance;
    if (options_.wanted_pieces == 0) fit.hopeless = 6 * options_.accept.tolerance;
    return fit;
  }

  Trial attempt(int joint, bool squeeze) const {
    const int n = pieces();
    const int first = std::max(0, joint - kReach);
    const int count = std::min(n, joint + kReach) - first;
    detail::Window w = detail::cut_window(chain_, points_, first, count);
    if (count == n) w.chain = chain_;
    const double before = weighted_cost(w.points, offsets(w.chain, w.points));
    w.chain = detail::without_joint(w.chain, joint - first);
    Trial trial;
    trial.fit = fit_chain(w.chain, w.points, fit_options());
    std::vector<double> found = offsets(w.chain, w.points);
    trial.good = good(trial.fit, w.points, found);
    if (!trial.good && squeeze && trial.fit.max_offset < 3 * options_.accept.tolerance)
      squeeze_window(w, trial);
    trial.fit.cost = weighted_cost(w.points, found) - before;
    if (!trial.good && options_.wanted_pieces == 0) return trial;
    trial.chain = count == n ? std::move(w.chain) : detail::paste_window(chain_, w, count);
    trial.index = std::move(w.index);
    return trial;
  }

  bool good(const ChainFitReport& fit, const std::vector<FitPoint>& points,
            const std::vector<double>& found) const {
    if (options_.wanted_pieces > 0)
      return fit.max_gap <= options_.accept.tolerance && pieces() > options_.wanted_pieces;
    return accepts(options_.accept, fit, points, found);
  }

  void squeeze_window(detail::Window& w, Trial& trial) const {
    const std::vector<FitPoint> original = w.points;
    for (int round = 0; round < kSqueezeRounds && !trial.good; ++round) {
      weigh_up(w.points, original, offsets(w.chain, w.points), options_.accept.tolerance, kHard);
      ChainFitOptions options = fit_options();
      options.iterations = 8;
      trial.fit = fit_chain(w.chain, w.points, options);
      if (trial.fit.max_offset > 4 * options_.accept.tolerance) break;
      trial.good = good(trial.fit, w.points, offsets(w.chain, w.points));
    }
    for (const FitPoint& p : w.points) trial.weights.push_back(p.weight);
  }

  static double weighted_cost(const std::vector<FitPoint>& points,
                              const std::vector<double>& offsets) {
    double sum = 0;
    for (std::size_t j = 0; j < points.size(); ++j)
      sum += points[j].weight * offsets[j] * offsets[j];
    return sum;
  }

  /// Merges while any joint can go; costs of untouched joints are kept from earlier tries.
  bool sweep(bool squeeze) {
    bool any = false;
    std::vector<double> cost(chain_.joints.size(), kUnknown);
    cost.front() = cost.back() = kNever;
    while (pieces() > 1 && !stop()) {
      find_costs(cost, squeeze);
      if (!merge_cheapest(cost, squeeze)) break;
      any = true;
    }
    return any;
  }

  void find_costs(std::vector<double>& cost, bool squeeze) {
    std::vector<int> unknown;
    for (std::size_t k = 0; k < cost.size(); ++k)
      if (cost[k] == kUnknown) unknown.push_back(static_cast<int>(k));
    numeric::parallel_for(unknown.size(), options_.threads, [&](std::size_t i) {
      if (options_.progress.stop_requested()) return;
      const Trial trial = attempt(unknown[i], squeeze);
      cost[unknown[i]] = trial.good ? trial.fit.cost : kNever;
    });
    trials_ += static_cast<int>(unknown.size());
  }

  bool merge_cheapest(std::vector<double>& cost, bool squeeze) {
    while (!options_.progress.stop_requested()) {
      const double least = *std::min_element(cost.begin(), cost.end());
      if (least == kNever || least == kUnknown) return false;
      // Of equals (symmetric shapes have them) the first, whatever rounding says.
      const double band = kTie * options_.accept.tolerance * options_.accept.tolerance;
      const auto cheapest =
          std::find_if(cost.begin(), cost.end(), [&](double c) { return c <= least + band; });
      const int joint = static_cast<int>(cheapest - cost.begin());
      ++trials_;
      Trial trial = attempt(joint, squeeze);
      if (!trial.good) {
        *cheapest = kNever;
        continue;
      }
      take(std::move(trial));
      cost.erase(cost.begin() + joint);
      for (int k = std::max(1, joint - 3); k <= joint + 2; ++k)
        if (k + 1 < static_cast<int>(cost.size())) cost[k] = kUnknown;
      report();
      return true;
    }
    return false;
  }

  void take(Trial trial) {
    chain_ = std::move(trial.chain);
    for (std::size_t k = 0; k < trial.weights.size(); ++k)
      points_[trial.index[k]].weight = trial.weights[k];
  }

  void report() {
    if (start_pieces_ == 0) start_pieces_ = pieces() + 1;
    const double done = 1 - static_cast<double>(pieces()) / start_pieces_;
    options_.progress.report(done, core::counted(chain_.pieces.size(), "piece"));
  }

  FitChain chain_;
  ChainFitReport fit_;
  std::vector<FitPoint> points_;
  const ChainSearchOptions& options_;
  int trials_ = 0;
  int start_pieces_ = 0;
};

void hold_end(FitJoint& joint, Hold& hold, const HeldEnd& end) {
  hold = end.hold;
  if (hold >= Hold::position) joint.position = end.joint.position;
  if (hold >= Hold::direction)
    joint.direction += core::wrap_angle(end.joint.direction - joint.direction);
  if (hold >= Hold::curvature) joint.curvature = end.joint.curvature;
}

/// Largest offsets of a dense chain pushed down where it comes near the tolerance.
void squeeze_start(ChainSearchResult& result, std::vector<FitPoint>& points, ChainFitOptions fit,
                   const ChainSearchOptions& options) {
  const std::vector<FitPoint> original = points;
  fit.usual_length = 1.0 / static_cast<double>(result.chain.pieces.size());
  for (int round = 0; round < kStartRounds && !result.within_tolerance; ++round) {
    if (result.fit.max_offset > 4 * options.accept.tolerance) return;
    if (options.progress.stop_requested()) return;
    weigh_up(points, original, offsets(result.chain, points), options.accept.tolerance, kGentle);
    result.fit = fit_chain(result.chain, points, fit);
    result.within_tolerance =
        accepts(options.accept, result.fit, points, offsets(result.chain, points));
  }
}

/// The spline through all points in place of what came near them only: steps of one point's width
/// (a ring about the neck of a traced bottle) are met by pieces that end there.
void start_at_points(ChainSearchResult& result, const std::vector<FitPoint>& points,
                     const ChainSearchOptions& options) {
  const bool held = options.start.hold != Hold::free || options.end.hold != Hold::free;
  if (held || noisy(options.accept) || points.size() > kMostSplinePoints) return;
  FitChain chain = spline_chain(points, result.chain.closed);
  if (chain.pieces.empty()) return;
  ChainFitOptions fit;
  fit.scale = options.accept.tolerance;
  fit.iterations = 0;
  const ChainFitReport report = fit_chain(chain, points, fit);
  if (!accepts(options.accept, report, points, offsets(chain, points))) return;
  result.chain = std::move(chain);
  result.fit = report;
  result.start_pieces = static_cast<int>(result.chain.pieces.size());
  result.within_tolerance = true;
}

/// Dense clothoid chains, twice as many pieces each time, until one is accepted.
void start_search(ChainSearchResult& result, std::vector<FitPoint>& points, bool closed,
                  const ChainSearchOptions& options) {
  ChainFitOptions fit;
  fit.scale = options.accept.tolerance;
  fit.length_prior = 1;
  const int count = static_cast<int>(points.size());
  const int least = closed ? 3 : 1;
  const int first = std::max(options.start_pieces, 2 * options.wanted_pieces);
  int pieces = std::clamp(count / 3, least, std::max(least, first));
  const int most = std::max(pieces, std::min(options.most_pieces, 4 * count / 5));
  result.fit.max_offset = kNever;
  while (true) {
    FitChain dense = dense_chain(points, closed, pieces);
    for (FitPiece& piece : dense.pieces) hold_slope(piece, -1);
    hold_end(dense.joints.front(), dense.hold_start, options.start);
    hold_end(dense.joints.back(), dense.hold_end, options.end);
    fit.usual_length = 1.0 / pieces;
    const ChainFitReport report = fit_chain(dense, points, fit);
    const bool good = accepts(options.accept, report, points, offsets(dense, points));
    if (good || report.max_offset < result.fit.max_offset) {
      result.chain = std::move(dense);
      result.fit = report;
      result.start_pieces = pieces;
    }
    result.within_tolerance = good;
    if (good || pieces >= most || options.progress.stop_requested()) break;
    pieces = std::min(most, noisy(options.accept) ? (3 * pieces + 1) / 2 : 2 * pieces);
  }
  if (!result.within_tolerance && options.wanted_pieces == 0) {
    const std::vector<FitPoint> original = points;
    squeeze_start(result, points, fit, options);
    if (!result.within_tolerance && options.spline_start)
      start_at_points(result, points = original, options);
  }
  for (FitPiece& piece : result.chain.pieces) {
    piece.alpha_low = -kSteepestSlope;
    piece.alpha_high = kSteepestSlope;
  }
}

ChainSearchResult search_once(const std::vector<FitPoint>& points, bool closed,
                              const ChainSearchOptions& options) {
  ChainSearchResult result;
  std::vector<FitPoint> weighed = points;
  start_search(result, weighed, closed, options);
  for (const FitPoint& p : weighed) result.weights.push_back(p.weight);
  if (!result.within_tolerance && options.wanted_pieces == 0) return result;
  Merger merger(result.chain, result.fit, std::move(weighed), options);
  merger.run();
  result.chain = std::move(merger.chain());
  for (std::size_t j = 0; j < points.size(); ++j) result.weights[j] = merger.points()[j].weight;
  const bool few = result.chain.pieces.size() <= kMostAlternatives;
  if (few && noisy(options.accept) && options.wanted_pieces == 0 &&
      detail::improve_structure(result.chain, points, options))
    for (std::size_t j = 0; j < points.size(); ++j) result.weights[j] = points[j].weight;
  ChainFitOptions last;
  last.iterations = 0;
  last.scale = options.accept.tolerance;
  result.fit = fit_chain(result.chain, merger.points(), last);
  result.within_tolerance =
      accepts(options.accept, result.fit, points, offsets(result.chain, points));
  result.trials = merger.trials();
  result.cancelled = options.progress.stop_requested();
  return result;
}

}  // namespace

bool noisy(const Acceptance& accept) { return accept.noise * 6 >= accept.tolerance; }

bool accepts(const Acceptance& accept, const ChainFitReport& fit,
             const std::vector<FitPoint>& points, const std::vector<double>& offsets) {
  if (!(fit.max_offset <= accept.tolerance && fit.max_gap <= 0.05 * accept.tolerance)) return false;
  if (!noisy(accept)) return true;
  for (double run = 4; run <= 0.5 * static_cast<double>(points.size()); run *= 2)
    if (has_trend(points, offsets, accept.noise, run)) return false;
  return true;
}

ChainSearchResult search_chain(const std::vector<FitPoint>& points, bool closed,
                               const ChainSearchOptions& options) {
  if (!noisy(options.accept) || options.wanted_pieces > 0)
    return search_once(points, closed, options);
  ChainSearchResult best;
  double least = kNever;
  for (const int start : kNoisyStarts) {
    ChainSearchOptions from = options;
    from.start_pieces = start;
    ChainSearchResult found = search_once(points, closed, from);
    const bool first = best.chain.pieces.empty();
    const double score = found.within_tolerance
                             ? detail::structure_score(found.chain, points, options.accept.noise)
                             : kNever;
    if (first || score < least) best = std::move(found);
    least = std::min(least, score);
    if (!best.within_tolerance || best.cancelled) break;
    if (best.chain.pieces.size() > kMostAlternatives) break;
  }
  return best;
}

}  // namespace keyline::fairing
