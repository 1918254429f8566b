#include "keyline/exchange/json_curve.h"
#include "keyline/operations/analysis_json.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

core::Result<nlohmann::json> run(const nlohmann::json& request, const Context&) {
  std::vector<document::PlanarCurve> curves;
  for (const auto& value : request.at("curves")) {
    const auto path = exchange::path_from_json(value, "curves");
    if (!path) return std::unexpected(path.error());
    curves.insert(curves.end(), path->curves.begin(), path->curves.end());
  }
  const bool closed = boolean_or(request, "closed", false);
  if (curves.size() < 2 && !closed)
    return core::fail(core::ErrorCode::bad_input, "a joint needs two curves",
                      "give at least two curves, or \"closed\": true", "curves");
  analysis::ContinuityTolerance tolerance;
  tolerance.gap = number_or(request, "gap", tolerance.gap);
  tolerance.angle = number_or(request, "angle", tolerance.angle);
  tolerance.curvature = number_or(request, "curvature", tolerance.curvature);
  tolerance.curvature_rate = number_or(request, "curvature_rate", tolerance.curvature_rate);
  nlohmann::json joints = nlohmann::json::array();
  int least = 3;
  for (const auto& joint : analysis::continuity(curves, closed, tolerance)) {
    joints.push_back(joint_json(joint));
    least = std::min(least, joint.order);
  }
  return nlohmann::json{{"joints", std::move(joints)},
                        {"order", least < 0 ? "none" : "G" + std::to_string(least)}};
}

}  // namespace

Operation curve_continuity_operation() {
  using Type = Field::Type;
  const auto line = [](double x0, double y0, double x1, double y1) {
    return nlohmann::json{{"type", "polyline"}, {"points", {{x0, y0}, {x1, y1}}}};
  };
  return {
      "curve.continuity",
      "Gap, angle, curvature and curvature-rate jumps where one curve ends and the next begins, "
      "and the order G0 to G3 they amount to.",
      {{"curves", Type::curves, true, "the curves in order; a path counts as its members"},
       {"closed", Type::boolean, false, "also the joint from the last curve to the first"},
       {"gap", Type::number, false, "largest gap that still joins, 1e-6"},
       {"angle", Type::number, false, "largest angle of a G1 joint in radians, 1e-4"},
       {"curvature", Type::number, false, "largest relative jump of a G2 joint, 1e-3"},
       {"curvature_rate", Type::number, false, "the same of a G3 joint, 1e-2"}},
      run,
      {{"curves", nlohmann::json::array({line(0, 0, 1, 0), line(1, 0, 2, 0)})}}};
}

}  // namespace keyline::operations
