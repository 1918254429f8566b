#include "keyline/lac/chain/drag.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/paper_operations.h"

namespace keyline::operations {
namespace {

struct DragRequest {
  document::Path curve;
  double at = 0;
  core::Point2 to;
  lac::DragOptions options;
  static constexpr auto describe() {
    return core::fields(
        core::field<&DragRequest::curve>("a log-aesthetic curve").needed(),
        core::field<&DragRequest::at>("the point that is dragged: fraction of the length")
            .within(core::from_to(0, 1))
            .needed(),
        core::field<&DragRequest::to>("where it is dragged to").needed(),
        core::field<&DragRequest::options, &lac::DragOptions::hold_end_curvatures>(
            "as well as the places and directions of both ends"));
  }
};

struct DragResult {
  MadeCurve curve;
  std::size_t joint = 0;
  double change = 0;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&DragResult::curve>(),
        core::field<&DragResult::joint>("the piece that starts at the dragged point"),
        core::field<&DragResult::change>(
            "root of the sum of squares of what changed of joint curvatures and lengths"));
  }
};

core::Result<DragResult> run(const DragRequest& request, const Context&) {
  const auto* chain = request.curve.curves.size() == 1
                          ? std::get_if<lac::Chain>(&request.curve.curves[0].value)
                          : nullptr;
  if (!chain)
    return core::fail(core::ErrorCode::unsupported, "only a log-aesthetic curve can be dragged",
                      "fair the curve first", "curve");
  auto dragged = lac::drag(*chain, request.at, request.to, request.options);
  if (!dragged) return std::unexpected(dragged.error());
  return DragResult{made({std::move(dragged->chain)}), dragged->joint, dragged->change};
}

}  // namespace

Operation lac_drag_operation() {
  return declare<run>(
      {.name = "lac.drag",
       .summary = "Drags one point of a log-aesthetic curve: slopes, places and directions of both "
                  "ends stay, curvature stays continuous, and all else changes as little as "
                  "possible.",
       .examples = {R"({"curve":{"type":"log-aesthetic","start":[0,0],"direction":0,"pieces":[
                        {"alpha":-1,"length":1,"curvature":[0.1,0.6]},
                        {"alpha":-1,"length":1,"curvature":[0.6,0.2]},
                        {"alpha":-1,"length":1,"curvature":[0.2,0.4]}]},
                        "at":0.5,"to":[1.4,0.5]})"}});
}

}  // namespace keyline::operations
