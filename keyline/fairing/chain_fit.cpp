#include "keyline/fairing/chain_fit.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/fairing/riccati.h"
#include "keyline/lac/sensitivity.h"

namespace keyline::fairing {
namespace {

using detail::Boundary;
using detail::Stage;
using lac::PieceTable;

// Positions in a stage's vector of seven.
enum { kX, kY, kDirection, kCurvature, kLengthAt, kAlphaAt, kNextCurvature };

constexpr double kInflectionSlope = -0.25;  // upper limit where curvature reaches zero
constexpr double kGapWeight = 0.5;
constexpr double kEndWeight = 1e9;

struct Model {
  std::vector<Stage> stages;
  double cost = 0;
  double merit = 0;
  double max_offset = 0;
  double max_gap = 0;
};

struct Frame {
  double c;
  double s;
};

/// Everything about one evaluation of a chain: tables of the pieces, feet of the points.
class Evaluation {
 public:
  Evaluation(FitChain& chain, const std::vector<FitPoint>& points, const ChainFitOptions& options)
      : chain_(chain), points_(points), options_(options) {
    tables_.resize(chain.pieces.size());
    for (std::size_t i = 0; i < tables_.size(); ++i) {
      const FitPiece& piece = chain.pieces[i];
      tables_[i].build(chain.joints[i].curvature, chain.joints[i + 1].curvature, piece.length,
                       piece.alpha, options.fine);
    }
  }

  Model model() {
    Model m;
    m.stages.resize(tables_.size());
    for (std::size_t i = 0; i < tables_.size(); ++i) add_dynamics(m, static_cast<int>(i));
    for (std::size_t j = 0; j < points_.size(); ++j) add_point(m, j);
    for (std::size_t i = 0; i < tables_.size(); ++i) add_prior(m, static_cast<int>(i));
    const double weight = kGapWeight * static_cast<double>(points_.size());
    m.merit = m.cost + weight * gap_square_;
    return m;
  }

  /// One Newton step of every foot along the chain; offsets as they are found there.
  void move_feet() {
    for (std::size_t j = 0; j < points_.size(); ++j) move_foot(j);
  }

  double offset(std::size_t j) const {
    const Foot& foot = chain_.feet[j];
    const auto value = tables_[foot.piece].at(foot.fraction);
    const core::Point2 at = place(foot.piece, frame(foot.piece), value.x, value.y);
    const double angle = chain_.joints[foot.piece].direction + value.angle;
    const core::Vector2 tangent{std::cos(angle), std::sin(angle)};
    const core::Vector2 miss = points_[j].position - at;
    const double side = core::cross(tangent, miss);
    if (!beyond_end(foot)) return side;
    return std::copysign(core::norm(miss), side);
  }

 private:
  bool beyond_end(const Foot& foot) const {
    const bool first = foot.fraction <= 0 && foot.piece == 0;
    const bool last = foot.fraction >= 1 && foot.piece + 1 == static_cast<int>(tables_.size());
    return !chain_.closed && (first || last);
  }

  Frame frame(int piece) const {
    const double d = chain_.joints[piece].direction;
    return {std::cos(d), std::sin(d)};
  }
  core::Point2 place(int piece, Frame f, double x, double y) const {
    const core::Point2 o = chain_.joints[piece].position;
    return {o.x + f.c * x - f.s * y, o.y + f.s * x + f.c * y};
  }

