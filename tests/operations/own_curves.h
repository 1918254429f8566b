#pragma once

#include <array>
#include <vector>

#include "own_numerics.h"

/// Béziers, B-splines, polylines and paths of them, and surfaces, by numerics of the tests' own: a
/// spline is cut into Béziers by its blossom, all else is de Casteljau's in homogeneous
/// coordinates.
namespace keyline::own {

using Vec = std::array<double, 3>;

Vec operator+(const Vec& a, const Vec& b);
Vec operator-(const Vec& a, const Vec& b);
Vec operator*(double s, const Vec& a);
double dot(const Vec& a, const Vec& b);
Vec cross(const Vec& a, const Vec& b);
double size(const Vec& a);
double distance(const Vec& a, const Vec& b);
/// Of two or three numbers.
Vec vec(const json& point);

/// (w x, w y, w z, w) of the control points.
using Bezier = std::vector<std::array<double, 4>>;

/// What a point of a curve does by the parameter of its Bézier.
struct Spot {
  Vec place{}, first{}, second{};
};
Spot spot(const Bezier& c, double t);

/// Signed, of a planar curve, positive turning left.
double curvature(const Spot& s);
double direction(const Spot& s);

/// Of the sign of curvature's rate, of a polynomial curve.
double curvature_rate(const Bezier& c, double t);

/// Of a bezier, bspline, polyline or a path of them, in order.
std::vector<Bezier> beziers_of(const json& curve);

/// Lengths by quadrature, panels halved until they agree.
double length_of(const Bezier& c, double from = 0, double to = 1);
double length_of(const std::vector<Bezier>& curve);

/// Places at even parameters of every Bézier, the first of each but the first left out.
std::vector<Spot> spots(const std::vector<Bezier>& curve, int each);

/// Distance of a point: parts are halved until none can hold a nearer place, by the coefficients of
/// the squared distance.
double distance_from(const std::vector<Bezier>& curve, const Vec& point);

/// Area between a planar curve and its chord, each side of it for itself.
double volume_of(const std::vector<Bezier>& curve);

/// Squared curvature along the length.
double energy_of(const Bezier& c);

/// Places of any planar curve value, a log-aesthetic one too: at least `about` of them.
std::vector<Vec> places_of(const json& curve, int about);

/// A patch of a surface: rows of Béziers along v.
struct Patch {
  std::vector<Bezier> rows;
};
struct SurfaceSpot {
  Vec place{}, u{}, v{}, uu{}, uv{}, vv{};
};
/// Patches of a surface value, by rows, `columns` of them in each.
struct Patches {
  std::vector<Patch> patches;
  std::size_t columns = 1;
};
Patches patches_of(const json& surface);
SurfaceSpot spot(const Patch& patch, double u, double v);

/// Distance of a point from a surface.
double distance_from(const Patches& surface, const Vec& point);

}  // namespace keyline::own
