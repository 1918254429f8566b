#include "keyline/fairing/rate_joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "keyline/fairing/calm.h"
#include "keyline/fairing/piece_energy.h"
#include "keyline/fairing/rate_descent.h"
#include "keyline/lac/segment/segment.h"
#include "keyline/lac/segment/sensitivity.h"

namespace keyline::fairing::detail {
namespace {

constexpr int kRounds = 4;             // of parting pieces
constexpr int kUntyings = 5;           // rounds in which ties go and the band gets firmer
constexpr double kFirmBand = 5;        // of the points' offsets where rates are held…
constexpr double kFirmer = 4;          // …and how much more at each untying
constexpr int kPasses = 2;             // over joints that stay
constexpr double kSteepPower = 12;     // of the offsets where joints are held one by one
constexpr int kRaises = 3;             // of the prices of points outside, then…
constexpr double kRaisePower = 16;     // …by that power of their offsets…
constexpr double kMostRaise = 16;      // …so much at most…
constexpr double kNearOutside = 0.97;  // …from here on
constexpr int kSteps = 20;             // of a solve while jumps are drawn to none
constexpr int kTiedSteps = 30;         // of one with ties, whose gaps have to close too
constexpr double kGone = 0.03;         // of the rate's logarithm: a jump that may be tied
constexpr double kShortest = 2e-3;     // of the length: shorter pieces are not parted
constexpr double kInside = 0.01;       // of their range that slopes start away from its ends
constexpr double kNear = 1e-2;         // of the other end's curvature: an inflection is near
constexpr double kFlattest = -0.3;     // slopes of pieces through or into an inflection
constexpr double kMet = 1;             // tolerances of gaps from which the last digits are closed
constexpr double kLastDigits = 1e-6;   // tolerances: gaps that are left count as closed
constexpr double kUntied = 0.05;       // of the ties that go at once

/// How much jumps of the rate count beside the variation, growing, and which are even.
struct Stiffness {
  double jump;
  double even;
  double band;
  double power;
};
// Solve by solve (see RateWeights): jumps cost nothing, then ten times as much each time; last,
// small ones still count by their size, and offsets count more.
constexpr std::array<Stiffness, 5> kStiffening{
    {{0, 0.1, 1, 2}, {0.01, 0.1, 3, 4}, {0.1, 0.1, 3, 4}, {1, 0.1, 3, 4}, {1, 0.02, 10, 4}}};

core::Interval slopes_of(const FitChain& chain, std::size_t p, core::Interval slopes) {
  const double a = chain.joints[p].curvature;
  const double b = chain.joints[p + 1].curvature;
  const double less = std::min(std::abs(a), std::abs(b));
  if (a * b > 0 && less >= kNear * std::max(std::abs(a), std::abs(b))) return slopes;
  // The rate does not grow without bound where curvature vanishes.
  return {std::max(slopes.low, -1.0), std::max(std::min(slopes.high, kFlattest), -0.9)};
}

class Joining {
 public:
  Joining(FitChain& chain, const std::vector<FitPoint>& points, const RateOptions& options)
      : chain_(chain), options_(options) {
    problem_.points = &points;
    problem_.weights.tolerance = options.tolerance;
    problem_.end = chain.joints.back();
    problem_.weights.energy = variation();
  }

  RateReport run() {
    RateReport best{false, 0, static_cast<int>(rate_joints(chain_).size()) + 1, {}};
    FitChain found = chain_;
    for (int round = 0; round < kRounds; ++round) {
      prepare();
      loosen();
      FitChain loose = chain_;
      const RateReport report = tie();
      if (report.within && report.missed < best.missed) {
        best = report;
        found = chain_;
      }
      if (best.missed == 0 || options_.progress.stop_requested()) break;
      chain_ = std::move(loose);
      if (!part()) break;
    }
    chain_ = std::move(found);
    return best.within || options_.progress.stop_requested() ? best : tie_some();
  }

 private:
  double variation() const {
    double sum = 0;
    for (std::size_t p = 0; p < chain_.pieces.size(); ++p) {
      const double root = piece_energy(chain_.joints[p].curvature, chain_.joints[p + 1].curvature,
                                       chain_.pieces[p].alpha)
                              .root;
      if (chain_.pieces[p].kind == PieceKind::curve) sum += root * root / chain_.pieces[p].length;
    }
    return sum;
  }

  void prepare() {
    problem_.joints = rate_joints(chain_);
    problem_.slopes.clear();
    problem_.growth.clear();
    for (std::size_t p = 0; p < chain_.pieces.size(); ++p) {
      const core::Interval range = slopes_of(chain_, p, options_.slopes);
      problem_.slopes.push_back(range);
      const bool grows =
          std::abs(chain_.joints[p + 1].curvature) > std::abs(chain_.joints[p].curvature);
      problem_.growth.push_back(grows ? 1 : -1);
      const double inside = kInside * (range.high - range.low);
      FitPiece& piece = chain_.pieces[p];
      if (piece.kind != PieceKind::line)
        piece.alpha = std::clamp(piece.alpha, range.low + inside, range.high - inside);
    }
  }

