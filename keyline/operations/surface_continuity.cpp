#include "keyline/exchange/json_space.h"
#include "keyline/exchange/json_surface.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"
#include "keyline/surface/continuity.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;
using nlohmann::json;
using surface::Edge;

Result<std::optional<std::array<Edge, 2>>> edges_of(const json& request) {
  if (!request.contains("edges")) return std::nullopt;
  const json& value = request.at("edges");
  std::array<Edge, 2> edges{};
  bool sound = value.is_array() && value.size() == 2;
  for (std::size_t i = 0; sound && i < 2; ++i) {
    const auto edge =
        value[i].is_string() ? surface::edge_named(value[i].get<std::string>()) : std::nullopt;
    sound = edge.has_value();
    if (sound) edges[i] = *edge;
  }
  if (!sound)
    return core::fail(ErrorCode::bad_input, "two edges are wanted here",
                      "give for example [\"u1\", \"u0\"], of u0 u1 v0 v1", "edges");
  return edges;
}

json sample_json(const surface::EdgeSample& s) {
  json j{{"along", s.along}, {"position", exchange::to_json(s.position)}, {"gap", s.gap}};
  if (!s.defined) return j;
  j["angle"] = s.angle;
  j["curvature_jump"] = s.curvature_jump;
  j["rate_jump"] = s.rate_jump;
  return j;
}

json result_json(const surface::EdgeContinuity& c) {
  json samples = json::array();
  for (const surface::EdgeSample& s : c.samples) samples.push_back(sample_json(s));
  return {
      {"edges", {surface::edge_name(c.edges[0]), surface::edge_name(c.edges[1])}},
      {"order", c.order < 0 ? "none" : "G" + std::to_string(c.order)},
      {"pass",
       {{"G0", c.order >= 0}, {"G1", c.order >= 1}, {"G2", c.order >= 2}, {"G3", c.order >= 3}}},
      {"gap", c.gap},
      {"angle", c.angle},
      {"curvature_jump", c.curvature_jump},
      {"rate_jump", c.rate_jump},
      {"relative_curvature_jump", c.relative_curvature_jump},
      {"relative_rate_jump", c.relative_rate_jump},
      {"tolerance",
       {{"gap", c.tolerance.gap},
        {"angle", c.tolerance.angle},
        {"curvature", c.tolerance.curvature},
        {"curvature_rate", c.tolerance.curvature_rate}}},
      {"along", std::move(samples)}};
}

Result<json> run(const json& request, const Context&) {
  const json& values = request.at("surfaces");
  if (values.size() != 2)
    return core::fail(ErrorCode::bad_input, "two surfaces are compared", "give two", "surfaces");
  const auto first = exchange::surface_from_json(values[0], "surfaces[0]");
  const auto second = exchange::surface_from_json(values[1], "surfaces[1]");
  const auto edges = edges_of(request);
  if (!edges) return std::unexpected(edges.error());
  surface::EdgeTolerance tolerance;
  tolerance.gap = number_or(request, "gap", tolerance.gap);
  tolerance.angle = number_or(request, "angle", tolerance.angle);
  tolerance.curvature = number_or(request, "curvature", tolerance.curvature);
  tolerance.curvature_rate = number_or(request, "curvature_rate", tolerance.curvature_rate);
  const auto places = integer_between(request, "places", 101, 2, 100'000);
  if (!places) return std::unexpected(places.error());
  const auto found = surface::edge_continuity(*first, *second, *edges, tolerance, *places);
  if (!found) return std::unexpected(found.error());
  return result_json(*found);
}

}  // namespace

Operation surface_continuity_operation() {
  using Type = Field::Type;
  const auto plane = [](double from, double to) {
    return json{{"type", "bezier-surface"},
                {"points", {{{from, 0, 0}, {from, 1, 0}}, {{to, 0, 0}, {to, 1, 0}}}}};
  };
  return {
      "surface.continuity",
      "Gap, fold angle, curvature jump and jump of its rate along the common edge of two surfaces, "
      "and the order G0 to G3 they amount to.",
      {{"surfaces", Type::surfaces, true, "the two surfaces"},
       {"edges", Type::any, false,
        "an edge of each: u0, u1, v0 or v1; unless given, the two nearest to each other"},
       {"gap", Type::number, false, "largest gap that still joins, 0.001"},
       {"angle", Type::number, false, "largest fold of a G1 joint in radians, 0.016 degrees"},
       {"curvature", Type::number, false, "largest relative jump of a G2 joint, 0.01"},
       {"curvature_rate", Type::number, false, "the same of a G3 joint, 0.05"},
       {"places", Type::integer, false, "places along the edge, 101 unless given"}},
      run,
      {{"surfaces", json::array({plane(0, 1), plane(1, 2)})}}};
}

}  // namespace keyline::operations
