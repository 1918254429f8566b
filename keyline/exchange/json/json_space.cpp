#include "keyline/exchange/json/json_space.h"

#include <algorithm>
#include <array>

#include "keyline/document/path_gap.h"
#include "keyline/exchange/json/json_parts.h"

namespace keyline::exchange {
namespace {

using core::ErrorCode;
using core::fail;
using core::Point3;
using core::Result;
using detail::in;
using detail::member;
using detail::number_member;
using nlohmann::json;

json vector_json(core::Vector3 v) { return json::array({v.x, v.y, v.z}); }

Result<lac::SpacePiece> read_piece(const json& j, const std::string& where) {
  if (!j.is_object())
    return fail(ErrorCode::bad_input, "a piece is wanted here",
                "give alpha, beta, length, curvature and torsion", where);
  lac::SpacePiece piece;
  for (const auto& [key, target] :
       {std::pair{"alpha", &piece.alpha}, {"beta", &piece.beta}, {"length", &piece.length}}) {
    const auto n = number_member(j, key, where);
    if (!n) return std::unexpected(n.error());
    *target = *n;
  }
  const auto curvature = detail::pair_member(j, "curvature", where);
  if (!curvature) return std::unexpected(curvature.error());
  const auto torsion = detail::pair_member(j, "torsion", where);
  if (!torsion) return std::unexpected(torsion.error());
  piece.curvature_start = (*curvature)[0];
  piece.curvature_end = (*curvature)[1];
  piece.torsion_start = (*torsion)[0];
  piece.torsion_end = (*torsion)[1];
  return piece;
}

Result<lac::SpaceFrame> read_frame(const json& j, const std::string& where) {
  lac::SpaceFrame frame;
  const auto start = member(j, "start", where);
  if (!start) return std::unexpected(start.error());
  const auto position = point3_from_json(**start, in(where, "start"));
  if (!position) return std::unexpected(position.error());
  frame.position = *position;
  const auto vectors = member(j, "frame", where);
  if (!vectors) return std::unexpected(vectors.error());
  if (!(*vectors)->is_array() || (*vectors)->size() != 3)
    return fail(ErrorCode::bad_input, "three vectors are wanted here",
                "give [tangent, normal, binormal]", in(where, "frame"));
  core::Vector3* const targets[3] = {&frame.tangent, &frame.normal, &frame.binormal};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto v = point3_from_json((**vectors)[i], in(in(where, "frame"), i));
    if (!v) return std::unexpected(v.error());
    *targets[i] = *v - Point3{};
  }
  return frame;
}

}  // namespace

json to_json(Point3 p) { return json::array({p.x, p.y, p.z}); }

json to_json(const lac::SpaceChain& c) {
  json pieces = json::array();
  for (const lac::SpacePiece& p : c.pieces)
    pieces.push_back({{"alpha", p.alpha},
                      {"beta", p.beta},
                      {"length", p.length},
                      {"curvature", {p.curvature_start, p.curvature_end}},
                      {"torsion", {p.torsion_start, p.torsion_end}}});
  return {
      {"type", "log-aesthetic-space"},
      {"start", to_json(c.start.position)},
      {"frame",
       {vector_json(c.start.tangent), vector_json(c.start.normal), vector_json(c.start.binormal)}},
      {"pieces", std::move(pieces)}};
}

json to_json(const curve::Bezier3& c) { return detail::curve_json(c); }

json to_json(const curve::BSpline3& c) { return detail::curve_json(c); }

json to_json(const document::SpaceCurve& c) {
  if (const auto* chain = std::get_if<lac::SpaceChain>(&c.value)) return to_json(*chain);
  if (const auto* line = std::get_if<curve::Polyline3>(&c.value)) return detail::curve_json(*line);
  if (const auto* bezier = std::get_if<curve::Bezier3>(&c.value)) return to_json(*bezier);
  return to_json(std::get<curve::BSpline3>(c.value));
}

Result<Point3> point3_from_json(const json& j, const std::string& where) {
  const auto c = detail::coordinates_of(j, where, "give [x, y, z]");
  if (!c) return std::unexpected(c.error());
  return Point3{(*c)[0], (*c)[1], (*c)[2]};
}

Result<lac::SpaceChain> space_chain_from_json(const json& j, const std::string& where) {
  if (!j.is_object() || j.value("type", json()) != "log-aesthetic-space")
    return fail(ErrorCode::bad_input, "a log-aesthetic space curve is wanted here",
                "give {\"type\":\"log-aesthetic-space\", …}", where);
  const auto frame = read_frame(j, where);
  if (!frame) return std::unexpected(frame.error());
  auto pieces = detail::list_member(j, "pieces", "pieces", where, read_piece);
  if (!pieces) return std::unexpected(pieces.error());
  lac::SpaceChain chain{*frame, std::move(*pieces)};
  if (auto sound = lac::validate(chain); !sound) return detail::placed(sound.error(), where);
  return chain;
}

bool is_space_curve(const json& j) {
  if (!j.is_object()) return false;
  if (j.value("type", json()) == "log-aesthetic-space") return true;
  const auto points = j.find("points");
  if (points == j.end() || !points->is_array()) return false;
  return std::any_of(points->begin(), points->end(), [](const json& p) {
    return p.is_array() && p.size() == 3 && p[2].is_number() && p[2].get<double>() != 0;
  });
}

bool is_space_path(const json& j) {
  if (!j.is_object() || j.value("type", json()) != "path") return false;
  const auto members = j.find("curves");
  return members != j.end() && members->is_array() &&
         std::any_of(members->begin(), members->end(), is_space_curve);
}

Result<std::vector<document::SpaceCurve>> space_path_from_json(const json& j,
                                                               const std::string& where) {
  if (const auto closed = detail::closed_of(j, where); !closed)
    return std::unexpected(closed.error());
  auto members = detail::list_member(j, "curves", "curves", where, space_curve_from_json);
  if (!members) return members;
  if (const auto gap = document::first_gap(*members))
    return core::fail(core::ErrorCode::bad_input, "this curve of a path " + in_words(*gap),
                      "close the gap with a line, or give two curves",
                      in(in(where, "curves"), gap->member));
  return members;
}

Result<document::SpaceCurve> space_curve_from_json(const json& j, const std::string& where) {
  const auto type = detail::type_of(j, where);
  if (!type) return std::unexpected(type.error());
  const auto checked = [&](auto read) -> Result<document::SpaceCurve> {
    if (!read) return std::unexpected(std::move(read.error()));
    document::SpaceCurve c{std::move(*read)};
    if (auto sound = validate(c); !sound) return detail::placed(sound.error(), where);
    return c;
  };
  if (*type == "log-aesthetic-space") return checked(space_chain_from_json(j, where));
  if (*type == "polyline") return checked(detail::read_polyline<Point3>(j, where));
  if (*type == "bezier") return checked(detail::read_bezier<Point3>(j, where));
  if (*type == "bspline") return checked(detail::read_bspline<Point3>(j, where));
  return fail(ErrorCode::bad_input, "\"" + *type + "\" is not a space curve type",
              "use polyline, bezier, bspline or log-aesthetic-space", in(where, "type"));
}

}  // namespace keyline::exchange
