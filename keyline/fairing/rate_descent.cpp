#include "keyline/fairing/rate_descent.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace keyline::fairing::detail {
namespace {

constexpr double kBarrier = 1e-3;     // beside a variation of one
constexpr double kBoundary = 0.9;     // of a limit's room that a step may take
constexpr double kCentred = 1e2;      // room times multiplier stays this near the barrier
constexpr double kStill = 1e-5;       // what keeps unknowns that nothing tells
constexpr double kMostDamping = 1e5;  // no step is looked for beyond it
constexpr double kLongest = 4;        // change of a logarithm or slope in one step
constexpr int kHalvings = 3;          // of a step that is not worth it, to an eighth
constexpr double kGain = 2e-3;        // of the cost: steps that gain less are the last
constexpr double kClosed = 1e-2;      // tolerances
constexpr double kDecrease = 0.7;     // of the gaps' price that a step has to be worth
constexpr double kLeastPrice = 0.05;  // of a tolerance's gap
constexpr int kClosings = 12;         // Newton steps: it stops where gaps get no smaller

class Descent {
 public:
  Descent(FitChain chain, const RateProblem& problem)
      : problem_(problem), model_(std::move(chain), problem) {
    centre();
  }

  RateSolution run(int iterations, const core::Progress& progress) {
    int slow = 0;
    for (int i = 0; i < iterations && slow < 2 && !progress.stop_requested(); ++i) {
      const double before = model_.cost + price_ * model_.gaps;
      if (!iterate()) break;
      const double gain = before - model_.cost - price_ * model_.gaps;
      const bool idle = gain < kGain * std::max(model_.cost, 1e-6) && model_.gaps < kClosed;
      slow = idle ? slow + 1 : 0;
    }
    return {model_.chain, model_.max_offset, model_.gaps,  model_.variation,
            model_.jump,  strain_,           model_.offset};
  }

 private:
  void centre() {
    multiplier_.clear();
    for (const RateLimit& limit : model_.limits) multiplier_.push_back(kBarrier / limit.room);
  }

  static double barrier(const RateModel& model) {
    double logs = 0;
    for (const RateLimit& limit : model.limits) {
      if (!(limit.room > 0)) return HUGE_VAL;
      logs -= kBarrier * std::log(limit.room);
    }
    return logs;
  }

  double merit(const RateModel& model) const {
    if (!model.sound) return HUGE_VAL;
    return model.cost + barrier(model) + price_ * model.gaps;
  }

  /// The quadratic model's matrix with the equations beside it.
  void assemble() {
    const int n = model_.unknowns.count();
    const auto m = static_cast<int>(model_.miss.size());
    matrix_.setZero(n + m, n + m);
    matrix_.topLeftCorner(n, n).selfadjointView<Eigen::Lower>().rankUpdate(model_.rows.transpose(),
                                                                           2);
    for (std::size_t i = 0; i < model_.limits.size(); ++i) {
      const RateLimit& l = model_.limits[i];
      const double w = multiplier_[i] / l.room;
      matrix_(l.more, l.more) += w;
      if (l.less < 0) continue;
      matrix_(l.less, l.less) += w;
      matrix_(std::max(l.more, l.less), std::min(l.more, l.less)) -= w;
    }
    matrix_.topLeftCorner(n, n).triangularView<Eigen::StrictlyUpper>() =
        matrix_.topLeftCorner(n, n).transpose();
    matrix_.bottomLeftCorner(m, n) = model_.equation;
    matrix_.topRightCorner(n, m) = model_.equation.transpose();
    matrix_.bottomRightCorner(m, m).diagonal().setConstant(-1e-14);
  }

  void factorise(double damping) {
    const int n = model_.unknowns.count();
    Eigen::MatrixXd damped = matrix_;
    damped.diagonal().segment(3, n - 3).array() += damping + kStill;
    const FitChain& chain = model_.chain;
    const int held = static_cast<int>(chain.hold_start);
    for (int k = 0; k < 3; ++k)
      if (!chain.closed && held > 0 && k <= held) hold(damped, k);
    if (!chain.closed && chain.hold_start >= Hold::curvature) hold(damped, 3);
    if (!chain.closed && chain.hold_end >= Hold::curvature)
      hold(damped, model_.unknowns.joint(model_.unknowns.pieces));
    for (int p = 0; p < model_.unknowns.pieces; ++p)
      if (chain.pieces[p].kind == PieceKind::line) hold(damped, model_.unknowns.slope(p));
    for (int j = 0; j < model_.unknowns.joints; ++j)
      if (chain.joints[j].curvature == 0) hold(damped, model_.unknowns.joint(j));
    factor_.compute(damped);
  }

  static void hold(Eigen::MatrixXd& matrix, int unknown) { matrix(unknown, unknown) += 1e20; }

  Eigen::VectorXd solve(const RateModel& about, bool barrier) {
    const int n = about.unknowns.count();
    Eigen::VectorXd right(n + about.miss.size());
    right.head(n) = -2 * about.rows.transpose() * (about.value + about.shift);
    right.tail(about.miss.size()) = -about.miss;
    if (barrier)
      for (const RateLimit& l : about.limits) {
        right(l.more) += l.sign * kBarrier / l.room;
        if (l.less >= 0) right(l.less) -= l.sign * kBarrier / l.room;
      }
    return factor_.solve(right);
  }

