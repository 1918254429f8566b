#include "keyline/fit/bezier_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "keyline/core/polygon.h"
#include "keyline/fit/parametrization.h"
#include "keyline/numeric/solve.h"

namespace keyline::fit {
namespace {

using core::ErrorCode;
using core::Point2;
using core::Vector2;

constexpr double kSliding = 0.0005;  // weight of residuals along the curve

struct Problem {
  std::span<const Point2> samples;
  Vector2 start;  // unit tangents
  Vector2 end;
  double size = 0;
};

/// All Bernstein polynomials of a degree at t.
Eigen::VectorXd bernstein(int degree, double t) {
  Eigen::VectorXd b = Eigen::VectorXd::Zero(degree + 1);
  b[0] = 1;
  for (int r = 1; r <= degree; ++r) {
    for (int j = r; j > 0; --j) b[j] = (1 - t) * b[j] + t * b[j - 1];
    b[0] *= 1 - t;
  }
  return b;
}

/// Normal equations for the handle lengths and the free inner points, the parameters given.
/// Unknowns: length of the first handle, of the last, then x and y of points 2 … degree - 2, these
/// counted from the first point.
struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

/// Where tangents are given, residuals along them count only a little: a foot may slide, and the
/// alternation converges like Gauss-Newton on the distances.
NormalEquations assemble(const Problem& problem, int degree, const std::vector<double>& t,
                         const std::vector<Vector2>& tangents) {
  const int inner = degree - 3;
  const int unknowns = 2 + 2 * inner;
  const Vector2 chord = problem.samples.back() - problem.samples.front();
  NormalEquations n{Eigen::MatrixXd::Zero(unknowns, unknowns), Eigen::VectorXd::Zero(unknowns)};
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2, unknowns);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Eigen::VectorXd b = bernstein(degree, t[i]);
    rows.col(0) << b[1] * problem.start.x, b[1] * problem.start.y;
    rows.col(1) << -b[degree - 1] * problem.end.x, -b[degree - 1] * problem.end.y;
    for (int j = 0; j < inner; ++j) {
      rows(0, 2 + 2 * j) = b[j + 2];
      rows(1, 3 + 2 * j) = b[j + 2];
    }
    const double at_last = b[degree - 1] + b[degree];
    const Vector2 offset = problem.samples[i] - problem.samples.front();
    const Eigen::Vector2d rest(offset.x - at_last * chord.x, offset.y - at_last * chord.y);
    Eigen::Matrix2d frame = Eigen::Matrix2d::Identity();
    if (!tangents.empty()) {
      const Vector2 along = tangents[i];
      frame << kSliding * along.x, kSliding * along.y, -along.y, along.x;
    }
    const Eigen::MatrixXd weighted = frame * rows;
    n.matrix += weighted.transpose() * weighted;
    n.right += weighted.transpose() * (frame * rest);
  }
  n.matrix.diagonal().array() += 1e-13 * n.matrix.trace();
  return n;
}

/// The unknowns; a handle that would turn back is held at the least length.
Eigen::VectorXd solve(NormalEquations n, double least_handle) {
  Eigen::VectorXd x = numeric::solve_symmetric(n.matrix, n.right);
  for (int k = 0; k < 2; ++k) {
    if (x[k] >= least_handle) continue;
    n.right -= n.matrix.col(k) * least_handle;
    n.matrix.row(k).setZero();
    n.matrix.col(k).setZero();
    n.matrix(k, k) = 1;
    n.right[k] = least_handle;
    x = numeric::solve_symmetric(n.matrix, n.right);
  }
  return x;
}

/// Curve of least squares for given parameters of the samples.
curve::Bezier2 best_curve(const Problem& problem, int degree, const std::vector<double>& t,
                          const std::vector<Vector2>& tangents) {
  const Eigen::VectorXd x =
      solve(assemble(problem, degree, t, tangents), 1e-3 * problem.size / degree);
  const Point2 first = problem.samples.front();
  const Point2 last = problem.samples.back();
  curve::Bezier2 result;
  result.control = {first, first + x[0] * problem.start};
  for (Eigen::Index k = 2; k < x.size(); k += 2)
    result.control.push_back(first + Vector2{x[k], x[k + 1]});
  result.control.push_back(last - x[1] * problem.end);
  result.control.push_back(last);
  return result;
}

