#include "keyline/fairing/one_piece.h"

#include <algorithm>
#include <cmath>

#include "keyline/fairing/evaluation.h"
#include "keyline/fairing/local_pose.h"
#include "keyline/numeric/levenberg_marquardt.h"

namespace keyline::fairing::detail {
namespace {

constexpr int kFootSteps = 4;
constexpr double kReach = 0.1;     // of the length: points that an end's first pose is read from
constexpr double kClothoid = -1;   // slope
constexpr double kShortest = 0.5;  // of the points' length: no piece through them is shorter
constexpr int kUnknowns = 7;       // those of a stage

/// The least-squares problem. All lengths are parts of the points' length.
class Problem {
 public:
  explicit Problem(const std::vector<FitPoint>& points) : origin_(points.front().position) {
    const Track track = make_track(points, false);
    size_ = track.total;
    for (const FitPoint& p : points) {
      const core::Vector2 to = (p.position - origin_) / size_;
      points_.push_back({.position = {to.x, to.y}});
    }
    const Track scaled = make_track(points_, false);
    start_.joints = {local_pose(scaled, 0, kReach), local_pose(scaled, 1, kReach)};
    start_.pieces = {{.length = 1, .alpha = kClothoid}};
    start_.first_at_start = start_.last_at_end = true;
    for (const double at : scaled.position) start_.feet.push_back({0, std::min(at, 1.0)});
    start_.feet.back().fraction = 1;
    const FitJoint& joint = start_.joints[0];
    x_.resize(kUnknowns);
    x_[kX] = joint.position.x;
    x_[kY] = joint.position.y;
    x_[kDirection] = joint.direction;
    x_[kCurvature] = joint.curvature;
    x_[kNextCurvature] = start_.joints[1].curvature;
    x_[kLengthAt] = 1;
    x_[kAlphaAt] = kClothoid;
  }

  /// A clothoid first: from a rough start the slope would follow what the ends do not meet yet.
  OnePiece run() {
    fit(kClothoid, kClothoid);
    fit(-kSteepestSlope, kSteepestSlope);
    return found();
  }

 private:
  void fit(double least_slope, double most_slope) {
    numeric::LevenbergMarquardtOptions options;
    options.low = Eigen::VectorXd::Constant(kUnknowns, -HUGE_VAL);
    options.high = -options.low;
    options.low[kAlphaAt] = least_slope;
    options.high[kAlphaAt] = most_slope;
    options.low[kLengthAt] = kShortest;
    numeric::minimize_least_squares(
        [this](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
          return residuals(x, r, jacobian);
        },
        x_, options);
  }

  FitChain drawn(const Eigen::VectorXd& x) const {
    FitChain chain = start_;
    chain.joints[0] = {{x[kX], x[kY]}, x[kDirection], x[kCurvature]};
    chain.joints[1].curvature = x[kNextCurvature];
    chain.pieces[0].length = x[kLengthAt];
    chain.pieces[0].alpha = x[kAlphaAt];
    return chain;
  }

  /// The chain evaluated with its feet at home.
  Evaluation evaluated(FitChain& chain) const {
    Evaluation evaluation(chain, points_, fine_);
    for (int step = 0; step < kFootSteps; ++step) evaluation.move_feet();
    return evaluation;
  }

  bool residuals(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) const {
    if (x[kCurvature] * x[kNextCurvature] <= 0 && x[kAlphaAt] >= 0) return false;  // no such piece
    FitChain chain = drawn(x);
    const Evaluation evaluation = evaluated(chain);
    const auto n = static_cast<Eigen::Index>(points_.size());
    r.resize(n + 2);
    if (jacobian) jacobian->resize(n + 2, kUnknowns);
    const auto take = [&](Eigen::Index at, double value, const Vector7& by) {
      r[at] = value;
      if (jacobian) jacobian->row(at) = by.transpose();
    };
    for (Eigen::Index i = 0; i < n; ++i) {
      const Evaluation::PointRow row = evaluation.row(static_cast<std::size_t>(i));
      take(i, row.across, row.by_across);
      if (i == 0) take(n, row.along, row.by_along);
      if (i == n - 1) take(n + 1, row.along, row.by_along);
    }
    return r.allFinite();
  }

  OnePiece found() const {
    OnePiece one{drawn(x_)};
    const Evaluation evaluation = evaluated(one.chain);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Evaluation::PointRow row = evaluation.row(i);
      one.off = std::max(one.off, size_ * std::hypot(row.across, row.along));
    }
    FitJoint& start = one.chain.joints[0];
    start.position = origin_ + size_ * core::Vector2{start.position.x, start.position.y};
    for (FitJoint& joint : one.chain.joints) joint.curvature /= size_;
    one.chain.pieces[0].length *= size_;
    const core::Pose2 end = lac::end_pose(one.segment());
    one.chain.joints[1].position = end.position;
    one.chain.joints[1].direction = end.direction;
    return one;
  }

  core::Point2 origin_;
  double size_ = 1;
  std::vector<FitPoint> points_;  ///< from the first, parts of the length
  FitChain start_;                ///< with the feet that every evaluation sets out from
  ChainFitOptions fine_{.fine = true};
  Eigen::VectorXd x_;
};

}  // namespace

lac::Segment OnePiece::segment() const {
  const FitJoint& start = chain.joints[0];
  const FitPiece& piece = chain.pieces[0];
  return {{start.position, start.direction},
          piece.alpha,
          piece.length,
          start.curvature,
          chain.joints[1].curvature};
}

OnePiece fit_one_piece(const std::vector<FitPoint>& points) { return Problem(points).run(); }

}  // namespace keyline::fairing::detail