  void add_dynamics(Model& m, int i) {
    Stage& stage = m.stages[i];
    const FitPiece& piece = chain_.pieces[i];
    const FitJoint& from = chain_.joints[i];
    const FitJoint& to = chain_.joints[i + 1];
    const auto& end = tables_[i].end();
    const Frame f = frame(i);
    const core::Point2 at = place(i, f, end.x, end.y);
    auto& j = stage.step;
    j.setZero();
    j(0, kX) = 1;
    j(1, kY) = 1;
    j(0, kDirection) = -(at.y - from.position.y);
    j(1, kDirection) = at.x - from.position.x;
    j(2, kDirection) = 1;
    const int columns[4] = {kCurvature, kNextCurvature, kLengthAt, kAlphaAt};
    for (int q = 0; q < 4; ++q) {
      j(0, columns[q]) = f.c * end.dx[q] - f.s * end.dy[q];
      j(1, columns[q]) = f.s * end.dx[q] + f.c * end.dy[q];
      j(2, columns[q]) = end.dangle[q];
    }
    stage.gap << at.x - to.position.x, at.y - to.position.y,
        from.direction + end.angle - to.direction, 0;
    if (piece.kind == PieceKind::arc) {
      // An arc's curvature is one: the next joint's follows this one's.
      for (int r = 0; r < 3; ++r) j(r, kCurvature) += j(r, kNextCurvature);
      j(3, kCurvature) = 1;
      for (int r = 0; r < 4; ++r) j(r, kNextCurvature) = 0;
    } else {
      j(3, kNextCurvature) = 1;
    }
    stage.fixed[1] = slope_held(piece) || piece.kind != PieceKind::curve;
    const bool before_line = i + 1 < static_cast<int>(chain_.pieces.size()) &&
                             chain_.pieces[i + 1].kind == PieceKind::line;
    stage.fixed[2] = piece.kind != PieceKind::curve || before_line ||
                     (i + 1 == static_cast<int>(chain_.pieces.size()) && chain_.closed &&
                      chain_.pieces[0].kind == PieceKind::line);
    const double turn = stage.gap(2) * piece.length;
    const double square = stage.gap.head<2>().squaredNorm() + turn * turn;
    gap_square_ += square;
    m.max_gap = std::max(m.max_gap, std::sqrt(square));
  }

  /// Residual and its derivative by the stage's seven variables.
  void add_residual(Model& m, int i, double r, const detail::Vector7& d, double weight) {
    detail::Vector7 g = d;
    if (chain_.pieces[i].kind == PieceKind::arc) {
      g(kCurvature) += g(kNextCurvature);
      g(kNextCurvature) = 0;
    }
    m.stages[i].hessian.selfadjointView<Eigen::Lower>().rankUpdate(g, weight);
    m.stages[i].gradient += weight * r * g;
    m.cost += weight * r * r;
  }

  void add_point(Model& m, std::size_t j) {
    const Foot& foot = chain_.feet[j];
    const int i = foot.piece;
    const auto value = tables_[i].at(foot.fraction);
    const Frame f = frame(i);
    const core::Point2 at = place(i, f, value.x, value.y);
    const core::Vector2 miss = at - points_[j].position;
    const double local = value.angle;
    const double direction = chain_.joints[i].direction + local;
    const core::Vector2 tangent{std::cos(direction), std::sin(direction)};
    const core::Vector2 arm = at - chain_.joints[i].position;
    const auto derivative = [&](core::Vector2 n) {
      const double lx = f.c * n.x + f.s * n.y;
      const double ly = -f.s * n.x + f.c * n.y;
      detail::Vector7 d;
      d(kX) = n.x;
      d(kY) = n.y;
      d(kDirection) = -arm.y * n.x + arm.x * n.y;
      d(kCurvature) = lx * value.dx[0] + ly * value.dy[0];
      d(kNextCurvature) = lx * value.dx[1] + ly * value.dy[1];
      d(kLengthAt) = lx * value.dx[2] + ly * value.dy[2];
      d(kAlphaAt) = lx * value.dx[3] + ly * value.dy[3];
      return d;
    };
    const core::Vector2 normal{-tangent.y, tangent.x};
    const double weight = points_[j].weight;
    const double r = core::dot(miss, normal);
    add_residual(m, i, r, derivative(normal), weight);
    const bool first = !chain_.closed && j == 0;
    const bool last = !chain_.closed && j + 1 == points_.size();
    double along = core::dot(miss, tangent);
    if (first || last) add_residual(m, i, along, derivative(tangent), weight);
    if (!beyond_end(foot)) along = 0;
    const double spread = std::max(std::abs(-r + points_[j].high), std::abs(-r + points_[j].low));
    m.max_offset = std::max(m.max_offset, std::hypot(spread, along));
  }

  void add_prior(Model& m, int i) {
    const FitPiece& piece = chain_.pieces[i];
    Stage& stage = m.stages[i];
    if (options_.length_prior > 0) {
      const double w = options_.length_prior * options_.scale / options_.usual_length;
      const double r = w * (piece.length - options_.usual_length);
      stage.hessian(kLengthAt, kLengthAt) += w * w;
      stage.gradient(kLengthAt) += w * r;
      m.cost += r * r;
    }
    if (piece.kind != PieceKind::curve || slope_held(piece) || options_.slope_prior == 0) return;
    const double w = options_.slope_prior * options_.scale;
    const double r = w * (piece.alpha + 1);
    stage.hessian(kAlphaAt, kAlphaAt) += w * w;
    stage.gradient(kAlphaAt) += w * r;
    m.cost += r * r;
  }

