#include "keyline/operations/spline_input.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "keyline/curve/conversion.h"
#include "keyline/exchange/json_curve.h"
#include "keyline/exchange/json_space.h"
#include "keyline/lac/cad.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::fail;
using core::Point3;
using core::Result;
using nlohmann::json;

/// The value with points [x, y], so that the planar reader checks it, and the z apart.
struct Flat {
  json value;
  std::vector<double> z;
  bool planar = true;
};

Flat flattened(const json& j) {
  Flat flat{j, {}, true};
  const auto points = flat.value.find("points");
  if (points == flat.value.end() || !points->is_array()) return flat;
  for (json& p : *points) {
    const bool three = p.is_array() && p.size() == 3 && p[2].is_number();
    flat.z.push_back(three ? p[2].get<double>() : 0.0);
    flat.planar = flat.planar && flat.z.back() == 0;
    if (three) p = json::array({p[0], p[1]});
  }
  return flat;
}

curve::BSpline3 lifted(const curve::BSpline2& c, const std::vector<double>& z) {
  curve::BSpline3 s{c.degree, c.knots, {}, c.weights};
  for (std::size_t i = 0; i < c.control.size(); ++i)
    s.control.push_back({c.control[i].x, c.control[i].y, i < z.size() ? z[i] : 0});
  return s;
}

curve::BSpline2 as_spline(const curve::Bezier2& c) {
  std::vector<double> knots(c.control.size(), 0.0);
  knots.insert(knots.end(), c.control.size(), 1.0);
  return {static_cast<int>(c.control.size()) - 1, std::move(knots), c.control, c.weights};
}

/// Even knots over the points: nothing is dropped, so that z stays with its point.
curve::BSpline2 as_spline(const curve::Polyline2& c) {
  curve::BSpline2 s{1, {0}, c.points, {}};
  for (std::size_t i = 0; i < c.points.size(); ++i) s.knots.push_back(static_cast<double>(i));
  s.knots.push_back(static_cast<double>(c.points.size() - 1));
  return s;
}

Result<SplineInput> from_chain(const lac::Chain& chain, double tolerance) {
  const auto made = lac::to_bspline(chain, {5, tolerance, true});
  if (!made) return std::unexpected(made.error());
  return SplineInput{lifted(made->curve, {}), made->deviation, true};
}

Result<SplineInput> from_space_chain(const json& j, const std::string& where, double tolerance) {
  const auto chain = exchange::space_chain_from_json(j, where);
  if (!chain) return std::unexpected(chain.error());
  const lac::SpaceBeziers made = lac::approximate_by_quintics(*chain, tolerance);
  auto spline = curve::to_bspline(made.pieces, tolerance);
  if (!spline) return std::unexpected(spline.error());
  return SplineInput{std::move(*spline), made.deviation, false};
}

Result<SplineInput> from_path(const json& j, const std::string& where, double tolerance) {
  const auto members = j.find("curves");
  if (members == j.end() || !members->is_array() || members->empty())
    return fail(ErrorCode::bad_input, "a list of curves is wanted here", "give at least one",
                where + ".curves");
  SplineInput whole;
  std::vector<curve::Bezier3> pieces;
  for (std::size_t i = 0; i < members->size(); ++i) {
    const auto part =
        spline_from_json((*members)[i], where + ".curves[" + std::to_string(i) + "]", tolerance);
    if (!part) return part;
    for (auto& piece : curve::to_beziers(part->curve)) pieces.push_back(std::move(piece));
    whole.deviation = std::max(whole.deviation, part->deviation);
    whole.planar = whole.planar && part->planar;
  }
  auto spline = curve::to_bspline(pieces, tolerance);
  if (!spline) return std::unexpected(spline.error());
  whole.curve = std::move(*spline);
  return whole;
}

}  // namespace

Result<SplineInput> spline_from_json(const json& j, const std::string& where, double tolerance) {
  const json type = j.is_object() ? j.value("type", json()) : json();
  if (type == "log-aesthetic-space") return from_space_chain(j, where, tolerance);
  if (type == "path") return from_path(j, where, tolerance);
  const Flat flat = j.is_object() ? flattened(j) : Flat{j, {}, true};
  const auto c = exchange::curve_from_json(flat.value, where);
  if (!c) return std::unexpected(c.error());
  if (const auto* chain = std::get_if<lac::Chain>(&c->value)) return from_chain(*chain, tolerance);
  if (const auto* spline = std::get_if<curve::BSpline2>(&c->value))
    return SplineInput{lifted(*spline, flat.z), 0, flat.planar};
  if (const auto* bezier = std::get_if<curve::Bezier2>(&c->value))
    return SplineInput{lifted(as_spline(*bezier), flat.z), 0, flat.planar};
  return SplineInput{lifted(as_spline(std::get<curve::Polyline2>(c->value)), flat.z), 0,
                     flat.planar};
}

double size_of_curve_json(const json& j) {
  double low = INFINITY;
  double high = -INFINITY;
  double length = 0;
  const auto visit = [&](const auto& self, const json& value) -> void {
    if (!value.is_object()) return;
    for (const json& p : value.value("points", json::array()))
      if (p.is_array())
        for (const json& x : p)
          if (x.is_number()) {
            low = std::min(low, x.get<double>());
            high = std::max(high, x.get<double>());
          }
    for (const json& piece : value.value("pieces", json::array()))
      if (piece.is_object() && piece.contains("length") && piece["length"].is_number())
        length += std::abs(piece["length"].get<double>());
    for (const json& member : value.value("curves", json::array())) self(self, member);
  };
  visit(visit, j);
  const double size = std::max(high - low, length);
  return size > 0 && std::isfinite(size) ? size : 1;
}

}  // namespace keyline::operations
