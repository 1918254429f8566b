#include "keyline/fairing/calm_run.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/fairing/graph_pieces.h"

namespace keyline::fairing::detail {
namespace {

constexpr int kLeastCells = 240;    // a hundredth of the energy is lost to half as many
constexpr double kForPieces = 0.1;  // of the energy, given for having few pieces
constexpr double kWorth = 1.5;      // a wave less, a line or an arc are worth so much energy
constexpr double kBandWidth = 2;    // in tolerances: what a piece may give up within the band
constexpr double kUnseen = 0.1;     // of the tolerance: a departure from an arc that is not seen
constexpr double kPieceGap = 0.03;  // of the energy: accuracy while pieces are being chosen
constexpr int kPieceSteps = 40;
constexpr int kRefinements = 40;

void put_end(DenseCurve& curve, const HeldEnd& end, bool at_start) {
  FitJoint& joint = at_start ? curve.joints.front() : curve.joints.back();
  double& value = at_start ? curve.value.front() : curve.value.back();
  (at_start ? curve.hold_start : curve.hold_end) = end.hold;
  (at_start ? curve.held_start : curve.held_end) = end.joint;
  if (end.hold >= Hold::position) joint.position = end.joint.position;
  if (end.hold >= Hold::direction) {
    const double turn = end.joint.direction - joint.direction;
    joint.direction += std::remainder(turn, 2 * core::kPi);
    (at_start ? curve.held_start : curve.held_end).direction = joint.direction;
  }
  if (end.hold >= Hold::curvature) value = end.joint.curvature * curve.length;
  joint.curvature = value;
}

/// Where along the curve points lie outside the tolerance.
std::vector<double> outside(DenseCurve& curve, const std::vector<FitPoint>& points,
                            double tolerance) {
  const std::vector<CellShape> shapes = shapes_of(curve);
  std::vector<double> at;
  for (std::size_t j = 0; j < points.size(); ++j) {
    const double off = offset_of(curve, shapes, points[j], curve.feet[j]);
    const double share = points[j].share;
    if (std::max(off + share * points[j].high, -off - share * points[j].low) <= tolerance) continue;
    const Foot& foot = curve.feet[j];
    at.push_back(std::lerp(curve.at[foot.piece], curve.at[foot.piece + 1], foot.fraction));
  }
  return at;
}

/// Energy below which nothing is to be seen: of curvature that changes so little that the curve
/// departs from an arc by a tenth of the tolerance.
double unseen_energy(const DenseCurve& curve, double tolerance) {
  const double change = 32 * kUnseen * tolerance / curve.length;
  return change * change;
}

/// Pieces for a calm curve, solved for.
void choose_pieces(CalmRun& run, const std::vector<FitPoint>& points,
                   const CalmRunOptions& options) {
  const GraphPieces graph(run.curve, turns_of(run.curve), options.slopes);
  std::vector<int> count =
      options.pieces > 0 ? graph.of_count(options.pieces)
                         : graph.within(std::max(kForPieces * run.calm_energy,
                                                 unseen_energy(run.curve, options.tolerance)));
  BandOptions band{.tolerance = options.tolerance,
                   .iterations = kPieceSteps,
                   .gap = kPieceGap,
                   .warm = true,
                   .progress = options.progress};
  for (int round = 0; round <= kRefinements; ++round) {
    DenseCurve trial = graph.cut_by(count);
    const BandReport found = least_variation(trial, points, band);
    if (round == 0 || found.max_offset < run.band.max_offset || found.within) {
      run.curve = trial;
      run.band = found;
    }
    if (found.within || options.pieces > 0 || options.progress.stop_requested()) return;
    if (!graph.refine(count, outside(trial, points, options.tolerance)) &&
        !graph.refine(count, trial.at))
      return;
  }
}

}  // namespace

namespace {

/// How far a piece departs from an arc of its length and turning, or from its chord.
double departure(const DenseCurve& curve, std::size_t p, PieceKind kind) {
  const double share = curve.at[curve.cut[p + 1]] - curve.at[curve.cut[p]];
  const double length = share * curve.length;
  const double a = curve.value[p] / curve.length;
  const double b = curve.value[p + 1] / curve.length;
  if (kind == PieceKind::arc) return std::abs(b - a) / 32 * length * length;
  return std::max(std::abs(a), std::abs(b)) / 8 * length * length;
}

/// Pieces that the points cannot tell from lines or arcs become one, where the whole stays as fair:
/// all that may, at once, else one after another.
class Flattening {
 public:
  Flattening(CalmRun& run, const std::vector<FitPoint>& points, const CalmRunOptions& options)
      : run_(run),
        points_(points),
        band_{.tolerance = options.tolerance,
              .iterations = kPieceSteps,
              .gap = kPieceGap,
              .warm = true,
              .progress = options.progress} {
    most_ = kWorth * std::max({run.band.energy, run.calm_energy,
                               unseen_energy(run.curve, options.tolerance)});
  }

