#include "keyline/exchange/json_curve.h"
#include "keyline/lac/compound.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

core::Result<nlohmann::json> run(const nlohmann::json& request, const Context&) {
  const auto handles = three_handles(request);
  if (!handles) return std::unexpected(handles.error());
  const auto alpha = numbers_of_count(request, "alpha", 2, 2);
  if (!alpha) return std::unexpected(alpha.error());
  const auto ratio = share_of(request, "ratio");
  if (!ratio) return std::unexpected(ratio.error());
  const auto& [p0, p1, p2] = *handles;
  const auto solved = lac::solve_compound(p0, p1, p2, {(*alpha)[0], (*alpha)[1], *ratio});
  if (!solved) return std::unexpected(solved.error());
  return nlohmann::json{{"curve", exchange::to_json(document::PlanarCurve{solved->chain})},
                        {"lambda", {solved->lambda0, solved->lambda1}},
                        {"joint", exchange::to_json(solved->joint)},
                        {"theta", solved->turning},
                        {"chord_angle", solved->chord_angle},
                        {"reversed", solved->reversed}};
}

}  // namespace

Operation lac_compound_operation() {
  using Type = Field::Type;
  return {"lac.compound",
          "The compound-rhythm curve from the handles P0, P1, P2: two log-aesthetic pieces with "
          "curvature and its rate continuous at the joint (G3).",
          {{"points", Type::points, true, "P0, P1, P2: ends P0 and P2, tangents along P0P1, P1P2"},
           {"alpha", Type::numbers, true, "two slopes, the first for the end of smaller radius"},
           {"ratio", Type::number, true,
            "share of the whole turning that falls to the first slope, between 0 and 1"}},
          run,
          {{"points", {{0, 0}, {2, 0}, {3, 1.5}}}, {"alpha", {-1, 1.5}}, {"ratio", 0.4}}};
}

}  // namespace keyline::operations
