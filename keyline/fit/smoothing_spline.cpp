#include "keyline/fit/smoothing_spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/SparseCore>

#include "keyline/fit/spline_band.h"
#include "keyline/numeric/halving.h"
#include "keyline/numeric/parallel.h"
#include "keyline/numeric/solve.h"

namespace keyline::fit {
namespace {

constexpr int kMostSpans = 1000;
constexpr int kHalvings = 18;
// Of the distances between points: chord length, and centripetal and even ones, which have more
// knots where points are dense.
constexpr std::array kPowers{1.0, 0.5, 0.0};
constexpr double kStiffest = 12;  // decimal logarithms of the penalty that are searched
constexpr double kSoftest = -12;
constexpr int kSamplesPerSpan = 16;

using Basis = std::array<double, 6>;

/// The six quintic B-splines of even knots that are not 0 at a place u in [0, 1] of their span, or
/// their derivatives, by de Boor's recurrence.
Basis basis(double u, int derivative) {
  Basis b{1, 0, 0, 0, 0, 0};
  const int degree = 5 - derivative;
  for (int d = 1; d <= degree; ++d)
    for (int j = d; j >= 0; --j) {
      const double rising = j > 0 ? (u + d - j) / d * b[j - 1] : 0;
      const double falling = j < d ? (j + 1 - u) / d * b[j] : 0;
      b[j] = rising + falling;
    }
  // Here b[j] belongs to the j-th spline from the left; derivatives are differences of lower ones.
  for (int k = 0; k < derivative; ++k)
    for (int j = degree + k + 1; j >= 0; --j) {
      const double left = j > 0 ? b[j - 1] : 0;
      const double right = j <= degree + k ? b[j] : 0;
      b[j] = left - right;
    }
  return b;
}

class Smoother {
 public:
  /// power: of the points' distances, by whose sums the parameter runs.
  Smoother(std::span<const core::Point2> points, bool closed, double power)
      : points_(points), closed_(closed) {
    const auto gap = [&](std::size_t from, std::size_t to) {
      const double d = core::distance(points[from], points[to]);
      return d > 0 ? std::pow(d, power) : 0;
    };
    at_.push_back(0);
    for (std::size_t i = 1; i < points.size(); ++i) at_.push_back(at_.back() + gap(i - 1, i));
    total_ = at_.back() + (closed ? gap(points.size() - 1, 0) : 0);
    spans_ = std::clamp(static_cast<int>(2 * points.size()), 16, kMostSpans);
    count_ = closed ? spans_ : spans_ + 5;
    gather();
  }

  bool sound() const { return total_ > 0; }

  bool within(double penalty, double tolerance) {
    return solve(penalty) &&
           band_.holds(points_.size(), [&](std::size_t i) { return farther(i, tolerance); });
  }

  /// The coefficients as they stand are those of the graph.
  void keep() {
    kept_x_ = x_;
    kept_y_ = y_;
  }

  curve::CurvatureGraph graph_of_kept() {
    x_ = kept_x_;
    y_ = kept_y_;
    curve::CurvatureGraph graph;
    core::Point2 last = at(0, 0);
    double s = 0;
    for (int i = 0; i <= spans_ * kSamplesPerSpan; ++i) {
      const double t = static_cast<double>(i) / kSamplesPerSpan;
      const core::Point2 p = at(t, 0);
      const auto [dx, dy] = at(t, 1);
      const auto [ddx, ddy] = at(t, 2);
      s += core::distance(last, p);
      last = p;
      const double speed = std::hypot(dx, dy);
      graph.arc_length.push_back(s);
      graph.curvature.push_back((dx * ddy - dy * ddx) / (speed * speed * speed));
    }
    return graph;
  }

 private:
  int span(double t) const { return std::clamp(static_cast<int>(t), 0, spans_ - 1); }
  int index(int i) const { return closed_ ? i % count_ : i; }

  core::Point2 at(double t, int derivative) const {
    const int k = span(t);
    return sum_of(k, basis(t - k, derivative));
  }

  core::Point2 sum_of(int k, const Basis& b) const {
    core::Point2 sum{0, 0};
    for (int j = 0; j < 6; ++j) {
      sum.x += b[j] * x_(index(k + j));
      sum.y += b[j] * y_(index(k + j));
    }
    return sum;
  }

  double place(std::size_t i) const { return at_[i] / total_ * spans_; }

  bool farther(std::size_t i, double tolerance) const {
    const double t = place(i);
    return detail::farther_than(
        tolerance, points_[i], t, sum_of(span(t), basis_[i]),
        {.end = static_cast<double>(spans_), .closed = closed_}, [&](double u) { return at(u, 0); },
        [&](double u) {
          const auto [dx, dy] = at(u, 1);
          return core::Vector2{dx, dy};
        });
  }