/// One Newton step to the foot of p, shortened until it comes nearer; the distance then.
double step_to_foot(const curve::Bezier2& c, Point2 p, double& t) {
  const auto j = jet(c, t);
  const Vector2 off = j.point - p;
  const double here = norm(off);
  const double slope = dot(off, j.first);
  double bend = dot(j.first, j.first) + dot(off, j.second);
  if (bend <= 0) bend = dot(j.first, j.first);
  if (!(bend > 0)) return here;
  for (double share = 1; share > 0.1; share /= 2) {
    const double next = std::clamp(t - share * slope / bend, 0.0, 1.0);
    const double there = core::distance(evaluate(c, next), p);
    if (there < here) {
      t = next;
      return there;
    }
  }
  return here;
}

/// Moves every parameter to the foot of its sample; the largest distance.
double correct_feet(const Problem& problem, const curve::Bezier2& c, std::vector<double>& t) {
  double largest = 0;
  for (std::size_t i = 1; i + 1 < t.size(); ++i) {
    double distance = 0;
    for (int step = 0; step < 4; ++step) {
      const double before = t[i];
      distance = step_to_foot(c, problem.samples[i], t[i]);
      if (std::abs(t[i] - before) < 1e-12) break;
    }
    largest = std::max(largest, distance);
  }
  return largest;
}

std::vector<Vector2> tangents_at(const curve::Bezier2& c, const std::vector<double>& t) {
  std::vector<Vector2> result;
  for (const double v : t) {
    const Vector2 d = jet(c, v).first;
    const double length = norm(d);
    result.push_back(length > 0 ? d / length : Vector2{1, 0});
  }
  return result;
}

BezierFit fit_degree(const Problem& problem, int degree, const std::vector<double>& start,
                     const BezierFitOptions& options) {
  BezierFit best;
  best.deviation = std::numeric_limits<double>::infinity();
  std::vector<double> t = start;
  std::vector<Vector2> tangents;
  for (int i = 0; i <= options.iterations; ++i) {
    const curve::Bezier2 c = best_curve(problem, degree, t, tangents);
    const double deviation = correct_feet(problem, c, t);
    if (i >= 2) tangents = tangents_at(c, t);
    if (!(deviation < best.deviation)) continue;
    best = {c, deviation, deviation <= options.tolerance, t};
    if (best.within && i > 2) break;
  }
  return best;
}

}  // namespace

core::Result<BezierFit> fit_bezier(std::span<const Point2> samples, Vector2 start_tangent,
                                   Vector2 end_tangent, const BezierFitOptions& options) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (core::is_finite(samples[i])) continue;
    return core::fail(ErrorCode::bad_input, "a coordinate is not a finite number", "",
                      "points[" + std::to_string(i) + "]");
  }
  const double start = norm(start_tangent);
  const double end = norm(end_tangent);
  if (!(start > 0) || !(end > 0) || !std::isfinite(start) || !std::isfinite(end)) {
    return core::fail(ErrorCode::bad_input, "end tangents must have a direction");
  }
  if (options.lowest_degree < 3 || options.highest_degree > 12 ||
      options.lowest_degree > options.highest_degree || !(options.tolerance >= 0)) {
    return core::fail(ErrorCode::bad_input,
                      "degrees must lie in 3 … 12, the tolerance be positive");
  }
  const std::vector<double> t = parametrize(samples, Parametrization::chord);
  if (t.empty())
    return core::fail(ErrorCode::bad_input, "at least two different points are needed");
  const Problem problem{samples, start_tangent / start, end_tangent / end,
                        core::polygon_length(samples)};
  BezierFit best;
  best.deviation = std::numeric_limits<double>::infinity();
  for (int degree = options.lowest_degree; degree <= options.highest_degree; ++degree) {
    BezierFit fit = fit_degree(problem, degree, t, options);
    if (fit.deviation < best.deviation) best = std::move(fit);
    if (best.within) break;
  }
  return best;
}

}  // namespace keyline::fit
