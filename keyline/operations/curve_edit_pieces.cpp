#include "keyline/operations/curve_edit_pieces.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "keyline/analysis/continuity.h"
#include "keyline/classa/between_tangents.h"
#include "keyline/classa/deviation.h"
#include "keyline/core/text.h"
#include "keyline/operations/registry.h"

/// A path edited Bezier by Bezier, its joints held: the operation curve.edit_pieces.
namespace keyline::operations {
namespace {

using core::Result;
using curve::Bezier2;
using document::Path;
using document::PlanarCurve;

/// Polynomial Beziers for what is one or can be cut into some; polylines as they stand.
Result<std::vector<PlanarCurve>> pieces_of(const Path& path, std::optional<double> tolerance) {
  const double size = analysis::ArcLengthTable(analysis::view(path)).length();
  std::vector<PlanarCurve> all;
  for (const PlanarCurve& c : path.curves) {
    const auto* bezier = std::get_if<Bezier2>(&c.value);
    if (std::holds_alternative<curve::Polyline2>(c.value) || (bezier && !is_rational(*bezier))) {
      all.push_back(c);
      continue;
    }
    auto row = bounded_pieces({{c}, false}, tolerance.value_or(1e-3 * size));
    if (!row) return std::unexpected(std::move(row.error()));
    for (Bezier2& piece : row->pieces) all.push_back({std::move(piece)});
  }
  return all;
}

bool is_straight(const Bezier2& c) {
  const core::Vector2 chord = c.control.back() - c.control.front();
  const double most = 1e-9 * norm(chord) * norm(chord);
  return std::all_of(c.control.begin(), c.control.end(), [&](const core::Point2& p) {
    return std::abs(cross(chord, p - c.control.front())) <= most;
  });
}

PieceValue place_of(const Bezier2& c, double alpha_max) {
  classa::CavOptions options;
  options.alpha_max = alpha_max;
  const auto value = classa::cav(c, options);
  return value ? PieceValue{value->type, value->cav, {}} : PieceValue{};
}

/// The target and the given curve mixed by their control points.
Bezier2 mixed(const Bezier2& given, const Bezier2& target, double amount) {
  Bezier2 c = target;
  const Bezier2 from = curve::elevate_degree(given, curve::degree(target) - curve::degree(given));
  for (std::size_t i = 0; i < c.control.size(); ++i)
    c.control[i] = core::mix(from.control[i], c.control[i], amount);
  c.control.front() = given.control.front();
  c.control.back() = given.control.back();
  return c;
}

/// The Class A curve between the tangents of the piece, if there is one.
std::optional<Bezier2> target_of(const Bezier2& c, double alpha_max) {
  const int degree = curve::degree(c);
  if (degree > kHighestPieceDegree) return std::nullopt;
  classa::BetweenRange range;
  range.lowest_degree = std::max(3, degree);
  range.highest_degree = kHighestPieceDegree;
  range.alpha_max = alpha_max;
  const core::Vector2 arriving = curve::unit_tangent(jet(c, 1));
  const auto found = classa::class_a_between(
      {c.control.front(), curve::unit_tangent(jet(c, 0)), c.control.back(), arriving}, range);
  if (!found) return std::nullopt;
  Bezier2 target = classa::to_bezier(*found);
  auto& points = target.control;
  const double first = core::distance(points[0], points[1]);
  const double edge = core::distance(points[points.size() - 2], points.back());
  if (std::min(first, edge) < kLeastEdge * core::distance(points.front(), points.back()))
    return std::nullopt;
  // What the end misses by would turn a short edge: it is set along its tangent.
  points.back() = c.control.back();
  points[points.size() - 2] = points.back() - edge * arriving;
  return target;
}

/// Edits one piece in place.
EditedPiece edit_piece(Bezier2& c, const PiecesRequest& request) {
  EditedPiece shown;
  shown.degree = curve::degree(c);
  if (is_straight(c)) {
    shown.became = Became::straight;
    shown.before = shown.after = {1, 0, {}};
    return shown;
  }
  shown.before = shown.after = place_of(c, request.alpha_max);
  const auto target = target_of(c, request.alpha_max);
  if (!target) {
    shown.why = kNoTarget;
    return shown;
  }
  Bezier2 moved = mixed(c, *target, request.amount);
  const double away = classa::deviation_bound(std::span(&c, 1), moved,
                                              1e-3 * distance(c.control.front(), c.control.back()));
  if (request.limit && away > *request.limit) {
    shown.why = "it would depart by " + core::number_text(away, 4);
    return shown;
  }
  shown.became = Became::edited;
  shown.departure = away;
  shown.degree = curve::degree(moved);
  shown.after = place_of(moved, request.alpha_max);
  c = std::move(moved);
  return shown;
}

JointCount joints_of(const std::vector<PlanarCurve>& pieces, bool closed) {
  std::vector<analysis::CurveView> views;
  for (const PlanarCurve& c : pieces) views.push_back(analysis::view(c));
  JointCount count;
  if (views.size() < 2) return count;
  for (const analysis::JointContinuity& joint : analysis::continuity(views, closed)) {
    count.g0 += joint.order >= 0;
    count.g1 += joint.order >= 1;
    count.g2 += joint.order >= 2;
  }
  return count;
}

Result<PiecesAnswer> run(const PiecesRequest& request, const Context&) {
  const auto path = planar_path(request.curve);
  if (!path) return edit_pieces_in_space(request);
  auto pieces = pieces_of(*path, request.fit_tolerance);
  if (!pieces) return std::unexpected(std::move(pieces.error()));
  PiecesAnswer answer;
  answer.joints_before = joints_of(*pieces, path->closed);
  for (PlanarCurve& c : *pieces) {
    auto* bezier = std::get_if<Bezier2>(&c.value);
    EditedPiece shown;
    if (bezier)
      shown = edit_piece(*bezier, request);
    else
      shown.why = "a polyline";
    add(answer, std::move(shown));
  }
  answer.joints_after = joints_of(*pieces, path->closed);
  answer.curve.curve = simplest({std::move(*pieces), path->closed});
  return answer;
}

}  // namespace

void add(PiecesAnswer& answer, EditedPiece piece) {
  answer.edited += piece.became == Became::edited;
  answer.cav_before += piece.before.cav.value_or(0);
  answer.cav_after += piece.after.cav.value_or(0);
  answer.departure = std::max(answer.departure, piece.departure);
  answer.pieces.push_back(std::move(piece));
}

Operation curve_edit_pieces_operation() {
  return declare<run>(
      {.name = "curve.edit_pieces",
       .summary = "Takes every Bezier of a path, in the plane or in space, to the Class A curve "
                  "between its own ends and tangents, so that joints keep their directions; those "
                  "that have none stay.",
       .examples = {R"({"curve":{"type":"bezier","points":[[0,0],[2,0],[3,1],[3,4]]},
                        "limit":0.5})"}});
}

}  // namespace keyline::operations
