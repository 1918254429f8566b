#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "keyline/lac/chain/chain.h"

/// Internals: the plane curves of two slopes with given shares of the length.
namespace keyline::lac::detail::space {

struct PlaneRhythm {
  double alpha0 = -1, alpha1 = 1;
  double length_share = 0.5;  ///< of the whole length in the first piece
};

/// One of the curves of a rhythm with length 1: `size` is curvature at the joint, `rate` tells that
/// of curvature there over curvature, drawn out (two_slopes.h).
struct Member {
  double rate = 0, size = 0;
};

/// Directions at both ends, less what is wanted; the same of the reversed curve.
struct Off {
  double start = 0, end = 0;
  double largest() const { return std::fmax(std::abs(start), std::abs(end)); }
};

/// What a curve of size 1 turns by.
struct Bends {
  double net = 0, both = 0;  ///< to the left less to the right; together
  bool inflects = false;
};

/// The curves of a rhythm, and how they meet a chord along x from direction `from` to `to`.
class Family {
 public:
  Family(const PlaneRhythm& r, double from, double to) : r_(r), from_(from), turning_(to - from) {}

  double from() const { return from_; }
  double turning() const { return turning_; }

  /// To either side, at the least: somewhere the tangent is along the chord.
  double least_turning() const;
  /// Empty where curvature leaves the doubles.
  std::optional<Chain> chain(const Member& m) const;
  std::optional<Bends> bends(double rate) const;
  std::optional<Off> off(const Member& m) const;
  /// From the least to the greatest, as far as anything changes with them.
  std::vector<double> rates() const;

 private:
  PlaneRhythm r_;
  double from_, turning_;
};

}  // namespace keyline::lac::detail::space
