#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "keyline/analysis/continuity.h"
#include "keyline/classa/between_tangents.h"
#include "keyline/classa/cav.h"
#include "keyline/classa/deviation.h"
#include "keyline/core/text.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"

/// A path edited Bezier by Bezier, its joints held: the operation curve.edit_pieces.
namespace keyline::operations {
namespace {

using core::Result;
using curve::Bezier2;
using document::Path;
using document::PlanarCurve;

constexpr int kHighestDegree = 8;  ///< as of the approximation by one Bezier

/// Of the chord, first and last control edge of a target: at coordinates of a thousand chords
/// rounding still leaves their direction to 2e-9, far below what a joint shows.
constexpr double kLeastEdge = 1e-4;

struct PiecesRequest {
  Path curve;
  double amount = 1;
  std::optional<double> limit;
  double alpha_max = classa::kDefaultAlphaMax;
  std::optional<double> fit_tolerance;
  static constexpr auto describe() {
    using Request = PiecesRequest;
    return core::fields(
        core::field<&Request::curve>("any planar curve or path, closed or with corners").needed(),
        core::field<&Request::amount>("0 the given curve to 1 the target")
            .within(core::from_to(0, 1)),
        core::field<&Request::limit>("largest departure of a piece; those farther off stay")
            .in("length")
            .within(core::at_least(0)),
        core::field<&Request::alpha_max>("largest rotation, of Tab. 2 and of the plane")
            .in("radian")
            .within(core::between(0, core::kPi / 2)),
        core::field<&Request::fit_tolerance>(
            "of pieces for what is no polynomial bezier; 0.001 of the size unless given")
            .in("length")
            .within(core::kPositive));
  }
};

enum class Became { edited, straight, kept };
constexpr auto choices(const Became*) {
  return core::words<Became>(
      {{Became::edited, "edited"}, {Became::straight, "straight"}, {Became::kept, "kept"}});
}

struct PieceValue {
  std::optional<int> type;
  std::optional<double> cav;
  static constexpr auto describe() {
    return core::fields(
        core::field<&PieceValue::type>("1 at the minimum to 5 none; null where it has no value")
            .null_if_empty(),
        core::field<&PieceValue::cav>("curve aesthetic value").null_if_empty());
  }
};

struct EditedPiece {
  Became became = Became::kept;
  int degree = 0;
  PieceValue before;
  PieceValue after;
  double departure = 0;
  std::optional<std::string> why;
  static constexpr auto describe() {
    using Piece = EditedPiece;
    return core::fields(core::field<&Piece::became>("of the piece"),
                        core::field<&Piece::degree>("of the Bezier it is now"),
                        core::field<&Piece::before>("as given"), core::field<&Piece::after>("now"),
                        core::field<&Piece::departure>("from the given piece").in("length"),
                        core::field<&Piece::why>("it was kept"));
  }
};

/// Joints of an order or more.
struct JointCount {
  std::size_t g0 = 0;
  std::size_t g1 = 0;
  std::size_t g2 = 0;
  static constexpr auto describe() {
    return core::fields(core::field<&JointCount::g0>("that meet"),
                        core::field<&JointCount::g1>("with one direction"),
                        core::field<&JointCount::g2>("with one curvature"));
  }
};

struct PiecesAnswer {
  MadeCurve curve;
  std::vector<EditedPiece> pieces;
  std::size_t edited = 0;
  double cav_before = 0;
  double cav_after = 0;
  double departure = 0;
  JointCount joints_before;
  JointCount joints_after;
  static constexpr auto describe() {
    using Answer = PiecesAnswer;
    return core::fields(core::flattened<&Answer::curve>(),
                        core::field<&Answer::pieces>("in order along the curve"),
                        core::field<&Answer::edited>("pieces that were"),
                        core::field<&Answer::cav_before>("sum over the pieces that have a value"),
                        core::field<&Answer::cav_after>("the same, now"),
                        core::field<&Answer::departure>("largest of the pieces").in("length"),
                        core::field<&Answer::joints_before>("between the pieces, as given"),
                        core::field<&Answer::joints_after>("now"));
  }
};

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
  return value ? PieceValue{value->type, value->cav} : PieceValue{};
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
  if (degree > kHighestDegree) return std::nullopt;
  classa::BetweenRange range;
  range.lowest_degree = std::max(3, degree);
  range.highest_degree = kHighestDegree;
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
    shown.before = shown.after = {1, 0};
    return shown;
  }
  shown.before = shown.after = place_of(c, request.alpha_max);
  const auto target = target_of(c, request.alpha_max);
  if (!target) {
    shown.why =
        "no Class A curve of degree 3 to 8 between its tangents, with edges of 1e-4 of the chord "
        "or more";
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
  auto pieces = pieces_of(request.curve, request.fit_tolerance);
  if (!pieces) return std::unexpected(std::move(pieces.error()));
  PiecesAnswer answer;
  answer.joints_before = joints_of(*pieces, request.curve.closed);
  for (PlanarCurve& c : *pieces) {
    auto* bezier = std::get_if<Bezier2>(&c.value);
    EditedPiece shown;
    if (bezier)
      shown = edit_piece(*bezier, request);
    else
      shown.why = "a polyline";
    answer.edited += shown.became == Became::edited;
    answer.cav_before += shown.before.cav.value_or(0);
    answer.cav_after += shown.after.cav.value_or(0);
    answer.departure = std::max(answer.departure, shown.departure);
    answer.pieces.push_back(std::move(shown));
  }
  answer.joints_after = joints_of(*pieces, request.curve.closed);
  answer.curve.curve = simplest({std::move(*pieces), request.curve.closed});
  return answer;
}

}  // namespace

Operation curve_edit_pieces_operation() {
  return declare<run>(
      {.name = "curve.edit_pieces",
       .summary = "Takes every Bezier of a path to the Class A curve between its own ends and "
                  "tangents, so that joints keep their directions; those that have none stay.",
       .examples = {R"({"curve":{"type":"bezier","points":[[0,0],[2,0],[3,1],[3,4]]},
                        "limit":0.5})"}});
}

}  // namespace keyline::operations
