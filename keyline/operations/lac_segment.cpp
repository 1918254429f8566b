#include "keyline/exchange/json_curve.h"
#include "keyline/lac/clamped.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

core::Result<nlohmann::json> run(const nlohmann::json& request, const Context&) {
  const auto handles = three_handles(request);
  if (!handles) return std::unexpected(handles.error());
  const auto& [p0, p1, p2] = *handles;
  const auto solved = lac::solve_g1_chain(p0, p1, p2, number_or(request, "alpha", -1));
  if (!solved) return std::unexpected(solved.error());
  return nlohmann::json{{"curve", exchange::to_json(document::PlanarCurve{solved->chain})},
                        {"lambda", solved->lambda},
                        {"theta", solved->turning},
                        {"chord_angle", solved->chord_angle},
                        {"reversed", solved->reversed},
                        {"clamped", solved->clamped}};
}

}  // namespace

Operation lac_segment_operation() {
  using Type = Field::Type;
  return {
      "lac.segment",
      "The log-aesthetic segment of slope alpha through two ends with given tangents "
      "(G1 Hermite), from the handles P0, P1, P2.",
      {{"points", Type::points, true, "P0, P1, P2: ends P0 and P2, tangents along P0P1 and P1P2"},
       {"alpha", Type::number, true, "slope of the logarithmic curvature graph; any number"}},
      run,
      {{"points", {{0, 0}, {2, 0}, {3, 1.5}}}, {"alpha", -1}}};
}

}  // namespace keyline::operations
