#include "keyline/fairing/evaluation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace keyline::fairing::detail {
namespace {

constexpr double kGapWeight = 0.5;  // of a squared gap, beside each point's squared offset

}  // namespace

Evaluation::Evaluation(FitChain& chain, const std::vector<FitPoint>& points,
                       const ChainFitOptions& options)
    : chain_(chain), points_(points), options_(options) {
  tables_.resize(chain.pieces.size());
  for (std::size_t i = 0; i < tables_.size(); ++i) {
    const FitPiece& piece = chain.pieces[i];
    tables_[i].build(chain.joints[i].curvature, chain.joints[i + 1].curvature, piece.length,
                     piece.alpha, options.fine);
    const double d = chain.joints[i].direction;
    frames_.push_back({std::cos(d), std::sin(d)});
  }
}

Model Evaluation::model() {
  Model m;
  m.stages.resize(tables_.size());
  for (std::size_t i = 0; i < tables_.size(); ++i) add_dynamics(m, static_cast<int>(i));
  if (chain_.closed) add_seam(m);
  for (std::size_t j = 0; j < points_.size(); ++j) add_point(m, j);
  if (options_.close_gaps)
    keep_still(m);
  else
    for (std::size_t i = 0; i < tables_.size(); ++i) add_prior(m, static_cast<int>(i));
  double weight = 0;
  for (const FitPoint& p : points_) weight += kGapWeight * std::max(1.0, p.weight);
  m.merit = m.cost + weight * gap_square_;
  return m;
}

void Evaluation::move_feet() {
  for (std::size_t j = 0; j < points_.size(); ++j) move_foot(j);
}

double Evaluation::offset(std::size_t j) const {
  const Foot& foot = chain_.feet[j];
  const Stand s = stand(foot);
  const core::Vector2 miss = points_[j].position - s.at;
  const double side = core::cross(s.tangent, miss);
  if (!beyond_end(foot)) return points_[j].share * side;
  return points_[j].share * std::copysign(core::norm(miss), side);
}

Evaluation::PointRow Evaluation::row(std::size_t j) const {
  const Foot& foot = chain_.feet[j];
  const Stand s = stand(foot);
  const core::Vector2 miss = s.at - points_[j].position;
  const core::Vector2 normal{-s.tangent.y, s.tangent.x};
  return {foot.piece, core::dot(miss, normal), core::dot(miss, s.tangent),
          derivative(foot, s, normal), derivative(foot, s, s.tangent)};
}

bool Evaluation::beyond_end(const Foot& foot) const {
  const bool first = foot.fraction <= 0 && foot.piece == 0;
  const bool last = foot.fraction >= 1 && foot.piece + 1 == static_cast<int>(tables_.size());
  return !chain_.closed && (first || last);
}

bool Evaluation::pinned(std::size_t j) const {
  return (chain_.first_at_start && j == 0) || (chain_.last_at_end && j + 1 == points_.size());
}

core::Point2 Evaluation::place(int piece, Frame f, double x, double y) const {
  const core::Point2 o = chain_.joints[piece].position;
  return {o.x + f.c * x - f.s * y, o.y + f.s * x + f.c * y};
}

Evaluation::Stand Evaluation::stand(const Foot& foot) const {
  Stand s{frames_[foot.piece], tables_[foot.piece].at(foot.fraction), {}, {}};
  s.at = place(foot.piece, s.frame, s.value.x, s.value.y);
  const double direction = chain_.joints[foot.piece].direction + s.value.angle;
  s.tangent = {std::cos(direction), std::sin(direction)};
  return s;
}

/// Of the foot's place, taken along a direction, by the seven variables of its stage.
Vector7 Evaluation::derivative(const Foot& foot, const Stand& s, core::Vector2 n) const {
  const core::Vector2 arm = s.at - chain_.joints[foot.piece].position;
  const double lx = s.frame.c * n.x + s.frame.s * n.y;
  const double ly = -s.frame.s * n.x + s.frame.c * n.y;
  Vector7 d;
  d(kX) = n.x;
  d(kY) = n.y;
  d(kDirection) = -arm.y * n.x + arm.x * n.y;
  d(kCurvature) = lx * s.value.dx[0] + ly * s.value.dy[0];
  d(kNextCurvature) = lx * s.value.dx[1] + ly * s.value.dy[1];
  d(kLengthAt) = lx * s.value.dx[2] + ly * s.value.dy[2];
  d(kAlphaAt) = lx * s.value.dx[3] + ly * s.value.dy[3];
  return d;
}

void Evaluation::add_dynamics(Model& m, int i) {
  Stage& stage = m.stages[i];
  const FitJoint& from = chain_.joints[i];
  const FitJoint& to = chain_.joints[i + 1];
  const auto& end = tables_[i].end();
  const Frame f = frames_[i];
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
  fix_controls(stage, i);
  const double turn = stage.gap(2) * chain_.pieces[i].length;
  const double square = stage.gap.head<2>().squaredNorm() + turn * turn;
  gap_square_ += square;
  m.max_gap = std::max(m.max_gap, std::sqrt(square));
}

