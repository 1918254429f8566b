#include "keyline/exchange/json_curve.h"
#include "keyline/lac/blend.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;
using nlohmann::json;

Result<lac::BlendOrder> order_of(const json& request) {
  const std::string name = string_or(request, "order", "G2");
  if (name == "G1") return lac::BlendOrder::g1;
  if (name == "G2") return lac::BlendOrder::g2;
  if (name == "G3") return lac::BlendOrder::g3;
  return core::fail(ErrorCode::bad_input, "\"" + name + "\" is no order", "use G1, G2 or G3",
                    "order");
}

/// Where the blend leaves the first curve and joins the second: parameters in [0, 1].
Result<std::array<double, 2>> places_of(const json& request) {
  if (!request.contains("at")) return std::array{1.0, 0.0};
  const auto at = numbers_of_count(request, "at", 2, 2);
  if (!at) return std::unexpected(at.error());
  for (const double t : *at)
    if (!(t >= 0 && t <= 1))
      return core::fail(ErrorCode::bad_input, "a place on a curve is out of range",
                        "give parameters from 0 (start) to 1 (end)", "at");
  return std::array{(*at)[0], (*at)[1]};
}

Result<json> run(const json& request, const Context&) {
  const json& curves = request.at("curves");
  if (curves.size() != 2)
    return core::fail(ErrorCode::bad_input, "two curves are wanted",
                      "give the one to leave and the one to join", "curves");
  const auto first = exchange::path_from_json(curves[0], "curves[0]").value();
  const auto second = exchange::path_from_json(curves[1], "curves[1]").value();
  const auto at = places_of(request);
  if (!at) return std::unexpected(at.error());
  const auto order = order_of(request);
  if (!order) return std::unexpected(order.error());
  const auto solved =
      lac::solve_blend(lac::blend_end(first, (*at)[0]), lac::blend_end(second, (*at)[1]), *order,
                       number_or(request, "alpha", -1));
  if (!solved) return std::unexpected(solved.error());
  return json{{"curve", exchange::to_json(document::PlanarCurve{solved->chain})},
              {"overridden", solved->overridden},
              {"absolute_turning", solved->absolute_turning},
              {"bending_energy", solved->bending_energy}};
}

}  // namespace

Operation lac_blend_operation() {
  using Type = Field::Type;
  const json first{{"type", "polyline"}, {"points", {{0, 0}, {1, 0}}}};
  const json second{{"type", "polyline"}, {"points", {{3, 1}, {3, 2}}}};
  return {"lac.blend",
          "A log-aesthetic chain from a point of one curve, in its direction, into a point of "
          "another, in its direction, G1 to G3 at both.",
          {{"curves", Type::curves, true, "the curve to leave and the curve to join"},
           {"at", Type::numbers, false,
            "parameters on the two curves, 0 start to 1 end; [1, 0] if left out"},
           {"order", Type::string, false, "G1, G2 or G3; G2 if left out"},
           {"alpha", Type::number, false, "slope of the pieces; -1 if left out"}},
          run,
          {{"curves", {first, second}}, {"order", "G2"}, {"alpha", -1}}};
}

}  // namespace keyline::operations
