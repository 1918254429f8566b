#pragma once

#include <vector>

#include <Eigen/Core>

#include "keyline/core/interval.h"
#include "keyline/fairing/chain_fit.h"
#include "keyline/fairing/evaluation.h"

/// A chain of log-aesthetic pieces whose joints' rates are to be one, and its linear model.
namespace keyline::fairing::detail {

/// Logarithms of |d curvature / ds| at both ends of a piece between two curvatures, neither of
/// which is the other; an end of curvature 0 has none that counts.
struct EndRates {
  double start = 0;
  double end = 0;
};
EndRates log_rates(double curvature_start, double curvature_end, double alpha, double length);

/// A joint through which curvature runs one way.
struct RateJoint {
  int before = 0;  ///< the pieces that it is between
  int after = 0;
  bool tied = false;  ///< the rate is held to be one
};
std::vector<RateJoint> rate_joints(const FitChain& chain);

/// Where each unknown stands: pose of the start, logarithms of the joints' curvatures, logarithms
/// of the pieces' lengths, their slopes.
struct RateUnknowns {
  explicit RateUnknowns(const FitChain& chain);
  int joint(int j) const { return 3 + (closed && j == pieces ? 0 : j); }
  int length(int p) const { return 3 + joints + p; }
  int slope(int p) const { return 3 + joints + pieces + p; }
  int count() const { return 3 + joints + 2 * pieces; }
  int pieces = 0;
  int joints = 0;
  bool closed = false;
};

/// An unknown, or the difference of two, that stays above a bound.
struct RateLimit {
  int more = 0;
  int less = -1;
  double sign = 1;
  double room = 0;  ///< that is left
  double change(const Eigen::VectorXd& step) const {
    return sign * (step(more) - (less < 0 ? 0 : step(less)));
  }
};

/// What counts in a solve.
struct RateWeights {
  double tolerance = 0;
  double energy = 1;  ///< unit of the variation
  double band = 1;    ///< of the mean square of the band's excess
  double power = 4;   ///< with which offsets count in it
  double jump = 0;    ///< of the sum of the rates' jumps
  double even = 0.1;  ///< jumps below this count by their squares
};

/// What all models of one solve share.
struct RateProblem {
  const std::vector<FitPoint>* points = nullptr;
  std::vector<RateJoint> joints;
  std::vector<core::Interval> slopes;  ///< of the pieces
  std::vector<double> growth;          ///< of their |curvature|: 1 or -1, which stays
  RateWeights weights;
  std::vector<double> price;  ///< of the points' excess, each by itself; empty: all 1
  FitJoint end;               ///< where a held end is held
};

/// A chain as it stands: what it costs and how that changes.
class RateModel {
 public:
  RateModel(FitChain chain, const RateProblem& problem);

  /// Costs, gaps and limits, the feet moved home first.
  void look();
  /// Rows of the least squares and of the equations.
  void linearise();
  /// What else the unknowns have to make up for, by the gaps of a chain nearby.
  void take_gaps_of(const RateModel& other);

  FitChain moved(const Eigen::VectorXd& step, double share) const;

  FitChain chain;
  double cost = 0;             ///< without the limits' barrier
  double gaps = 0;             ///< between pieces, in tolerances, and of tied rates
  double max_offset = 0;       ///< in tolerances
  std::vector<double> offset;  ///< of the points, likewise
  double variation = 0;        ///< in the unit of the weights
  std::vector<double> jump;
  std::vector<RateLimit> limits;
  bool sound = true;

  Eigen::MatrixXd rows;      ///< of the least squares, by the unknowns
  Eigen::VectorXd value;     ///< theirs
  Eigen::VectorXd shift;     ///< what they change by where gaps close
  Eigen::MatrixXd equation;  ///< of what has to be met, by the unknowns
  Eigen::VectorXd miss;
  RateUnknowns unknowns;

 private:
  void look_at_pieces();
  void look_at_points();
  void look_at_gaps();
  void add_limits();
  void condense();
  void add_point(std::size_t j);
  double price_of(std::size_t j) const;
  void add_piece(int p);
  void add_jump(std::size_t k, Eigen::Ref<Eigen::MatrixXd> out, int row, double by) const;
  void set_equations();
  void scatter(Eigen::RowVectorXd& row, int piece, const Vector7& by) const;

  const RateProblem* problem_;
  std::vector<Stage> stages_;
  std::vector<Evaluation::PointRow> spots_;
  std::vector<double> energy_;               ///< roots of the pieces'
  std::vector<Eigen::Matrix3Xd> by_;         ///< of the joints' poses by the unknowns
  std::vector<Eigen::Vector3d> pose_shift_;  ///< what they change by where gaps close
  Eigen::Vector3d seam_ = Eigen::Vector3d::Zero();
};

}  // namespace keyline::fairing::detail
