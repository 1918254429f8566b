#include "keyline/fairing/one_piece.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/fairing/local_pose.h"
#include "keyline/lac/segment/sensitivity.h"
#include "keyline/numeric/levenberg_marquardt.h"

namespace keyline::fairing::detail {
namespace {

using core::Vector2;

constexpr int kFootSteps = 4;
constexpr double kReach =
    0.1;  // of the length, of the points that an end's first pose is read from
constexpr double kClothoid = -1;  // slope
constexpr double kShortest =
    0.5;                      // of the points' length, which no piece through them is shorter than
constexpr int kUnknowns = 7;  // place, direction, curvatures of both ends, length, slope
constexpr int kPlaceAt = 0, kDirectionAt = 2, kPieceAt = 3;

/// The least-squares problem. All lengths are parts of the points' length.
class Problem {
 public:
  explicit Problem(const std::vector<FitPoint>& points)
      : track_(make_track(points, false)), size_(track_.total) {
    for (const FitPoint& p : points) points_.push_back((p.position - points[0].position) / size_);
    const FitJoint start = local_pose(track_, 0, kReach * size_);
    const FitJoint end = local_pose(track_, size_, kReach * size_);
    const Vector2 place = (start.position - points[0].position) / size_;
    x_.resize(kUnknowns);
    x_ << place.x, place.y, start.direction, size_ * start.curvature, size_ * end.curvature, 1,
        kClothoid;
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
    options.low[kPieceAt + lac::kAlpha] = least_slope;
    options.high[kPieceAt + lac::kAlpha] = most_slope;
    options.low[kPieceAt + lac::kLength] = kShortest;
    numeric::minimize_least_squares(
        [this](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
          return residuals(x, r, jacobian);
        },
        x_, options);
  }

  static bool drawable(const Eigen::VectorXd& x) {
    const double a = x[kPieceAt + lac::kCurvatureStart];
    const double b = x[kPieceAt + lac::kCurvatureEnd];
    return a * b > 0 || x[kPieceAt + lac::kAlpha] < 0;
  }

  lac::PieceTable table(const Eigen::VectorXd& x) const {
    lac::PieceTable made;
    made.build(x[kPieceAt + lac::kCurvatureStart], x[kPieceAt + lac::kCurvatureEnd],
               x[kPieceAt + lac::kLength], x[kPieceAt + lac::kAlpha], true);
    return made;
  }

  /// Point i in the frame of the piece's start.
  Vector2 local(const Eigen::VectorXd& x, std::size_t i) const {
    const Vector2 along = core::unit_vector(x[kDirectionAt]);
    const Vector2 d = points_[i] - Vector2{x[kPlaceAt], x[kPlaceAt + 1]};
    return {dot(d, along), cross(along, d)};
  }

  /// Fraction of the length at which the piece is nearest to its i-th point; the ends' are its own.
  double foot(const lac::PieceTable& piece, Vector2 p, std::size_t i) const {
    if (i == 0) return 0;
    if (i + 1 == points_.size()) return 1;
    double v = track_.position[i] / size_;
    for (int step = 0; step < kFootSteps; ++step) {
      const lac::PieceTable::Place at = piece.place(v);
      const Vector2 d = p - Vector2{at.x, at.y};
      const Vector2 t = core::unit_vector(at.angle);
      const double bent = 1 - piece.curvature(v) * cross(t, d);
      v += dot(d, t) / (piece.length() * std::max(bent, 0.5));
      v = std::clamp(v, 0.0, 1.0);
    }
    return v;
  }

  bool residuals(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) const {
    if (!drawable(x)) return false;
    const lac::PieceTable piece = table(x);
    const Vector2 along = core::unit_vector(x[kDirectionAt]);
    const auto n = static_cast<Eigen::Index>(points_.size());
    r.resize(n + 2);
    if (jacobian) jacobian->setZero(n + 2, kUnknowns);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Vector2 p = local(x, i);
      const lac::PieceTable::Value at = piece.at(foot(piece, p, i));
      const Vector2 t = core::unit_vector(at.angle);
      const Vector2 d{at.x - p.x, at.y - p.y};
      const auto row = [&](Eigen::Index k, Vector2 against) {
        r[k] = dot(against, d);
        if (!jacobian) return;
        const Vector2 outer = against.x * along + against.y * core::perpendicular_left(along);
        (*jacobian)(k, kPlaceAt) = outer.x;
        (*jacobian)(k, kPlaceAt + 1) = outer.y;
        (*jacobian)(k, kDirectionAt) = dot(against, core::perpendicular_left(p));
        for (int q = 0; q < lac::kPieceVariables; ++q)
          (*jacobian)(k, kPieceAt + q) = against.x * at.dx[q] + against.y * at.dy[q];
      };
      row(i, core::perpendicular_left(t));
      if (i == 0) row(n, t);
      if (i == n - 1) row(n + 1, t);
    }
    return r.allFinite();
  }

  OnePiece found() const {
    OnePiece one;
    const lac::PieceTable piece = table(x_);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vector2 p = local(x_, i);
      one.feet.push_back(foot(piece, p, i));
      const lac::PieceTable::Place at = piece.place(one.feet.back());
      one.off = std::max(one.off, size_ * norm(p - Vector2{at.x, at.y}));
    }
    const core::Point2 start =
        track_.points[0].position + size_ * Vector2{x_[kPlaceAt], x_[kPlaceAt + 1]};
    one.segment = {{start, x_[kDirectionAt]},
                   x_[kPieceAt + lac::kAlpha],
                   size_ * x_[kPieceAt + lac::kLength],
                   x_[kPieceAt + lac::kCurvatureStart] / size_,
                   x_[kPieceAt + lac::kCurvatureEnd] / size_};
    return one;
  }

  Track track_;
  double size_;
  std::vector<Vector2> points_;  ///< from the first, parts of the length
  Eigen::VectorXd x_;
};

}  // namespace

OnePiece fit_one_piece(const std::vector<FitPoint>& points) { return Problem(points).run(); }

}  // namespace keyline::fairing::detail
