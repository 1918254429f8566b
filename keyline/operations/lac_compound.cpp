#include "keyline/lac/hermite/compound.h"
#include "keyline/operations/handles.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/standard_bounds.h"

namespace keyline::operations {
namespace {

struct CompoundRequest {
  Handles points;
  std::array<double, 2> alpha{-1, -1};
  double ratio = 0.5;
  static constexpr auto describe() {
    return core::fields(
        core::field<&CompoundRequest::points>(kHandles).needed(),
        core::field<&CompoundRequest::alpha>("two slopes, the first for the end of smaller radius")
            .needed(),
        core::field<&CompoundRequest::ratio>(
            "share of the whole turning that falls to the first slope, between 0 and 1")
            .within(core::between(0, 1))
            .needed());
  }
};

struct CompoundResult {
  MadeCurve curve;
  std::array<double, 2> lambda{};
  core::Point2 joint;
  HandlesSolution solution;
  bool clamped = false;
  std::array<BoundsShown, 2> bounds;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&CompoundResult::curve>(),
        core::field<&CompoundResult::lambda>("of the standard forms of both pieces"),
        core::field<&CompoundResult::joint>("where the pieces meet"),
        core::flattened<&CompoundResult::solution>(),
        core::field<&CompoundResult::clamped>(
            "the curvature would leave the doubles and stays constant from e^-100 and e^100 on"),
        core::field<&CompoundResult::bounds>(kBounds));
  }
};

core::Result<CompoundResult> run(const CompoundRequest& request, const Context&) {
  const auto& [p0, p1, p2] = request.points;
  auto solved =
      lac::solve_compound(p0, p1, p2, {request.alpha[0], request.alpha[1], request.ratio});
  if (!solved) return std::unexpected(solved.error());
  return CompoundResult{made({std::move(solved->chain)}),
                        {solved->lambda0, solved->lambda1},
                        solved->joint,
                        {solved->turning, solved->chord_angle, solved->reversed},
                        solved->clamped,
                        {bounds_shown(request.alpha[0], solved->lambda0),
                         bounds_shown(request.alpha[1], solved->lambda1)}};
}

}  // namespace

Operation lac_compound_operation() {
  return declare<run>(
      {.name = "lac.compound",
       .summary = "The compound-rhythm curve from the handles P0, P1, P2: two log-aesthetic "
                  "pieces with curvature and its rate continuous at the joint (G3).",
       .examples = {R"({"points":[[0,0],[2,0],[3,1.5]],"alpha":[-1,1.5],"ratio":0.4})"}});
}

}  // namespace keyline::operations
