#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "keyline/numeric/solve.h"
#include "keyline/surface/joint_conditions.h"
#include "keyline/surface/network.h"

/// Internals of room surface: the network curves of many patches as one system of equations.
namespace keyline::surface::detail {

/// What is asked of a curve: one matrix; a plane; that it stays an affine image of the given one;
/// nothing.
enum class Asked { one_matrix, plane, likeness, nothing };

/// A row or column of a patch, its points by their number among those of all patches.
struct Strand {
  std::size_t patch = 0;
  std::vector<Eigen::Index> points = {};
  Asked asked = Asked::nothing;
  std::optional<double> growth = {};  ///< wanted of its edges, ln(s), signed
  bool firm = false;                  ///< growth has to hold
};

/// How much each strand's equations count; those of joints always hold.
struct StrandWeights {
  std::vector<double> shape;
  std::vector<double> growth;
};

inline constexpr double kHolds = 1e8;  ///< weight of what has to hold

/// Control points of patches whose joints hold, moved in steps of Gauss and Newton: least squares
/// of what strands are asked for and of the way from home, linear in the conditions of joints,
/// which therefore hold after every step.
class StrandSystem {
 public:
  StrandSystem(std::span<const BezierSurface> patches, std::span<const HeldJoint> joints,
               const std::vector<std::vector<bool>>& fixed);

  /// Rows, then columns of each patch, in the order of network_curves.
  std::vector<Strand>& strands() { return strands_; }
  const std::vector<Strand>& strands() const { return strands_; }
  const Eigen::MatrixX3d& given() const { return given_; }

  /// How far a strand is from what is asked of it: edges, or its length, as the unit.
  double misfit(const Strand& s, const Eigen::MatrixX3d& x) const;
  /// ln of the ratio of neighbouring edges, in the mean.
  double growth(const Strand& s, const Eigen::MatrixX3d& x) const;

  /// One step from x. `homing`: weight of the squared distance from home, the mean length of
  /// strands as unit. No edge changes by more than a quarter of itself. Returns how far the
  /// farthest coordinate went, in that unit.
  double step(Eigen::MatrixX3d& x, const Eigen::MatrixX3d& home, double homing,
              const StrandWeights& weights);

 private:
  void add_strands(const Net& net, std::size_t patch, Eigen::Index base);
  Eigen::VectorXd whole_step(const Eigen::MatrixX3d& x, const Eigen::MatrixX3d& home, double homing,
                             const StrandWeights& weights);
  double share_of(const Eigen::MatrixX3d& x, const Eigen::VectorXd& dx) const;
  Eigen::RowVector3d moved(Eigen::Index point, const Eigen::VectorXd& dx) const;

  Eigen::MatrixX3d given_;
  std::vector<Strand> strands_;
  std::vector<Eigen::Index> column_;  ///< of each point's first coordinate; -1: it stays
  Eigen::Index unknowns_ = 0;
  double size_ = 1;  ///< mean length of the strands
  std::vector<Form> joints_;
  numeric::SparseSymmetric factor_;
};

}  // namespace keyline::surface::detail
