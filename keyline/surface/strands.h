#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "keyline/numeric/block_cholesky.h"
#include "keyline/surface/joint_rows.h"
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
/// of what strands are asked for and of the way from home. With multipliers given, the conditions
/// of joints are linear and hold after every step; open ones are further unknowns, and conditions
/// hold as the steps converge.
class StrandSystem {
 public:
  StrandSystem(std::span<const BezierSurface> patches, std::span<const HeldJoint> joints,
               const std::vector<std::vector<bool>>& fixed,
               JointMultipliers multipliers = JointMultipliers::given);

  /// Rows, then columns of each patch, in the order of network_curves.
  std::vector<Strand>& strands() { return strands_; }
  const std::vector<Strand>& strands() const { return strands_; }
  const Eigen::MatrixX3d& given() const { return given_; }

  /// How far a strand is from what is asked of it: edges, or its length, as the unit.
  double misfit(const Strand& s, const Eigen::MatrixX3d& x) const;
  /// ln of the ratio of neighbouring edges, in the mean.
  double growth(const Strand& s, const Eigen::MatrixX3d& x) const;

  /// The most that a condition of a joint lacks, the mean length of strands as unit.
  double joint_misfit(const Eigen::MatrixX3d& x) const { return joints_->misfit(x); }
  /// Those that joints hold with now, where they are open.
  const std::vector<double>& multipliers() const { return joints_->multipliers(); }
  void set_multipliers(std::vector<double> m) { joints_->set_multipliers(std::move(m)); }

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
  Eigen::Index all_unknowns() const {
    return unknowns_ + static_cast<Eigen::Index>(multipliers().size());
  }
  Eigen::RowVector3d moved(Eigen::Index point, const Eigen::VectorXd& dx) const;

  Eigen::MatrixX3d given_;
  std::vector<Strand> strands_;
  std::vector<Eigen::Index> column_;  ///< of each point's first coordinate; -1: it stays
  Eigen::Index unknowns_ = 0;         ///< coordinates; multipliers come behind them
  double size_ = 1;                   ///< mean length of the strands
  std::optional<JointRows> joints_;
  numeric::BlockCholesky factor_;
};

}  // namespace keyline::surface::detail
