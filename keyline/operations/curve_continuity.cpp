#include <algorithm>

#include "keyline/document/cusped.h"
#include "keyline/operations/joint.h"
#include "keyline/operations/joints_inside.h"
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
    return core::fields(
        core::field<&ContinuityResult::joints>("one for each joint; curves of no length have none"),
        core::field<&ContinuityResult::order>("the least of them"));
  }
};

/// What a curve is like where it begins and ends.
struct Ends {
  curve::Jet2 start, end;
  bool steep_start = false, steep_end = false;
  double length = 0;
};

Ends ends_of(const document::PlanarCurve& c) {
  const document::Path path{{c}, false};
  const document::CuspedPath cusped(path);
  Ends ends{jet(cusped, 0), jet(cusped, 1)};
  ends.length = analysis::ArcLengthTable(analysis::view(cusped)).length();
  ends.steep_start = is_steep_at_start(c);
  ends.steep_end = is_steep_at_end(c);
  return ends;
}

analysis::JointContinuity joint_between(const Ends& before, const Ends& after,
                                        const analysis::ContinuityTolerance& tolerance) {
  const auto joint = analysis::joint_continuity(before.end, after.start,
                                                std::min(before.length, after.length), tolerance);
  return before.steep_end || after.steep_start ? without_rate(joint) : joint;
}

core::Result<ContinuityResult> run(const ContinuityRequest& request, const Context&) {
  std::vector<Ends> curves;
  for (const document::Path& path : request.curves)
    for (const auto& curve : path.curves) curves.push_back(ends_of(curve));
  std::erase_if(curves, [](const Ends& ends) { return ends.length == 0; });
  if (curves.empty() || (curves.size() < 2 && !request.closed))
    return core::fail(core::ErrorCode::bad_input, "a joint needs two curves that have a length",
                      "give at least two curves, or \"closed\": true", "curves");
  ContinuityResult result;
  int least = 3;
  for (std::size_t i = 0; i < curves.size() && (request.closed || i + 1 < curves.size()); ++i) {
    const auto joint = joint_between(curves[i], curves[(i + 1) % curves.size()], request.tolerance);
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
