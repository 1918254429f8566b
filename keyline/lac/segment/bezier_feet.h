#pragma once

#include <vector>

#include "keyline/core/point.h"
#include "keyline/curve/bezier.h"
#include "keyline/lac/segment/taylor.h"

/// Internals: which parameter of a Bezier belongs to which place of a segment.
namespace keyline::lac::detail {

/// Point and weight: a rational Bézier in homogeneous form.
struct Weighted {
  core::Vector2 point;
  double weight = 0;
};
inline Weighted operator+(Weighted a, Weighted b) {
  return {a.point + b.point, a.weight + b.weight};
}
inline Weighted operator-(Weighted a, Weighted b) {
  return {a.point - b.point, a.weight - b.weight};
}
inline Weighted operator*(double k, Weighted a) { return {k * a.point, k * a.weight}; }

/// The Bézier in the frame of the unit piece.
struct Homogeneous {
  std::vector<Weighted> control;
  double least_weight = 1;
  int degree() const { return static_cast<int>(control.size()) - 1; }
};

/// `c` in the frame of the segment's unit piece.
Homogeneous reduced(const curve::Bezier2& c, const Segment& s, const UnitPiece& unit);

/// v -> t: feet, moved linearly so that ends meet ends; simply the guess where a foot is lost.
class ParameterMap {
 public:
  ParameterMap(const Homogeneous& h, const UnitPiece& unit);
  double operator()(double v, double guess) const;

 private:
  const Homogeneous& h_;
  const UnitPiece& unit_;
  double start_ = 0;
  double end_ = 1;
  bool sound_ = false;
};

}  // namespace keyline::lac::detail
