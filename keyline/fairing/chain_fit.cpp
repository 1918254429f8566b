#include "keyline/fairing/chain_fit.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/fairing/evaluation.h"
#include "keyline/fairing/piece_energy.h"
#include "keyline/numeric/damped_descent.h"

namespace keyline::fairing {
namespace {

using detail::Boundary;
using detail::Evaluation;
using detail::kAlphaAt;
using detail::kCurvature;
using detail::kInflectionSlope;
using detail::kLengthAt;
using detail::kNextCurvature;
using detail::Model;
using detail::Stage;

constexpr double kSmall = 0.3;    // curvature beside that of the other end: an inflection is near
constexpr double kAtHome = 1e-8;  // of a piece: a foot that moves less is there, to the last digit
constexpr double kEndWeight = 1e9;  // times a point's weight: what is held gives way by a billionth

/// The boundary of a closed chain or of an open one with held ends.
Boundary boundary_of(const FitChain& chain) {
  Boundary b;
  b.closed = chain.closed;
  const int held = static_cast<int>(chain.hold_start);
  for (int k = 0; k < 4; ++k) b.fixed_start[k] = k < (held == 0 ? 0 : held + 1);
  if (chain.pieces[0].kind == PieceKind::line) b.fixed_start[kCurvature] = true;
  if (chain.closed) {
    const FitJoint& first = chain.joints.front();
    const FitJoint& last = chain.joints.back();
    b.end_hessian = kEndWeight * detail::Matrix4::Identity();
    b.end_hessian(3, 3) *= 1e-3;
    const detail::Vector4 miss{
        last.position.x - first.position.x, last.position.y - first.position.y,
        last.direction - first.direction - chain.turning, last.curvature - first.curvature};
    b.end_gradient = b.end_hessian * miss;
    return b;
  }
  const int held_end = static_cast<int>(chain.hold_end);
  for (int k = 0; k < 4; ++k)
    if (k < (held_end == 0 ? 0 : held_end + 1)) b.end_hessian(k, k) = kEndWeight;
  return b;
}

/// Largest share of the step that keeps lengths positive and curvature on its side where the
/// slope allows no inflection.
double step_limit(const FitChain& chain, const detail::Step& step) {
  double share = 1;
  for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
    const FitPiece& piece = chain.pieces[i];
    const double change = step.control[i](0);
    if (change < -0.7 * piece.length) share = std::min(share, -0.7 * piece.length / change);
    if (piece.kind != PieceKind::curve || piece.alpha <= kInflectionSlope) continue;
    for (std::size_t k = i; k <= i + 1; ++k) {
      const double curvature = chain.joints[k].curvature;
      const double by = step.state[k](3);
      if (curvature * by < 0 && std::abs(by) > 0.8 * std::abs(curvature))
        share = std::min(share, 0.8 * std::abs(curvature / by));
    }
  }
  return share;
}

/// What a joint's curvature is to the pieces beside it: near an inflection they depend smoothly on
/// bend = |curvature|^exponent * beside^(1 - exponent), with its sign, and not on the curvature.
struct Bend {
  double exponent = 1;  ///< 1 where no inflection is near
  double beside = 1;    ///< the larger curvature at the piece's other end

  /// By which the curvature changes with the bend.
  double rate(double curvature) const {
    if (exponent == 1 || curvature == 0) return 1;
    return std::pow(std::abs(curvature) / beside, 1 - exponent) / exponent;
  }