/// What lines and arcs leave no choice about.
void Evaluation::fix_controls(Stage& stage, int i) const {
  const FitPiece& piece = chain_.pieces[i];
  auto& j = stage.step;
  if (piece.kind == PieceKind::arc) {
    // An arc's curvature is one: the next joint's follows this one's.
    for (int r = 0; r < 3; ++r) j(r, kCurvature) += j(r, kNextCurvature);
    j(3, kCurvature) = 1;
    for (int r = 0; r < 4; ++r) j(r, kNextCurvature) = 0;
  } else {
    j(3, kNextCurvature) = 1;
  }
  // Slopes stay when gaps close: at their limits they could not move as the step says.
  stage.fixed[1] = slope_held(piece) || piece.kind != PieceKind::curve || options_.close_gaps;
  const int count = static_cast<int>(chain_.pieces.size());
  const bool before_line = i + 1 < count
                               ? chain_.pieces[i + 1].kind == PieceKind::line
                               : chain_.closed && chain_.pieces[0].kind == PieceKind::line;
  stage.fixed[2] = piece.kind != PieceKind::curve || before_line;
}

/// A closed chain's last joint is its first.
void Evaluation::add_seam(Model& m) {
  const FitJoint& first = chain_.joints.front();
  const FitJoint& last = chain_.joints.back();
  const double length = chain_.pieces.back().length;
  const double turn = (last.direction - first.direction - chain_.turning) * length;
  const double bend = (last.curvature - first.curvature) * length * length;
  const double gap = core::distance(last.position, first.position);
  const double square = gap * gap + turn * turn + bend * bend;
  gap_square_ += square;
  m.max_gap = std::max(m.max_gap, std::sqrt(square));
}

/// Residual and its derivative by the stage's seven variables.
void Evaluation::add_residual(Model& m, int i, double r, const Vector7& d, double weight) {
  Vector7 g = d;
  if (chain_.pieces[i].kind == PieceKind::arc) {
    g(kCurvature) += g(kNextCurvature);
    g(kNextCurvature) = 0;
  }
  m.stages[i].hessian.selfadjointView<Eigen::Lower>().rankUpdate(g, weight);
  m.stages[i].gradient += weight * r * g;
  m.cost += weight * r * r;
}

void Evaluation::add_point(Model& m, std::size_t j) {
  const Foot& foot = chain_.feet[j];
  const Stand s = stand(foot);
  const core::Vector2 miss = s.at - points_[j].position;
  const core::Vector2 normal{-s.tangent.y, s.tangent.x};
  const double share = points_[j].share;
  const double weight = points_[j].weight * share * share;
  const double r = core::dot(miss, normal);
  add_residual(m, foot.piece, r, derivative(foot, s, normal), weight);
  double along = core::dot(miss, s.tangent);
  if (pinned(j)) add_residual(m, foot.piece, along, derivative(foot, s, s.tangent), weight);
  if (!beyond_end(foot)) along = 0;
  const double spread = std::max(std::abs(-r + points_[j].high), std::abs(-r + points_[j].low));
  m.max_offset = std::max(m.max_offset, share * std::hypot(spread, along));
}

void Evaluation::add_prior(Model& m, int i) {
  const FitPiece& piece = chain_.pieces[i];
  Stage& stage = m.stages[i];
  if (options_.length_prior > 0) {
    const double w = options_.length_prior * options_.scale / options_.usual_length;
    const double r = w * (piece.length - options_.usual_length);
    stage.hessian(kLengthAt, kLengthAt) += w * w;
    stage.gradient(kLengthAt) += w * r;
    m.cost += r * r;
  }
  if (piece.kind != PieceKind::curve || slope_held(piece)) return;
  const double w = options_.slope_prior * options_.scale;
  const double r = w * (piece.alpha + 1);
  stage.hessian(kAlphaAt, kAlphaAt) += w * w;
  stage.gradient(kAlphaAt) += w * r;
  m.cost += r * r;
}

/// In place of the data: every variable wants to stay where it is, as much as it moves the chain.
void Evaluation::keep_still(Model& m) const {
  for (std::size_t i = 0; i < m.stages.size(); ++i) {
    const double length = chain_.pieces[i].length;
    const double bend = std::abs(chain_.joints[i].curvature - chain_.joints[i + 1].curvature);
    const double square = length * length;
    Vector7 d;
    d << 1, 1, length, 0.1 * square, 0.3, 0.02 * bend * square + 1e-6, 0.1 * square;
    m.stages[i].hessian = d.cwiseAbs2().asDiagonal();
    m.stages[i].gradient.setZero();
  }
}

double Evaluation::move_foot(std::size_t j) {
  if (pinned(j)) return 0;
  Foot& foot = chain_.feet[j];
  double moved = 0;
  const int count = static_cast<int>(tables_.size());
  for (int hop = 0; hop < 4; ++hop) {
    const lac::PieceTable& table = tables_[foot.piece];
    const lac::PieceTable::Place local = table.place(foot.fraction);
    const double direction = chain_.joints[foot.piece].direction + local.angle;
    const core::Vector2 tangent{std::cos(direction), std::sin(direction)};
    const core::Vector2 miss =
        points_[j].position - place(foot.piece, frames_[foot.piece], local.x, local.y);
    const double side = core::cross(tangent, miss);
    const double bend = 1 - table.curvature(foot.fraction) * side;
    const double step = core::dot(miss, tangent) / std::max(0.25, bend) / table.length();
    const double to = foot.fraction + std::clamp(step, -0.5, 0.5);
    const bool back = to < 0 && (chain_.closed || foot.piece > 0);
    const bool on = to > 1 && (chain_.closed || foot.piece + 1 < count);
    if (!back && !on) {
      const double from = std::exchange(foot.fraction, std::clamp(to, 0.0, 1.0));
      return moved + std::abs(foot.fraction - from);
    }
    moved += std::abs((on ? 1 : 0) - foot.fraction);
    foot.piece = (foot.piece + (on ? 1 : count - 1)) % count;
    foot.fraction = on ? 0 : 1;
  }
  return moved;
}

}  // namespace keyline::fairing::detail
