#pragma once

#include <vector>

#include <Eigen/Core>

#include "keyline/curve/piecewise_bezier.h"
#include "keyline/fit/control_edges.h"

/// How far a chain moves off itself while its control edges change length, for drive_curvature().
namespace keyline::fit {

/// Distances along the normals of the start, at places spread over every piece. They are linear in
/// the lengths, and sliding along the curve does not count.
class ChainDisplacement {
 public:
  ChainDisplacement(const curve::PiecewiseBezier& start, const std::vector<Edges>& edges);

  /// Distances at the places for all lengths, piece by piece (kEdges each); signed, left positive.
  Eigen::VectorXd operator()(const Eigen::VectorXd& lengths) const {
    return by_length_ * (lengths - start_);
  }
  /// Their derivatives by the lengths: constant.
  const RowMatrix& by_length() const { return by_length_; }
  /// Lengths in the start.
  const Eigen::VectorXd& start() const { return start_; }

 private:
  RowMatrix by_length_;
  Eigen::VectorXd start_;
};

}  // namespace keyline::fit
