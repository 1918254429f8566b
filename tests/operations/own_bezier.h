#pragma once

#include <array>
#include <vector>

#include "own_curves.h"

/// What own_curves.cpp and own_surfaces.cpp share: control points in homogeneous coordinates.
namespace keyline::own {

using Four = std::array<double, 4>;

Four casteljau(Bezier b, double t);

/// Control points of the derivative, homogeneous coordinates each for themselves.
Bezier derivative(const Bezier& b);

inline Vec front(const Four& a) { return {a[0], a[1], a[2]}; }

/// Of points with weights, or null for weights of 1.
Bezier control_of(const json& points, const json* weights);

/// The Béziers of a B-spline of degree p.
std::vector<Bezier> cut(const Bezier& control, const std::vector<double>& knots, std::size_t p);

}  // namespace keyline::own
