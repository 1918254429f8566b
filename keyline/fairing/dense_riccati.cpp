#include "keyline/fairing/dense_riccati.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "keyline/fairing/sweep_ends.h"

namespace keyline::fairing::detail {
namespace {

/// S states: 6, or 12 where the start state rides along so that a closed curve can be tied to it.
template <int S>
class Sweep {
 public:
  Sweep(const std::vector<Cell>& cells, const DenseBoundary& boundary)
      : cells_(cells), boundary_(boundary) {}

  DenseStep run() {
    DenseStep step;
    set_end_model(boundary_.end_hessian, boundary_.end_gradient, value_, slope_);
    gains_.resize(cells_.size());
    values_.resize(cells_.size());
    for (std::size_t i = cells_.size(); i-- > 0 && sound_;) backward(i);
    if (sound_) forward(step);
    step.sound = sound_;
    return step;
  }

 private:
  using MatrixS = Eigen::Matrix<double, S, S>;
  using VectorS = Eigen::Matrix<double, S, 1>;
  // Where the state holds them, after x, y and direction: curvature at both ends of a cell, length.
  static constexpr int kStart = 3;
  static constexpr int kEnd = 4;
  static constexpr int kLength = 5;
  struct Gain {
    VectorS by_state;
    double offset = 0;
  };
  /// Of x, y and direction after a cell: what the rest of the curve costs by them.
  struct Value {
    Eigen::Matrix<double, 3, S> by_state;
    Eigen::Vector3d slope;
  };

  /// Rows over the state after a cell, over the one before it: times the identity but for the pose
  /// and for what becomes of the curvatures.
  template <int R>
  static Eigen::Matrix<double, R, S> after(const Cell& cell, bool chosen,
                                           const Eigen::Matrix<double, R, S>& rows) {
    Eigen::Matrix<double, R, S> out = rows;
    out.template leftCols<6>() = rows.template leftCols<3>().lazyProduct(cell.step);
    const bool passes = cell.passage.ends_piece && !cell.passage.arc;
    out.col(passes ? kEnd : kStart) += rows.col(kStart);
    if (!chosen) out.col(kEnd) += rows.col(kEnd);
    out.col(kLength) += rows.col(kLength);
    return out;
  }

  void backward(std::size_t i) {
    const Cell& cell = cells_[i];
    values_[i] = {value_.template topRows<3>(), slope_.template head<3>()};
    const Passage& passage = cell.passage;
    const bool chosen = passage.ends_piece && !passage.ends_curve;
    const VectorS v = slope_ + value_.template leftCols<3>().lazyProduct(cell.gap);
    const MatrixS va = after<S>(cell, chosen, value_);
    gains_[i] = {VectorS::Zero(), 0};
    const VectorS qux = va.row(kEnd).transpose();
    const double quu = value_(kEnd, kEnd);
    const double qu = v(kEnd);
    value_ = after<S>(cell, chosen, va.transpose());
    slope_ = after<1>(cell, chosen, v.transpose()).transpose();
    if (chosen && !passage.fixed) {
      if (!(quu > 0) || !std::isfinite(quu)) {
        sound_ = false;
        return;
      }
      gains_[i] = {-qux / quu, -qu / quu};
      value_ += qux.lazyProduct(gains_[i].by_state.transpose());
      slope_ += gains_[i].offset * qux;
    }
    value_.template topLeftCorner<6, 6>() += cell.hessian;
    value_ = (0.5 * (value_ + value_.transpose())).eval();
    slope_.template head<6>() += cell.gradient;
  }

  Vector6 start_change() {
    auto start = start_model<6>(value_, slope_, boundary_.fixed_start);
    start.hessian.diagonal() *= 1 + 1e-12;
    const Eigen::LDLT<Matrix6> factor(start.hessian);
    if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0)) sound_ = false;
    return -factor.solve(start.gradient);
  }

  void forward(DenseStep& step) {
    const Vector6 start = start_change();
    VectorS x;
    x.template head<6>() = start;
    if constexpr (S == 12) x.template tail<6>() = start;
    step.state.reserve(cells_.size() + 1);
    step.state.push_back(start);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const double u = gains_[i].by_state.dot(x) + gains_[i].offset;
      const Eigen::Vector3d pose = cells_[i].step * x.template head<6>() + cells_[i].gap;
      x.template head<3>() = pose;
      const Passage& passage = cells_[i].passage;
      if (passage.ends_piece && !passage.arc) x(kStart) = x(kEnd);
      if (passage.ends_piece && !passage.ends_curve) x(kEnd) = u;
      const Eigen::Vector3d costate = values_[i].by_state * x + values_[i].slope;
      step.largest_costate = std::max(step.largest_costate, costate.cwiseAbs().maxCoeff());
      step.state.push_back(x.template head<6>());
    }
  }

  const std::vector<Cell>& cells_;
  const DenseBoundary& boundary_;
  MatrixS value_;
  VectorS slope_;
  std::vector<Gain> gains_;
  std::vector<Value> values_;
  bool sound_ = true;
};

}  // namespace

DenseStep solve_cells(const std::vector<Cell>& cells, const DenseBoundary& boundary) {
  if (boundary.closed) return Sweep<12>(cells, boundary).run();
  return Sweep<6>(cells, boundary).run();
}

}  // namespace keyline::fairing::detail
