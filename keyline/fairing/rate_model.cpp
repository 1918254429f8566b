#include "keyline/fairing/rate_model.h"

#include <algorithm>
#include <cmath>

#include "keyline/fairing/piece_energy.h"
#include "keyline/numeric/power_mean.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kBand = 0.9;         // of the room: what offsets are kept below
constexpr double kKnee = 1.3;         // beyond it their cost goes on as its tangent
constexpr double kTip = 0.1;          // weight of where an open chain ends beside its last point
constexpr double kTurnWeight = 0.1;   // length to a turn, where gaps are told
constexpr double kTiedWeight = 0.3;   // tolerances that a jump of a held rate counts
constexpr double kLeastRoom = 0.1;    // of the tolerance
constexpr double kDifference = 1e-5;  // for derivatives of closed forms

bool line(const FitPiece& piece) { return piece.kind == PieceKind::line; }

int sense_of(const FitChain& chain, std::size_t p) {
  const double rise = chain.joints[p + 1].curvature - chain.joints[p].curvature;
  return line(chain.pieces[p]) || rise == 0 ? 0 : (rise > 0 ? 1 : -1);
}

/// A power that goes on as its tangent, and its derivative.
struct Excess {
  double value = 0;
  double slope = 0;
};

Excess excess(double offset, double power) {
  const double a = std::abs(offset) / kBand;
  const double at = std::min(a, kKnee);
  const double slope = power * std::pow(at, power - 1);
  return {std::pow(at, power) + slope * (a - at), std::copysign(slope / kBand, offset)};
}

double root_energy(double a, double b, double alpha, double length) {
  return std::abs(piece_energy(a, b, alpha).root) / std::sqrt(length);
}

/// By the logarithms of both end curvatures, that of the length and the slope.
template <class Function>
Eigen::Vector4d by_piece(const Function& of, double a, double b, double alpha, double length) {
  const double up = std::exp(kDifference);
  const auto half = [](double high, double low) { return (high - low) / (2 * kDifference); };
  return {half(of(a * up, b, alpha, length), of(a / up, b, alpha, length)),
          half(of(a, b * up, alpha, length), of(a, b / up, alpha, length)),
          half(of(a, b, alpha, length * up), of(a, b, alpha, length / up)),
          half(of(a, b, alpha + kDifference, length), of(a, b, alpha - kDifference, length))};
}

double at_start(double a, double b, double alpha, double length) {
  return log_rates(a, b, alpha, length).start;
}

double at_end(double a, double b, double alpha, double length) {
  return log_rates(a, b, alpha, length).end;
}

}  // namespace

EndRates log_rates(double a, double b, double alpha, double length) {
  const double p = -alpha;
  const double u = std::log(std::abs(a));
  const double v = std::log(std::abs(b));
  if (a * b > 0) {
    const double l = v - u;
    const double start =
        u + std::log(std::abs(l)) + std::log(numeric::expm1_over(p * l)) - std::log(length);
    return {start, start + (1 - p) * l};
  }
  const double sum = std::pow(std::abs(a), p) + std::pow(std::abs(b), p);
  const double constant = std::log(sum / p) - std::log(length);
  return {constant + (1 - p) * u, constant + (1 - p) * v};
}

std::vector<RateJoint> rate_joints(const FitChain& chain) {
  std::vector<RateJoint> joints;
  const std::size_t n = chain.pieces.size();
  for (std::size_t p = 0; p + (chain.closed ? 0 : 1) < n; ++p) {
    const std::size_t next = (p + 1) % n;
    if (next == p || chain.joints[p + 1].curvature == 0) continue;
    const int sense = sense_of(chain, p);
    if (sense != 0 && sense == sense_of(chain, next))
      joints.push_back({static_cast<int>(p), static_cast<int>(next)});
  }
  return joints;
}

RateUnknowns::RateUnknowns(const FitChain& chain)
    : pieces(static_cast<int>(chain.pieces.size())),
      joints(pieces + (chain.closed ? 0 : 1)),
      closed(chain.closed) {}

RateModel::RateModel(FitChain given, const RateProblem& problem)
    : chain(std::move(given)), unknowns(chain), problem_(&problem) {
  look();
}

