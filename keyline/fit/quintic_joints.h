#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "keyline/core/point.h"

/// Quintics in a row by what their neighbours share, so that they are G2 whatever the numbers.
namespace keyline::fit {

/// Five over k.
inline constexpr std::array<double, 6> kChoose5 = {1, 5, 10, 10, 5, 1};

struct QuinticJoint {
  core::Point2 place;
  double direction = 0;
  double curvature = 0;
};

/// End edges, and the tangential part of the edges beside them.
struct QuinticLengths {
  double a = 0, b = 0, c = 0, d = 0;
};

using QuinticHandles = std::array<core::Point2, 6>;

/// Derivatives of a place by its piece's unknowns: the first joint's x, y, direction and curvature,
/// the four lengths, the last joint's.
using QuinticRow = std::array<core::Vector2, 12>;

/// Weights of the six control points.
using QuinticWeights = std::array<double, 6>;

struct JointedQuintics {
  std::vector<QuinticJoint> joints;  ///< closed: as many as pieces; open: one more
  std::vector<QuinticLengths> lengths;
  bool closed = false;

  const QuinticJoint& end_of(std::size_t piece) const {
    return joints[(piece + 1) % joints.size()];
  }
};

/// A piece's control points, the third ones standing off by Eqs. 9 and 10 of [Sketch], and what
/// they were made from.
struct JointedQuintic {
  QuinticHandles control;
  core::Vector2 start_tangent, end_tangent;
  double start_curvature = 0, end_curvature = 0;
  QuinticLengths lengths;
};

JointedQuintic piece_of(const JointedQuintics& chain, std::size_t piece);
std::vector<JointedQuintic> pieces_of(const JointedQuintics& chain);

/// Bernstein polynomials of degree 5.
constexpr QuinticWeights place_weights(double t) {
  const double u = 1 - t;
  const double u2 = u * u;
  const double t2 = t * t;
  return {u2 * u2 * u,      5 * u2 * u2 * t, 10 * u2 * u * t2,
          10 * u2 * t2 * t, 5 * u * t2 * t2, t2 * t2 * t};
}

/// Their derivatives by t.
constexpr QuinticWeights first_weights(double t) {
  const double u = 1 - t;
  const double a = 5 * u * u * u * u;
  const double b = 20 * u * u * u * t;
  const double c = 30 * u * u * t * t;
  const double d = 20 * u * t * t * t;
  const double e = 5 * t * t * t * t;
  return {-a, a - b, b - c, c - d, d - e, e};
}

constexpr QuinticWeights second_weights(double t) {
  const double u = 1 - t;
  const double a = 20 * u * u * u;
  const double b = 60 * u * u * t;
  const double c = 60 * u * t * t;
  const double d = 20 * t * t * t;
  return {a, b - 2 * a, a - 2 * b + c, b - 2 * c + d, c - 2 * d, d};
}

constexpr QuinticWeights third_weights(double t) {
  const double u = 1 - t;
  const double a = 60 * u * u;
  const double b = 120 * u * t;
  const double c = 60 * t * t;
  return {-a, 3 * a - b, 3 * b - 3 * a - c, a - 3 * b + 3 * c, b - 3 * c, c};
}

/// Sum of the control points with these weights: a place or, as a vector, a derivative.
inline core::Vector2 weighted(const QuinticHandles& control, const QuinticWeights& weights) {
  core::Vector2 sum{};
  for (std::size_t k = 0; k < 6; ++k) sum = sum + weights[k] * (control[k] - core::Point2{});
  return sum;
}

inline core::Point2 place(const QuinticHandles& control, double t) {
  return core::Point2{} + weighted(control, place_weights(t));
}

/// How the sum of a piece's control points with these weights changes with its unknowns.
QuinticRow sensitivity(const JointedQuintic& piece, const QuinticWeights& weights);

}  // namespace keyline::fit
