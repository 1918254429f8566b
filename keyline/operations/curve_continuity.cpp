#include <algorithm>

#include "keyline/operations/joint.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/values.h"

namespace keyline::operations {
namespace {

struct ContinuityRequest {
  std::vector<document::Path> curves;
  bool closed = false;
  analysis::ContinuityTolerance tolerance;
  static constexpr auto describe() {
    return core::fields(
        core::field<&ContinuityRequest::curves>("the curves in order; a path counts as its members")
            .count(1)
            .needed(),
        core::field<&ContinuityRequest::closed>("also the joint from the last curve to the first"),
        core::flattened<&ContinuityRequest::tolerance>());
  }
};

struct ContinuityResult {
  std::vector<Joint> joints;
  Order order = Order::none;
  static constexpr auto describe() {
    return core::fields(core::field<&ContinuityResult::joints>("one for each joint"),
                        core::field<&ContinuityResult::order>("the least of them"));
  }
};

core::Result<ContinuityResult> run(const ContinuityRequest& request, const Context&) {
  std::vector<document::PlanarCurve> curves;
  for (const document::Path& path : request.curves)
    curves.insert(curves.end(), path.curves.begin(), path.curves.end());
  if (curves.size() < 2 && !request.closed)
    return core::fail(core::ErrorCode::bad_input, "a joint needs two curves",
                      "give at least two curves, or \"closed\": true", "curves");
  ContinuityResult result;
  int least = 3;
  for (const auto& joint : analysis::continuity(curves, request.closed, request.tolerance)) {
    result.joints.push_back(joint_of(joint));
    least = std::min(least, joint.order);
  }
  result.order = order_of(least);
  return result;
}

}  // namespace

Operation curve_continuity_operation() {
  return declare<run>(
      {.name = "curve.continuity",
       .summary = "Gap, angle, curvature and curvature-rate jumps where one curve ends and the "
                  "next begins, and the order G0 to G3 they amount to.",
       .examples = {R"({"curves":[{"type":"polyline","points":[[0,0],[1,0]]},
                                  {"type":"polyline","points":[[1,0],[2,0]]}]})"}});
}

}  // namespace keyline::operations
