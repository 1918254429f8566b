#include "keyline/operations/curve_edit_pieces.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "keyline/analysis/continuity.h"
#include "keyline/classa/between_tangents.h"
#include "keyline/classa/deviation.h"
#include "keyline/curve/arriving.h"
#include "keyline/operations/edit_piece.h"
#include "keyline/operations/ends.h"
#include "keyline/operations/registry.h"

/// A path edited Bezier by Bezier, its joints held: the operation curve.edit_pieces.
namespace keyline::operations {
namespace {

using core::Result;
using curve::Bezier2;
using document::Path;
using document::PlanarCurve;

/// A curve alone does not say that it is closed: its ends do.
bool is_closed(const Path& path, double size) {
  return path.closed || meet(evaluate(path, 0), evaluate(path, 1), size, kOneHeldEnd);
}

/// Polynomial Beziers for what is one or can be cut into some; polylines as they stand. Adds how
/// far they lie from the path at most to the answer.
Result<std::vector<PlanarCurve>> pieces_of(const Path& path, double size,
                                           std::optional<double> tolerance, PiecesAnswer& answer) {
  std::vector<PlanarCurve> all;
  for (const PlanarCurve& c : path.curves) {
    const auto* bezier = std::get_if<Bezier2>(&c.value);
    if (std::holds_alternative<curve::Polyline2>(c.value) || (bezier && !is_rational(*bezier))) {
      all.push_back(c);
      continue;
    }
    auto row = bounded_pieces({{c}, false}, tolerance.value_or(1e-3 * size));
    if (!row) return std::unexpected(std::move(row.error()));
    answer.approximated = std::max(answer.approximated, row->deviation);
    for (Bezier2& piece : row->pieces) all.push_back({std::move(piece)});
  }
  return all;
}

PieceValue place_of(const Bezier2& c, double alpha_max) {
  classa::CavOptions options;
  options.alpha_max = alpha_max;
  const auto value = classa::cav(c, options);
  return value ? PieceValue{value->type, value->cav, {}} : PieceValue{};
}

/// The Class A curve between the tangents of the piece, if there is one.
std::optional<Bezier2> target_of(const Bezier2& c, double alpha_max) {
  const int degree = curve::degree(c);
  if (degree > kHighestPieceDegree) return std::nullopt;
  const core::Vector2 arriving = curve::arriving_tangent(jet(c, 1));
  const auto found = classa::class_a_between(
      {c.control.front(), curve::unit_tangent(jet(c, 0)), c.control.back(), arriving},
      range_for(degree, alpha_max));
  return found ? set_end(classa::to_bezier(*found), c, arriving) : std::nullopt;
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
  return take(
      std::move(shown), c, target_of(c, request.alpha_max), request,
      [&c](const Bezier2& moved, double wanted) {
        return classa::deviation_bound(std::span(&c, 1), moved, wanted);
      },
      [&](const Bezier2& moved) { return place_of(moved, request.alpha_max); });
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
  PiecesAnswer answer;
  const double size = analysis::ArcLengthTable(analysis::view(*path)).length();
  auto pieces = pieces_of(*path, size, request.fit_tolerance, answer);
  if (!pieces) return std::unexpected(std::move(pieces.error()));
  const bool closed = pieces->size() > 1 && is_closed(*path, size);
  answer.joints_before = joints_of(*pieces, closed);
  for (PlanarCurve& c : *pieces) {
    auto* bezier = std::get_if<Bezier2>(&c.value);
    EditedPiece shown;
    if (bezier)
      shown = edit_piece(*bezier, request);
    else
      shown.why = "a polyline";
    add(answer, std::move(shown));
  }
  answer.joints_after = joints_of(*pieces, closed);
  answer.curve.curve = simplest({std::move(*pieces), closed || path->closed});
  return answer;
}

}  // namespace

void add(PiecesAnswer& answer, EditedPiece piece) {
  answer.edited += piece.became == Became::edited;
  answer.cav_before += piece.before.cav.value_or(0);
  answer.cav_after += piece.after.cav.value_or(0);
  answer.departure = std::max(answer.departure, answer.approximated + piece.departure);
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
