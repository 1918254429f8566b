#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "keyline/fit/chain_data.h"
#include "keyline/fit/quintic_chain.h"
#include "keyline/fit/quintic_joints.h"

namespace keyline::fit {

/// Quintics in a row on their way to the points, Gauss–Newton's: least squares of the distances
/// along the normals and, with a weight, of the curvature's rate.
class QuinticSolver {
 public:
  /// Joints at these points of the data, which has to stay.
  QuinticSolver(const ChainData& data, bool closed, const std::vector<std::size_t>& at,
                double tolerance);

  /// As near to the points as it goes in so many steps, with that weight on variation().
  void run(double weight = 0, int most = 12);

  /// As calm as the tolerance allows, where run() has come within it: the weight is raised step by
  /// step, so that every chain starts from one that is nearly as calm.
  void calm();

  QuinticChain result() const;

  /// Largest distance of the points of every piece.
  std::vector<double> deviations() const;

  /// L³ ∫ (dκ/ds)² ds with the data's length, by the midpoints of 32 parts of each piece.
  double variation() const;

 private:
  /// A point of the data: which piece it belongs to and where on it.
  struct Foot {
    std::size_t piece = 0;
    double t = 0;
  };
  using Row = Eigen::Matrix<double, 12, 1>;

  /// Normal equations of one piece's unknowns.
  struct Normal {
    Eigen::Matrix<double, 12, 12> matrix = Eigen::Matrix<double, 12, 12>::Zero();
    Row wanted = Row::Zero();

    void add(const Row& row, double value) {
      matrix.noalias() += row * row.transpose();
      wanted += value * row;
    }
  };
  struct State {
    JointedQuintics chain;
    std::vector<Foot> feet;
  };

  /// Of every point from its foot.
  std::vector<double> distances() const;

  /// run(), points that stay beyond the tolerance pulling harder, until none does; whether.
  bool run_within(double weight);

  /// A place of a piece that lies farther than the tolerance from the line of the points, and the
  /// way it is too far.
  struct Stray {
    std::size_t piece = 0;
    std::size_t node = 0;
    core::Vector2 way;
  };
  std::vector<Stray> strays() const;
  bool is_sound() const;
  double move_feet(int rounds);
  double off_line() const;
  double off_rest() const;
  double cost(double weight) {
    // on the way to a calm chain one round: the next step goes on from there
    return move_feet(weight > 0 ? 1 : 2) + off_line() + off_rest() +
           (weight > 0 ? weight * variation() : 0);
  }
  void step(double weight, double damping);
  void add_points(const std::vector<JointedQuintic>& pieces, std::vector<Normal>& parts) const;
  void add_strays(const std::vector<JointedQuintic>& pieces, std::vector<Normal>& parts) const;
  void add_variation(double weight, const std::vector<JointedQuintic>& pieces,
                     std::vector<Normal>& parts) const;
  void add(std::size_t piece, const Normal& part, Eigen::MatrixXd& a, Eigen::VectorXd& g) const;
  void solve(Eigen::MatrixXd& a, Eigen::VectorXd& g, double damping);

  /// First unknown of a joint, of a piece. Ends of an open chain hold their place.
  int joint_at(std::size_t j) const;
  int piece_at(std::size_t k) const;
  bool held(std::size_t j) const;

  const ChainData& data_;
  double tolerance_;
  State now_;
  std::vector<double> pull_;  ///< weights of the points
  std::vector<double> rest_;  ///< a fifth of each piece's length
};

}  // namespace keyline::fit
