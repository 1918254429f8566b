// A step of quintic_solver.h: what the pieces ask, as one system, and its solution.
#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/fit/quintic_solver.h"
#include "keyline/numeric/solve.h"

namespace keyline::fit {
namespace {

using core::Vector2;

constexpr int kJointSize = 4;  ///< x, y, direction, curvature
constexpr int kPieceSize = 4;  ///< a, b (end edges), c, d (tangential part of the second edges)
constexpr double kLeastEdge = 0.5;  ///< of a fifth of the piece: shorter ones hide a cusp
constexpr double kRidge = 1e-9;     ///< for unknowns of which nothing is asked
constexpr double kMostTurn = 0.5;   ///< of a joint, radians per step

/// Takes an unknown out: it stays.
void fix(Eigen::Index i, Eigen::MatrixXd& a, Eigen::VectorXd& g) {
  a.row(i).setZero();
  a.col(i).setZero();
  a(i, i) = 1;
  g[i] = 0;
}

}  // namespace

int QuinticSolver::joint_at(std::size_t j) const {
  return static_cast<int>(j) * (kJointSize + kPieceSize);
}

int QuinticSolver::piece_at(std::size_t k) const { return joint_at(k) + kJointSize; }

bool QuinticSolver::held(std::size_t j) const {
  if (now_.chain.closed) return false;
  const bool calm = price_ > 0;
  return (j == 0 && !(calm && free_start_)) ||
         (j + 1 == now_.chain.joints.size() && !(calm && free_end_));
}

/// What a piece asks, the lengths' stiffness with it.
void QuinticSolver::add(std::size_t piece, Eigen::MatrixXd& a, Eigen::VectorXd& g) const {
  std::array<int, 12> at{};
  const std::size_t last = (piece + 1) % now_.chain.joints.size();
  for (std::size_t c = 0; c < 12; ++c) {
    const int base = c < 4 ? joint_at(piece) : c < 8 ? piece_at(piece) : joint_at(last);
    at[c] = base + static_cast<int>(c % 4);
  }
  QuinticNormal::Matrix matrix;
  QuinticNormal::Row wanted;
  now_.asked[piece].gather(piece_of(now_.chain, piece), price_ > 0 ? price_ : 1, matrix, wanted);
  const double stiff = kStiffness * unit();
  const QuinticLengths& l = now_.chain.lengths[piece];
  const std::array<double, 4> lengths = {l.a, l.b, l.c, l.d};
  for (int c = 0; c < kPieceSize; ++c) {
    matrix(kJointSize + c, kJointSize + c) += stiff;
    wanted[kJointSize + c] += stiff * (rest_[piece] - lengths[static_cast<std::size_t>(c)]);
  }
  for (int r = 0; r < 12; ++r) {
    const auto to = static_cast<std::size_t>(r);
    g[at[to]] += wanted[r];
    for (int c = 0; c < 12; ++c) a(at[to], at[static_cast<std::size_t>(c)]) += matrix(r, c);
  }
}

/// Damps, and keeps what may not move: places of ends, and edges that are shortest and would
/// shrink.
void QuinticSolver::hold(double damping, Eigen::MatrixXd& a, Eigen::VectorXd& g) const {
  const double ridge = kRidge * unit();
  const double length = 5 * rest_.front();
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const auto c = i % (kJointSize + kPieceSize);
    const double own = c == 2 ? length * length : c == 3 ? std::pow(length, 4) : 1;
    a(i, i) += damping * a(i, i) + own * ridge;
  }
  const JointedQuintics& chain = now_.chain;
  for (std::size_t j = 0; j < chain.joints.size(); ++j)
    for (int c = 0; held(j) && c < 2; ++c) fix(joint_at(j) + c, a, g);
  for (std::size_t k = 0; k < chain.lengths.size(); ++k) {
    const double least = kLeastEdge * rest_[k];
    if (chain.lengths[k].a <= least && g[piece_at(k)] < 0) fix(piece_at(k), a, g);
    if (chain.lengths[k].b <= least && g[piece_at(k) + 1] < 0) fix(piece_at(k) + 1, a, g);
  }
}

Eigen::VectorXd QuinticSolver::step(double damping) const {
  const auto size = static_cast<Eigen::Index>(kJointSize * now_.chain.joints.size() +
                                              kPieceSize * now_.chain.lengths.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(size);
  for (std::size_t k = 0; k < now_.asked.size(); ++k) add(k, a, g);
  hold(damping, a, g);
  return numeric::solve_symmetric(a, g);
}

void QuinticSolver::take(const Eigen::VectorXd& x) {
  if (!x.allFinite()) return;
  JointedQuintics& chain = now_.chain;
  for (std::size_t j = 0; j < chain.joints.size(); ++j) {
    QuinticJoint& joint = chain.joints[j];
    const int at = joint_at(j);
    joint.place = joint.place + Vector2{x[at], x[at + 1]};
    joint.direction += std::clamp(x[at + 2], -kMostTurn, kMostTurn);
    joint.curvature += x[at + 3];
  }
  for (std::size_t k = 0; k < chain.lengths.size(); ++k) {
    QuinticLengths& l = chain.lengths[k];
    const int at = piece_at(k);
    const double least = kLeastEdge * rest_[k];
    l.a = std::max(least, l.a + x[at]);
    l.b = std::max(least, l.b + x[at + 1]);
    l.c += x[at + 2];
    l.d += x[at + 3];
  }
}

}  // namespace keyline::fit
