#include "keyline/fairing/flat_pieces.h"

#include <algorithm>
#include <array>

#include "keyline/fairing/straights.h"
#include "keyline/fairing/turns.h"

namespace keyline::fairing::detail {
namespace {

constexpr std::array<double, 3> kShortened{0.03, 0.1, 0.2};  // parts of a line left at either end
constexpr double kBeside = 0.25;  // of a line's length: how far beyond its ends it is felt
constexpr double kNear = 0.1;     // of it: reach of what is compared with twice as far around
constexpr double kBandWidth = 2;  // in tolerances: what a piece may give up within the band
constexpr double kFree = 0.01;    // of the energy: what a piece that may be an arc has at most
constexpr double kUnseen = 0.1;   // of the tolerance: a departure from an arc that is not seen
constexpr double kArc = 32;       // length^2 * change of curvature over an arc's departure

/// Energy of the cells whose middles are within `reach` of a share of the length.
double energy_near(const DenseCurve& curve, double place, double reach) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < curve.at.size(); ++i) {
    const double h = curve.at[i + 1] - curve.at[i];
    double away = curve.at[i] + 0.5 * h - place;
    if (curve.closed) away = std::remainder(away, 1.0);
    const double change = curve.joints[i + 1].curvature - curve.joints[i].curvature;
    if (std::abs(away) < reach) sum += change * change / h;
  }
  return sum;
}

/// Whether a line costs what it may wherever it is felt, beside what the curve varies nearby: a
/// needle at its end is nothing beside a sharp bend elsewhere.
bool worth_about(const DenseCurve& trial, const DenseCurve& curve, const Straight& line,
                 const FlatOptions& options) {
  const double length = curve.at[line.last] - curve.at[line.first];
  const double reach = kNear * length;
  const double unseen =
      unseen_energy(curve.length, options.band.tolerance) / std::pow(4 * reach, 5);
  const int steps = static_cast<int>(std::ceil((1 + 2 * kBeside) / kNear));
  for (int k = 0; k <= steps; ++k) {
    const double place = curve.at[line.first] + length * ((1 + 2 * kBeside) * k / steps - kBeside);
    const double nearby = std::max(energy_near(curve, place, 2 * reach), unseen);
    if (energy_near(trial, place, reach) > options.worth * nearby) return false;
  }
  return true;
}

/// Takes the trial over where it is solved within what it may cost.
bool take(DenseCurve trial, DenseCurve& curve, BandReport& band,
          const std::vector<FitPoint>& points, const FlatOptions& options,
          const std::vector<Straight>& lines = {}) {
  const double before = std::max(band.energy, unseen_energy(curve.length, options.band.tolerance));
  const BandReport found = least_variation(trial, points, options.band);
  if (!found.within || found.rms > options.most_rms || found.energy > options.worth * before)
    return false;
  if (turns_of(trial).size() > turns_of(curve).size()) return false;
  if (seen_waves(trial) > seen_waves(curve)) return false;
  for (const Straight& line : lines)
    if (!worth_about(trial, curve, line, options)) return false;
  curve = std::move(trial);
  band = found;
  return true;
}

/// How far a piece departs from an arc of its length and turning.
double departure(const DenseCurve& curve, std::size_t p) {
  const double share = curve.at[curve.cut[p + 1]] - curve.at[curve.cut[p]];
  return std::abs(curve.value[p + 1] - curve.value[p]) * share * share * curve.length / kArc;
}

/// Beside a line or an arc no arc: their curvatures would have to be one.
bool alone(const DenseCurve& curve, std::size_t p) {
  const std::size_t n = curve.alpha.size();
  const bool before = (p > 0 || curve.closed) && flat(curve, (p + n - 1) % n);
  const bool after = (p + 1 < n || curve.closed) && flat(curve, (p + 1) % n);
  return !before && !after;
}

/// Whether the curvature of an end of the piece is held, so that it is no arc's to choose.
bool bends_as_held(const DenseCurve& curve, std::size_t p) {
  return (p == 0 && curve.hold_start == Hold::curvature) ||
         (p + 1 == curve.alpha.size() && curve.hold_end == Hold::curvature);
}

/// Whether an arc would bend to the side that one of the piece's ends does not.
bool against_side(const DenseCurve& curve, std::size_t p) {
  const double mean = curve.value[p] + curve.value[p + 1];
  return !curve.side.empty() && (mean * curve.side[p] < 0 || mean * curve.side[p + 1] < 0);
}

