#include "keyline/sketch/calm_quintics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include <Eigen/SparseCore>

#include "keyline/analysis/comb_figures.h"
#include "keyline/core/polygon.h"
#include "keyline/fit/quintic_chain.h"
#include "keyline/numeric/halving.h"
#include "keyline/numeric/solve.h"

namespace keyline::sketch {
namespace {

using core::Point2;
using core::Vector2;
using Matrix = Eigen::SparseMatrix<double>;

constexpr double kSmoothShare = 0.8;  ///< of what may be moved: by smoothing …
constexpr double kFitShare = 0.05;    ///< … and by fitting quintics to that
constexpr double kHeldEnd = 1e6;      ///< weight of ends that stay
constexpr double kShortest = 4;       ///< points: wavelength that nothing is lost with
constexpr int kHalvings = 14;         ///< of the wavelength's range: within 0.1 %
constexpr int kSamples = 32;          ///< of a piece
constexpr int kMostPieces = 48;       ///< of a stroke at most

/// Points under a penalty on their third differences.
class Smoother {
 public:
  Smoother(const std::vector<Point2>& points, bool closed) : n_(Index(points.size())) {
    const std::array<double, 4> row = {-1, 3, -3, 1};
    std::vector<Eigen::Triplet<double>> entries;
    const Index rows = closed ? n_ : n_ - 3;
    for (Index i = 0; i < rows; ++i)
      for (Index k = 0; k < 4; ++k)
        entries.emplace_back(i, (i + k) % n_, row[static_cast<std::size_t>(k)]);
    difference_.resize(rows, n_);
    difference_.setFromTriplets(entries.begin(), entries.end());
    penalty_ = difference_.transpose() * difference_;
    pull_ = Eigen::MatrixX2d::Zero(n_, 2);
    weight_ = Eigen::VectorXd::Ones(n_);
    if (!closed) weight_[0] = weight_[n_ - 1] = kHeldEnd;
    given_.resize(n_, 2);
    for (Index i = 0; i < n_; ++i) {
      given_(i, 0) = points[static_cast<std::size_t>(i)].x;
      given_(i, 1) = points[static_cast<std::size_t>(i)].y;
    }
  }

  /// Third differences that are wanted, from the first point on; 0 unless set.
  void want(const std::vector<Vector2>& third) {
    Eigen::MatrixX2d all(difference_.rows(), 2);
    for (Index i = 0; i < all.rows(); ++i)
      all.row(i) << third[static_cast<std::size_t>(i)].x, third[static_cast<std::size_t>(i)].y;
    pull_ = difference_.transpose() * all;
  }

  /// Waves of that many points are halved.
  std::vector<Point2> smooth(double wavelength) {
    const double lambda = std::pow(wavelength / (2 * std::numbers::pi), 6);
    solver_.renew(system(lambda));
    const Eigen::MatrixXd z =
        solver_.solve(Eigen::MatrixXd(weight_.asDiagonal() * given_ + lambda * pull_));
    std::vector<Point2> points;
    for (Index i = 0; i < n_; ++i) points.push_back({z(i, 0), z(i, 1)});
    return points;
  }

 private:
  using Index = Eigen::Index;
  Matrix system(double lambda) const {
    Matrix all = lambda * penalty_;
    for (Index i = 0; i < n_; ++i) all.coeffRef(i, i) += weight_[i];
    return all;
  }

