#include "keyline/operations/made_curve.h"

#include <algorithm>
#include <iterator>

#include "keyline/curve/conversion.h"
#include "keyline/lac/cad/cad.h"
#include "keyline/lac/space/space.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;
using core::Type;
using Kind = Type::Kind;

curve::Bezier2 raised(const curve::Bezier2& piece, int to) {
  const int by = to - static_cast<int>(piece.control.size() - 1);
  return by > 0 ? elevate_degree(piece, by) : piece;
}

/// The polynomial pieces the curve consists of, if none is above the degree.
std::optional<std::vector<curve::Bezier2>> exact_pieces(const document::PlanarCurve& c,
                                                        int degree) {
  std::vector<curve::Bezier2> pieces;
  if (const auto* bezier = std::get_if<curve::Bezier2>(&c.value)) pieces = {*bezier};
  if (const auto* spline = std::get_if<curve::BSpline2>(&c.value)) pieces = to_beziers(*spline);
  const auto fits = [&](const curve::Bezier2& piece) {
    return !is_rational(piece) && curve::degree(piece) <= degree;
  };
  if (pieces.empty() || !std::all_of(pieces.begin(), pieces.end(), fits)) return std::nullopt;
  return pieces;
}

/// Polynomials of the degree or less exactly; of a log-aesthetic chain cubics, or quintics from
/// degree 5 on, their distance bounded rigorously; other curves, and chains with a cusp, as cubics.
Result<curve::PiecewiseBezier> pieces_of(const document::PlanarCurve& c, int degree,
                                         double tolerance) {
  if (auto exact = exact_pieces(c, degree)) return curve::PiecewiseBezier{std::move(*exact), 0};
  if (const auto* chain = std::get_if<lac::Chain>(&c.value)) {
    lac::CadOptions options;
    options.degree = degree < 5 ? 3 : 5;
    options.tolerance = tolerance;
    options.monotone = false;
    auto made = lac::to_beziers(*chain, options);
    if (made) return curve::PiecewiseBezier{std::move(made->pieces), made->deviation};
    if (made.error().code == ErrorCode::not_converged) return std::unexpected(made.error());
  }
  return std::visit([&](const auto& v) { return curve::approximate_by_cubics(v, tolerance); },
                    c.value);
}

Result<curve::PiecewiseBezier> joined_pieces(const document::Path& path, int degree,
                                             double tolerance) {
  curve::PiecewiseBezier all;
  for (const document::PlanarCurve& c : path.curves) {
    auto part = pieces_of(c, degree, tolerance);
    if (!part) return part;
    all.deviation = std::max(all.deviation, part->deviation);
    std::move(part->pieces.begin(), part->pieces.end(), std::back_inserter(all.pieces));
  }
  return all;
}

std::string tolerance_path(const char* name) { return std::string(name) + ".tolerance"; }

Result<curve::PiecewiseBezier> pieces_for(const Form& form, const char* name,
                                          const document::Path& path) {
  auto all = joined_pieces(path, form.degree, form.tolerance);
  if (!all) {
    all.error().path = tolerance_path(name);
    return all;
  }
  for (curve::Bezier2& piece : all->pieces) piece = raised(piece, form.degree);
  if (all->deviation > form.tolerance)
    return core::fail(ErrorCode::not_converged, "the tolerance is below what doubles can do",
                      "give 1e-12 of the size or more", tolerance_path(name));
  return all;
}

curve::Polyline2 polyline_of(const document::Path& path, int count) {
  if (path.curves.size() == 1)
    if (const auto* chain = std::get_if<lac::Chain>(&path.curves[0].value))
      return {lac::sample(*chain, count)};
  return {curve::sample(path, count)};
}

Result<void> add_plane_forms(const document::Path& path, const Forms& forms, MadeCurve& to) {
  if (forms.samples) to.polyline = document::PlanarCurve{polyline_of(path, *forms.samples)};
  if (forms.bezier) {
    const auto pieces = pieces_for(*forms.bezier, "bezier", path);
    if (!pieces) return std::unexpected(pieces.error());
    document::Path beziers{{}, path.closed};
    for (const curve::Bezier2& piece : pieces->pieces) beziers.curves.push_back({piece});
    to.bezier = BoundedCurve{std::move(beziers), pieces->deviation};
  }
  if (forms.nurbs) {
    const auto pieces = pieces_for(*forms.nurbs, "nurbs", path);
    if (!pieces) return std::unexpected(pieces.error());
    auto spline = curve::to_bspline(pieces->pieces, forms.nurbs->tolerance);
    if (!spline) return std::unexpected(spline.error());
    to.nurbs = BoundedCurve{document::PlanarCurve{std::move(*spline)}, pieces->deviation};
  }
  if (forms.comb) {
    auto comb = sampled_comb(path, *forms.comb);
    if (!comb) return std::unexpected(comb.error());
    to.comb = std::move(*comb);
  }
  return {};
}