void RateModel::look() {
  ChainFitOptions options;
  options.slope_prior = 0;
  Evaluation evaluation(chain, *problem_->points, options);
  for (int round = 0; round < 2; ++round) evaluation.move_feet();
  stages_ = evaluation.model().stages;
  spots_.clear();
  for (std::size_t j = 0; j < problem_->points->size(); ++j) spots_.push_back(evaluation.row(j));
  cost = 0;
  look_at_points();
  look_at_pieces();
  look_at_gaps();
  add_limits();
  sound = std::isfinite(cost) && std::isfinite(gaps);
}

namespace {

/// A point's offset as a share of what it may be on its side.
struct Share {
  double offset = 0;
  double room = 1;
};

Share share_of(const FitPoint& point, double across, double tolerance) {
  const double offset = -point.share * across;
  const double high = std::min(tolerance - point.share * point.high, point.highest);
  const double low = std::min(tolerance + point.share * point.low, -point.lowest);
  const double room = std::max(offset > 0 ? high : low, kLeastRoom * tolerance);
  return {offset / room, room};
}

}  // namespace

double RateModel::price_of(std::size_t j) const {
  const double own = problem_->price.empty() ? 1 : problem_->price[j];
  return own * problem_->weights.band / static_cast<double>(spots_.size());
}

void RateModel::look_at_points() {
  const RateWeights& w = problem_->weights;
  const std::size_t n = spots_.size();
  max_offset = 0;
  offset.resize(n);
  for (std::size_t j = 0; j < n; ++j) {
    offset[j] = share_of((*problem_->points)[j], spots_[j].across, w.tolerance).offset;
    max_offset = std::max(max_offset, std::abs(offset[j]));
    const double over = excess(offset[j], w.power).value;
    cost += price_of(j) * over * over;
  }
  if (chain.closed) return;
  for (const std::size_t j : {std::size_t{0}, n - 1}) {
    const double along = spots_[j].along / w.tolerance;
    cost += kTip * along * along;
  }
}

void RateModel::look_at_pieces() {
  const RateWeights& w = problem_->weights;
  energy_.assign(chain.pieces.size(), 0);
  variation = 0;
  for (std::size_t p = 0; p < energy_.size(); ++p) {
    const FitPiece& piece = chain.pieces[p];
    if (line(piece)) continue;
    energy_[p] = root_energy(chain.joints[p].curvature, chain.joints[p + 1].curvature, piece.alpha,
                             piece.length) /
                 std::sqrt(w.energy);
    variation += energy_[p] * energy_[p];
  }
  cost += variation;
  jump.clear();
  const auto rates = [this](int p) {
    const FitPiece& piece = chain.pieces[p];
    return log_rates(chain.joints[p].curvature, chain.joints[p + 1].curvature, piece.alpha,
                     piece.length);
  };
  for (const RateJoint& joint : problem_->joints) {
    jump.push_back(rates(joint.before).end - rates(joint.after).start);
    if (!joint.tied) cost += w.jump * (std::hypot(jump.back(), w.even) - w.even);
  }
}

void RateModel::look_at_gaps() {
  const double unit = problem_->weights.tolerance;
  const auto size = [&](const Eigen::Vector3d& gap) {
    return (std::abs(gap(0)) + std::abs(gap(1)) + kTurnWeight * std::abs(gap(2))) / unit;
  };
  gaps = 0;
  for (const Stage& stage : stages_) gaps += size(stage.gap.head<3>());
  const FitJoint& last = chain.joints.back();
  const FitJoint& to = chain.closed ? chain.joints.front() : problem_->end;
  seam_ << last.position.x - to.position.x, last.position.y - to.position.y,
      last.direction - to.direction - (chain.closed ? chain.turning : 0);
  if (!chain.closed && chain.hold_end < Hold::position) seam_.setZero();
  if (!chain.closed && chain.hold_end < Hold::direction) seam_(2) = 0;
  gaps += size(seam_);
  for (std::size_t k = 0; k < jump.size(); ++k)
    if (problem_->joints[k].tied) gaps += kTiedWeight * std::abs(jump[k]);
}

