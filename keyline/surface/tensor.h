#pragma once

#include <array>
#include <span>
#include <vector>

#include "keyline/curve/bezier.h"
#include "keyline/surface/jet.h"
#include "keyline/surface/net.h"

/// Internals of room surface: tensor product evaluation from B-spline basis functions.
namespace keyline::surface::detail {

inline constexpr int kOrders = 4;  ///< value and three derivatives

/// The degree + 1 basis functions that do not vanish at a parameter, with derivatives in the
/// parameter of [0, 1]; they belong to the control points from `first` on. Only the first `count`
/// of the orders that were asked for are set.
struct Basis {
  int first = 0;
  int count = 0;
  std::array<std::array<double, curve::kMaxBezierDegree + 1>, kOrders> values;
};

/// Bernstein polynomials of the degree at t, clamped to [0, 1].
Basis bernstein_basis(int degree, double t, int orders = kOrders);

/// B-spline basis at t in [0, 1] mapped to [knots[degree], knots[n]], n control points.
Basis spline_basis(int degree, std::span<const double> knots, double t, int orders = kOrders);

/// Net and weights of a surface, not owned.
struct NetView {
  const Net* net;
  const std::vector<double>* weights;
};

/// The rows contracted with a basis in u: control values of the curve of constant u and of its
/// derivatives by u, one for each column that is asked for. Homogeneous where there are weights.
struct Strip {
  std::array<std::vector<core::Vector3>, kOrders> vector;
  std::array<std::vector<double>, kOrders> weight;  ///< empty lists: polynomial
};
void contract(const NetView& net, const Basis& u, int orders, Strip& strip);

/// Point and derivatives from a strip and a basis in v; derivatives of total order >= orders stay
/// zero. orders in 1 … 4.
SurfaceJet combine(const Strip& strip, const Basis& v, int orders);

}  // namespace keyline::surface::detail
