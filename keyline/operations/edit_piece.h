#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "keyline/classa/between_tangents.h"
#include "keyline/core/text.h"
#include "keyline/operations/curve_edit_pieces.h"

/// What editing a piece takes in the plane and in space alike.
namespace keyline::operations {

/// The target and the given curve mixed by their control points, with the given ends.
template <class Bezier>
Bezier mixed(const Bezier& given, const Bezier& target, double amount) {
  Bezier c = target;
  const Bezier from = curve::elevate_degree(given, curve::degree(target) - curve::degree(given));
  for (std::size_t i = 0; i < c.control.size(); ++i)
    c.control[i] = core::mix(from.control[i], c.control[i], amount);
  c.control.front() = given.control.front();
  c.control.back() = given.control.back();
  return c;
}

/// Degrees of the curves that a piece may become.
inline classa::BetweenRange range_for(int degree, double alpha_max) {
  classa::BetweenRange range;
  range.lowest_degree = std::max(3, degree);
  range.highest_degree = kHighestPieceDegree;
  range.alpha_max = alpha_max;
  return range;
}

/// The target with its end moved to the given curve's; nothing where an edge is so short that
/// rounding turns it. The small move would turn a short last edge too, so that edge is set along
/// `arriving`, the unit tangent at the end.
template <class Bezier, class Vector>
std::optional<Bezier> set_end(Bezier target, const Bezier& given, Vector arriving) {
  auto& points = target.control;
  const double first = core::distance(points[0], points[1]);
  const double edge = core::distance(points[points.size() - 2], points.back());
  if (std::min(first, edge) < kLeastEdge * core::distance(points.front(), points.back()))
    return std::nullopt;
  points.back() = given.control.back();
  points[points.size() - 2] = points.back() - edge * arriving;
  return target;
}

/// Takes a piece part of the way to its target, if there is one and the limit allows it. `shown`
/// has its value before; `bound(moved, wanted)` bounds the departure, `value(moved)` is what it has
/// then.
template <class Bezier, class Bound, class Value>
EditedPiece take(EditedPiece shown, Bezier& c, const std::optional<Bezier>& target,
                 const PiecesRequest& request, Bound bound, Value value) {
  if (!target) {
    shown.why = kNoTarget;
    return shown;
  }
  Bezier moved = mixed(c, *target, request.amount);
  const double chord = core::distance(c.control.front(), c.control.back());
  const double away = bound(moved, 1e-3 * chord);
  if (request.limit && away > *request.limit) {
    shown.why = "it would depart by " + core::number_text(away, 4);
    return shown;
  }
  shown.became = Became::edited;
  shown.departure = away;
  shown.degree = curve::degree(moved);
  shown.after = value(moved);
  c = std::move(moved);
  return shown;
}

}  // namespace keyline::operations