void make_arc(DenseCurve& curve, std::size_t p) {
  const double mean = 0.5 * (curve.value[p] + curve.value[p + 1]);
  curve.kind[p] = PieceKind::arc;
  curve.alpha[p] = -1;
  curve.value[p] = curve.value[p + 1] = mean;
  if (!curve.closed) return;
  if (p == 0) curve.value.back() = mean;
  if (p + 1 == curve.alpha.size()) curve.value.front() = mean;
}

/// The whole as one arc.
DenseCurve one_arc(const DenseCurve& curve) {
  DenseCurve arc = curve;
  double mean = 0;
  for (std::size_t i = 0; i + 1 < curve.at.size(); ++i)
    mean += (curve.at[i + 1] - curve.at[i]) * curve.joints[i].curvature;
  arc.cut = {0, static_cast<int>(curve.at.size()) - 1};
  arc.alpha = {-1};
  arc.value = {mean, mean};
  arc.kind = {PieceKind::arc};
  arc.sense.clear();
  arc.side.clear();
  return arc;
}

/// Whether the whole departs from an arc by about what the points may, and may be one.
bool nearly_arc(const DenseCurve& curve, double tolerance) {
  if (curve.hold_start == Hold::curvature || curve.hold_end == Hold::curvature) return false;
  const auto [low, high] = std::minmax_element(
      curve.joints.begin(), curve.joints.end(),
      [](const FitJoint& a, const FitJoint& b) { return a.curvature < b.curvature; });
  return (high->curvature - low->curvature) * curve.length / kArc < 2 * kBandWidth * tolerance;
}

}  // namespace

double unseen_energy(double length, double tolerance) {
  const double change = kArc * kUnseen * tolerance / length;
  return change * change;
}

void lay_lines(DenseCurve& curve, BandReport& band, const std::vector<FitPoint>& points,
               const FlatOptions& options) {
  const std::vector<Straight> lines = straight_stretches(curve, points, options.noise);
  const bool whole =
      lines.size() == 1 && lines[0].first == 0 && lines[0].last + 1 == int(curve.at.size());
  const bool arc = !whole && nearly_arc(curve, options.band.tolerance);
  if (arc && take(one_arc(curve), curve, band, points, options)) return;
  if (lines.empty()) return;
  for (const double share : kShortened)
    if (take(with_lines(curve, lines, share), curve, band, points, options, lines)) return;
  if (lines.size() == 1) return;
  std::vector<Straight> kept;
  const DenseCurve free = curve;
  for (const Straight& line : lines) {
    kept.push_back(line);
    const bool taken = std::any_of(kShortened.begin(), kShortened.end(), [&](double share) {
      return take(with_lines(free, kept, share), curve, band, points, options, {line});
    });
    if (!taken) kept.pop_back();
  }
}

void make_arcs(DenseCurve& curve, BandReport& band, const std::vector<FitPoint>& points,
               const FlatOptions& options) {
  if (curve.kind.empty()) curve.kind.assign(curve.alpha.size(), PieceKind::curve);
  std::vector<double> own(curve.alpha.size());  // roots of the pieces' energies
  for (std::size_t p = 0; p < own.size(); ++p) own[p] = std::abs(energy_of(curve, p).root);
  const double least =
      std::max(kFree * band.energy, unseen_energy(curve.length, options.band.tolerance));
  // What arcs do not vary their neighbours have to, at more cost: more than that is not worth a
  // try.
  const double most = (options.worth - 1) *
                      std::max(band.energy, unseen_energy(curve.length, options.band.tolerance));
  std::vector<std::size_t> which;
  for (std::size_t p = 0; p < curve.alpha.size(); ++p)
    if (!flat(curve, p) && !bends_as_held(curve, p) && !against_side(curve, p) &&
        own[p] * own[p] < least && departure(curve, p) < kBandWidth * options.band.tolerance)
      which.push_back(p);
  std::stable_sort(which.begin(), which.end(),
                   [&](std::size_t a, std::size_t b) { return own[a] < own[b]; });
  for (; !which.empty() && !options.band.progress.stop_requested();
       which.resize(which.size() / 2)) {
    double given = 0;
    for (const std::size_t p : which) given += own[p] * own[p];
    if (given > most) continue;
    DenseCurve trial = curve;
    for (const std::size_t p : which)
      if (alone(trial, p)) make_arc(trial, p);
    if (take(std::move(trial), curve, band, points, options)) return;
  }
}

}  // namespace keyline::fairing::detail
