#include "keyline/fairing/least_variation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "keyline/fairing/band.h"
#include "keyline/fairing/dense_places.h"
#include "keyline/fairing/dense_riccati.h"
#include "keyline/fairing/dense_step.h"
#include "keyline/fairing/rise_barrier.h"
#include "keyline/fairing/spring_power.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kReach = 1e2;  // as kHeld, of where an open curve ends beside its last point
constexpr double kBarrierDrop = 0.25;   // of the barrier that is kept each time a curve settles
constexpr double kExtra = 1e-6;         // of the tolerance: extra width that counts as none
constexpr double kProgress = 0.9;       // of the extra width after a step that is worth it
constexpr std::size_t kStuck = 6;       // steps that together leave more…
constexpr double kDrawnIn = 0.95;       // …than this of the extra width: more would not draw it in
constexpr double kAlike = 1e-3;         // of a step: as good as the same
constexpr int kHalvings = 5;            // of a step that is refused, to a thirty-second
constexpr double kLeastDamping = 1e-2;  // full steps lower it tenfold: less is none
constexpr double kMostDamping = 1e9;    // refused ones raise it tenfold: the search ends here
constexpr int kStiffenings = 6;         // of the first springs, each tenfold: 100,000 times at most
constexpr int kFollowSteps = 12;        // with springs of one stiffness, which need not settle
constexpr double kFollowed = 0.5;       // of the tolerance: a first curve so near is near enough
constexpr double kFollowGain = 1e-2;    // of what a step lowers: one that gains less is the last
constexpr int kLoosenings = 12;         // secant steps to the weight of the springs
constexpr double kMeanSquareGap = 0.02;  // of the rms asked for
constexpr int kRateRounds = 4;           // of limiting rates, each about the curve of the last
constexpr double kAsFast = 1 + 1e-6;     // times the fastest rate allowed
constexpr double kMostLoosening = 4.6;   // a hundredfold at once

class Search {
 public:
  Search(DenseCurve& curve, const std::vector<FitPoint>& points, const BandOptions& options)
      : curve_(curve), points_(points), options_(options), unit_(options.tolerance) {
    mean_weight_ = mean_weights(points);
    spring_ = options.spring;
    look();
    energy_unit_ = energy_scale();
  }

  /// Follows the points closely: springs, stiffened until all lie well inside the tolerance or the
  /// curve follows them no closer. Then the spring whose curve has the offsets' mean square that
  /// is asked for.
  void follow() {
    double weight = 1 / (unit_ * unit_);
    for (int round = 0; round < kStiffenings; ++round, weight *= 10) {
      hang(weight);
      if (largest() < kFollowed * unit_ && closed_enough()) break;
    }
    if (spring_ > 0) hang_on(spring_);
    if (spring_ == 0 && options_.rms > 0) loosen(hung_);
  }

  BandReport run() {
    keep_rises(curve_);
    look();
    energy_unit_ = energy_scale();
    Band band(points_, unit_, spring_ / energy_unit_);
    band.start(spots_.offset, 0.5 / static_cast<double>(points_.size()));
    rises_.emplace(curve_, band.barrier());
    limits_ = &band;
    band_ = &band;
    damping_ = 0;
    refused_.reset();
    widths_.clear();
    finished_ = false;
    BandReport report;
    while (report.iterations < options_.iterations && !finished_ &&
           !options_.progress.stop_requested()) {
      ++report.iterations;
      const double before = band.extra();
      iterate();
      const bool idle = before > kExtra * unit_ && band.extra() > kProgress * before;
      idle_ = idle ? idle_ + 1 : 0;
      if (options_.patience > 0 && idle_ >= options_.patience) break;
      if (options_.warm && stuck()) break;
    }
    report.converged = converged_;
    report.energy = variation(curve_);
    report.max_offset = largest();
    report.rms = root_mean_square(mean_weight_, spots_.offset);
    report.spring = spring_;
    report.within = report.max_offset <= options_.tolerance && closed_enough() &&
                    limits_kept(points_, spots_.offset, kExtra * unit_) &&
                    all_passed(points_, spots_.offset, unit_);
    return report;
  }

 private:
  double largest() const { return largest_of(points_, spots_.offset); }