/// The same for a log-aesthetic curve in space: quintics, or what degree from 5 on is asked for.
lac::SpaceBeziers space_pieces(const lac::SpaceChain& chain, const Form& form) {
  auto made = lac::approximate_by_quintics(chain, form.tolerance);
  for (curve::Bezier3& piece : made.pieces)
    if (form.degree > 5) piece = elevate_degree(piece, form.degree - 5);
  return made;
}

Result<void> add_space_forms(const lac::SpaceChain& chain, const Forms& forms, MadeCurve& to) {
  if (forms.samples)
    to.polyline = document::SpaceCurve{curve::Polyline3{lac::sample(chain, *forms.samples)}};
  if (forms.bezier) {
    auto made = space_pieces(chain, *forms.bezier);
    SpacePath path;
    for (curve::Bezier3& piece : made.pieces) path.curves.push_back({std::move(piece)});
    to.bezier = BoundedCurve{std::move(path), made.deviation};
  }
  if (forms.nurbs) {
    const auto made = space_pieces(chain, *forms.nurbs);
    auto spline = curve::to_bspline(made.pieces, forms.nurbs->tolerance);
    if (!spline) return std::unexpected(spline.error());
    to.nurbs = BoundedCurve{document::SpaceCurve{std::move(*spline)}, made.deviation};
  }
  return {};
}

Result<void> add_to(MadeCurve& to, const Forms& forms) {
  if (const auto path = planar_path(to.curve)) return add_plane_forms(*path, forms, to);
  if (forms.comb)
    return core::fail(ErrorCode::unsupported, "a comb is drawn of planar curves", "leave out comb",
                      "comb");
  if (const auto* space = std::get_if<document::SpaceCurve>(&to.curve))
    if (const auto* chain = std::get_if<lac::SpaceChain>(&space->value))
      return add_space_forms(*chain, forms, to);
  return core::fail(ErrorCode::unsupported, "this curve in space has no other forms",
                    "leave out samples, bezier and nurbs");
}

bool holds(const Type& type, std::vector<const Type*>& seen) {
  if (&type == &core::type_of<MadeCurve>()) return true;
  if (std::find(seen.begin(), seen.end(), &type) != seen.end()) return false;
  seen.push_back(&type);
  if (type.kind == Kind::optional || type.kind == Kind::list) return holds(type.item(), seen);
  if (type.kind != Kind::record) return false;
  const auto fields = type.fields();
  return std::any_of(fields.begin(), fields.end(),
                     [&](const core::Field& field) { return holds(field.type(), seen); });
}

}  // namespace

Result<curve::PiecewiseBezier> bounded_pieces(const document::Path& path, double tolerance) {
  return joined_pieces(path, curve::kMaxBezierDegree, tolerance);
}

MadeCurve made(document::PlanarCurve curve) { return {std::move(curve), {}, {}, {}, {}}; }

bool holds_made_curve(const Type& type) {
  std::vector<const Type*> seen;
  return holds(type, seen);
}

Result<void> add_forms(const Type& type, void* value, const Forms& forms) {
  if (!forms.samples && !forms.bezier && !forms.nurbs && !forms.comb) return {};
  if (&type == &core::type_of<MadeCurve>()) return add_to(*static_cast<MadeCurve*>(value), forms);
  if (!holds_made_curve(type)) return {};
  if (type.kind == Kind::optional) {
    void* const held = const_cast<void*>(type.held(value));
    return held ? add_forms(type.item(), held, forms) : Result<void>{};
  }
  if (type.kind == Kind::list) {
    for (std::size_t i = 0; i < type.size(value); ++i)
      if (auto done = add_forms(type.item(), type.at(value, i), forms); !done) return done;
    return {};
  }
  for (const core::Field& field : type.fields())
    if (auto done = add_forms(field.type(), field.at(value), forms); !done) return done;
  return {};
}

}  // namespace keyline::operations