  /// What the points ask of the coefficients, whatever the penalty.
  void gather() {
    normal_.assign(spans_, {});
    right_x_ = Eigen::VectorXd::Zero(count_);
    right_y_ = Eigen::VectorXd::Zero(count_);
    if (!sound()) return;
    basis_.reserve(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const int k = span(place(i));
      const Basis& b = basis_.emplace_back(basis(place(i) - k, 0));
      for (int j = 0; j < 6; ++j) {
        for (int l = 0; l < 6; ++l) normal_[k][j][l] += b[j] * b[l];
        right_x_(index(k + j)) += b[j] * points_[i].x;
        right_y_(index(k + j)) += b[j] * points_[i].y;
      }
    }
  }

  bool solve(double penalty) {
    if (!matrix_.nonZeros()) lay_out();
    std::copy_n(data_.data(), data_.size(), matrix_.valuePtr());
    auto place = penalised_.begin();
    each_penalised(
        [&](int, int, double a, double b) { matrix_.valuePtr()[*place++] += penalty * a * b; });
    factor_.renew(matrix_);
    if (!factor_) return false;
    x_ = factor_.solve(right_x_);
    y_ = factor_.solve(right_y_);
    return x_.allFinite() && y_.allFinite();
  }

  /// Where the matrix has entries, what the points add to them, and which of them the penalty.
  void lay_out() {
    std::vector<Eigen::Triplet<double>> entries;
    for (int k = 0; k < spans_; ++k)
      for (int j = 0; j < 6; ++j)
        for (int l = 0; l < 6; ++l)
          entries.emplace_back(index(k + j), index(k + l), normal_[k][j][l]);
    matrix_.resize(count_, count_);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    data_.assign(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros());
    each_penalised([&](int row, int column, double, double) {
      penalised_.push_back(&matrix_.coeffRef(row, column) - matrix_.valuePtr());
    });
  }

  /// Squares of third differences of the coefficients.
  template <class Visit>
  void each_penalised(Visit visit) const {
    constexpr std::array<double, 4> kThird{-1, 3, -3, 1};
    for (int i = 0; i + (closed_ ? 0 : 3) < count_; ++i)
      for (int j = 0; j < 4; ++j)
        for (int l = 0; l < 4; ++l) visit(index(i + j), index(i + l), kThird[j], kThird[l]);
  }

  std::span<const core::Point2> points_;
  bool closed_;
  std::vector<double> at_;
  double total_ = 0;
  int spans_ = 0;
  int count_ = 0;
  std::vector<Basis> basis_;                  ///< of every point's parameter
  std::vector<std::array<Basis, 6>> normal_;  ///< of every span: products of its splines
  Eigen::SparseMatrix<double> matrix_;
  std::vector<double> data_;               ///< its entries without the penalty
  std::vector<std::ptrdiff_t> penalised_;  ///< numbers of its entries, as each_penalised visits
  Eigen::VectorXd right_x_;
  Eigen::VectorXd right_y_;
  Eigen::VectorXd x_;
  Eigen::VectorXd y_;
  Eigen::VectorXd kept_x_;
  Eigen::VectorXd kept_y_;
  numeric::SparseSymmetric factor_;
  detail::Band band_;
};

/// The smoothest with that parameter.
std::optional<curve::CurvatureGraph> smoothest(std::span<const core::Point2> points, bool closed,
                                               double tolerance, double power) {
  Smoother smoother(points, closed, power);
  if (!smoother.sound()) return std::nullopt;
  const auto is_kept = [&](double log_penalty) {
    const bool kept = smoother.within(std::pow(10, log_penalty), tolerance);
    if (kept) smoother.keep();
    return kept;
  };
  if (numeric::last_that_holds(is_kept, kSoftest, kStiffest, kHalvings) == kSoftest)
    return std::nullopt;
  return smoother.graph_of_kept();
}

}  // namespace

std::optional<curve::CurvatureGraph> smoothing_spline_curvature(
    std::span<const core::Point2> points, bool closed, double tolerance, int threads) {
  if (points.size() < 3) return std::nullopt;
  std::array<std::optional<curve::CurvatureGraph>, kPowers.size()> all;
  numeric::parallel_for(all.size(), threads, [&](std::size_t i) {
    all[i] = smoothest(points, closed, tolerance, kPowers[i]);
  });
  std::optional<curve::CurvatureGraph> best;
  for (auto& found : all)
    if (found && (!best || variation(*found) < variation(*best))) best = std::move(found);
  return best;
}

}  // namespace keyline::fit
