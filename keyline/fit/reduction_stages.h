#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace keyline::fit::detail {

/// Where a reduction of observations to a band stood after every knot span: one of knots that begin
/// alike goes on from there and comes to the same, bit by bit.
class ReductionStages {
 public:
  struct Stage {
    std::size_t span = 0;  ///< the next
    std::size_t data = 0;  ///< that were taken up to then
    double rest = 0;       ///< residual squares of them
  };

  /// Rows of the band that the spans after this one will still change, right-hand sides behind.
  void keep(const Stage& stage, std::span<const double> band, std::span<const double> right) {
    stages_.push_back(stage);
    rows_.insert(rows_.end(), band.begin(), band.end());
    rows_.insert(rows_.end(), right.begin(), right.end());
  }

  /// The last stage whose span and all before it have the knots they had; none: from the start on.
  std::optional<Stage> resume(std::span<const double> knots, std::size_t order) {
    const auto same =
        static_cast<std::size_t>(std::ranges::mismatch(knots, knots_).in1 - knots.begin());
    knots_.assign(knots.begin(), knots.end());
    const std::size_t each = stages_.empty() ? 0 : rows_.size() / stages_.size();
    while (!stages_.empty() && stages_.back().span + order > same + 1) stages_.pop_back();
    rows_.resize(each * stages_.size());
    if (stages_.empty()) return std::nullopt;
    return stages_.back();
  }

  /// Of every span with data.
  const std::vector<Stage>& all() const { return stages_; }

  /// As kept with the last stage.
  void put_back(std::span<double> band, std::span<double> right) const {
    const auto from = rows_.end() - static_cast<std::ptrdiff_t>(band.size() + right.size());
    std::copy_n(from, band.size(), band.begin());
    std::copy_n(from + static_cast<std::ptrdiff_t>(band.size()), right.size(), right.begin());
  }

 private:
  std::vector<double> knots_;
  std::vector<Stage> stages_;
  std::vector<double> rows_;
};

}  // namespace keyline::fit::detail
