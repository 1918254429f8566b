#include "keyline/exchange/json/json_curve.h"

#include <cmath>
#include <limits>

#include "keyline/core/coordinate.h"
#include "keyline/document/path_gap.h"
#include "keyline/exchange/json/json_parts.h"
#include "keyline/lac/chain/chain.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;
using core::fail;
using core::Point2;
using core::Result;
using detail::closed_of;
using detail::in;
using detail::member;
using detail::type_of;
using document::Path;
using document::PlanarCurve;
using nlohmann::json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using detail::curve_json;

json curve_json(const lac::Chain& c) {
  json pieces = json::array();
  for (const lac::Piece& p : c.pieces) {
    json piece{{"alpha", p.alpha}, {"length", p.length}};
    const bool cusp = std::isinf(p.curvature_start) || std::isinf(p.curvature_end);
    if (cusp)
      piece["radius"] = {1 / p.curvature_start, 1 / p.curvature_end};
    else
      piece["curvature"] = {p.curvature_start, p.curvature_end};
    pieces.push_back(std::move(piece));
  }
  return {{"type", "log-aesthetic"},
          {"start", to_json(c.start.position)},
          {"direction", c.start.direction},
          {"closed", c.closed},
          {"pieces", std::move(pieces)}};
}

/// "curvature":[κ0,κ1] or "radius":[ρ0,ρ1], the latter with 0 for a cusp.
Result<std::array<double, 2>> end_curvatures(const json& j, const std::string& where) {
  const bool by_radius = j.contains("radius");
  if (by_radius == j.contains("curvature"))
    return fail(ErrorCode::bad_input, "a piece has either \"curvature\" or \"radius\"",
                "give one of the two", where);
  auto pair = detail::pair_member(j, by_radius ? "radius" : "curvature", where);
  if (!pair || !by_radius) return pair;
  const double sign = (*pair)[0] < 0 || (*pair)[1] < 0 ? -1 : 1;
  for (double& x : *pair) x = x == 0 ? sign * kInfinity : 1 / x;
  return pair;
}

Result<lac::Piece> read_piece(const json& j, const std::string& where) {
  if (!j.is_object())
    return fail(ErrorCode::bad_input, "a piece is wanted here",
                "give {\"alpha\":…, \"length\":…, \"curvature\":[…]}", where);
  lac::Piece piece;
  for (const auto& [key, target] :
       {std::pair{"alpha", &piece.alpha}, std::pair{"length", &piece.length}}) {
    const auto n = detail::number_member(j, key, where);
    if (!n) return std::unexpected(n.error());
    *target = *n;
  }
  const auto ends = end_curvatures(j, where);
  if (!ends) return std::unexpected(ends.error());
  piece.curvature_start = (*ends)[0];
  piece.curvature_end = (*ends)[1];
  return piece;
}

Result<PlanarCurve> read_chain(const json& j, const std::string& where) {
  lac::Chain chain;
  const auto start = member(j, "start", where);
  if (!start) return std::unexpected(start.error());
  const auto position = point_from_json(**start, in(where, "start"));
  if (!position) return std::unexpected(position.error());
  const auto direction = detail::number_member(j, "direction", where);
  if (!direction) return std::unexpected(direction.error());
  if (std::abs(*direction) > lac::kLargestTurning)
    return fail(ErrorCode::bad_input, "the direction lies beyond 1e5 radians",
                "take off whole turns", in(where, "direction"));
  chain.start = {*position, *direction};
  const auto closed = closed_of(j, where);
  if (!closed) return std::unexpected(closed.error());
  chain.closed = *closed;
  auto pieces = detail::list_member(j, "pieces", "pieces", where, read_piece);
  if (!pieces) return std::unexpected(pieces.error());
  chain.pieces = std::move(*pieces);
  return PlanarCurve{std::move(chain)};
}

template <class T>
Result<PlanarCurve> planar(Result<T> read) {
  if (!read) return std::unexpected(std::move(read.error()));
  return PlanarCurve{std::move(*read)};
}

Result<PlanarCurve> read_by_type(const json& j, const std::string& type, const std::string& where) {
  if (type == "polyline") return planar(detail::read_polyline<Point2>(j, where));
  if (type == "bezier") return planar(detail::read_bezier<Point2>(j, where));
  if (type == "bspline") return planar(detail::read_bspline<Point2>(j, where));
  if (type == "log-aesthetic") return read_chain(j, where);
  return fail(ErrorCode::bad_input, "\"" + type + "\" is not a planar curve type",
              "use polyline, bezier, bspline, log-aesthetic or path", in(where, "type"));
}

}  // namespace

json to_json(Point2 p) { return json::array({p.x, p.y}); }

json to_json(const PlanarCurve& c) {
  return std::visit([](const auto& v) { return curve_json(v); }, c.value);
}

json to_json(const Path& path) {
  json curves = json::array();
  for (const PlanarCurve& c : path.curves) curves.push_back(to_json(c));
  return {{"type", "path"}, {"curves", std::move(curves)}, {"closed", path.closed}};
}

Result<double> number_from_json(const json& j, const std::string& where) {
  if (!j.is_number())
    return fail(ErrorCode::bad_input, "a number is wanted here", "give a finite number", where);
  const double value = j.get<double>();
  if (!std::isfinite(value))
    return fail(ErrorCode::bad_input, "the number is not finite", "give a finite number", where);
  return core::with_all_digits(value);
}

Result<Point2> point_from_json(const json& j, const std::string& where) {
  const auto c = detail::coordinates_of(j, where, "give [x, y]");
  if (!c) return std::unexpected(c.error());
  if ((*c)[2] != 0)
    return fail(ErrorCode::unsupported, "a point in space where a planar one is wanted",
                "project the points on a plane first", where);
  return Point2{(*c)[0], (*c)[1]};
}

Result<PlanarCurve> curve_from_json(const json& j, const std::string& where) {
  const auto type = type_of(j, where);
  if (!type) return std::unexpected(type.error());
  auto c = read_by_type(j, *type, where);
  if (!c) return c;
  if (auto sound = validate(*c); !sound) return detail::placed(sound.error(), where);
  return c;
}

Result<Path> path_from_json(const json& j, const std::string& where) {
  const auto type = type_of(j, where);
  if (!type) return std::unexpected(type.error());
  Path path;
  if (*type != "path") {
    auto only = curve_from_json(j, where);
    if (!only) return std::unexpected(only.error());
    if (const auto* chain = std::get_if<lac::Chain>(&only->value)) path.closed = chain->closed;
    path.curves.push_back(std::move(*only));
    return path;
  }
  auto curves = detail::list_member(j, "curves", "curves", where, curve_from_json);
  if (!curves) return std::unexpected(curves.error());
  path.curves = std::move(*curves);
  const auto closed = closed_of(j, where);
  if (!closed) return std::unexpected(closed.error());
  path.closed = *closed;
  if (const auto gap = document::first_gap(path))
    return fail(ErrorCode::bad_input, "this curve of a path " + in_words(*gap),
                "close the gap with a line, or give two paths",
                in(in(where, "curves"), gap->member));
  if (path.closed) close_gaps(path);  // as in drawings
  return path;
}

}  // namespace keyline::exchange