  Index n_;
  Matrix difference_;
  Matrix penalty_;
  Eigen::MatrixX2d pull_;
  Eigen::VectorXd weight_;
  Eigen::MatrixX2d given_;
  numeric::SparseSymmetric solver_;
};

double largest_move(const std::vector<Point2>& a, const std::vector<Point2>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, core::distance(a[i], b[i]));
  return most;
}

/// The smoothest points that lie within `most` of the given ones.
std::vector<Point2> calmed(const std::vector<Point2>& points, Smoother& smoother, double most) {
  std::vector<Point2> best = points;
  const auto stays_near = [&](double log_wavelength) {
    std::vector<Point2> smooth = smoother.smooth(std::exp(log_wavelength));
    const bool near = largest_move(smooth, points) <= most;
    if (near) best = std::move(smooth);
    return near;
  };
  const double longest = 4 * static_cast<double>(points.size()) + kShortest;
  numeric::last_that_holds(stays_near, std::log(kShortest), std::log(longest), kHalvings);
  return best;
}

/// Third differences of a line that goes as the points do, with that curvature: by the length,
/// p''' = κ' n - κ² t.
std::vector<Vector2> third_differences(const std::vector<Point2>& points, bool closed,
                                       const std::vector<double>& curvature) {
  const std::size_t n = points.size();
  const double step =
      core::polygon_length(points, closed) / static_cast<double>(closed ? n : n - 1);
  std::vector<Vector2> third;
  for (std::size_t i = 0; i < (closed ? n : n - 3); ++i) {
    const std::size_t b = (i + 1) % n;
    const std::size_t c = (i + 2) % n;
    const Vector2 way = points[(i + 3) % n] - points[i];
    const Vector2 tangent = way / std::max(core::norm(way), 1e-300);
    const double middle = 0.5 * step * (curvature[b] + curvature[c]);
    third.push_back(step *
                    ((step * (curvature[c] - curvature[b])) * core::perpendicular_left(tangent) -
                     (middle * middle) * tangent));
  }
  return third;
}

curve::CurvatureGraph graph_of(const std::vector<curve::Bezier2>& pieces) {
  curve::CurvatureGraph graph;
  double length = 0;
  for (const curve::Bezier2& piece : pieces)
    for (int k = 0; k <= kSamples; ++k) {
      const double t = static_cast<double>(k) / kSamples;
      if (k > 0) length += core::distance(evaluate(piece, t - 1.0 / kSamples), evaluate(piece, t));
      graph.arc_length.push_back(length);
      graph.curvature.push_back(curvature(jet(piece, t)));
    }
  return graph;
}

std::vector<Point2> places_of(const std::vector<curve::Bezier2>& pieces, bool closed) {
  std::vector<Point2> places;
  for (const curve::Bezier2& piece : pieces)
    for (int k = 0; k < kSamples; ++k)
      places.push_back(evaluate(piece, static_cast<double>(k) / kSamples));
  if (!closed) places.push_back(evaluate(pieces.back(), 1));
  return places;
}

analysis::CombFigures comb_of(const std::vector<curve::Bezier2>& pieces) {
  return analysis::comb_figures(graph_of(pieces));
}

/// Less of it is calmer.
std::tuple<int, double> unrest(const std::vector<curve::Bezier2>& pieces) {
  const analysis::CombFigures comb = comb_of(pieces);
  return {comb.waves, comb.energy};
}

}  // namespace

CalmQuintics calm_quintics(const std::vector<Point2>& points, bool closed, double most,
                           const std::vector<curve::Bezier2>& given) {
  if (points.size() < 8) return {};
  auto chain = fit::fit_quintic_chain(points, closed, {most, kMostPieces, true});
  if (!chain.within_tolerance || unrest(chain.pieces) >= unrest(given)) return {};
  std::vector<Point2> line = places_of(chain.pieces, closed);
  return {std::move(chain.pieces), std::move(line)};
}

CalmQuintics quintics_towards(const std::vector<Point2>& points, bool closed, double most,
                              const std::vector<double>& curvature) {
  if (points.size() < 8) return {};
  // directions are read where the hand's waves are gone
  Smoother smoother(points, closed);
  const auto calm = calmed(points, smoother, 0.5 * kSmoothShare * most);
  smoother.want(third_differences(calm, closed, curvature));
  CalmQuintics made{{}, calmed(points, smoother, kSmoothShare * most)};
  auto chain = fit::fit_quintic_chain(made.line, closed, {kFitShare * most, kMostPieces, true});
  if (!chain.within_tolerance) return {};
  made.pieces = std::move(chain.pieces);
  return made;
}

int waves_of(const std::vector<curve::Bezier2>& pieces) { return comb_of(pieces).waves; }

}  // namespace keyline::sketch
