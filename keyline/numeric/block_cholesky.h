#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace keyline::numeric {

/// Cholesky's factor of a sparse, symmetric, definite matrix of which the lower half is read, made
/// of dense blocks: columns of the factor with numbers at the same places are eliminated together
/// (multifrontal method; Liu, SIAM Review 34 (1992)). Several times as fast as column by column
/// where unknowns come in groups that all depend on one another.
class BlockCholesky {
 public:
  /// False, and of no use, where the matrix is not definite within rounding. Where its numbers
  /// stand at the places of the last one's, the order of elimination is kept.
  bool renew(const Eigen::SparseMatrix<double>& a);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  /// Columns [first, first + count) and the rows of all of them, its own columns first.
  struct Block {
    Eigen::Index first = 0;
    Eigen::Index count = 0;
    std::vector<Eigen::Index> rows;
    std::vector<std::size_t> children;
    Eigen::MatrixXd factor;  ///< a row for each of `rows`, a column for each of the block's
  };

  bool same_places(const Eigen::SparseMatrix<double>& a) const;
  void arrange(const Eigen::SparseMatrix<double>& a);
  void analyze(const Eigen::SparseMatrix<double>& lower);
  void gather(const std::vector<std::vector<Eigen::Index>>& rows);
  bool eliminate(Block& block, const Eigen::SparseMatrix<double>& lower);

  Eigen::PermutationMatrix<Eigen::Dynamic> order_;  ///< from the given places to those eliminated
  std::vector<int> starts_, places_;                ///< of the last matrix
  std::vector<Block> blocks_;
  std::vector<Eigen::MatrixXd> updates_;  ///< by block, until its parent has it
  std::vector<Eigen::Index> local_;       ///< place among the rows of the block at hand
};

}  // namespace keyline::numeric
