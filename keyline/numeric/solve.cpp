#include "keyline/numeric/solve.h"

#include <utility>
#include <vector>

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
  /// Whether `a` has numbers at the places of the last matrix; they are kept.
  bool same_places(const Eigen::SparseMatrix<double>& a) {
    const std::vector<int> last = std::exchange(places, places_of(a));
    return places == last;
  }

  static std::vector<int> places_of(const Eigen::SparseMatrix<double>& a) {
    std::vector<int> places{static_cast<int>(a.cols())};
    for (int k = 0; k < a.outerSize(); ++k) {
      for (Eigen::SparseMatrix<double>::InnerIterator it(a, k); it; ++it)
        places.push_back(static_cast<int>(it.row()));
      places.push_back(-1);
    }
    return places;
  }

  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt;
  std::vector<int> places;  ///< rows of every column's numbers, columns parted by -1
};

SparseSymmetric::SparseSymmetric() : factor_(std::make_unique<Factor>()) {}
SparseSymmetric::SparseSymmetric(const Eigen::SparseMatrix<double>& a) : SparseSymmetric() {
  renew(a);
}
SparseSymmetric::SparseSymmetric(SparseSymmetric&&) noexcept = default;
SparseSymmetric& SparseSymmetric::operator=(SparseSymmetric&&) noexcept = default;
SparseSymmetric::~SparseSymmetric() = default;

void SparseSymmetric::renew(const Eigen::SparseMatrix<double>& a) {
  if (factor_->same_places(a))
    factor_->ldlt.factorize(a);
  else
    factor_->ldlt.compute(a);
}

SparseSymmetric::operator bool() const {
  return !factor_->places.empty() && factor_->ldlt.info() == Eigen::Success;
}

VectorXd SparseSymmetric::solve(const VectorXd& b) const { return factor_->ldlt.solve(b); }

MatrixXd SparseSymmetric::solve(const MatrixXd& b) const { return factor_->ldlt.solve(b); }

}  // namespace keyline::numeric
