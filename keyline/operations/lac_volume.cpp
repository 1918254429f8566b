#include "keyline/lac/hermite/volume.h"
#include "keyline/operations/handles.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

struct VolumeRequest {
  std::array<core::Point2, 2> points;
  double direction = 0;
  std::vector<double> alpha{-1};
  std::optional<double> ratio;
  double volume = 0;
  static constexpr auto describe() {
    return core::fields(
        core::field<&VolumeRequest::points>("P0 and P2: start and end").needed(),
        core::field<&VolumeRequest::direction>("direction of travel at P0").in("radian").needed(),
        core::field<&VolumeRequest::alpha>(
            "the slope, or two for a compound rhythm, the first for the end of smaller radius")
            .count(1, 2)
            .or_bare_item()
            .needed(),
        core::field<&VolumeRequest::ratio>(
            "with two slopes: share of the turning that falls to the first, between 0 and 1")
            .within(core::between(0, 1)),
        core::field<&VolumeRequest::volume>("area between curve and chord, 0 or more")
            .in("length^2")
            .needed());
  }
};

struct VolumeResult {
  MadeCurve curve;
  double volume = 0;
  core::Interval reachable;
  std::variant<double, std::array<double, 2>> lambda = 0.0;
  double theta = 0;
  bool reversed = false;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&VolumeResult::curve>(),
        core::field<&VolumeResult::volume>("reached").in("length^2"),
        core::field<&VolumeResult::reachable>("by any curve of these slopes").in("length^2"),
        core::field<&VolumeResult::lambda>(
            "of the standard form in the paper's configuration; of a compound rhythm both"),
        core::field<&VolumeResult::theta>("the whole turning, signed").in("radian"),
        core::field<&VolumeResult::reversed>("whether the radius falls from P0 to P2"));
  }
};

core::Result<VolumeResult> compound(const VolumeRequest& request, const core::Pose2& start) {
  if (!request.ratio)
    return core::fail(core::ErrorCode::bad_input, "\"ratio\" is missing",
                      "two slopes need the share of the turning that falls to the first", "ratio");
  const lac::CompoundRhythm rhythm{request.alpha[0], request.alpha[1], *request.ratio};
  auto solved = lac::solve_volume(start, request.points[1], rhythm, request.volume);
  if (!solved) return std::unexpected(solved.error());
  lac::CompoundSolution& s = solved->solution;
  const double turning = lac::total_turning(s.chain);
  return VolumeResult{made({std::move(s.chain)}),
                      solved->volume,
                      {solved->reachable.smallest, solved->reachable.largest},
                      std::array{s.lambda0, s.lambda1},
                      turning,
                      s.reversed};
}

core::Result<VolumeResult> run(const VolumeRequest& request, const Context&) {
  const core::Pose2 start{request.points[0], request.direction};
  if (request.alpha.size() == 2) return compound(request, start);
  const auto solved = lac::solve_volume(start, request.points[1], request.alpha[0], request.volume);
  if (!solved) return std::unexpected(solved.error());
  const lac::G1Chain& s = solved->solution;
  return VolumeResult{made({s.chain}),
                      solved->volume,
                      {solved->reachable.smallest, solved->reachable.largest},
                      s.lambda,
                      lac::total_turning(s.chain),
                      s.reversed};
}

}  // namespace

Operation lac_volume_operation() {
  return declare<run>(
      {.name = "lac.volume",
       .summary = "The log-aesthetic segment, or compound-rhythm curve, with given ends, direction "
                  "at the start and area over its chord.",
       .examples = {R"({"points":[[0,0],[2,0]],"direction":0.6,"alpha":-1,"volume":0.4})",
                    R"({"points":[[0,0],[2,0]],"direction":0.6,"alpha":[-1,1.5],"ratio":0.4,
                        "volume":0.4})"}});
}

}  // namespace keyline::operations
