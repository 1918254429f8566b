#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace keyline::lac::detail {

/// Square matrix with two diagonals on each side, solved by elimination with row exchanges for two
/// right-hand sides at once; linear cost.
class PentadiagonalSystem {
 public:
  static constexpr int kBelow = 2;
  static constexpr int kAbove = 4;  ///< two of its own and two that exchanges fill in
  using Row = std::array<double, kBelow + kAbove + 1>;
  using Sides = std::array<double, 2>;

  void reset(std::size_t size) {
    rows_.assign(size, Row{});
    sides_.assign(size, Sides{});
  }
  std::size_t size() const { return rows_.size(); }
  double& at(std::size_t row, std::size_t column) { return rows_[row][column + kBelow - row]; }
  Sides& sides(std::size_t row) { return sides_[row]; }

  /// Replaces the right-hand sides by the solutions; false where the matrix is singular.
  bool solve() {
    const std::size_t n = size();
    for (std::size_t c = 0; c < n; ++c) {
      const std::size_t last = std::min(c + kBelow, n - 1);
      std::size_t best = c;
      for (std::size_t r = c + 1; r <= last; ++r) {
        if (std::abs(at(r, c)) > std::abs(at(best, c))) best = r;
      }
      if (!(std::abs(at(best, c)) > 1e-280)) return false;
      const std::size_t right = std::min(c + kAbove, n - 1);
      if (best != c) {
        for (std::size_t k = c; k <= right; ++k) std::swap(at(best, k), at(c, k));
        std::swap(sides_[best], sides_[c]);
      }
      for (std::size_t r = c + 1; r <= last; ++r) eliminate(c, r, right);
    }
    for (std::size_t c = n; c-- > 0;) substitute(c, std::min(c + kAbove, n - 1));
    return true;
  }

 private:
  void eliminate(std::size_t pivot, std::size_t row, std::size_t right) {
    const double f = at(row, pivot) / at(pivot, pivot);
    if (f == 0) return;
    for (std::size_t k = pivot; k <= right; ++k) at(row, k) -= f * at(pivot, k);
    for (int i = 0; i < 2; ++i) sides_[row][i] -= f * sides_[pivot][i];
  }
  void substitute(std::size_t row, std::size_t right) {
    for (int i = 0; i < 2; ++i) {
      for (std::size_t k = row + 1; k <= right; ++k) sides_[row][i] -= at(row, k) * sides_[k][i];
      sides_[row][i] /= at(row, row);
    }
  }

  std::vector<Row> rows_;
  std::vector<Sides> sides_;
};

}  // namespace keyline::lac::detail
