#include "keyline/lac/cad/cad.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "keyline/core/angle.h"
#include "keyline/curve/conversion.h"
#include "keyline/curve/monotone.h"
#include "keyline/lac/cad/cad_cubic.h"
#include "keyline/lac/quasi/quasi_forms.h"
#include "keyline/lac/segment/deviation.h"

namespace keyline::lac {

using core::ErrorCode;
using core::Point2;
using core::Result;
using core::Vector2;
using curve::Bezier2;
using detail::UnitPiece;

namespace {

constexpr double kFinest = 1e-13;  ///< of the length
constexpr std::size_t kMostPieces = 100000;

Result<void> check(const CadOptions& o) {
  if (o.degree != 3 && o.degree != 5)
    return core::fail(ErrorCode::bad_input, "the degree must be 3 or 5", "", "degree");
  if (!(o.tolerance > 0) || std::isinf(o.tolerance))
    return core::fail(ErrorCode::bad_input, "the tolerance must be a positive number", "",
                      "tolerance");
  return {};
}

std::unexpected<core::Failure> too_fine() {
  return core::fail(ErrorCode::not_converged, "the tolerance cannot be met in double precision",
                    "ask for at least 1e-13 of the length", "tolerance");
}

bool certified(const Bezier2& b) {
  return curve::certify_monotone_curvature(b).answer == curve::MonotoneVerdict::yes;
}

void append(CadBeziers& out, Bezier2 piece, double bound, bool known_monotone = false) {
  if (!out.pieces.empty()) piece.control.front() = out.pieces.back().control.back();
  out.not_monotone += known_monotone || certified(piece) ? 0 : 1;
  out.deviation = std::max(out.deviation, bound);
  out.pieces.push_back(std::move(piece));
}

/// Part without inflection, as cubics (raised to the degree asked for).
bool append_cubics(const Segment& part, const CadOptions& o, CadBeziers& out) {
  const UnitPiece unit = detail::unit_piece(piece_of(part));
  const auto cubics = detail::cubics_of(unit, o.tolerance / unit.length, o.monotone);
  for (const auto& c : cubics) {
    Bezier2 b;
    b.control.reserve(4);
    for (const Vector2 v : c.cubic.control) b.control.push_back(detail::in_place(part, unit, v));
    append(out, curve::elevate_degree(b, o.degree - 3), c.bound * unit.length, c.monotone);
  }
  return !cubics.empty();
}

struct QuinticTry {
  Bezier2 bezier;
  double bound = 0;
};
QuinticTry try_quintic(const Segment& s) {
  const UnitPiece unit = detail::unit_piece(piece_of(s));
  const QuinticTry none{{}, std::numeric_limits<double>::infinity()};
  if (unit.turning > 3) return none;
  const detail::ControlPolygon polygon = detail::best_polygon(unit, 5, {});
  if (polygon.empty()) return none;  // no handle of a usual length meets such end curvatures
  QuinticTry q;
  for (const Vector2 v : polygon) q.bezier.control.push_back(detail::in_place(s, unit, v));
  q.bound = deviation_bound(s, q.bezier);
  return q;
}

/// Longest quintic from v0 on; its error grows with the tenth power of the length.
bool append_quintics(const Segment& s, const CadOptions& o, CadBeziers& out) {
  const bool monotone = o.monotone && s.curvature_start != s.curvature_end;
  double v0 = 0;
  double width = 1;
  while (v0 < 1) {
    double most = 1 - v0;
    width = std::min(width * 1.05, most);
    QuinticTry best;
    double reached = 0;
    for (int step = 0; step < 24; ++step) {
      const double v1 = width == 1 - v0 ? 1 : v0 + width;
      const QuinticTry q = try_quintic(part(s, v0, v1));
      const bool fits = q.bound <= o.tolerance && (!monotone || step > 12 || certified(q.bezier));
      if (fits && v1 > reached) {
        best = q;
        reached = v1;
      }
      if (!fits) most = std::min(most, width);
      if (fits && (v1 == 1 || q.bound > 0.5 * o.tolerance || width * 1.03 > most)) break;
      const double growth = q.bound <= o.tolerance && !fits
                                ? 0.9
                                : std::clamp(std::pow(0.8 * o.tolerance / q.bound, 0.1), 0.4, 2.0);
      width = std::min(width * growth, fits ? 0.5 * (width + most) : 0.98 * most);
      if (fits && most == 1 - v0) width = std::min((v1 - v0) * growth, most);
    }
    if (!(reached > v0) || out.pieces.size() > kMostPieces) return false;
    width = reached - v0;
    append(out, std::move(best.bezier), best.bound);
    v0 = reached;
  }
  return true;
}

/// Quintics, and cubics where those end: next to a cusp their handles have no room.
bool append_side(const Segment& side, const CadOptions& o, bool cuspidal, CadBeziers& out) {
  if (o.degree == 3 || cuspidal) return append_cubics(side, o, out);
  const CadBeziers before = out;
  if (append_quintics(side, o, out)) return true;
  out = before;
  return append_cubics(side, o, out);
}

bool is_straight(const Segment& s) { return s.curvature_start == 0 && s.curvature_end == 0; }

Bezier2 straight_piece(const Segment& s, int degree) {
  const Bezier2 line{{s.start.position, evaluate(s, 1)}, {}};
  return curve::elevate_degree(line, degree - 1);
}

bool append_segment(const Segment& s, const CadOptions& o, CadBeziers& out) {
  if (is_straight(s)) {
    append(out, straight_piece(s, o.degree), 1e-15 * s.length);
    return true;
  }
  // Close to a cusp: quintics that meet such curvatures have no room to.
  const double least = std::min(std::abs(s.curvature_start), std::abs(s.curvature_end));
  const double most = std::max(std::abs(s.curvature_start), std::abs(s.curvature_end));
  const bool cuspidal = std::isinf(most) || (least > 0 && most > 1e12 * least);
  const auto breaks = breakpoints(s);
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    Segment side = breaks.size() == 2 ? s : part(s, breaks[i], breaks[i + 1]);
    if (breaks.size() == 3) (i == 0 ? side.curvature_end : side.curvature_start) = 0;
    if (!append_side(side, o, cuspidal, out)) return false;
  }
  return true;
}

Bezier2 quarter(const Segment& s) {
  const double turn = total_turning(s);
  const Point2 end = evaluate(s, 1);
  const double weight = std::cos(0.5 * turn);
  const double handle = std::tan(0.5 * turn) / s.curvature_start;
  const Point2 corner = s.start.position + handle * core::unit_vector(s.start.direction);
  return {{s.start.position, corner, end}, {1, weight, 1}};
}

}  // namespace

