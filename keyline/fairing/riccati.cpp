#include "keyline/fairing/riccati.h"

#include <Eigen/Cholesky>

#include "keyline/fairing/sweep_ends.h"

namespace keyline::fairing::detail {
namespace {

/// S states: 4, or 8 where the start state rides along so that a closed chain can be tied to it.
template <int S>
class Sweep {
 public:
  Sweep(const std::vector<Stage>& stages, const Boundary& boundary)
      : stages_(stages), boundary_(boundary) {}

  Step run() {
    backward();
    Step step;
    step.sound = sound_;
    if (!sound_) return step;
    forward(step);
    return step;
  }

 private:
  using MatrixS = Eigen::Matrix<double, S, S>;
  using VectorS = Eigen::Matrix<double, S, 1>;
  using Gain = Eigen::Matrix<double, 3, S>;

  void backward() {
    set_end_model(boundary_.end_hessian, boundary_.end_gradient, value_, slope_);
    gains_.resize(stages_.size());
    offsets_.resize(stages_.size());
    for (std::size_t i = stages_.size(); i-- > 0 && sound_;) backward_step(i);
  }

  void backward_step(std::size_t i) {
    const Stage& stage = stages_[i];
    Eigen::Matrix<double, S, S> a = MatrixS::Identity();
    a.template topLeftCorner<4, 4>() = stage.step.template leftCols<4>();
    Eigen::Matrix<double, S, 3> b = Eigen::Matrix<double, S, 3>::Zero();
    b.template topRows<4>() = stage.step.template rightCols<3>();
    VectorS c = VectorS::Zero();
    c.template head<4>() = stage.gap;

    const MatrixS va = value_ * a;
    const Eigen::Matrix<double, S, 3> vb = value_ * b;
    const VectorS v = slope_ + value_ * c;
    MatrixS qxx = a.transpose() * va;
    Eigen::Matrix3d quu = b.transpose() * vb;
    Gain qux = b.transpose() * va;
    VectorS qx = a.transpose() * v;
    Eigen::Vector3d qu = b.transpose() * v;
    qxx.template topLeftCorner<4, 4>() += stage.hessian.template topLeftCorner<4, 4>();
    quu += stage.hessian.template bottomRightCorner<3, 3>();
    qux.template leftCols<4>() += stage.hessian.template bottomLeftCorner<3, 4>();
    qx.template head<4>() += stage.gradient.template head<4>();
    qu += stage.gradient.template tail<3>();
    for (int k = 0; k < 3; ++k) {
      if (!stage.fixed[k]) continue;
      quu.row(k).setZero();
      quu.col(k).setZero();
      quu(k, k) = 1;
      qux.row(k).setZero();
      qu(k) = 0;
    }
    const Eigen::LLT<Eigen::Matrix3d> factor(quu);
    if (factor.info() != Eigen::Success) {
      sound_ = false;
      return;
    }
    gains_[i] = -factor.solve(qux);
    offsets_[i] = -factor.solve(qu);
    value_ = qxx + qux.transpose() * gains_[i];
    value_ = (0.5 * (value_ + value_.transpose())).eval();
    slope_ = qx + qux.transpose() * offsets_[i];
  }

  Vector4 start_change() {
    const auto start = start_model<4>(value_, slope_, boundary_.fixed_start);
    const Eigen::LLT<Matrix4> factor(start.hessian);
    if (factor.info() != Eigen::Success) sound_ = false;
    return -factor.solve(start.gradient);
  }

  void forward(Step& step) {
    const Vector4 start = start_change();
    step.sound = sound_;
    VectorS x;
    x.template head<4>() = start;
    if constexpr (S == 8) x.template tail<4>() = start;
    step.state.reserve(stages_.size() + 1);
    step.control.reserve(stages_.size());
    step.state.push_back(start);
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      const Eigen::Vector3d u = gains_[i] * x + offsets_[i];
      const Vector4 next = stages_[i].step.template leftCols<4>() * x.template head<4>() +
                           stages_[i].step.template rightCols<3>() * u + stages_[i].gap;
      x.template head<4>() = next;
      step.state.push_back(next);
      step.control.push_back(u);
    }
  }

  const std::vector<Stage>& stages_;
  const Boundary& boundary_;
  MatrixS value_;
  VectorS slope_;
  std::vector<Gain> gains_;
  std::vector<Eigen::Vector3d> offsets_;
  bool sound_ = true;
};

}  // namespace

Step solve_stages(const std::vector<Stage>& stages, const Boundary& boundary) {
  if (boundary.closed) return Sweep<8>(stages, boundary).run();
  return Sweep<4>(stages, boundary).run();
}

}  // namespace keyline::fairing::detail