  void run() {
    for (const PieceKind kind : {PieceKind::line, PieceKind::arc}) {
      const std::vector<std::size_t> which = candidates(kind);
      if (which.empty() || become(which, kind)) continue;
      if (which.size() == 1) continue;
      for (const std::size_t p : which) become({p}, kind);
    }
    join_lines();
  }

 private:
  /// Lines that follow one another are one.
  void join_lines() {
    DenseCurve& curve = run_.curve;
    for (std::size_t p = 1; p < curve.kind.size();) {
      if (curve.kind[p] != PieceKind::line || curve.kind[p - 1] != PieceKind::line) {
        ++p;
        continue;
      }
      const auto at = static_cast<std::ptrdiff_t>(p);
      curve.kind.erase(curve.kind.begin() + at);
      curve.alpha.erase(curve.alpha.begin() + at);
      curve.cut.erase(curve.cut.begin() + at);
      curve.value.erase(curve.value.begin() + at);
      if (!curve.sense.empty()) curve.sense.erase(curve.sense.begin() + at);
    }
  }

  std::vector<std::size_t> candidates(PieceKind kind) const {
    std::vector<std::size_t> which;
    const std::size_t n = run_.curve.alpha.size();
    for (std::size_t p = 0; p < n; ++p) {
      const bool curve = run_.curve.kind.empty() || run_.curve.kind[p] == PieceKind::curve;
      if (curve && departure(run_.curve, p, kind) < kBandWidth * band_.tolerance)
        which.push_back(p);
    }
    return which;
  }

  static void set_value(DenseCurve& curve, std::size_t cut, double value) {
    curve.value[cut] = value;
    const std::size_t last = curve.alpha.size();
    if (curve.closed && cut == 0) curve.value[last] = value;
    if (curve.closed && cut == last) curve.value[0] = value;
  }

  /// Beside a line no arc, beside an arc no line nor arc: their curvatures would have to be one.
  bool alone(const DenseCurve& curve, std::size_t p, PieceKind kind) const {
    const std::size_t n = curve.alpha.size();
    for (const std::size_t side : {(p + n - 1) % n, (p + 1) % n}) {
      const bool across = (p == 0 && side == n - 1) || (p == n - 1 && side == 0);
      if (side == p || (across && !curve.closed) || curve.kind.empty()) continue;
      if (curve.kind[side] != PieceKind::curve &&
          !(kind == PieceKind::line && curve.kind[side] == PieceKind::line))
        return false;
    }
    return true;
  }

  bool become(const std::vector<std::size_t>& which, PieceKind kind) {
    if (band_.progress.stop_requested()) return false;
    DenseCurve trial = run_.curve;
    if (trial.kind.empty()) trial.kind.assign(trial.alpha.size(), PieceKind::curve);
    for (const std::size_t p : which) {
      if (!alone(trial, p, kind)) continue;
      trial.kind[p] = kind;
      trial.alpha[p] = -1;
      const double mean = 0.5 * (trial.value[p] + trial.value[p + 1]);
      set_value(trial, p, kind == PieceKind::line ? 0 : mean);
      set_value(trial, p + 1, kind == PieceKind::line ? 0 : mean);
      for (const std::size_t side : {p - 1, p + 1}) {
        // A piece that meets a line ends in an inflection.
        const bool there = side < trial.alpha.size();
        if (there && kind == PieceKind::line) trial.alpha[side] = -1;
      }
    }
    const BandReport found = least_variation(trial, points_, band_);
    if (!found.within || found.energy > most_ ||
        turns_of(trial).size() > turns_of(run_.curve).size())
      return false;
    run_.curve = std::move(trial);
    run_.band = found;
    return true;
  }