  RateSolution solve(int steps) {
    RateSolution found = solve_rates(chain_, problem_, steps, options_.progress);
    chain_ = found.chain;
    return found;
  }

  void loosen() {
    RateSolution found;
    for (std::size_t i = round_++ == 0 ? 0 : 1; i < kStiffening.size(); ++i) {
      const Stiffness& stiffness = kStiffening[i];
      problem_.weights.jump = stiffness.jump;
      problem_.weights.even = stiffness.even;
      problem_.weights.band = stiffness.band;
      problem_.weights.power = stiffness.power;
      found = solve(kSteps);
    }
    jump_ = found.jump;
  }

  int tied() const {
    return static_cast<int>(
        std::ranges::count_if(problem_.joints, [](const RateJoint& j) { return j.tied; }));
  }

  /// Jumps that are gone are held at none, but for a few where that costs too much, the offsets
  /// dearer each time.
  RateReport tie() {
    const int count = static_cast<int>(problem_.joints.size());
    RateReport report{false, count, count, {}};
    for (std::size_t k = 0; k < problem_.joints.size(); ++k) {
      problem_.joints[k].tied = std::abs(jump_[k]) <= kGone;
      if (!problem_.joints[k].tied)
        report.stay.push_back({problem_.joints[k].after, RateLoss::slopes});
    }
    problem_.weights.jump = 0;
    for (int i = 0; i < kUntyings && !options_.progress.stop_requested(); ++i) {
      problem_.weights.band = kFirmBand * std::pow(kFirmer, i);
      const RateSolution found = solve(kTiedSteps);
      const std::optional<RateLoss> loss = loss_of(found);
      report.within = !loss;
      if (report.within || tied() == 0) break;
      untie(found.strain, 1 + static_cast<int>(kUntied * tied()), *loss, report.stay);
    }
    if (report.within) report.missed = static_cast<int>(report.stay.size());
    return report;
  }

  /// Joint by joint from the G2 chain, where nearly all cannot be held: all at once, else halves of
  /// them, those of the smaller jumps first.
  RateReport tie_some() {
    prepare();
    problem_.weights = RateWeights{.tolerance = options_.tolerance,
                                   .energy = problem_.weights.energy,
                                   .band = kFirmBand,
                                   .power = kSteepPower,
                                   .jump = 0,
                                   .even = 0.1};
    jump_ = RateModel(chain_, problem_).jump;
    std::vector<int> all(problem_.joints.size());
    std::iota(all.begin(), all.end(), 0);
    std::ranges::sort(all, {}, [this](int k) { return std::abs(jump_[k]); });
    RateReport report{false, static_cast<int>(all.size()), 0, {}};
    for (int pass = 0; pass < kPasses && !all.empty(); ++pass) {
      report.stay.clear();
      hold_some(all, report);
      std::erase_if(all, [this](int k) { return problem_.joints[k].tied; });
    }
    report.missed = static_cast<int>(all.size());
    report.within = report.missed < report.joints;
    return report;
  }

  void hold_some(const std::vector<int>& joints, RateReport& report) {
    if (joints.empty() || options_.progress.stop_requested()) return;
    const std::optional<RateLoss> loss = loss_by(joints);
    if (!loss) return;
    if (joints.size() == 1) {
      report.stay.push_back({problem_.joints[joints[0]].after, *loss});
      return;
    }
    const auto half = joints.begin() + static_cast<std::ptrdiff_t>(joints.size() / 2);
    hold_some({joints.begin(), half}, report);
    hold_some({half, joints.end()}, report);
  }

  /// What is lost by holding these joints too; where nothing, they are held.
  std::optional<RateLoss> loss_by(const std::vector<int>& joints) {
    const FitChain before = chain_;
    for (const int k : joints) problem_.joints[k].tied = true;
    problem_.price.assign(problem_.points->size(), 1);
    std::optional<RateLoss> loss;
    for (int i = 0; i < kRaises; ++i) {
      const RateSolution found = solve(kTiedSteps);
      loss = loss_of(found);
      if (!loss) return loss;
      if (loss != RateLoss::tolerance) break;
      raise_prices(found.offset);
    }
    chain_ = before;
    for (const int k : joints) problem_.joints[k].tied = false;
    return loss;
  }

  void raise_prices(const std::vector<double>& offset) {
    for (std::size_t j = 0; j < offset.size(); ++j) {
      const double over = std::abs(offset[j]) / kNearOutside;
      if (over > 1) problem_.price[j] *= std::min(kMostRaise, std::pow(over, kRaisePower));
    }
  }

