#pragma once

#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "keyline/surface/joint_conditions.h"

/// Internals of room surface: the conditions of joints as equations to be solved in steps.
namespace keyline::surface::detail {

/// Whether joints keep the multipliers of the given ones (joint_conditions.h). Only joints that
/// meet their conditions can do without: one that is held to what it misses them by keeps its own.
enum class JointMultipliers { given, open };

/// One condition at a place of the control points, for each coordinate: what it lacks, and by how
/// much that changes with each point and each multiplier.
struct JointRow {
  Eigen::RowVector3d lacks;
  std::vector<std::pair<Eigen::Index, double>> points;
  std::vector<std::pair<Eigen::Index, Eigen::RowVector3d>> multipliers;
};

/// Conditions of joints, linear in the control points, and the multipliers they hold with now.
class JointRows {
 public:
  /// unit: of the conditions, a length.
  JointRows(std::span<const JointEquations> joints, const Eigen::MatrixX3d& given, double unit,
            JointMultipliers multipliers);

  std::size_t count() const { return conditions_.size(); }

  JointRow at(std::size_t condition, const Eigen::MatrixX3d& x) const;
  /// The most that a condition with open multipliers lacks: others are linear.
  double misfit(const Eigen::MatrixX3d& x) const;
  /// By how much a multiplier counts in the conditions, as given.
  double weight(std::size_t multiplier) const { return weights_[multiplier]; }
  const std::vector<double>& multipliers() const { return multipliers_; }
  void set_multipliers(std::vector<double> multipliers) { multipliers_ = std::move(multipliers); }

 private:
  /// Over the points that it has: a row of weights for each product of multipliers.
  struct Condition {
    std::vector<Eigen::Index> points;
    std::vector<Factors> factors;
    Eigen::MatrixXd weights;
    Eigen::RowVector3d given;  ///< its value, which stays
  };

  void add(const JointForm& form, std::size_t first, double unit, const Eigen::MatrixX3d& given);
  Eigen::MatrixX3d values_of(const Condition& c, const Eigen::MatrixX3d& x) const;
  Eigen::RowVectorXd products_of(const Condition& c) const;

  std::vector<Condition> conditions_;
  std::vector<double> multipliers_;
  std::vector<double> weights_;
};

}  // namespace keyline::surface::detail
