#include "keyline/numeric/block_cholesky.h"

#include <algorithm>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>

namespace keyline::numeric {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::SparseMatrix;
using Eigen::VectorXd;

bool BlockCholesky::same_places(const SparseMatrix<double>& a) const {
  const auto columns = static_cast<std::size_t>(a.outerSize());
  const auto numbers = static_cast<std::size_t>(a.nonZeros());
  return starts_.size() == columns + 1 && places_.size() == numbers &&
         std::equal(starts_.begin(), starts_.end(), a.outerIndexPtr()) &&
         std::equal(places_.begin(), places_.end(), a.innerIndexPtr());
}

/// The order of elimination.
void BlockCholesky::arrange(const SparseMatrix<double>& a) {
  starts_.assign(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1);
  places_.assign(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros());
  Eigen::PermutationMatrix<Eigen::Dynamic> back;
  Eigen::AMDOrdering<int>()(a.selfadjointView<Eigen::Lower>(), back);
  order_ = back.inverse();
}

void BlockCholesky::analyze(const SparseMatrix<double>& lower) {
  const auto n = static_cast<std::size_t>(lower.cols());
  std::vector<std::vector<Index>> rows(n);  // below the diagonal, by column of the factor
  std::vector<std::vector<std::size_t>> children(n);
  std::vector<Index> seen(n, -1);
  for (std::size_t j = 0; j < n; ++j) {
    const auto column = static_cast<Index>(j);
    const auto take = [&](Index i) {
      if (i > column && std::exchange(seen[static_cast<std::size_t>(i)], column) != column)
        rows[j].push_back(i);
    };
    for (SparseMatrix<double>::InnerIterator it(lower, column); it; ++it) take(it.row());
    for (const std::size_t child : children[j])
      for (const Index i : rows[child]) take(i);
    std::ranges::sort(rows[j]);
    if (!rows[j].empty()) children[static_cast<std::size_t>(rows[j].front())].push_back(j);
  }
  gather(rows);
}

/// A column joins the block of the one before where that only lacks its own row.
void BlockCholesky::gather(const std::vector<std::vector<Index>>& rows) {
  blocks_.clear();
  std::vector<std::size_t> block_of(rows.size());
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const bool joins = j > 0 && !rows[j - 1].empty() &&
                       rows[j - 1].front() == static_cast<Index>(j) &&
                       rows[j - 1].size() == rows[j].size() + 1;
    if (!joins) blocks_.push_back({static_cast<Index>(j), 0, {}, {}, {}});
    ++blocks_.back().count;
    block_of[j] = blocks_.size() - 1;
  }
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    Block& block = blocks_[b];
    const auto& below = rows[static_cast<std::size_t>(block.first + block.count - 1)];
    for (Index k = 0; k < block.count; ++k) block.rows.push_back(block.first + k);
    block.rows.insert(block.rows.end(), below.begin(), below.end());
    if (!below.empty())
      blocks_[block_of[static_cast<std::size_t>(below.front())]].children.push_back(b);
  }
  updates_.assign(blocks_.size(), {});
  local_.assign(rows.size(), 0);
}

bool BlockCholesky::eliminate(Block& block, const SparseMatrix<double>& lower) {
  const auto size = static_cast<Index>(block.rows.size());
  for (Index i = 0; i < size; ++i)
    local_[static_cast<std::size_t>(block.rows[static_cast<std::size_t>(i)])] = i;
  MatrixXd front = MatrixXd::Zero(size, size);
  for (Index k = 0; k < block.count; ++k)
    for (SparseMatrix<double>::InnerIterator it(lower, block.first + k); it; ++it)
      front(local_[static_cast<std::size_t>(it.row())], k) = it.value();
  for (const std::size_t c : block.children) {
    const Block& child = blocks_[c];
    MatrixXd& update = updates_[c];
    const Index* rows = child.rows.data() + child.count;
    for (Index k = 0; k < update.cols(); ++k) {
      double* column = front.col(local_[static_cast<std::size_t>(rows[k])]).data();
      for (Index i = k; i < update.rows(); ++i)
        column[local_[static_cast<std::size_t>(rows[i])]] += update(i, k);
    }
    update.resize(0, 0);
  }
  const Index count = block.count;
  const Index below = size - count;
  Eigen::Ref<MatrixXd> top = front.topLeftCorner(count, count);
  const Eigen::LLT<Eigen::Ref<MatrixXd>> own(top);
  if (own.info() != Eigen::Success) return false;
  auto rest = front.bottomLeftCorner(below, count);
  top.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(rest);
  auto corner = front.bottomRightCorner(below, below);
  corner.selfadjointView<Eigen::Lower>().rankUpdate(rest, -1);
  updates_[static_cast<std::size_t>(&block - blocks_.data())] = corner;
  block.factor = front.leftCols(count);
  return true;
}

bool BlockCholesky::renew(const SparseMatrix<double>& a) {
  const bool known = same_places(a);
  if (!known) arrange(a);
  SparseMatrix<double> lower(a.rows(), a.cols());
  lower.selfadjointView<Eigen::Lower>() = a.selfadjointView<Eigen::Lower>().twistedBy(order_);
  if (!known) analyze(lower);
  return std::all_of(blocks_.begin(), blocks_.end(),
                     [&](Block& block) { return eliminate(block, lower); });
}

VectorXd BlockCholesky::solve(const VectorXd& b) const {
  VectorXd x = order_ * b;
  const auto below_of = [](const Block& block) {
    return block.factor.bottomRows(block.factor.rows() - block.count);
  };
  for (const Block& block : blocks_) {
    auto own = x.segment(block.first, block.count);
    block.factor.topRows(block.count).triangularView<Eigen::Lower>().solveInPlace(own);
    const VectorXd less = below_of(block) * own;
    for (Index i = 0; i < less.size(); ++i)
      x[block.rows[static_cast<std::size_t>(block.count + i)]] -= less[i];
  }
  for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block) {
    VectorXd below(static_cast<Index>(block->rows.size()) - block->count);
    for (Index i = 0; i < below.size(); ++i)
      below[i] = x[block->rows[static_cast<std::size_t>(block->count + i)]];
    auto own = x.segment(block->first, block->count);
    own -= below_of(*block).transpose() * below;
    block->factor.topRows(block->count)
        .triangularView<Eigen::Lower>()
        .transpose()
        .solveInPlace(own);
  }
  return order_.transpose() * x;
}

}  // namespace keyline::numeric
