#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace keyline::core {

/// Things 0 … n-1 in sets that grow together, each at first alone in its own.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n = 0) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  /// The member that stands for the set of i.
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// The set of a goes into that of b, whose member stands for both from now on. False where they
  /// were one already.
  bool join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[a] = b;
    return a != b;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace keyline::core