  /// The curvature after a change that is meant linearly in the bend.
  double changed(double curvature, double by) const {
    if (exponent == 1 || curvature == 0) return curvature + by;
    const double power = 1 + exponent * by / curvature;
    return curvature * std::copysign(std::pow(std::abs(power), 1 / exponent), power);
  }
};

/// Of the two pieces beside a joint that with the smaller exponent, to which the other is smooth as
/// well.
Bend bend_at(const FitChain& chain, std::size_t joint) {
  Bend least{.exponent = kSteepestSlope};
  for (const std::size_t i : {joint - 1, joint}) {
    if (i >= chain.pieces.size() || chain.pieces[i].kind != PieceKind::curve) continue;
    const double other = std::abs(chain.joints[i == joint ? joint + 1 : joint - 1].curvature);
    const double alpha = chain.pieces[i].alpha;
    if (alpha >= 0 || std::abs(chain.joints[joint].curvature) > kSmall * other) continue;
    if (-alpha < least.exponent) least = {-alpha, other};
  }
  return least.exponent < kSteepestSlope ? least : Bend{};
}

/// The end is held by a heavy weight, which gives way by a billionth: not at all.
void keep_held_end(FitChain& next, const FitChain& chain) {
  const FitJoint& before = chain.joints.back();
  FitJoint& end = next.joints.back();
  if (chain.hold_end >= Hold::position) end.position = before.position;
  if (chain.hold_end >= Hold::direction) end.direction = before.direction;
  if (chain.hold_end >= Hold::curvature) end.curvature = before.curvature;
}

FitChain moved(const FitChain& chain, const detail::Step& step, double share,
               const std::vector<Bend>& bends) {
  FitChain next = chain;
  for (std::size_t k = 0; k < next.joints.size(); ++k) {
    FitJoint& joint = next.joints[k];
    joint.position.x += share * step.state[k](0);
    joint.position.y += share * step.state[k](1);
    joint.direction += share * step.state[k](2);
    joint.curvature = bends[k].changed(joint.curvature, share * step.state[k](3));
  }
  keep_held_end(next, chain);
  for (std::size_t i = 0; i < next.pieces.size(); ++i) {
    FitPiece& piece = next.pieces[i];
    piece.length = std::max(0.2 * piece.length, piece.length + share * step.control[i](0));
    if (piece.kind == PieceKind::curve && !slope_held(piece)) {
      const double change = std::clamp(share * step.control[i](1), -1.5, 1.5);
      piece.alpha = std::clamp(piece.alpha + change, piece.alpha_low, piece.alpha_high);
      const double a = next.joints[i].curvature;
      const double b = next.joints[i + 1].curvature;
      const bool touches = a * b <= 0 || std::min(std::abs(a / b), std::abs(b / a)) < 1e-4;
      if (touches) piece.alpha = std::clamp(piece.alpha, -6.0, kInflectionSlope);
    }
  }
  return next;
}

/// In terms of bends: near an inflection what the chain changes by with the curvature, beyond all
/// bounds or hardly at all, would drown the rest. `still`: the squares that keep variables where
/// they are stay theirs.
void take_bends(std::vector<Stage>& stages, const std::vector<double>& rates, bool still) {
  for (std::size_t i = 0; i < stages.size(); ++i) {
    Stage& stage = stages[i];
    detail::Vector7 by = detail::Vector7::Ones();
    by(kCurvature) = rates[i];
    by(kNextCurvature) = rates[i + 1];
    stage.step *= by.asDiagonal();
    stage.step.row(3) /= rates[i + 1];
    if (still) continue;
    stage.hessian = by.asDiagonal() * stage.hessian * by.asDiagonal();
    stage.gradient = by.asDiagonal() * stage.gradient;
  }
}

void damp(std::vector<Stage>& stages, const FitChain& chain, double lambda, double unit) {
  for (std::size_t i = 0; i < stages.size(); ++i) {
    Stage& stage = stages[i];
    stage.hessian.triangularView<Eigen::StrictlyUpper>() =
        stage.hessian.transpose().triangularView<Eigen::StrictlyUpper>();
    const double floor = 1e-12 * stage.hessian.diagonal().maxCoeff() + 1e-18;
    stage.hessian.diagonal() += lambda * stage.hessian.diagonal();
    stage.hessian.diagonal().array() += floor;
    // What the data do not determine changes by no more than its own size at a time.
    const double length = chain.pieces[i].length;
    const double bend = std::max(std::abs(chain.joints[i + 1].curvature), 0.1 / length);
    stage.hessian(kLengthAt, kLengthAt) += lambda * unit / (length * length);
    stage.hessian(kAlphaAt, kAlphaAt) += lambda * unit;
    stage.hessian(kNextCurvature, kNextCurvature) += lambda * unit / (bend * bend);
  }
}

/// Levenberg and Marquardt's iteration with the gaps between pieces as constraints.
class Descent {
 public:
  Descent(FitChain& chain, const std::vector<FitPoint>& points, const ChainFitOptions& options)
      : chain_(chain), points_(points), options_(options) {
    Evaluation evaluation(chain, points, options);
    for (int round = 0; round < 2; ++round) evaluation.move_feet();
    model_ = evaluation.model();
    damping_.value = options.close_gaps ? 1e-9 : 1e-2;
  }