  /// The curve that hangs on springs of this weight of the mean square beside the energy's unit.
  void hang(double weight) {
    limits_ = &springs_.emplace(points_, spots_.offset, weight);
    damping_ = 0;
    refused_.reset();
    finished_ = false;
    for (int i = 0; i < kFollowSteps && !finished_; ++i) iterate();
    hung_ = weight * energy_unit_;
    energy_unit_ = energy_scale();
  }

  double rms() const { return root_mean_square(mean_weight_, spots_.offset); }

  /// The softest springs that keep the mean square, by the secant of logarithms: it grows with a
  /// power of the weight. The curve stays the softest that lies inside the tolerance.
  void loosen(double weight) {
    SpringPower power;
    double before = rms();
    for (int round = 0; round < kLoosenings; ++round) {
      if (std::abs(std::log(options_.rms / before)) < kMeanSquareGap) break;
      const double by =
          std::clamp(power.growth(before, options_.rms), -kMostLoosening, kMostLoosening);
      weight *= std::exp(by);
      const double now = hang_on(weight);
      power.learn(by, before, now);
      before = now;
    }
    spring_ = weight;
  }

  /// Root of the mean square on springs of that weight; a curve outside the tolerance is not kept.
  double hang_on(double weight) {
    const DenseCurve before = curve_;
    hang(weight / energy_unit_);
    const double now = rms();
    if (largest() <= unit_) return now;
    curve_ = before;
    look();
    return now;
  }

  /// What depends on the curve, anew.
  void look() {
    shapes_ = shapes_of(curve_);
    settle_feet(curve_, shapes_, 3);
    spots_ = spots_of(curve_, shapes_, points_);
    gaps_ = gaps_of(curve_, shapes_);
  }

  double energy_scale() const { return std::max(variation(curve_), unit_ * unit_); }

  bool closed_enough() const { return gaps_.sum <= 1e-2 * unit_; }

  void settle_feet(DenseCurve& curve, const Shapes& shapes, int rounds) const {
    for (std::size_t j = 0; j < points_.size(); ++j) {
      if (pinned(j)) continue;
      for (int r = 0; r < rounds; ++r) move_foot(curve, shapes, points_[j], curve.feet[j]);
    }
  }

  /// Whether an end that nothing holds is to come to stand beside that point, its last one.
  bool pinned(std::size_t j) const {
    if (curve_.closed || (j > 0 && j + 1 < points_.size())) return false;
    return (j == 0 ? curve_.hold_start : curve_.hold_end) == Hold::free;
  }

  double merit(const DenseCurve& curve, const Spots& spots, const std::vector<double>& offset,
               double gaps, double share) const {
    double sum = variation(curve) / energy_unit_ + limits_->merit(offset, share);
    if (rises_) sum += rises_->merit(curve);
    for (const std::size_t j : {std::size_t{0}, points_.size() - 1})
      if (pinned(j)) sum += 0.5 * kReach * std::pow(along(spots, points_, j) / unit_, 2);
    return sum + gap_price_ * gaps;
  }

  std::vector<Cell> model() const {
    std::vector<Cell> cells(curve_.joints.size() - 1);
    for (std::size_t i = 0; i < cells.size(); ++i) set_step(cells[i], curve_, gaps_, i);
    for (std::size_t j = 0; j < points_.size(); ++j) add_point(cells, j);
    const std::size_t pieces = curve_.alpha.size();
    for (std::size_t p = 0; p < pieces; ++p) {
      add_piece(cells[curve_.cut[p]], p);
      Passage& passage = cells[curve_.cut[p + 1] - 1].passage;
      passage.ends_piece = true;
      passage.arc = flat(curve_, p);
      passage.ends_curve = p + 1 == pieces;
      passage.fixed = !passage.ends_curve && (flat(curve_, p + 1) || end_of_line(curve_, p + 2));
    }
    return cells;
  }

