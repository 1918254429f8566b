#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "keyline/curve/bounding_box.h"

namespace keyline::curve {

/// Boxes in an order in which neighbours lie near each other, as along a curve, to be searched for
/// what is nearest to a point: halves of halves, each with the box around its own.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box2>& boxes) : count_(boxes.size()) {
    leaves_ = 1;
    while (leaves_ < count_) leaves_ *= 2;
    constexpr double kFar = std::numeric_limits<double>::infinity();
    nodes_.assign(2 * leaves_, Box2{{kFar, kFar}, {-kFar, -kFar}});
    std::ranges::copy(boxes, nodes_.begin() + static_cast<std::ptrdiff_t>(leaves_));
    for (std::size_t k = leaves_ - 1; k > 0; --k)
      nodes_[k] = united(nodes_[2 * k], nodes_[2 * k + 1]);
  }

  /// Calls look(i) for boxes no farther from p than `nearest`, which look lowers, the nearer half
  /// first.
  template <class Look>
  void visit(core::Point2 p, const double& nearest, const Look& look) const {
    if (count_ > 0) visit(1, p, nearest, look);
  }

 private:
  template <class Look>
  void visit(std::size_t node, core::Point2 p, const double& nearest, const Look& look) const {
    if (node >= leaves_) {
      if (node - leaves_ < count_ && distance(nodes_[node], p) <= nearest) look(node - leaves_);
      return;
    }
    const double left = distance(nodes_[2 * node], p);
    const double right = distance(nodes_[2 * node + 1], p);
    const std::size_t first = right < left ? 1 : 0;
    if ((first ? right : left) <= nearest) visit(2 * node + first, p, nearest, look);
    if ((first ? left : right) <= nearest) visit(2 * node + 1 - first, p, nearest, look);
  }

  std::size_t count_;
  std::size_t leaves_;
  std::vector<Box2> nodes_;  ///< the root at 1, of k the halves at 2k and 2k + 1
};

}  // namespace keyline::curve
