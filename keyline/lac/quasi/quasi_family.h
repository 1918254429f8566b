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
/// where these are held: none that is infinite (at a cusp) is. Unknowns: handle length and far
/// handle's offset along the tangent at either end, the inner points, then, of each curvature not
/// held, the far handle's offset across.
class Family {
 public:
  Family(const UnitPiece& unit, int degree, bool curvatures_held);

  int unknowns() const { return last_across() + (last_held_ ? 0 : 1); }
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
  int first_across() const { return 4 + 2 * (n_ - 5); }
  int last_across() const { return first_across() + (first_held_ ? 0 : 1); }

  const UnitPiece& unit_;
  int n_;
  bool first_held_, last_held_;
  core::Vector2 end_, end_tangent_;
};

/// A polygon of degree >= 5 with its ends and end tangents where those of the piece are; empty
/// where an end edge is too short for that.
ControlPolygon moved_to_ends(const UnitPiece& unit, const ControlPolygon& polygon);

}  // namespace keyline::lac::detail