  /// The piece's variation, told where it begins: both its curvatures are known there.
  void add_piece(Cell& cell, std::size_t p) const {
    const PieceEnergy energy = energy_of(curve_, p);
    const double w = 2 / energy_unit_;
    Vector6 d = Vector6::Zero();
    d(3) = energy.by_start;
    d(4) = energy.by_end;
    add(cell, d, w, w * energy.root);
    if (!rises_) return;
    rises_->each_pull(p, [&](double start, double end, const Pull& pull) {
      d(3) = start;
      d(4) = end;
      add(cell, d, pull.weight, pull.slope);
    });
  }

  void add_point(std::vector<Cell>& cells, std::size_t j) const {
    const int cell = curve_.feet[j].piece;
    const CellPlace& s = spots_.place[j];
    const Pull pull = limits_->pull(j);
    add(cells[cell], by_offset(curve_, spots_, points_, j), pull.weight, pull.slope);
    if (!pinned(j)) return;
    const double w = kReach / (unit_ * unit_);
    add(cells[cell], derivative(curve_, s, cell, s.tangent), w, w * along(spots_, points_, j));
  }

  DenseBoundary boundary(const Vector6& seam) const {
    return boundary_of(curve_, seam, multiplier_, kHeld / (unit_ * unit_));
  }

  DenseStep solve(const std::vector<Cell>& cells, const Vector6& seam) const {
    return solve_held(cells, boundary(seam), seam);
  }

  std::vector<double> meant(const DenseStep& step) const {
    std::vector<double> change(points_.size());
    for (std::size_t j = 0; j < points_.size(); ++j)
      change[j] = by_offset(curve_, spots_, points_, j).dot(step.state[curve_.feet[j].piece]);
    return change;
  }

  /// Whether the last steps that were taken hardly drew the band in: more of them would not.
  bool stuck() {
    const double extra = band_->extra();
    if (!refused_) widths_.push_back(extra);
    if (extra <= kExtra * unit_ || widths_.size() <= kStuck) return false;
    return extra > kDrawnIn * widths_[widths_.size() - 1 - kStuck];
  }

  void iterate() {
    if (!refused_) cells_ = model();
    std::vector<Cell> cells = cells_;
    damp(cells, curve_, damping_);
    DenseStep step = solve(cells, gaps_.seam);
    if (!step.sound) {
      refuse();
      return;
    }
    const double price = gap_price_;
    gap_price_ = std::max(gap_price(step), 0.5 * gap_price_);
    if (refused_ && alike(step, *refused_, kAlike) &&
        std::abs(gap_price_ - price) < kAlike * price) {
      refuse();
      return;
    }
    if (go(step, kHalvings, cells)) {
      refused_.reset();
      return;
    }
    refused_ = std::move(step);
    refuse();
  }

  void refuse() {
    damping_ = std::max(10 * damping_, 1.0);
    if (damping_ < kMostDamping) return;
    finished_ = true;
    converged_ = band_ && band_->extra() <= kExtra * unit_ && closed_enough() && last();
  }

  /// Goes as much of the step as may be gone, halved so often at most. Where all of it opens gaps,
  /// since pieces bend where their model is straight, first what closes these too is tried.
  /// Source: second-order corrections, [Nocedal 2006], section 18.3.
  bool go(const DenseStep& step, int halvings, std::vector<Cell>& cells) {
    const std::vector<double> planned = meant(step);
    const RiseBarrier::Ends rises = meant_ends(curve_, step);
    const double before = merit(curve_, spots_, spots_.offset, gaps_.sum, 0);
    double share = std::min(limits_->longest(planned), keeps_side(curve_, step));
    if (rises_) share = std::min(share, rises_->longest(rises));
    for (int h = 0; h <= halvings; ++h, share *= 0.5) {
      if (take(step, planned, share, before)) {
        if (rises_) rises_->move(curve_, rises);
        damping_ = h == 0 ? 0.1 * damping_ : damping_;
        if (damping_ < kLeastDamping) damping_ = 0;
        return true;
      }
      const bool opens = h == 0 && halvings > 0 && opened_.sum > gaps_.sum;
      if (opens && corrects() && go(closing(share, cells), 0, cells)) return true;
    }
    return false;
  }

  /// Pieces in the tolerance alone. Of a free curve more waves would go, each at up to `worth`; on
  /// springs pieces that cannot come as near would climb in small steps.
  bool corrects() const { return curve_.cut.size() < curve_.joints.size() && spring_ == 0; }

