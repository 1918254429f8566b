#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "keyline/fit/quintic_joints.h"

namespace keyline::fit {

/// A quintic by powers of t, from its first control point: place and slope in one go.
class QuinticPowers {
 public:
  explicit QuinticPowers(const QuinticHandles& h) : start_(h[0].x, h[0].y) {
    std::array<core::Vector2, 6> d;  // differences, of rising order
    for (std::size_t k = 0; k < 6; ++k) d[k] = h[k] - h[0];
    for (std::size_t order = 1; order < 6; ++order)
      for (std::size_t k = 5; k >= order; --k) d[k] = d[k] - d[k - 1];
    for (std::size_t k = 0; k < 6; ++k) power_[k] = kChoose5[k] * Pair(d[k].x, d[k].y);
  }

  /// From the place at t to a point, and the first derivative there.
  struct Passing {
    core::Vector2 off, first;
  };
  Passing pass(double t, core::Point2 p) const {
    Pair place = power_[5];
    Pair first = power_[5];
    for (std::size_t k = 4; k > 0; --k) {
      place = t * place + power_[k];
      first = t * first + place;
    }
    const Pair off = Pair(p.x, p.y) - start_ - t * place;
    return {{off[0], off[1]}, {first[0], first[1]}};
  }

 private:
  using Pair = Eigen::Array2d;  // x and y in one go
  Pair start_;
  std::array<Pair, 6> power_;
};

}  // namespace keyline::fit