  void move_foot(std::size_t j) {
    Foot& foot = chain_.feet[j];
    const int count = static_cast<int>(tables_.size());
    for (int hop = 0; hop < 4; ++hop) {
      const PieceTable& table = tables_[foot.piece];
      const auto value = table.at(foot.fraction);
      const Frame f = frame(foot.piece);
      const core::Point2 at = place(foot.piece, f, value.x, value.y);
      const double direction = chain_.joints[foot.piece].direction + value.angle;
      const core::Vector2 tangent{std::cos(direction), std::sin(direction)};
      const core::Vector2 miss = points_[j].position - at;
      const double side = core::cross(tangent, miss);
      const double bend = 1 - table.curvature(foot.fraction) * side;
      const double step = core::dot(miss, tangent) / std::max(0.25, bend) / table.length();
      const double to = foot.fraction + std::clamp(step, -0.5, 0.5);
      const bool back = to < 0 && (chain_.closed || foot.piece > 0);
      const bool on = to > 1 && (chain_.closed || foot.piece + 1 < count);
      if (!back && !on) {
        foot.fraction = std::clamp(to, 0.0, 1.0);
        return;
      }
      foot.piece = (foot.piece + (on ? 1 : count - 1)) % count;
      foot.fraction = on ? 0 : 1;
    }
  }

  FitChain& chain_;
  const std::vector<FitPoint>& points_;
  const ChainFitOptions& options_;
  std::vector<PieceTable> tables_;
  double gap_square_ = 0;
};

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

FitChain moved(const FitChain& chain, const detail::Step& step, double share) {
  FitChain next = chain;
  for (std::size_t k = 0; k < next.joints.size(); ++k) {
    FitJoint& joint = next.joints[k];
    joint.position.x += share * step.state[k](0);
    joint.position.y += share * step.state[k](1);
    joint.direction += share * step.state[k](2);
    joint.curvature += share * step.state[k](3);
  }
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

}  // namespace

ChainFitReport fit_chain(FitChain& chain, const std::vector<FitPoint>& points,
                         const ChainFitOptions& options) {
  ChainFitReport report;
  {
    Evaluation start(chain, points, options);
    start.move_feet();
    start.move_feet();
  }
  Model model = Evaluation(chain, points, options).model();
  double lambda = options.close_gaps ? 1e-9 : 1e-2;
  int calm = 0;
  bool refused = false;
  const double unit = 100 * options.scale * options.scale;
  for (report.iterations = 0; report.iterations < options.iterations; ++report.iterations) {
    std::vector<Stage> stages = model.stages;
    damp(stages, chain, lambda, unit);
    const detail::Step step = solve_stages(stages, boundary_of(chain));
    if (!step.sound) {
      lambda = std::max(lambda * 10, 1e-8);
      if (lambda > 1e8) break;
      continue;
    }
    FitChain next = moved(chain, step, step_limit(chain, step));
    Evaluation evaluation(next, points, options);
    evaluation.move_feet();
    Model trial = evaluation.model();
    const bool finite = std::isfinite(trial.merit);
    const bool better = finite && (options.close_gaps ? trial.max_gap < 0.7 * model.max_gap
                                                      : trial.merit < model.merit);
    if (!better) {
      if (options.close_gaps && model.max_gap < 1e-14) break;
      lambda *= 5;
      refused = true;
      if (lambda > 1e8) {
        report.converged = true;
        break;
      }
      continue;
    }
    const double gain = (model.merit - trial.merit) / std::max(model.merit, 1e-300);
    chain = std::move(next);
    model = std::move(trial);
    if (!refused) lambda = std::max(lambda * 0.3, 1e-12);
    refused = false;
    if (options.close_gaps) continue;
    calm = gain < options.gradient_tolerance ? calm + 1 : 0;
    if (calm >= 2 || model.merit < 1e-30) {
      report.converged = true;
      break;
    }
    if (options.hopeless > 0 && report.iterations >= 3 && gain < 0.3 &&
        model.max_offset > options.hopeless)
      break;
  }
  report.cost = model.cost;
  report.max_offset = model.max_offset;
  report.max_gap = model.max_gap;
  return report;
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
  for (int round = 0; round < rounds; ++round) evaluation.move_feet();
  std::vector<double> result(points.size());
  for (std::size_t j = 0; j < points.size(); ++j) result[j] = evaluation.offset(j);
  return result;
}

}  // namespace keyline::fairing
