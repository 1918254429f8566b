#include <algorithm>

#include "keyline/analysis/continuity.h"
#include "keyline/classa/between_in_space.h"
#include "keyline/classa/deviation.h"
#include "keyline/classa/farin.h"
#include "keyline/core/axis.h"
#include "keyline/core/extent.h"
#include "keyline/operations/edit_piece.h"
#include "keyline/operations/ends.h"
#include "keyline/surface/net.h"

namespace keyline::operations {
namespace {

using core::Result;
using core::Vector3;
using curve::Bezier3;
using document::SpaceCurve;

/// Of all vertices and control points, the diagonal of their box.
double size_of(const std::vector<SpaceCurve>& pieces) {
  core::Box3 box;
  for (const SpaceCurve& c : pieces) {
    const auto* line = std::get_if<curve::Polyline3>(&c.value);
    for (const auto& p : line ? line->points : std::get<Bezier3>(c.value).control) box.take(p);
  }
  return diagonal(box);
}

std::unexpected<core::Failure> rational() {
  return core::fail(core::ErrorCode::unsupported,
                    "a rational curve in space is no row of polynomial Beziers",
                    "give it without weights", "curve");
}

/// Polynomial Beziers for what is one or can be cut into some; polylines as they stand. Adds how
/// far they lie from the curves at most to the answer.
Result<std::vector<SpaceCurve>> pieces_of(const std::vector<SpaceCurve>& curves,
                                          std::optional<double> tolerance, PiecesAnswer& answer) {
  std::vector<SpaceCurve> all;
  const auto add = [&all](std::vector<Bezier3> pieces) {
    for (Bezier3& c : pieces) all.push_back({std::move(c)});
  };
  for (const SpaceCurve& c : curves) {
    if (const auto* spline = std::get_if<curve::BSpline3>(&c.value)) {
      if (is_rational(*spline)) return rational();
      add(curve::to_beziers(*spline));
    } else if (const auto* chain = std::get_if<lac::SpaceChain>(&c.value)) {
      auto row =
          lac::approximate_by_quintics(*chain, tolerance.value_or(1e-3 * lac::arc_length(*chain)));
      answer.approximated = std::max(answer.approximated, row.deviation);
      add(std::move(row.pieces));
    } else {
      const auto* bezier = std::get_if<Bezier3>(&c.value);
      if (bezier && is_rational(*bezier)) return rational();
      all.push_back(c);
    }
  }
  return all;
}

PieceValue value_of(const Bezier3& c, double alpha_max) {
  classa::CavOptions options;
  options.alpha_max = alpha_max;
  PieceValue value;
  if (const auto found = classa::cav(c, options)) {
    value.type = found->type;
    value.cav = found->cav;
  }
  value.monotone = verdict_of(classa::certify_monotone_curvature(c).answer);
  return value;
}

/// The Class A curve between the tangents of the piece, if there is one.
std::optional<Bezier3> target_of(const Bezier3& c, double alpha_max) {
  const int degree = curve::degree(c);
  if (degree > kHighestPieceDegree) return std::nullopt;
  const Vector3 leaving = jet(c, 0).first;
  const Vector3 arriving = jet(c, 1).first;
  if (!(norm(leaving) > 0) || !(norm(arriving) > 0)) return std::nullopt;
  const auto found = classa::class_a_between(
      classa::SpaceEndTangents{c.control.front(), leaving, c.control.back(), arriving},
      range_for(degree, alpha_max));
  return found ? set_end(*found, c, (1 / norm(arriving)) * arriving) : std::nullopt;
}

/// Edits one piece in place.
EditedPiece edit_piece(Bezier3& c, const PiecesRequest& request) {
  EditedPiece shown;
  shown.degree = curve::degree(c);
  shown.before = shown.after = value_of(c, request.alpha_max);
  if (is_straight(c)) {
    shown.became = Became::straight;
    return shown;
  }
  return take(
      std::move(shown), c, target_of(c, request.alpha_max), request,
      [&c](const Bezier3& moved, double wanted) {
        return classa::deviation_bound(c, moved, wanted);
      },
      [&](const Bezier3& moved) { return value_of(moved, request.alpha_max); });
}

Vector3 curvature_vector(const curve::Jet3& j) {
  const double square = dot(j.first, j.first);
  return cross(cross(j.first, j.second), j.first) / (square * square);
}

/// As analysis::continuity, with curvature as a vector: its plane counts too.
JointCount joints_of(const std::vector<SpaceCurve>& pieces, bool closed, double size) {
  constexpr analysis::ContinuityTolerance kTolerance;
  JointCount count;
  const std::size_t n = pieces.size();
  for (std::size_t i = 0; n > 1 && i + (closed ? 0 : 1) < n; ++i) {
    const curve::Jet3 end = jet(pieces[i], 1);
    const curve::Jet3 start = jet(pieces[(i + 1) % n], 0);
    if (core::distance(end.point, start.point) > kTolerance.gap) continue;
    ++count.g0;
    if (!(core::angle_between(end.first, start.first) <= kTolerance.angle)) continue;
    ++count.g1;
    const Vector3 before = curvature_vector(end), after = curvature_vector(start);
    const double most = std::max({norm(before), norm(after), 1 / size});
    count.g2 += norm(after - before) <= kTolerance.curvature * most;
  }
  return count;
}

/// A curve alone does not say that it is closed: its ends do.
bool is_closed(const SpacePath& path, double size) {
  const core::Point3 start = evaluate(path.curves.front(), 0),
                     end = evaluate(path.curves.back(), 1);
  return path.closed || meet(start, end, size, kOneHeldEnd);
}

}  // namespace

Result<PiecesAnswer> edit_pieces_in_space(const PiecesRequest& request) {
  SpacePath path;
  if (const auto* one = std::get_if<SpaceCurve>(&request.curve))
    path.curves = {*one};
  else
    path = std::get<SpacePath>(request.curve);
  PiecesAnswer answer;
  auto pieces = pieces_of(path.curves, request.fit_tolerance, answer);
  if (!pieces) return std::unexpected(std::move(pieces.error()));
  const double size = size_of(*pieces);
  const bool closed = pieces->size() > 1 && is_closed(path, size);
  answer.joints_before = joints_of(*pieces, closed, size);
  for (SpaceCurve& c : *pieces) {
    if (auto* bezier = std::get_if<Bezier3>(&c.value)) {
      add(answer, edit_piece(*bezier, request));
      continue;
    }
    EditedPiece shown;
    shown.why = "a polyline";
    add(answer, std::move(shown));
  }
  answer.joints_after = joints_of(*pieces, closed, size);
  if (pieces->size() == 1)
    answer.curve.curve = std::move(pieces->front());
  else
    answer.curve.curve = SpacePath{std::move(*pieces), closed};
  return answer;
}

}  // namespace keyline::operations
