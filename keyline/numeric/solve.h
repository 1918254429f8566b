#pragma once

#include <memory>
#include <optional>

#include <Eigen/Core>
#include <Eigen/SparseCore>

/// Linear systems, compiled once for all rooms: Eigen's decompositions cost seconds wherever they
/// are used.
namespace keyline::numeric {

/// x of least |a x - b|; the columns of `a` must be independent (Householder's QR).
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// Columns of least |a x - b| where columns of `a` may depend on others; the unknowns of those are
/// 0 (QR with column pivots).
Eigen::MatrixXd pivoted_least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// The shortest x of least |a x - b|, whatever the rank of `a`. Columns count as dependent where
/// they are within `dependent` of the largest; by default within rounding.
Eigen::VectorXd least_norm(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                           std::optional<double> dependent = std::nullopt);

/// x of a x = b for a symmetric, semidefinite `a`, of which the lower half is read.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// The inverse, or nothing where `a` has none within rounding.
std::optional<Eigen::MatrixXd> inverse(const Eigen::MatrixXd& a);

/// A sparse, symmetric, definite matrix made ready to be solved with, of which the lower half is
/// read. Made of nothing it has no solution.
class SparseSymmetric {
 public:
  SparseSymmetric();
  explicit SparseSymmetric(const Eigen::SparseMatrix<double>& a);
  SparseSymmetric(SparseSymmetric&&) noexcept;
  SparseSymmetric& operator=(SparseSymmetric&&) noexcept;
  ~SparseSymmetric();

  /// Another matrix. Where its numbers stand at the places of the last one's, the order in which
  /// unknowns are eliminated is kept, which is about half of the work.
  void renew(const Eigen::SparseMatrix<double>& a);

  /// Whether there is a solution; solve() may be called only then.
  explicit operator bool() const;

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace keyline::numeric
