#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

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

/// Where a point's nearest place on a chain is: on which piece, and where on it.
struct QuinticFoot {
  std::size_t piece = 0;
  double t = 0;
};

/// Newton's steps of a foot towards the place nearest to p, over joints too.
inline QuinticPowers::Passing follow(const std::vector<QuinticPowers>& pieces, bool closed,
                                     core::Point2 p, int rounds, QuinticFoot& f) {
  QuinticPowers::Passing at = pieces[f.piece].pass(f.t, p);
  for (int round = 0; round < rounds; ++round) {
    const double square = dot(at.first, at.first);
    if (!(square > 0)) break;
    f.t += dot(at.off, at.first) / square;
    if (f.t < 0 && (closed || f.piece > 0)) {
      f = {(f.piece + pieces.size() - 1) % pieces.size(), 1};
    } else if (f.t > 1 && (closed || f.piece + 1 < pieces.size())) {
      f = {(f.piece + 1) % pieces.size(), 0};
    } else {
      f.t = std::clamp(f.t, 0.0, 1.0);
    }
    at = pieces[f.piece].pass(f.t, p);
  }
  return at;
}

}  // namespace keyline::fit
