#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "keyline/curve/bezier.h"
#include "keyline/lac/quasi/quasi_forms.h"

/// Internals: the Bézier polygons among which the form `best` is looked for.
namespace keyline::lac::detail {

/// Bernstein polynomials of degree n at t, and their derivatives.
struct Basis {
  using Row = std::array<double, curve::kMaxBezierDegree + 1>;
  Row value{}, slope{};
  Basis(int n, double t);
};

core::Vector2 combine(const Basis::Row& weights, const ControlPolygon& b);

/// Bézier polygons of one degree with the ends and tangents of a unit piece, and its end curvatures
/// where these are held. Unknowns: handle length and far handle's offset along the tangent at
/// either end, the inner points, then, of curvatures not held, the far handles' offsets across.
class Family {
 public:
  Family(const UnitPiece& unit, int degree, bool curvatures_held);

  int unknowns() const { return inner_end() + (held_ ? 0 : 2); }
  ControlPolygon polygon(const Eigen::VectorXd& x) const;

  /// d(combination of the polygon) / dx_k.
  core::Vector2 change(const Eigen::VectorXd& x, const Basis::Row& w, int k) const;

  /// The curve of the family nearest to a polygon of its degree: what that misses the ends by is
  /// spread over it.
  Eigen::VectorXd nearest(const ControlPolygon& polygon) const;

  /// Handles of the given lengths, all else by least squares against points at given parameters;
  /// `miss` is the root mean square that is left.
  Eigen::VectorXd start(double first, double last, const std::vector<double>& at,
                        const std::vector<core::Vector2>& points, double& miss) const;

 private:
  int inner_end() const { return 4 + 2 * (n_ - 5); }

  const UnitPiece& unit_;
  int n_;
  bool held_;
  core::Vector2 end_, end_tangent_;
};

}  // namespace keyline::lac::detail
