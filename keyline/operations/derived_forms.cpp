#include "keyline/operations/derived_forms.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>

#include "keyline/curve/conversion.h"
#include "keyline/exchange/json_curve.h"
#include "keyline/exchange/json_space.h"
#include "keyline/lac/cad.h"
#include "keyline/lac/space.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;
using nlohmann::json;

constexpr int kMostSamples = 10'000'000;

Result<double> tolerance_of(const json& form, const char* name) {
  if (!form.is_object() || !form.contains("tolerance"))
    return fail(ErrorCode::bad_input, "a tolerance is wanted here",
                "give {\"tolerance\": a length}", std::string(name) + ".tolerance");
  const auto value =
      exchange::number_from_json(form["tolerance"], std::string(name) + ".tolerance");
  if (!value) return value;
  if (!(*value > 0))
    return fail(ErrorCode::bad_input, "the tolerance is not greater than zero",
                "give a length greater than zero", std::string(name) + ".tolerance");
  return value;
}

/// The degree asked for, 3 unless given; what is made of lower degree is raised to it.
Result<int> degree_of(const json& form, const char* name) {
  if (!form.contains("degree")) return 3;
  const json& degree = form["degree"];
  if (!degree.is_number_integer() || degree.get<std::int64_t>() < 3 ||
      degree.get<std::int64_t>() > 30)
    return fail(ErrorCode::bad_input, "the degree is out of range",
                "give a whole number from 3 to 30", std::string(name) + ".degree");
  return degree.get<int>();
}

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

Result<curve::PiecewiseBezier> pieces_for(const json& form, const char* name,
                                          const document::Path& path) {
  const auto tolerance = tolerance_of(form, name);
  if (!tolerance) return std::unexpected(tolerance.error());
  const auto degree = degree_of(form, name);
  if (!degree) return std::unexpected(degree.error());
  auto all = joined_pieces(path, *degree, *tolerance);
  if (!all) {
    all.error().path = std::string(name) + ".tolerance";
    return all;
  }
  for (curve::Bezier2& piece : all->pieces) piece = raised(piece, *degree);
  if (all->deviation > *tolerance)
    return fail(ErrorCode::not_converged, "the tolerance is below what doubles can do",
                "give 1e-12 of the size or more", std::string(name) + ".tolerance");
  return all;
}

Result<int> sample_count(const json& wanted) {
  if (!wanted.is_number_integer() || wanted.get<std::int64_t>() < 2 ||
      wanted.get<std::int64_t>() > kMostSamples)
    return fail(ErrorCode::bad_input, "\"samples\" is out of range",
                "give a whole number from 2 to 10000000", "samples");
  return wanted.get<int>();
}

Result<void> add_samples(const json& wanted, const document::Path& path, json& result) {
  const auto count = sample_count(wanted);
  if (!count) return std::unexpected(count.error());
  const int n = *count;
  curve::Polyline2 line;
  if (path.curves.size() == 1 && std::holds_alternative<lac::Chain>(path.curves[0].value))
    line.points = lac::sample(std::get<lac::Chain>(path.curves[0].value), n);
  else
    line.points = curve::sample(path, n);
  result["polyline"] = exchange::to_json(document::PlanarCurve{std::move(line)});
  return {};
}

Result<void> add_bezier(const json& form, const document::Path& path, json& result) {
  const auto made = pieces_for(form, "bezier", path);
  if (!made) return std::unexpected(made.error());
  document::Path as_path{{}, path.closed};
  for (const curve::Bezier2& piece : made->pieces) as_path.curves.push_back({piece});
  result["bezier"] = exchange::to_json(as_path);
  result["bezier"]["deviation"] = made->deviation;
  return {};
}

Result<void> add_nurbs(const json& form, const document::Path& path, json& result) {
  const auto made = pieces_for(form, "nurbs", path);
  if (!made) return std::unexpected(made.error());
  const auto spline = curve::to_bspline(made->pieces, tolerance_of(form, "nurbs").value());
  if (!spline) return std::unexpected(spline.error());
  result["nurbs"] = exchange::to_json(document::PlanarCurve{*spline});
  result["nurbs"]["deviation"] = made->deviation;
  return {};
}

/// The same for a curve in space: quintics, or what degree from 5 on is asked for.
Result<void> add_space_forms(const json& request, const lac::SpaceChain& chain, json& result) {
  if (request.contains("samples")) {
    const auto n = sample_count(request["samples"]);
    if (!n) return std::unexpected(n.error());
    result["polyline"] = exchange::polyline_json(lac::sample(chain, *n));
  }
  for (const char* name : {"bezier", "nurbs"}) {
    if (!request.contains(name)) continue;
    const auto tolerance = tolerance_of(request[name], name);
    if (!tolerance) return std::unexpected(tolerance.error());
    const auto degree = degree_of(request[name], name);
    if (!degree) return std::unexpected(degree.error());
    auto made = lac::approximate_by_quintics(chain, *tolerance);
    for (curve::Bezier3& piece : made.pieces)
      if (*degree > 5) piece = elevate_degree(piece, *degree - 5);
    json& form = result[name];
    if (std::string_view(name) == "nurbs") {
      const auto spline = curve::to_bspline(made.pieces, *tolerance);
      if (!spline) return std::unexpected(spline.error());
      form = exchange::to_json(*spline);
    } else {
      form = {{"type", "path"}, {"curves", json::array()}, {"closed", false}};
      for (const curve::Bezier3& piece : made.pieces)
        form["curves"].push_back(exchange::to_json(piece));
    }
    form["deviation"] = made.deviation;
  }
  return {};
}

/// Adds the forms beside a member "curve" of `holder`.
Result<void> add_forms(const json& request, json& holder) {
  if (holder["curve"]["type"] == "log-aesthetic-space") {
    const auto chain = exchange::space_chain_from_json(holder["curve"], "curve");
    if (!chain) return std::unexpected(chain.error());
    return add_space_forms(request, *chain, holder);
  }
  const auto path = exchange::path_from_json(holder["curve"], "curve");
  if (!path) return std::unexpected(path.error());
  if (request.contains("samples"))
    if (auto done = add_samples(request["samples"], *path, holder); !done) return done;
  if (request.contains("bezier"))
    if (auto done = add_bezier(request["bezier"], *path, holder); !done) return done;
  if (request.contains("nurbs"))
    if (auto done = add_nurbs(request["nurbs"], *path, holder); !done) return done;
  return {};
}

}  // namespace

Result<curve::PiecewiseBezier> bounded_pieces(const document::Path& path, double tolerance) {
  return joined_pieces(path, curve::kMaxBezierDegree, tolerance);
}

Result<void> add_derived_forms(const json& request, json& result) {
  const bool wanted =
      request.contains("samples") || request.contains("bezier") || request.contains("nurbs");
  if (!wanted) return {};
  if (result.contains("curve")) return add_forms(request, result);
  if (!result.contains("strokes"))
    return fail(ErrorCode::unsupported, "the result holds no curve to convert",
                "leave out samples, bezier and nurbs");
  for (json& stroke : result["strokes"])
    if (auto done = add_forms(request, stroke); !done) return done;
  return {};
}

}  // namespace keyline::operations