  ChainFitReport run() {
    const numeric::DescentEnd end = numeric::damped_descent(
        damping_, options_.iterations, [this](double damping) { return iterate(damping); });
    ChainFitReport report;
    report.iterations = end.steps;
    report.converged = converged_ || (end.exhausted && damping_.refused);
    report.cost = model_.cost;
    report.max_offset = model_.max_offset;
    report.max_gap = model_.max_gap;
    return report;
  }

 private:
  numeric::StepOutcome iterate(double damping) {
    const int iteration = steps_++;
    const std::vector<Bend> bends = bends_of_joints();
    std::vector<double> rates;
    for (std::size_t k = 0; k < bends.size(); ++k)
      rates.push_back(bends[k].rate(chain_.joints[k].curvature));
    std::vector<Stage> stages = model_.stages;
    take_bends(stages, rates, options_.close_gaps);
    damp(stages, chain_, damping, 100 * options_.scale * options_.scale);
    detail::Step step = solve_stages(stages, boundary_of(chain_));
    if (!step.sound) return {numeric::StepEnd::unsolved};
    for (std::size_t k = 0; k < rates.size(); ++k) step.state[k](3) *= rates[k];
    FitChain next = moved(chain_, step, step_limit(chain_, step), bends);
    Evaluation evaluation(next, points_, options_);
    evaluation.move_feet();
    Model trial = evaluation.model();
    if (better(trial)) return {accept(std::move(next), std::move(trial), iteration)};
    const bool closed = options_.close_gaps && model_.max_gap < 1e-14;
    return {closed ? numeric::StepEnd::settled : numeric::StepEnd::refused};
  }

  std::vector<Bend> bends_of_joints() const {
    std::vector<Bend> bends(chain_.joints.size());
    if (options_.fine && !chain_.closed)
      for (std::size_t k = 0; k < bends.size(); ++k) bends[k] = bend_at(chain_, k);
    return bends;
  }

  bool better(const Model& trial) const {
    if (!std::isfinite(trial.merit)) return false;
    return options_.close_gaps ? trial.max_gap < 0.7 * model_.max_gap : trial.merit < model_.merit;
  }

  numeric::StepEnd accept(FitChain next, Model trial, int iteration) {
    const double gain = (model_.merit - trial.merit) / std::max(model_.merit, 1e-300);
    chain_ = std::move(next);
    model_ = std::move(trial);
    if (options_.close_gaps) return numeric::StepEnd::taken;
    calm_ = gain < options_.gradient_tolerance ? calm_ + 1 : 0;
    converged_ = calm_ >= 2 || model_.merit < 1e-30;
    const bool slow = iteration >= 3 && gain < 0.3;
    const bool hopeless = options_.hopeless > 0 && slow && model_.max_offset > options_.hopeless;
    return converged_ || hopeless ? numeric::StepEnd::settled : numeric::StepEnd::taken;
  }

  FitChain& chain_;
  const std::vector<FitPoint>& points_;
  const ChainFitOptions& options_;
  Model model_;
  numeric::FactorDamping damping_{
      .raise = 5, .lower = 0.3, .least = 1e-12, .most = 1e8, .after_refusal = true};
  int steps_ = 0;
  int calm_ = 0;
  bool converged_ = false;
};

}  // namespace

ChainFitReport fit_chain(FitChain& chain, const std::vector<FitPoint>& points,
                         const ChainFitOptions& options) {
  return Descent(chain, points, options).run();
}

std::vector<double> offsets(const FitChain& chain, const std::vector<FitPoint>& points) {
  FitChain copy = chain;
  const Evaluation evaluation(copy, points, {});
  std::vector<double> result(points.size());
  for (std::size_t j = 0; j < points.size(); ++j) result[j] = evaluation.offset(j);
  return result;
}

std::vector<double> settle_feet(FitChain& chain, const std::vector<FitPoint>& points, int rounds) {
  ChainFitOptions options;
  options.fine = true;
  Evaluation evaluation(chain, points, options);
  std::vector<double> result(points.size());
  for (std::size_t j = 0; j < points.size(); ++j) {
    for (int round = 0; round < rounds; ++round)
      if (evaluation.move_foot(j) < kAtHome) break;
    result[j] = evaluation.offset(j);
  }
  return result;
}

}  // namespace keyline::fairing
