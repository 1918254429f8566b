#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/curve/piecewise_bezier.h"

/// Quintics by the directions and lengths of their control edges, for drive_curvature().
namespace keyline::fit {

inline constexpr std::size_t kEdges = 5;

/// Derivatives are filled row by row.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Control edges of a piece: directions d_n and lengths a_n, [Sketch] Eq. 12.
struct Edges {
  std::array<core::Vector2, kEdges> direction;
  std::array<double, kEdges> length{};
};

/// Edges of every quintic of a chain; bad_input where one has no length.
core::Result<std::vector<Edges>> edges_of(const curve::PiecewiseBezier& chain);

/// The chain from `start` with these directions and lengths (kEdges per piece).
curve::PiecewiseBezier chain_of(core::Point2 start, const std::vector<Edges>& edges,
                                const Eigen::VectorXd& lengths);

/// Curvature at u, [Sketch] Eq. 8, and, where asked for, its derivatives by the five lengths.
double curvature_with_gradient(const Edges& e, double u, std::array<double, kEdges>* gradient);

/// The unknowns: logarithms of the factors by which free lengths change, which no unit is in; the
/// others follow from joints and a held end.
class FreeLengths {
 public:
  /// What does not change beside the directions.
  struct Held {
    bool closed = false;     ///< the last piece joins the first, and the end point stays
    bool end = false;        ///< the end point stays
    bool outermost = false;  ///< the first two and the last two lengths stay
  };
  FreeLengths(std::vector<Edges> start, const Held& held);

  /// False where an end is to be held and all lengths free for that are parallel.
  bool can_hold() const { return !wants_pair_ || pair_found_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(free_.size()); }
  /// Their values in the start.
  Eigen::VectorXd unknowns() const { return Eigen::VectorXd::Zero(size()); }
  /// All lengths, piece by piece, for the unknowns, with their derivatives where asked for; false
  /// where one would not be positive.
  bool expand(const Eigen::VectorXd& x, Eigen::VectorXd& lengths, RowMatrix* by_x) const;

 private:
  enum class Role { free, joint, end, fixed };
  /// a2 of the next piece from a4, a5 of this one and its own a1: factor * a4 * (a1 / a5)^2.
  struct Joint {
    Eigen::Index target, a4, a5, a1;
    double factor;
  };

  double start_at(std::size_t k) const { return start_[k / kEdges].length[k % kEdges]; }
  core::Vector2 direction_at(std::size_t k) const {
    return start_[k / kEdges].direction[k % kEdges];
  }
  void tie_joint(std::size_t i, std::size_t next);
  void choose_pair();
  void expand_joint(const Joint& joint, Eigen::VectorXd& a, RowMatrix* by_x) const;
  bool expand_pair(Eigen::VectorXd& a, RowMatrix* by_x) const;

  std::vector<Edges> start_;
  std::vector<Role> role_;
  std::vector<Joint> joints_;
  std::vector<std::size_t> source_;  ///< lengths that joints depend on
  std::vector<std::size_t> free_;
  std::array<std::size_t, 2> pair_{};  ///< lengths that hold the end
  bool wants_pair_ = false;
  bool pair_found_ = false;
  core::Vector2 end_{};
};

}  // namespace keyline::fit
