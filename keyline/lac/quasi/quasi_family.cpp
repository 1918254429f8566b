#include "keyline/lac/quasi/quasi_family.h"

#include <algorithm>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/numeric/binomials.h"
#include "keyline/numeric/solve.h"

namespace keyline::lac::detail {

using core::Vector2;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

using Row = Basis::Row;

constexpr const auto& kBinomials = numeric::kBinomials<curve::kMaxBezierDegree>;

}  // namespace

Basis::Basis(int n, double t) {
  Row rising, falling;
  rising[0] = falling[0] = 1;
  for (int i = 1; i <= n; ++i) {
    rising[i] = rising[i - 1] * t;
    falling[i] = falling[i - 1] * (1 - t);
  }
  double before = 0;  // of the degree below
  for (int i = 0; i <= n; ++i) {
    const double now = i < n ? kBinomials[n - 1][i] * rising[i] * falling[n - 1 - i] : 0;
    value[i] = (1 - t) * now + t * before;
    slope[i] = n * (before - now);
    before = now;
  }
}

Vector2 combine(const Basis::Row& weights, const ControlPolygon& b) {
  Vector2 v;
  for (std::size_t i = 0; i < b.size(); ++i) v = v + weights[i] * b[i];
  return v;
}

Family::Family(const UnitPiece& unit, int degree, bool curvatures_held)
    : unit_(unit),
      n_(degree),
      first_held_(curvatures_held && std::isfinite(unit.piece.curvature_start)),
      last_held_(curvatures_held && std::isfinite(unit.piece.curvature_end)),
      end_(displacement(unit.piece, 1)),
      end_tangent_(core::unit_vector(unit.turning)) {}

ControlPolygon Family::polygon(const VectorXd& x) const {
  ControlPolygon b(n_ + 1);
  const double bend = n_ / (n_ - 1.0);
  const double first =
      first_held_ ? bend * unit_.piece.curvature_start * x[0] * x[0] : x[first_across()];
  const double last =
      last_held_ ? bend * unit_.piece.curvature_end * x[2] * x[2] : x[last_across()];
  b[1] = {x[0], 0};
  b[2] = {x[1], first};
  for (int i = 3; i < n_ - 2; ++i) b[i] = {x[4 + 2 * (i - 3)], x[5 + 2 * (i - 3)]};
  b[n_] = end_;
  b[n_ - 1] = end_ - x[2] * end_tangent_;
  b[n_ - 2] = end_ - x[3] * end_tangent_ + last * core::perpendicular_left(end_tangent_);
  return b;
}

Vector2 Family::change(const VectorXd& x, const Basis::Row& w, int k) const {
  const double bend = 2 * n_ / (n_ - 1.0);
  const double first_bend = first_held_ ? bend * unit_.piece.curvature_start : 0;
  const double last_bend = last_held_ ? bend * unit_.piece.curvature_end : 0;
  const Vector2 normal = core::perpendicular_left(end_tangent_);
  switch (k) {
    case 0:
      return {w[1], w[2] * first_bend * x[0]};
    case 1:
      return {w[2], 0};
    case 2:
      return -w[n_ - 1] * end_tangent_ + (w[n_ - 2] * last_bend * x[2]) * normal;
    case 3:
      return -w[n_ - 2] * end_tangent_;
    default:
      break;
  }
  if (!first_held_ && k == first_across()) return {0, w[2]};
  if (!last_held_ && k == last_across()) return w[n_ - 2] * normal;
  const double at = w[3 + (k - 4) / 2];
  return k % 2 == 0 ? Vector2{at, 0} : Vector2{0, at};
}

VectorXd Family::nearest(const ControlPolygon& polygon) const {
  const Vector2 from = polygon.front();
  const Vector2 off = end_ - (polygon.back() - from);
  const auto moved = [&](int i) { return polygon[i] - from + (i / double(n_)) * off; };
  VectorXd x(unknowns());
  x[0] = std::max(moved(1).x, 2 * kShortestHandle);
  x[1] = moved(2).x;
  x[2] = std::max(dot(end_ - moved(n_ - 1), end_tangent_), 2 * kShortestHandle);
  x[3] = dot(end_ - moved(n_ - 2), end_tangent_);
  for (int i = 3; i < n_ - 2; ++i) {
    const Vector2 b = moved(i);
    x[4 + 2 * (i - 3)] = b.x;
    x[5 + 2 * (i - 3)] = b.y;
  }
  if (!first_held_) x[first_across()] = moved(2).y;
  if (!last_held_) x[last_across()] = cross(end_tangent_, moved(n_ - 2) - end_);
  return x;
}

VectorXd Family::start(double first, double last, const std::vector<double>& at,
                       const std::vector<Vector2>& points, double& miss) const {
  VectorXd x = VectorXd::Zero(unknowns());
  x[0] = first;
  x[2] = last;
  const ControlPolygon fixed = polygon(x);
  const int rows = static_cast<int>(at.size());
  const int columns = unknowns() - 2;
  const auto unknown = [](int column) { return column == 0 ? 1 : column + 2; };
  MatrixXd a(2 * rows, columns);
  VectorXd rest(2 * rows);
  for (int j = 0; j < rows; ++j) {
    const Basis basis(n_, at[j]);
    const Vector2 r = points[j] - combine(basis.value, fixed);
    rest.segment<2>(2 * j) << r.x, r.y;
    for (int i = 0; i < columns; ++i) {
      const Vector2 d = change(x, basis.value, unknown(i));
      a.block<2, 1>(2 * j, i) << d.x, d.y;
    }
  }
  const VectorXd solved = numeric::least_squares(a, rest);
  for (int i = 0; i < columns; ++i) x[unknown(i)] = solved[i];
  miss = (a * solved - rest).norm() / std::sqrt(static_cast<double>(rows));
  return x;
}

ControlPolygon moved_to_ends(const UnitPiece& unit, const ControlPolygon& polygon) {
  const Family family(unit, static_cast<int>(polygon.size()) - 1, false);
  const VectorXd x = family.nearest(polygon);
  if (!(std::min(x[0], x[2]) > kShortestHandle) || !x.allFinite()) return {};
  return family.polygon(x);
}

}  // namespace keyline::lac::detail
