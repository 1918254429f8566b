#include "keyline/exchange/json_space.h"
#include "keyline/lac/space_hermite.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::Result;
using nlohmann::json;

Result<lac::SpaceHermite> data_of(const json& request) {
  const json& tangents = request.at("tangents");
  if (tangents.size() != 2)
    return core::fail(core::ErrorCode::bad_input, "two tangents are wanted",
                      "give the directions of travel at start and end", "tangents");
  const auto vector = [&](std::size_t i) {
    return exchange::point3_from_json(tangents[i], "tangents").value() - core::Point3{};
  };
  return lac::SpaceHermite{exchange::point3_from_json(request.at("start"), "start").value(),
                           exchange::point3_from_json(request.at("end"), "end").value(), vector(0),
                           vector(1)};
}

json slope_or_null(bool defined, double slope) { return defined ? json(slope) : json(); }

Result<json> run(const json& request, const Context&) {
  const auto data = data_of(request);
  if (!data) return std::unexpected(data.error());
  const auto solved =
      lac::solve_g1_space(*data, number_or(request, "alpha", -1), number_or(request, "beta", -1),
                          number_or(request, "omega", 0));
  if (!solved) return std::unexpected(solved.error());
  const lac::SpaceGraphs graphs = lac::logarithmic_graphs(solved->chain.pieces[0]);
  return json{{"curve", exchange::to_json(solved->chain)},
              {"lambda", solved->lambda},
              {"nu", solved->nu},
              {"length", lac::arc_length(solved->chain)},
              {"planar", solved->planar},
              {"slopes",
               {{"curvature", slope_or_null(graphs.curvature_defined, graphs.curvature_slope)},
                {"torsion", slope_or_null(graphs.torsion_defined, graphs.torsion_slope)}}}};
}

}  // namespace

Operation lac_space_operation() {
  using Type = Field::Type;
  return {"lac.space",
          "The log-aesthetic space curve between two points with given tangents: curvature of "
          "slope alpha, torsion of slope beta. lambda, nu and omega are in units of the radius of "
          "curvature at the start; data in one plane give the plane curve.",
          {{"start", Type::point3, true, "where the curve starts"},
           {"end", Type::point3, true, "where it ends"},
           {"tangents", Type::points3, true, "directions of travel at start and end, any length"},
           {"alpha", Type::number, true, "slope of the logarithmic curvature graph"},
           {"beta", Type::number, true, "slope of the logarithmic torsion graph"},
           {"omega", Type::number, true, "rate of the radius of torsion in the standard form"}},
          run,
          {{"start", {0, 0, 0}},
           {"end", {3, 1, 0.5}},
           {"tangents", {{1, 0, 0}, {1, 1, 0.6}}},
           {"alpha", -1},
           {"beta", -1},
           {"omega", 0.1}}};
}

}  // namespace keyline::operations
