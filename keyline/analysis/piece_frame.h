#pragma once

#include <vector>

#include <Eigen/Core>

#include "keyline/analysis/profile.h"

namespace keyline::analysis::detail {

/// A piece brought into one frame: length 1, turning left, curvature falling (radius growing).
/// It measures how far another curvature profile is from it, as a distance between curves.
class PieceFrame {
 public:
  static constexpr int kCells = 200;    ///< even steps of the length
  static constexpr int kFewCells = 40;  ///< of the coarse frame

  /// The profile must be complete.
  explicit PieceFrame(const CurvatureProfile& piece);

  /// The same piece in kFewCells cells: where a fit ends is told nearly at a fifth of the cost.
  PieceFrame coarse() const;

  int cells() const { return static_cast<int>(turning_.size()); }

  double length() const { return length_; }    ///< of the original piece
  bool reversed() const { return reversed_; }  ///< the frame runs against the piece
  double sign() const { return sign_; }        ///< of the piece's curvature
  /// Turning of each cell of length 1 / cells(), in radians.
  const Eigen::VectorXd& turning() const { return turning_; }
  /// Mean curvature over the cells [from, to).
  double mean_curvature(int from, int to) const;

  /// Where a curve of the given turning per cell lies relative to the piece: x and y of the
  /// displacement at the ends of the cells, divided by sqrt(their number), to first order and
  /// after the rigid motion that makes them smallest. The norm is the root mean square distance
  /// for length 1. (Sideways distances alone would not do: a spiral may slide along itself.)
  Eigen::VectorXd displacement(const Eigen::VectorXd& model_turning) const;

 private:
  PieceFrame() = default;
  void make_modes();

  double length_ = 1;
  bool reversed_ = false;
  double sign_ = 1;
  Eigen::VectorXd turning_;
  std::vector<core::Vector2> normals_;  // at the middle of each cell
  Eigen::VectorXd turn_mode_;           // displacement by a turn about the centre, of norm 1
};

}  // namespace keyline::analysis::detail
