#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/fairing/dense_curve.h"
#include "keyline/numeric/quadrature.h"

/// What a cell turns up to places in it, where its curvature is a parabola: for sums over the cell.
namespace keyline::fairing::detail {

inline constexpr std::array<double, 4> kNode = numeric::gauss_legendre<4>.nodes;
inline constexpr std::array<double, 4> kWeight = numeric::gauss_legendre<4>.weights;

inline constexpr double kSmallTurn = 0.3;  // whose series below hold to 5e-14

/// Integrals from 0 to u of the parabolas that are 1 at one of 0, 1/2 and 1 and 0 at the others.
inline std::array<double, 3> parabolas(double u) {
  return {u * (1 + u * (-1.5 + u * (2.0 / 3))), u * u * (2 - u * (4.0 / 3)),
          u * u * (-0.5 + u * (2.0 / 3))};
}

/// Cosine and sine of a small angle.
inline core::Vector2 small_turn(double angle) {
  const double x = angle * angle;
  const double c = 1 - x / 2 * (1 - x / 12 * (1 - x / 30 * (1 - x / 56 * (1 - x / 90))));
  const double s = angle * (1 - x / 6 * (1 - x / 20 * (1 - x / 42 * (1 - x / 72))));
  return {c, s};
}

inline core::Vector2 turned_by(double angle) {
  if (std::abs(angle) > kSmallTurn) return {std::cos(angle), std::sin(angle)};
  return small_turn(angle);
}

inline core::Vector2 turned(core::Vector2 tangent, double angle) {
  const core::Vector2 by = turned_by(angle);
  return {tangent.x * by.x - tangent.y * by.y, tangent.x * by.y + tangent.y * by.x};
}

inline double sum_of(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

using Four = std::array<double, 4>;

/// parabolas() and turned_by() at the four nodes up to v, each step for all of them: what a
/// processor does two or four at a time.
struct Nodes {
  Four first, middle, last;  ///< of the parabolas
  Four cosine, sine;         ///< of what the cell turns up to there

  Nodes(const CellShape& shape, double h, double v) {
    Four turn;
    for (std::size_t q = 0; q < 4; ++q) {
      const std::array<double, 3> share = parabolas(v * kNode[q]);
      first[q] = share[0];
      middle[q] = share[1];
      last[q] = share[2];
      turn[q] = h * sum_of(share, shape.curvature);
    }
    double most = 0;
    for (const double t : turn) most = std::max(most, std::abs(t));
    const bool small = most <= kSmallTurn;
    for (std::size_t q = 0; q < 4 && small; ++q) set(q, small_turn(turn[q]));
    for (std::size_t q = 0; q < 4 && !small; ++q) set(q, turned_by(turn[q]));
  }

  /// The tangent at a node by its weight.
  core::Vector2 tangent(core::Vector2 at_start, std::size_t q) const {
    return kWeight[q] * core::Vector2{at_start.x * cosine[q] - at_start.y * sine[q],
                                      at_start.x * sine[q] + at_start.y * cosine[q]};
  }

  double sum(std::size_t q, const std::array<double, 3>& of) const {
    return sum_of({first[q], middle[q], last[q]}, of);
  }

 private:
  void set(std::size_t q, core::Vector2 by) {
    cosine[q] = by.x;
    sine[q] = by.y;
  }
};

}  // namespace keyline::fairing::detail
