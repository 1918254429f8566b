#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "keyline/fit/chain_data.h"
#include "keyline/fit/quintic_chain.h"
#include "keyline/fit/quintic_joints.h"
#include "keyline/fit/quintic_normal.h"
#include "keyline/fit/quintic_powers.h"

namespace keyline::fit {

/// Quintics in a row on their way to the points, Gauss–Newton's: first least squares of the
/// distances along the normals, then the least variation of curvature within the tolerance.
class QuinticSolver {
 public:
  /// Joints at these points of the data, which has to stay.
  QuinticSolver(const ChainData& data, bool closed, const std::vector<std::size_t>& at,
                const QuinticChainOptions& options);

  /// As near to the points as it goes in so many steps.
  void run(int most = 12);

  /// As calm as the tolerance allows, where run() has come within it: an interior point method.
  /// Room within the tolerance has a price beside variation(), which is lowered as the chain
  /// settles, so that no point is ever farther off.
  void calm();

  QuinticChain result() const;

  /// Largest distance of the points of every piece.
  std::vector<double> deviations() const;

  /// L³ ∫ (dκ/ds)² ds with the data's length, by the midpoints of 32 parts of each piece.
  double variation() const;

 private:
  /// A place of a piece, and its way to the line of the points, which may be so long.
  struct Beside {
    std::size_t piece = 0;
    std::size_t node = 0;
    core::Vector2 way;
    double most = 0;
  };

  struct State {
    JointedQuintics chain;
    std::vector<QuinticFoot> feet;
    std::vector<QuinticNormal> asked;  ///< by piece, see cost()
  };

  /// What a chain costs: distances, or room of the tolerance at price 1; and variation().
  struct Cost {
    double points = 0;
    double variation = 0;
    double gap = 0;  ///< ToleranceRoom's
    double at(double price) const { return variation + price * points; }
  };

  /// Of every point from its foot.
  std::vector<double> distances() const;

  /// Places of the pieces farther than `from` from the nearest point.
  std::vector<Beside> beside(const std::vector<JointedQuintic>& pieces, double from) const;
  std::vector<Beside> strays(const std::vector<JointedQuintic>& pieces) const;
  bool is_lively(const std::vector<JointedQuintic>& pieces) const;

  /// Of the chain as it is, the feet moved to their places first; what it asks of the unknowns
  /// stands in `asked` then. Infinite, on the way to a calm chain, where that leaves the tolerance.
  Cost cost();
  Cost far_cost(const std::vector<JointedQuintic>& pieces);
  Cost calm_cost(const std::vector<JointedQuintic>& pieces);
  QuinticPowers::Passing move_foot(std::size_t i, const std::vector<QuinticPowers>& pieces,
                                   int rounds);
  double ask_variation(const std::vector<JointedQuintic>& pieces);
  double off_rest() const;

  /// Whether a part of that step was taken: `taken` is how large a one, or 0.
  struct Progress {
    double taken = 0;
    double gained = 0;  ///< share of the cost
  };
  Progress try_step(const Eigen::VectorXd& x, Cost& now);

  Eigen::VectorXd step(double damping) const;
  void add(std::size_t piece, Eigen::MatrixXd& a, Eigen::VectorXd& g) const;
  void hold(double damping, Eigen::MatrixXd& a, Eigen::VectorXd& g) const;
  void take(const Eigen::VectorXd& x);

  /// What a squared length counts: at a price it is a share of the tolerance's.
  double unit() const { return price_ > 0 ? price_ / (rim_ * rim_) : 1; }

  /// What a point asks that its foot moves.
  void ask(std::size_t i, const QuinticPowers::Passing& at, double weight, double pull);

  /// First unknown of a joint, of a piece. Ends of an open chain hold their place; on the way to a
  /// calm one those that are free do not.
  int joint_at(std::size_t j) const;
  int piece_at(std::size_t k) const;
  bool held(std::size_t j) const;

  static constexpr double kStiffness = 1e-3;  ///< pull of the lengths to a fifth of the piece

  const ChainData& data_;
  double tolerance_;
  bool free_start_;
  bool free_end_;
  double rim_ = 0;  ///< the tolerance of a calm chain, or a little less
  State now_;
  double price_ = 0;          ///< of room within the tolerance; 0: least squares
  std::vector<double> rest_;  ///< a fifth of each piece's length
};

}  // namespace keyline::fit