  DenseStep closing(double share, std::vector<Cell>& cells) const {
    for (std::size_t i = 0; i < cells.size(); ++i)
      cells[i].gap = share * gaps_.cell[i] + opened_.cell[i];
    return solve(cells, share * gaps_.seam + opened_.seam);
  }

  /// Goes that share of the step where this keeps inside the band and lowers the merit.
  bool take(const DenseStep& step, const std::vector<double>& planned, double share,
            double before) {
    opened_ = {};
    DenseCurve trial = moved(curve_, step, share);
    if (!(trial.length > 0.3 * curve_.length)) return false;
    Shapes shapes = shapes_of(trial);
    settle_feet(trial, shapes, 2);
    Spots spots = spots_of(trial, shapes, points_);
    Gaps gaps = gaps_of(trial, shapes);
    const std::vector<double> offset = without_gaps(spots, curve_.feet, trial, gaps, points_);
    if (!limits_->allows(offset, share)) return false;
    opened_ = std::move(gaps);
    const double after = merit(trial, spots, offset, opened_.sum, share);
    if (!(after < before + 1e-10 * std::abs(before))) return false;
    limits_->move(offset, planned, share);
    limits_->rest(spots.offset);
    curve_ = std::move(trial);
    shapes_ = std::move(shapes);
    spots_ = std::move(spots);
    gaps_ = std::move(opened_);
    if (curve_.closed || curve_.hold_end != Hold::free)
      multiplier_ += boundary(gaps_.seam).end_hessian * gaps_.seam;
    advance(share, before - after);
    return true;
  }

  void advance(double share, double gain) {
    if (!band_) {
      if (gain < kFollowGain) finished_ = true;
      return;
    }
    const bool inside = band_->extra() <= kExtra * unit_ && closed_enough();
    if (last() && inside && gain < 1e-2 * options_.gap) converged_ = finished_ = true;
    if (share > 0.3 && !last()) drop_barrier();
  }

  bool last() const {
    const double limits = 2.0 * static_cast<double>(points_.size()) + rises_->count();
    return band_->barrier() * limits <= options_.gap;
  }

  void drop_barrier() {
    const double unit = energy_scale();
    const double rescale = energy_unit_ / unit;
    energy_unit_ = unit;
    band_->set_barrier(kBarrierDrop * band_->barrier());
    band_->rescale(rescale);
    rises_->set_barrier(band_->barrier());
    rises_->rescale(rescale);
    gap_price_ *= rescale;
    multiplier_ *= rescale;
  }

  DenseCurve& curve_;
  const std::vector<FitPoint>& points_;
  const BandOptions& options_;
  Limits* limits_ = nullptr;
  std::optional<Springs> springs_;
  std::optional<RiseBarrier> rises_;
  Band* band_ = nullptr;
  double unit_;
  Shapes shapes_;
  Spots spots_;
  Gaps gaps_;
  Gaps opened_;  ///< after the last trial
  std::vector<double> mean_weight_;
  Vector6 multiplier_ = Vector6::Zero();
  double spring_ = 0;
  double hung_ = 0;  ///< weight of the springs that the curve hung on last
  double energy_unit_ = 1;
  double gap_price_ = 0;
  double damping_ = 0;
  std::vector<Cell> cells_;           ///< the model without damping
  std::optional<DenseStep> refused_;  ///< the last step, where it was not taken: all is as before
  std::vector<double> widths_;        ///< extra widths of the band after the steps taken
  int idle_ = 0;  ///< steps in a row that brought the band hardly nearer to its width
  bool finished_ = false;
  bool converged_ = false;
};

}  // namespace

BandReport least_variation(DenseCurve& curve, const std::vector<FitPoint>& points,
                           const BandOptions& options) {
  Search search(curve, points, options);
  if (!options.warm) search.follow();
  BandReport report = search.run();
  // Of pieces the limit on rates is linear only about the curve that it was taken of.
  for (int round = 0; round < kRateRounds && too_fast(curve) > kAsFast; ++round) {
    ease(curve);
    report = Search(curve, points, options).run();
  }
  report.within = report.within && too_fast(curve) <= kAsFast;
  return report;
}

}  // namespace keyline::fairing::detail
