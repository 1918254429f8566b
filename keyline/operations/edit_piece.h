#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
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

/// Whether all control points lie on one straight line, to a billionth of their size.
template <class Bezier>
bool is_straight(const Bezier& c) {
  const auto& start = c.control.front();
  const auto size = [](const auto& v) {
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(v)>>)
      return std::abs(v);
    else
      return norm(v);
  };
  const auto farthest =
      std::ranges::max(c.control, {}, [&](const auto& p) { return core::distance(start, p); });
  const auto line = farthest - start;
  const double most = 1e-9 * dot(line, line);
  return std::ranges::all_of(c.control,
                             [&](const auto& p) { return size(cross(line, p - start)) <= most; });
}

/// Degrees of the curves that a piece may become.
inline classa::BetweenRange range_for(int degree, double alpha_max) {
  classa::BetweenRange range;
  range.lowest_degree = std::max(kLowestPieceDegree, degree);
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
    shown.why = "no Class A curve of degree " + std::to_string(kLowestPieceDegree) + " to " +
                std::to_string(kHighestPieceDegree) + " between its tangents, with edges of " +
                core::number_text(kLeastEdge, 2) + " of the chord or more";
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