Result<CadBeziers> to_beziers(const Chain& chain, const CadOptions& options) {
  if (auto checked = check(options); !checked) return std::unexpected(checked.error());
  if (auto valid = validate(chain); !valid) return std::unexpected(valid.error());
  CadBeziers out;
  for (const Segment& s : segments(chain)) {
    if (!(options.tolerance > kFinest * s.length)) return too_fine();
    if (!append_segment(s, options, out)) return too_fine();
  }
  return out;
}

Result<CadBeziers> to_beziers(const Segment& segment, const CadOptions& options) {
  return to_beziers(chain_of(segment), options);
}

Result<CadSpline> to_bspline(const Chain& chain, const CadOptions& options) {
  auto beziers = to_beziers(chain, options);
  if (!beziers) return std::unexpected(beziers.error());
  auto spline = curve::to_bspline(beziers->pieces);
  if (!spline) return std::unexpected(spline.error());
  return CadSpline{std::move(*spline), beziers->deviation, beziers->not_monotone};
}

Result<CadSpline> to_bspline(const Segment& segment, const CadOptions& options) {
  return to_bspline(chain_of(segment), options);
}

Result<curve::BSpline2> exact_nurbs(const Chain& chain) {
  if (auto valid = validate(chain); !valid) return std::unexpected(valid.error());
  std::vector<Bezier2> path;
  const auto all = segments(chain);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Segment& s = all[i];
    if (s.curvature_start != s.curvature_end)
      return core::fail(ErrorCode::unsupported, "only arcs and straight lines are exact as NURBS",
                        "convert within a tolerance", "pieces[" + std::to_string(i) + "]");
    const double turn = std::abs(total_turning(s));
    const int parts = static_cast<int>(std::ceil(turn / (0.5 * core::kPi) - 1e-9));
    for (int k = 0; k < parts; ++k)
      path.push_back(quarter(part(s, static_cast<double>(k) / parts, (k + 1.0) / parts)));
    if (parts == 0) path.push_back({{s.start.position, evaluate(s, 1)}, {}});
    const std::size_t first = path.size() - std::max(parts, 1);
    for (std::size_t k = std::max<std::size_t>(first, 1); k < path.size(); ++k)
      path[k].control.front() = path[k - 1].control.back();
  }
  return curve::to_bspline(path);
}

}  // namespace keyline::lac
