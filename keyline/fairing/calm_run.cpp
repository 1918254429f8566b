#include "keyline/fairing/calm_run.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/fairing/counter_bends.h"
#include "keyline/fairing/flat_pieces.h"
#include "keyline/fairing/graph_pieces.h"
#include "keyline/fairing/leaning_ends.h"
#include "keyline/fairing/piece_choice.h"
#include "keyline/fairing/settle.h"
#include "keyline/fairing/spring_power.h"
#include "keyline/fairing/turns.h"

namespace keyline::fairing::detail {
namespace {

constexpr int kLeastCells = 240;  // a hundredth of the energy is lost to half as many
constexpr double kForPieces =
    0.05;  // of the energy, given for few pieces, and before for bends gone
// Standard errors of the offsets' mean square that having fewer waves, fewer pieces, or a line may
// cost. Four: by chance a root of a mean square is hardly ever that large, so points that a wave
// would serve keep it. Five for pieces: with 3 there are a tenth more of them, with 8 a fifth fewer
// at a rougher comb. A line is a claim of its own and has to be as near as the noise.
constexpr double kErrorsOfWaves = 4;
constexpr double kErrorsOfPieces = 5;
constexpr double kErrorsOfLines = 2.5;
constexpr double kPieceGap = 0.03;  // of the energy: accuracy while pieces are being chosen
// Of the tolerance for the calm curve: the rest is for its pieces; the first that they fit into.
constexpr std::array kRooms{0.9, 0.8, 0.65};
constexpr double kLeastNoise = 1e-3;  // of the tolerance: what points are taken to err by at least
constexpr int kPieceSteps = 40;       // of a solve while pieces are being chosen
constexpr int kFootSteps = 4;         // Newton steps of a foot, which starts from a neighbour's
constexpr int kStiffenings = 3;   // of the springs, until the mean square is as small as asked for
constexpr double kStiffest = 64;  // times at once
constexpr double kSpringAim = 0.99;  // of that mean square's root: a hair above it is not below
constexpr int kPulls = 6;  // sixty-four times as strong: what leans then, other limits hold
constexpr double kFirstLoss = 1.6;    // what cutting may lose at first, in energies: solved for
                                      // again, pieces win most of it back; halved so many times,
constexpr int kRefinements = 10;      // which leaves bows of a tenth of the tolerance
constexpr double kLeastApart = 1e-6;  // of that least loss, where pieces leave a gap
constexpr double kLeastRefinement = 0.1;  // of a loss at once, where offsets are far too large

void put_end(DenseCurve& curve, const HeldEnd& end, bool at_start) {
  FitJoint& joint = at_start ? curve.joints.front() : curve.joints.back();
  double& value = at_start ? curve.value.front() : curve.value.back();
  (at_start ? curve.hold_start : curve.hold_end) = end.hold;
  (at_start ? curve.held_start : curve.held_end) = end.joint;
  (at_start ? curve.slides_start : curve.slides_end) = end.slides;
  if (end.hold >= Hold::position) {
    if (!end.slides) joint.position.x = end.joint.position.x;
    joint.position.y = end.joint.position.y;
  }
  if (end.hold >= Hold::direction) {
    const double turn = end.joint.direction - joint.direction;
    joint.direction += std::remainder(turn, 2 * core::kPi);
    (at_start ? curve.held_start : curve.held_end).direction = joint.direction;
  }
  if (end.hold >= Hold::curvature) value = end.joint.curvature * curve.length;
  joint.curvature = value;
}

/// Pieces that leave the mean square too large hang on stiffer springs, by the secant of
/// logarithms, while they may still be calm enough: springs only add to the energy.
BandReport solve_pieces(DenseCurve& curve, const std::vector<FitPoint>& points, BandOptions band,
                        double most_rms, double most_energy) {
  BandReport found = least_variation(curve, points, band);
  SpringPower power;
  for (int i = 0; i < kStiffenings; ++i) {
    if (!found.within || found.rms <= most_rms || found.energy > most_energy) break;
    const double by = power.growth(found.rms, kSpringAim * most_rms);
    if (by > std::log(kStiffest)) break;
    band.spring *= std::exp(by);
    DenseCurve stiffer = curve;
    const BandReport next = least_variation(stiffer, points, band);
    if (!next.within || next.rms >= found.rms) break;
    power.learn(by, found.rms, next.rms);
    found = next;
    curve = std::move(stiffer);
  }
  return found;
}

BandOptions piece_band(const CalmRun& run, const CalmRunOptions& options) {
  return {.tolerance = options.tolerance,
          .iterations = kPieceSteps,
          .gap = kPieceGap,
          .warm = true,
          .spring = run.band.spring,
          .progress = options.progress};
}

/// Whether pieces held in place and direction at both ends have freedoms to spare: lengths and
/// curvatures where they meet or end free, beside the three equations of where they lead.
bool spares(const DenseCurve& pieces) {
  if (pieces.hold_start < Hold::direction || pieces.hold_end < Hold::direction) return true;
  const auto free = [](Hold hold) { return hold < Hold::curvature ? 1 : 0; };
  const int count = static_cast<int>(pieces.alpha.size());
  return 2 * count - 1 + free(pieces.hold_start) + free(pieces.hold_end) > 3;
}

/// Pieces for a calm curve, solved for: as few as lose little of its energy and its place, fewer
/// and nearer until the points stay in the tolerance and the whole is as calm. A swing of the calm
/// curve that is too low to be seen may grow in them: then more are tried. The calm curve had that
/// share of their tolerance: where it was asked to depart farther than the noise, they may as much
/// farther than it.
void choose_pieces(CalmRun& run, double room, const std::vector<FitPoint>& points,
                   const CalmRunOptions& options) {
  const double energy =
      std::max(run.calm_energy, unseen_energy(run.curve.length, options.tolerance));
  GraphPieces graph(run.curve, turns_of(run.curve), options.slopes, energy, options.tolerance);
  const double most_energy = (1 + kForPieces) * energy;
  const BandOptions band = piece_band(run, options);
  const double most_rms = std::max(options.residuals.most(kErrorsOfPieces), run.band.rms / room);
  const bool means = options.residuals.scatter > 0;
  const double least = std::ldexp(kFirstLoss, -kRefinements);
  PieceChoice choice(run, seen_waves(run.curve));
  double finer = 0.5;
  bool apart = false;  // too few to meet what is held at both ends, near as they are to the points
  std::vector<int> last;
  int most = static_cast<int>(run.curve.joints.size());
  for (double loss = kFirstLoss; loss >= (apart ? kLeastApart * least : least); loss *= finer) {
    std::vector<int> count = graph.within(loss, most);
    if (count == last) continue;
    DenseCurve trial = graph.cut_by(count);
    refine_cells(trial);
    last = std::move(count);
    most = 2 * static_cast<int>(trial.alpha.size());
    apart = !spares(trial);
    if (apart) continue;
    const BandReport found = solve_pieces(trial, points, band, most_rms, most_energy);
    apart = !found.within && found.max_offset <= options.tolerance;
    const double lost = found.energy / most_energy;
    choice.offer(trial, found, std::max(lost, found.rms > 0 ? found.rms / most_rms : 0));
    if (options.progress.stop_requested() || choice.done()) return;
    // The loss goes with the square of a bow.
    if (means) finer = std::clamp(std::pow(most_rms / found.rms, 2), kLeastRefinement, 0.5);
  }
}

/// How far the points of every mean lie from the curve beside the mean itself: what its limits have
/// to leave room for. About a line through the neighbours, as means know it at first, a bend counts
/// as spread.
void measure_spread(std::vector<FitPoint>& points, DenseCurve curve, const Members& members) {
  const std::vector<CellShape> shapes = shapes_of(curve);
  const auto offset = [&](core::Point2 position, Foot foot) {
    const FitPoint point{.position = position};
    for (int i = 0; i < kFootSteps; ++i) move_foot(curve, shapes, point, foot);
    return offset_of(point, place_of(curve, shapes, foot));
  };
  std::vector<double> own(points.size());  // the means' offsets
  for (std::size_t f = 0; f < points.size(); ++f) {
    if (!(points[f].count > 1)) continue;
    own[f] = offset(points[f].position, curve.feet[f]);
    points[f].low = HUGE_VAL;
    points[f].high = -HUGE_VAL;
  }
  for (std::size_t j = 0; j < members.points.size(); ++j) {
    const std::size_t f = members.fitted[j];
    FitPoint& mean = points[f];
    if (!(mean.count > 1)) continue;
    const double off = offset(members.points[j], curve.feet[f]) - own[f];
    mean.low = std::min(mean.low, off);
    mean.high = std::max(mean.high, off);
  }
}

}  // namespace

namespace {

/// The dense curve that a run starts from.
DenseCurve first_curve(const std::vector<FitPoint>& points, bool closed,
                       const CalmRunOptions& options) {
  DenseCurve curve = dense_curve(points, closed, kLeastCells);
  curve.most_rate = options.most_rate;
  put_end(curve, options.start, true);
  put_end(curve, options.end, false);
  return curve;
}

/// The curve of least variation without waves that the points do not ask for, leaning nowhere at
/// its free ends. Which waves go is told before the ends are pulled, for a pull is felt by few
/// points. The springs' weight is the same each time: elsewhere nothing becomes softer.
Calmed calm_curve(DenseCurve& curve, std::vector<FitPoint>& points, bool closed,
                  const CalmRunOptions& options, const CalmOptions& calm_options) {
  curve = first_curve(points, closed, options);
  Calmed calmed = calm(curve, points, calm_options);
  for (int i = 0; i < kPulls && calmed.band.within; ++i) {
    if (!pull_leaning_ends(points, curve, options.residuals)) break;
    DenseCurve pulled = curve;
    const BandReport found = calm_again(pulled, points, calmed.band.spring, calm_options);
    if (!found.within) break;
    curve = std::move(pulled);
    calmed.band = found;
  }
  return calmed;
}

/// The calm curve in that share of the tolerance, in pieces in all of it.
CalmRun solve_in(double room, std::vector<FitPoint>& points, bool closed,
                 const CalmRunOptions& options) {
  CalmRun run;
  CalmOptions calm_options;
  calm_options.band.tolerance = room * options.tolerance;
  calm_options.band.rms = options.residuals.rms;
  calm_options.most_rms = options.residuals.most(kErrorsOfWaves);
  calm_options.worth = kWaveWorth;
  calm_options.bend_worth = 1 + kForPieces;
  calm_options.most_turns = options.most_turns;
  calm_options.threads = options.threads;
  calm_options.band.progress = options.progress;
  const Calmed calmed = calm_curve(run.curve, points, closed, options, calm_options);
  run.band = calmed.band;
  run.waves = calmed.waves;
  if (!options.members.points.empty() && run.band.within) {
    measure_spread(points, run.curve, options.members);
    BandOptions again = piece_band(run, options);
    again.tolerance = room * options.tolerance;
    run.band = least_variation(run.curve, points, again);
  }
  const auto rms_of_lines = [&] {
    return std::max(options.residuals.most(kErrorsOfLines), run.band.rms);
  };
  FlatOptions flat;
  flat.band = piece_band(run, options);
  flat.most_rms = rms_of_lines();
  flat.noise = std::max(options.residuals.noise, kLeastNoise * options.tolerance);
  if (run.band.within) lay_lines(run.curve, run.band, points, flat);
  run.calm_energy = run.band.energy;
  run.waves.turns = static_cast<int>(turns_of(run.curve).size());
  run.curve.sense.clear();
  choose_pieces(run, room, points, options);
  flat.band.spring = run.band.spring;
  flat.most_rms = rms_of_lines();
  flat.worth = 1 + kForPieces;
  if (run.band.within && options.arcs) make_arcs(run.curve, run.band, points, flat);
  return run;
}

}  // namespace

CalmRun solve_calm(std::vector<FitPoint>& points, bool closed, const CalmRunOptions& options) {
  CalmRun run;
  for (const double room : kRooms) {
    CalmRun found = solve_in(room, points, closed, options);
    if (room == kRooms.front() || found.band.within) run = std::move(found);
    if (run.band.within || options.progress.stop_requested()) break;
  }
  return run;
}

BandReport hold_ends(DenseCurve& curve, const std::vector<FitPoint>& points, double tolerance,
                     double spring, const HeldEnd& start, const HeldEnd& end) {
  if (curve.hold_start == Hold::free && start.hold != Hold::free) loosen_side(curve, true);
  if (curve.hold_end == Hold::free && end.hold != Hold::free) loosen_side(curve, false);
  put_end(curve, start, true);
  put_end(curve, end, false);
  return least_variation(
      curve, points,
      {.tolerance = tolerance, .gap = kPieceGap, .warm = true, .spring = spring, .progress = {}});
}

namespace {

/// A held end is where it is held, to the last digit.
void settle_end(FitJoint& joint, const FitJoint& held, Hold hold, bool slides) {
  if (hold >= Hold::position) {
    if (!slides) joint.position.x = held.position.x;
    joint.position.y = held.position.y;
  }
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
  settle_end(chain.joints.front(), curve.held_start, curve.hold_start, curve.slides_start);
  settle_end(chain.joints.back(), curve.held_end, curve.hold_end, curve.slides_end);
  for (const Foot& foot : curve.feet) {
    const int p = piece_of[foot.piece];
    const double t = place_along(curve, foot);
    const double from = curve.at[curve.cut[p]];
    const double to = curve.at[curve.cut[p + 1]];
    chain.feet.push_back({p, std::clamp((t - from) / (to - from), 0.0, 1.0)});
  }
  return chain;
}

}  // namespace keyline::fairing::detail