  double longest(const Eigen::VectorXd& step) const {
    double share = 1;
    for (const RateLimit& limit : model_.limits) {
      const double change = limit.change(step);
      if (change < 0) share = std::min(share, -kBoundary * limit.room / change);
    }
    const int n = model_.unknowns.count();
    return std::min(share, kLongest / std::max(1e-9, step.segment(3, n - 3).cwiseAbs().maxCoeff()));
  }

  /// Raises the gaps' price until the step is worth taking for the merit.
  void set_price(const Eigen::VectorXd& step) {
    const int n = model_.unknowns.count();
    const Eigen::VectorXd after = model_.value + model_.shift + model_.rows * step.head(n);
    double rise = after.squaredNorm() - model_.value.squaredNorm();
    for (const RateLimit& limit : model_.limits) rise -= kBarrier * limit.change(step) / limit.room;
    price_ = std::max(0.7 * price_, kLeastPrice);
    if (model_.gaps > 0) price_ = std::max(price_, rise / (kDecrease * model_.gaps));
  }

  bool iterate() {
    model_.linearise();
    assemble();
    for (double damping = damping_; damping <= kMostDamping;
         damping = std::max(10 * damping, 1e-4)) {
      factorise(damping);
      const Eigen::VectorXd step = solve(model_, true);
      if (!step.allFinite()) continue;
      set_price(step);
      if (!search(step)) continue;
      damping_ = damping == damping_ ? (damping > 1e-6 ? 0.1 * damping : 0) : damping;
      return true;
    }
    return false;
  }

  /// Along the step; where the whole of it opens gaps, with what closes them.
  bool search(const Eigen::VectorXd& step) {
    const double before = merit(model_);
    double share = longest(step);
    RateModel trial(model_.moved(step, share), problem_);
    if (accept(trial, before, step)) return true;
    if (trial.sound) {
      RateModel about = model_;
      about.take_gaps_of(trial);
      const Eigen::VectorXd more = solve(about, false);
      RateModel second(moved_twice(trial.chain, about, more), problem_);
      if (more.allFinite() && accept(second, before, step)) return true;
    }
    for (int i = 0; i < kHalvings; ++i) {
      share *= 0.5;
      RateModel shorter(model_.moved(step, share), problem_);
      if (accept(shorter, before, step)) return true;
    }
    return false;
  }

  /// A chain already moved once, moved by another step of the model.
  static FitChain moved_twice(const FitChain& first, RateModel& about,
                              const Eigen::VectorXd& step) {
    about.chain = first;
    return about.moved(step, 1);
  }

  bool accept(RateModel& trial, double before, const Eigen::VectorXd& step) {
    if (!(merit(trial) < before)) return false;
    raise_multipliers(step);
    strain_ = strains(step);
    model_ = std::move(trial);
    for (std::size_t i = 0; i < multiplier_.size(); ++i) {
      const double centred = kBarrier / model_.limits[i].room;
      multiplier_[i] = std::clamp(multiplier_[i], centred / kCentred, centred * kCentred);
    }
    return true;
  }

  void raise_multipliers(const Eigen::VectorXd& step) {
    std::vector<double> change(multiplier_.size());
    double share = 1;
    for (std::size_t i = 0; i < change.size(); ++i) {
      const RateLimit& l = model_.limits[i];
      change[i] = (kBarrier - multiplier_[i] * l.change(step)) / l.room - multiplier_[i];
      if (change[i] < 0) share = std::min(share, -0.95 * multiplier_[i] / change[i]);
    }
    for (std::size_t i = 0; i < change.size(); ++i) multiplier_[i] += share * change[i];
  }

  std::vector<double> strains(const Eigen::VectorXd& step) const {
    std::vector<double> strain(problem_.joints.size());
    auto row = step.size();
    for (std::size_t k = strain.size(); k-- > 0;)
      if (problem_.joints[k].tied) strain[k] = std::abs(step(--row));
    return strain;
  }

  const RateProblem& problem_;
  RateModel model_;
  std::vector<double> multiplier_;
  std::vector<double> strain_;
  Eigen::MatrixXd matrix_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
  double price_ = 0;
  double damping_ = 0;
};

}  // namespace

RateSolution solve_rates(FitChain chain, const RateProblem& problem, int iterations,
                         const core::Progress& progress) {
  return Descent(std::move(chain), problem).run(iterations, progress);
}

FitChain close_rates(FitChain chain, const RateProblem& problem) {
  RateModel model(std::move(chain), problem);
  for (int i = 0; i < kClosings; ++i) {
    model.linearise();
    const int n = model.unknowns.count();
    Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
    if (model.miss.size() > 0) {
      Eigen::MatrixXd by = model.equation;
      if (!model.chain.closed && model.chain.hold_start != Hold::free) by.leftCols(3).setZero();
      step = by.completeOrthogonalDecomposition().solve(-model.miss);
    }
    RateModel next(model.moved(step, 1), problem);
    if (!(next.gaps < model.gaps)) break;
    model = std::move(next);
  }
  return model.chain;
}

}  // namespace keyline::fairing::detail
