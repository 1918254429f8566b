#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "keyline/surface/surface.h"

namespace keyline::surface {

inline Net wavy_net(int rows, int columns) {
  Net net{rows, columns, {}};
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      net.points.push_back({i + 0.2 * std::sin(3.0 * j), j + 0.3 * std::cos(2.0 * i),
                            std::sin(1.3 * i) * std::cos(0.9 * j)});
  return net;
}

/// A gently crowned bicubic patch, 300 by 200.
inline BezierSurface crowned_patch() {
  Net net{4, 4, {}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double x = i / 3.0;
      const double y = j / 3.0;
      net.points.push_back({300 * x + 8 * y * y, 200 * y + 11 * x * x,
                            40 * x * (1.3 - x) + 25 * y * (1.1 - y) + 9 * x * x * y});
    }
  return {net, {}};
}

/// A crowned patch pushed out of shape by hand, so to say: SAV between 250 and 410.
inline BezierSurface distorted_patch() {
  BezierSurface s = crowned_patch();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double a = 1.7 * i + 2.9 * j;
      s.net.at(i, j) = s.net.at(i, j) +
                       core::Vector3{4 * std::sin(a), 4 * std::cos(1.3 * a), 5 * std::sin(2.1 * a)};
    }
  return s;
}

/// The halves of a patch in u.
inline std::pair<BezierSurface, BezierSurface> halves_u(const BezierSurface& s) {
  BezierSurface low = s;
  BezierSurface high = s;
  for (int j = 0; j < s.net.columns; ++j) {
    const auto [a, b] = curve::split(curve::Bezier3{column_of(s.net, j), {}}, 0.4);
    for (int i = 0; i < s.net.rows; ++i) {
      low.net.at(i, j) = a.control[i];
      high.net.at(i, j) = b.control[i];
    }
  }
  return {low, high};
}

/// An eighth of a sphere around the origin; its edge v = 1 is collapsed into the pole (0, 0, r).
inline BezierSurface sphere_octant(double r) {
  const double w = std::numbers::sqrt2 / 2;
  const double turn[3][2] = {{1, 0}, {1, 1}, {0, 1}};
  const double weight[3] = {1, w, 1};
  BezierSurface s{{3, 3, {}}, {}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double across = r * turn[j][0];
      s.net.points.push_back({across * turn[i][0], across * turn[i][1], r * turn[j][1]});
      s.weights.push_back(weight[i] * weight[j]);
    }
  return s;
}

/// A quarter of a cylinder about the line x = cx, z = cz; u runs around from the top (0) to the
/// side +x, v along y by `depth`.
inline BezierSurface quarter_cylinder(double cx, double cz, double radius, double depth) {
  const double w = std::numbers::sqrt2 / 2;
  const double at[3][2] = {{0, 1}, {1, 1}, {1, 0}};
  BezierSurface s{{3, 2, {}}, {1, 1, w, w, 1, 1}};
  for (const auto& p : at)
    for (const double y : {0.0, depth})
      s.net.points.push_back({cx + radius * p[0], y, cz + radius * p[1]});
  return s;
}

/// Bicubic, two by two patches, waves in its net: smooth joints.
inline BSplineSurface four_patches() {
  BSplineSurface s;
  s.net = wavy_net(5, 5);
  for (core::Point3& p : s.net.points) p = {40 * p.x, 40 * p.y, 6 * p.z};
  s.knots = {{{0, 0, 0, 0, 0.4, 1, 1, 1, 1}, {0, 0, 0, 0, 2, 3, 3, 3, 3}}};
  return s;
}

}  // namespace keyline::surface