  /// What the chain would lose as it stands; where nothing, its last digits are closed.
  std::optional<RateLoss> loss_of(const RateSolution& found) {
    if (!(found.max_offset <= 1 && found.gaps <= kMet)) return RateLoss::tolerance;
    const RateModel closed(close_rates(chain_, problem_), problem_);
    if (!(closed.gaps <= kLastDigits) || !(closed.max_offset <= 1)) return RateLoss::tolerance;
    if (!(closed.variation <= kWaveWorth)) return RateLoss::variation;
    for (const RateLimit& limit : closed.limits)
      if (!(limit.room >= 0)) return RateLoss::slopes;
    if (const auto lost = options_.loses ? options_.loses(closed.chain) : std::nullopt) return lost;
    chain_ = closed.chain;
    return std::nullopt;
  }

  void untie(const std::vector<double>& strain, int many, RateLoss loss,
             std::vector<RateReport::Stay>& stay) {
    for (int i = 0; i < many; ++i) {
      RateJoint* most = nullptr;
      double largest = -1;
      for (std::size_t k = 0; k < strain.size(); ++k) {
        if (!problem_.joints[k].tied || strain[k] <= largest) continue;
        largest = strain[k];
        most = &problem_.joints[k];
      }
      if (!most) return;
      most->tied = false;
      stay.push_back({most->after, loss});
    }
  }

  /// The pieces beside jumps become two each; false where none is long enough.
  bool part() {
    std::set<int> beside;
    for (std::size_t k = 0; k < problem_.joints.size(); ++k) {
      if (std::abs(jump_[k]) <= kGone) continue;
      beside.insert(problem_.joints[k].before);
      beside.insert(problem_.joints[k].after);
    }
    FitChain next = chain_;
    next.joints.clear();
    next.pieces.clear();
    std::vector<int> first;  // of the pieces that each has become
    std::vector<std::vector<double>> cuts;
    for (std::size_t p = 0; p < chain_.pieces.size(); ++p) {
      first.push_back(static_cast<int>(next.pieces.size()));
      cuts.push_back(cuts_of(p, beside.contains(static_cast<int>(p))));
      add_parts(next, p, cuts.back());
    }
    next.joints.push_back(chain_.joints.back());
    for (Foot& foot : next.feet) {
      const std::vector<double>& at = cuts[foot.piece];
      std::size_t part = 0;
      while (part + 2 < at.size() && foot.fraction > at[part + 1]) ++part;
      foot.fraction = (foot.fraction - at[part]) / (at[part + 1] - at[part]);
      foot.piece = first[foot.piece] + static_cast<int>(part);
    }
    const bool more = next.pieces.size() > chain_.pieces.size();
    chain_ = std::move(next);
    return more;
  }

  /// Fractions of a piece's length at which it is parted, 0 and 1 among them.
  std::vector<double> cuts_of(std::size_t p, bool wanted) const {
    const FitPiece& piece = chain_.pieces[p];
    if (!wanted || piece.kind == PieceKind::line || piece.length < kShortest) return {0, 1};
    const double zero = lac::inflection(
        {piece.alpha, piece.length, chain_.joints[p].curvature, chain_.joints[p + 1].curvature});
    if (zero < 0) return {0, 0.5, 1};
    std::vector<double> cuts{0};
    if (zero > 0.1) cuts.push_back(0.5 * zero);
    if (zero < 0.9) cuts.push_back(0.5 * (1 + zero));
    cuts.push_back(1);
    return cuts;
  }

  void add_parts(FitChain& next, std::size_t p, const std::vector<double>& cuts) const {
    const FitPiece& piece = chain_.pieces[p];
    const FitJoint& from = chain_.joints[p];
    lac::PieceTable table;
    table.build(from.curvature, chain_.joints[p + 1].curvature, piece.length, piece.alpha, true);
    const double c = std::cos(from.direction);
    const double s = std::sin(from.direction);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const lac::PieceTable::Value at = table.at(cuts[i]);
      FitJoint joint = from;
      if (i > 0)
        joint = {{from.position.x + c * at.x - s * at.y, from.position.y + s * at.x + c * at.y},
                 from.direction + at.angle,
                 table.curvature(cuts[i])};
      next.joints.push_back(joint);
      FitPiece part = piece;
      part.length *= cuts[i + 1] - cuts[i];
      next.pieces.push_back(part);
    }
  }

  FitChain& chain_;
  const RateOptions& options_;
  RateProblem problem_;
  std::vector<double> jump_;
  int round_ = 0;
};

}  // namespace

RateReport join_rates(FitChain& chain, const std::vector<FitPoint>& points,
                      const RateOptions& options) {
  const std::size_t n = chain.pieces.size();
  for (std::size_t p = 0; p < n; ++p)
    if (chain.pieces[p].kind == PieceKind::arc) return {};
  if (n < 2) return {true, 0, 0, {}};
  return Joining(chain, points, options).run();
}

}  // namespace keyline::fairing::detail
