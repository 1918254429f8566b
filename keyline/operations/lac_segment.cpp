#include "keyline/lac/hermite/clamped.h"
#include "keyline/operations/handles.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/standard_bounds.h"

namespace keyline::operations {
namespace {

struct SegmentRequest {
  Handles points;
  double alpha = -1;
  static constexpr auto describe() {
    return core::fields(core::field<&SegmentRequest::points>(kHandles).needed(),
                        core::field<&SegmentRequest::alpha>(kSlope).needed());
  }
};

struct SegmentResult {
  MadeCurve curve;
  double lambda = 0;
  HandlesSolution solution;
  bool clamped = false;
  BoundsShown bounds;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&SegmentResult::curve>(),
        core::field<&SegmentResult::lambda>("of the standard form in the paper's configuration"),
        core::flattened<&SegmentResult::solution>(),
        core::field<&SegmentResult::clamped>(
            "two pieces, because one's curvatures would leave the doubles"),
        core::field<&SegmentResult::bounds>(kBounds));
  }
};

core::Result<SegmentResult> run(const SegmentRequest& request, const Context&) {
  const auto& [p0, p1, p2] = request.points;
  auto solved = lac::solve_g1_chain(p0, p1, p2, request.alpha);
  if (!solved) return std::unexpected(solved.error());
  return SegmentResult{made({std::move(solved->chain)}),
                       solved->lambda,
                       {solved->turning, solved->chord_angle, solved->reversed},
                       solved->clamped,
                       bounds_shown(request.alpha, solved->lambda)};
}

}  // namespace

Operation lac_segment_operation() {
  return declare<run>(
      {.name = "lac.segment",
       .summary = "The log-aesthetic segment of slope alpha through two ends with given tangents "
                  "(G1 Hermite), from the handles P0, P1, P2.",
       .examples = {R"({"points":[[0,0],[2,0],[3,1.5]],"alpha":-1})"}});
}

}  // namespace keyline::operations