  CalmRun& run_;
  const std::vector<FitPoint>& points_;
  BandOptions band_;
  double most_ = 0;
};

}  // namespace

CalmRun solve_calm(const std::vector<FitPoint>& points, bool closed,
                   const CalmRunOptions& options) {
  CalmRun run;
  run.curve = dense_curve(points, closed, kLeastCells);
  put_end(run.curve, options.start, true);
  put_end(run.curve, options.end, false);
  CalmOptions calm_options;
  calm_options.band.tolerance = options.tolerance;
  calm_options.worth = kWorth;
  calm_options.band.progress = core::part_of(options.progress, 0, 0.7);
  run.band = calm(run.curve, points, calm_options);
  run.calm_energy = run.band.energy;
  run.curve.sense.clear();
  choose_pieces(run, points, options);
  if (run.band.within && options.pieces == 0) Flattening(run, points, options).run();
  return run;
}

BandReport hold_ends(DenseCurve& curve, const std::vector<FitPoint>& points, double tolerance,
                     const HeldEnd& start, const HeldEnd& end) {
  put_end(curve, start, true);
  put_end(curve, end, false);
  return least_variation(curve, points,
                         {.tolerance = tolerance, .gap = kPieceGap, .warm = true, .progress = {}});
}

namespace {

/// Arcs and lines, solved for with their variation dear, become exactly that.
void flatten(FitChain& chain) {
  const std::size_t n = chain.pieces.size();
  const auto set = [&](std::size_t joint, double curvature) {
    chain.joints[joint].curvature = curvature;
    if (chain.closed && joint == 0) chain.joints[n].curvature = curvature;
    if (chain.closed && joint == n) chain.joints[0].curvature = curvature;
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (chain.pieces[i].kind == PieceKind::curve) continue;
    const double mean = 0.5 * (chain.joints[i].curvature + chain.joints[i + 1].curvature);
    const double curvature = chain.pieces[i].kind == PieceKind::line ? 0 : mean;
    set(i, curvature);
    set(i + 1, curvature);
    chain.pieces[i].alpha = -1;
  }
}

/// A held end is where it is held, to the last digit.
void settle_end(FitJoint& joint, const FitJoint& held, Hold hold) {
  if (hold >= Hold::position) joint.position = held.position;
  if (hold >= Hold::direction) joint.direction = held.direction;
  if (hold >= Hold::curvature) joint.curvature = held.curvature;
}

}  // namespace

FitChain chain_of(const DenseCurve& curve) {
  FitChain chain;
  chain.closed = curve.closed;
  chain.turning = curve.turning;
  chain.hold_start = curve.hold_start;
  chain.hold_end = curve.hold_end;
  chain.first_at_start = chain.last_at_end = !curve.closed;
  const std::vector<int> piece_of = pieces_of(curve);
  for (std::size_t p = 0; p < curve.cut.size(); ++p) {
    FitJoint joint = curve.joints[curve.cut[p]];
    joint.curvature = curve.value[p] / curve.length;
    chain.joints.push_back(joint);
    if (p + 1 == curve.cut.size()) break;
    const double share = curve.at[curve.cut[p + 1]] - curve.at[curve.cut[p]];
    chain.pieces.push_back({.length = share * curve.length, .alpha = curve.alpha[p]});
    if (!curve.kind.empty()) chain.pieces.back().kind = curve.kind[p];
  }
  flatten(chain);
  settle_end(chain.joints.front(), curve.held_start, curve.hold_start);
  settle_end(chain.joints.back(), curve.held_end, curve.hold_end);
  for (const Foot& foot : curve.feet) {
    const int p = piece_of[foot.piece];
    const double t = std::lerp(curve.at[foot.piece], curve.at[foot.piece + 1], foot.fraction);
    const double from = curve.at[curve.cut[p]];
    const double to = curve.at[curve.cut[p + 1]];
    chain.feet.push_back({p, std::clamp((t - from) / (to - from), 0.0, 1.0)});
  }
  return chain;
}

}  // namespace keyline::fairing::detail
