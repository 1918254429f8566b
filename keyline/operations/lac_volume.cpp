#include "keyline/lac/volume.h"
#include "keyline/operations/handles.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

struct VolumeRequest {
  std::array<core::Point2, 2> points;
  double direction = 0;
  double alpha = -1;
  double volume = 0;
  static constexpr auto describe() {
    return core::fields(
        core::field<&VolumeRequest::points>("P0 and P2: start and end").needed(),
        core::field<&VolumeRequest::direction>("direction of travel at P0").in("radian").needed(),
        core::field<&VolumeRequest::alpha>(kSlope).needed(),
        core::field<&VolumeRequest::volume>("area between curve and chord, 0 or more")
            .in("length^2")
            .needed());
  }
};

struct VolumeResult {
  MadeCurve curve;
  double volume = 0;
  core::Interval reachable;
  double lambda = 0;
  double theta = 0;
  bool reversed = false;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&VolumeResult::curve>(),
        core::field<&VolumeResult::volume>("reached").in("length^2"),
        core::field<&VolumeResult::reachable>("by any curve of this slope").in("length^2"),
        core::field<&VolumeResult::lambda>("of the standard form in the paper's configuration"),
        core::field<&VolumeResult::theta>("the whole turning, signed").in("radian"),
        core::field<&VolumeResult::reversed>("whether the radius falls from P0 to P2"));
  }
};

core::Result<VolumeResult> run(const VolumeRequest& request, const Context&) {
  const core::Pose2 start{request.points[0], request.direction};
  const auto solved = lac::solve_volume(start, request.points[1], request.alpha, request.volume);
  if (!solved) return std::unexpected(solved.error());
  const lac::SegmentSolution& s = solved->solution;
  return VolumeResult{made({lac::chain_of(s.segment)}),
                      solved->volume,
                      {solved->reachable.smallest, solved->reachable.largest},
                      s.lambda,
                      lac::total_turning(s.segment),
                      s.reversed};
}

}  // namespace

Operation lac_volume_operation() {
  return declare<run>(
      {.name = "lac.volume",
       .summary = "The log-aesthetic segment with given ends, direction at the start and area over "
                  "its chord.",
       .examples = {R"({"points":[[0,0],[2,0]],"direction":0.6,"alpha":-1,"volume":0.4})"}});
}

}  // namespace keyline::operations
