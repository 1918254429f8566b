#include "keyline/numeric/solve.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>

namespace keyline::numeric {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd least_squares(const MatrixXd& a, const VectorXd& b) { return a.householderQr().solve(b); }

MatrixXd pivoted_least_squares(const MatrixXd& a, const MatrixXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

VectorXd least_norm(const MatrixXd& a, const VectorXd& b, std::optional<double> dependent) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> factor;
  if (dependent) factor.setThreshold(*dependent);
  factor.compute(a);
  return factor.solve(b);
}

VectorXd solve_symmetric(const MatrixXd& a, const VectorXd& b) { return a.ldlt().solve(b); }

std::optional<MatrixXd> inverse(const MatrixXd& a) {
  const Eigen::ColPivHouseholderQR<MatrixXd> factor(a);
  if (!factor.isInvertible()) return std::nullopt;
  return factor.inverse();
}

struct SparseSymmetric::Factor {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt;
};

SparseSymmetric::SparseSymmetric(const Eigen::SparseMatrix<double>& a)
    : factor_(std::make_unique<Factor>()) {
  factor_->ldlt.compute(a);
}
SparseSymmetric::SparseSymmetric(SparseSymmetric&&) noexcept = default;
SparseSymmetric& SparseSymmetric::operator=(SparseSymmetric&&) noexcept = default;
SparseSymmetric::~SparseSymmetric() = default;

void SparseSymmetric::renew(const Eigen::SparseMatrix<double>& a) { factor_->ldlt.factorize(a); }

SparseSymmetric::operator bool() const { return factor_->ldlt.info() == Eigen::Success; }

VectorXd SparseSymmetric::solve(const VectorXd& b) const { return factor_->ldlt.solve(b); }

MatrixXd SparseSymmetric::solve(const MatrixXd& b) const { return factor_->ldlt.solve(b); }

}  // namespace keyline::numeric