void RateModel::add_limits() {
  limits.clear();
  for (int p = 0; p < unknowns.pieces; ++p) {
    const FitPiece& piece = chain.pieces[p];
    if (line(piece)) continue;
    const core::Interval& range = problem_->slopes[p];
    const double width = range.high - range.low;
    limits.push_back({unknowns.slope(p), -1, 1 / width, (piece.alpha - range.low) / width});
    limits.push_back({unknowns.slope(p), -1, -1 / width, (range.high - piece.alpha) / width});
    const double a = chain.joints[p].curvature;
    const double b = chain.joints[p + 1].curvature;
    if (!(a * b > 0)) continue;
    // Curvature keeps its sense: the ratio of its ends does.
    const double sign = problem_->growth[p];
    limits.push_back({unknowns.joint(p + 1), unknowns.joint(p), sign, sign * std::log(b / a)});
  }
}

/// Poses of all joints by the unknowns, piece after piece.
void RateModel::condense() {
  const int n = unknowns.count();
  by_.assign(1, Eigen::Matrix3Xd::Zero(3, n));
  by_[0].leftCols<3>().setIdentity();
  pose_shift_.assign(1, Eigen::Vector3d::Zero());
  for (int p = 0; p < unknowns.pieces; ++p) {
    const Eigen::Matrix<double, 3, 7> step = stages_[p].step.topRows<3>();
    Eigen::Matrix3Xd next = step.leftCols<3>() * by_[p];
    const FitPiece& piece = chain.pieces[p];
    next.col(unknowns.joint(p)) += chain.joints[p].curvature * step.col(kCurvature);
    next.col(unknowns.joint(p + 1)) += chain.joints[p + 1].curvature * step.col(kNextCurvature);
    next.col(unknowns.length(p)) += piece.length * step.col(kLengthAt);
    if (!line(piece)) next.col(unknowns.slope(p)) += step.col(kAlphaAt);
    pose_shift_.push_back(step.leftCols<3>() * pose_shift_[p] + stages_[p].gap.head<3>());
    by_.push_back(std::move(next));
  }
}

void RateModel::scatter(Eigen::RowVectorXd& row, int p, const Vector7& by) const {
  row = by.head<3>().transpose() * by_[p];
  row(unknowns.joint(p)) += chain.joints[p].curvature * by(kCurvature);
  row(unknowns.joint(p + 1)) += chain.joints[p + 1].curvature * by(kNextCurvature);
  row(unknowns.length(p)) += chain.pieces[p].length * by(kLengthAt);
  if (!line(chain.pieces[p])) row(unknowns.slope(p)) += by(kAlphaAt);
}

void RateModel::add_point(std::size_t j) {
  const RateWeights& w = problem_->weights;
  const Evaluation::PointRow& spot = spots_[j];
  const FitPoint& point = (*problem_->points)[j];
  const Share share = share_of(point, spot.across, w.tolerance);
  const Excess over = excess(share.offset, w.power);
  const double weight = std::sqrt(price_of(j));
  const double by = -weight * over.slope * point.share / share.room;
  const auto index = static_cast<Eigen::Index>(j);
  Eigen::RowVectorXd row;
  scatter(row, spot.piece, spot.by_across);
  rows.row(index) = by * row;
  value(index) = weight * over.value;
  shift(index) = by * spot.by_across.head<3>().dot(pose_shift_[spot.piece]);
}

void RateModel::add_piece(int p) {
  const FitPiece& piece = chain.pieces[p];
  if (line(piece)) return;
  const int row = static_cast<int>(spots_.size()) + p;
  const Eigen::Vector4d by = by_piece(root_energy, chain.joints[p].curvature,
                                      chain.joints[p + 1].curvature, piece.alpha, piece.length) /
                             std::sqrt(problem_->weights.energy);
  value(row) = energy_[p];
  rows(row, unknowns.joint(p)) += by(0);
  rows(row, unknowns.joint(p + 1)) += by(1);
  rows(row, unknowns.length(p)) += by(2);
  rows(row, unknowns.slope(p)) += by(3);
}

