#pragma once

#include <variant>
#include <vector>

#include "keyline/curve/box_tree.h"
#include "keyline/curve/closest_point.h"
#include "keyline/document/planar_curve.h"

namespace keyline::document {

/// The point of a path nearest to one of many points; of several the one of smallest parameter, as
/// far as rounding can tell them apart. What each type of curve has for this is asked only of spans
/// whose boxes leave room for a nearer one: so many points as spans take n log n, not n^2.
/// Accuracy: that of the types' own closest_point; log-aesthetic pieces to 1e-14 of the parameter.
class ClosestSearch {
 public:
  /// Precondition: the path is valid. It need not outlive the search.
  explicit ClosestSearch(const Path& path);

  curve::ClosestPoint operator()(core::Point2 p) const;

 private:
  struct Edge {
    core::Point2 from, to;
  };
  /// A part of a member over [low, high] of the path's parameter.
  struct Span {
    std::variant<Edge, curve::Bezier2, lac::Segment, curve::BSpline2> value;
    double low = 0;
    double high = 0;
  };
  struct Gather;
  struct Nearest;

  static std::vector<curve::Box2> boxes_of(const std::vector<Span>& spans);

  std::vector<Span> spans_;
  curve::BoxTree tree_;
};

}  // namespace keyline::document