void RateModel::add_jump(std::size_t k, Eigen::Ref<Eigen::MatrixXd> out, int row, double by) const {
  const RateJoint& joint = problem_->joints[k];
  const auto add = [&](int p, const auto& rate, double sign) {
    const FitPiece& piece = chain.pieces[p];
    const Eigen::Vector4d d =
        sign * by_piece(rate, chain.joints[p].curvature, chain.joints[p + 1].curvature, piece.alpha,
                        piece.length);
    out(row, unknowns.joint(p)) += d(0);
    out(row, unknowns.joint(p + 1)) += d(1);
    out(row, unknowns.length(p)) += d(2);
    out(row, unknowns.slope(p)) += d(3);
  };
  add(joint.before, at_end, by);
  add(joint.after, at_start, -by);
}

void RateModel::linearise() {
  condense();
  const RateWeights& w = problem_->weights;
  const int points = static_cast<int>(spots_.size());
  const int jumps = points + unknowns.pieces;
  const int tips = jumps + static_cast<int>(jump.size());
  const int count = tips + (chain.closed ? 0 : 2);
  rows.setZero(count, unknowns.count());
  value.setZero(count);
  shift.setZero(count);
  for (std::size_t j = 0; j < spots_.size(); ++j) add_point(j);
  for (int p = 0; p < unknowns.pieces; ++p) add_piece(p);
  for (std::size_t k = 0; k < jump.size(); ++k) {
    if (problem_->joints[k].tied) continue;
    const double by = std::sqrt(0.5 * w.jump / std::hypot(jump[k], w.even));
    add_jump(k, rows, jumps + static_cast<int>(k), by);
    value(jumps + static_cast<int>(k)) = by * jump[k];
  }
  for (int t = 0; t < count - tips; ++t) {
    const Evaluation::PointRow& spot = t == 0 ? spots_.front() : spots_.back();
    const double by = std::sqrt(kTip) / w.tolerance;
    Eigen::RowVectorXd row;
    scatter(row, spot.piece, spot.by_along);
    rows.row(tips + t) = by * row;
    value(tips + t) = by * spot.along;
    shift(tips + t) = by * spot.by_along.head<3>().dot(pose_shift_[spot.piece]);
  }
  set_equations();
}

/// What has to be met: the seam or a held end, and the tied rates.
void RateModel::set_equations() {
  int seams = 0;
  if (chain.closed || chain.hold_end >= Hold::direction)
    seams = 3;
  else if (chain.hold_end >= Hold::position)
    seams = 2;
  const auto tied = static_cast<int>(
      std::ranges::count_if(problem_->joints, [](const RateJoint& joint) { return joint.tied; }));
  equation.setZero(seams + tied, unknowns.count());
  miss.setZero(seams + tied);
  equation.topRows(seams) = by_.back().topRows(seams);
  if (chain.closed) equation.topLeftCorner(seams, 3) -= Eigen::Matrix3d::Identity();
  miss.head(seams) = seam_.head(seams) + pose_shift_.back().head(seams);
  int row = seams;
  for (std::size_t k = 0; k < jump.size(); ++k) {
    if (!problem_->joints[k].tied) continue;
    add_jump(k, equation, row, 1);
    miss(row++) = jump[k];
  }
}

void RateModel::take_gaps_of(const RateModel& other) {
  for (int p = 0; p < unknowns.pieces; ++p) stages_[p].gap = other.stages_[p].gap;
  seam_ = other.seam_;
  jump = other.jump;
  linearise();
  value.setZero();
}

FitChain RateModel::moved(const Eigen::VectorXd& step, double share) const {
  FitChain next = chain;
  for (std::size_t j = 0; j < next.joints.size(); ++j) {
    FitJoint& joint = next.joints[j];
    const Eigen::Vector3d by = share * (by_[j] * step.head(unknowns.count()) + pose_shift_[j]);
    joint.position.x += by(0);
    joint.position.y += by(1);
    joint.direction += by(2);
    joint.curvature *= std::exp(share * step(unknowns.joint(static_cast<int>(j))));
  }
  for (int p = 0; p < unknowns.pieces; ++p) {
    next.pieces[p].length *= std::exp(share * step(unknowns.length(p)));
    if (!line(next.pieces[p])) next.pieces[p].alpha += share * step(unknowns.slope(p));
  }
  return next;
}

}  // namespace keyline::fairing::detail
