#include "keyline/lac/g2/blend.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

struct BlendRequest {
  std::vector<document::Path> curves;
  std::array<double, 2> at{1, 0};
  lac::BlendOrder order = lac::BlendOrder::g2;
  double alpha = -1;
  static constexpr auto describe() {
    return core::fields(
        core::field<&BlendRequest::curves>("the curve to leave and the curve to join")
            .count(2, 2)
            .needed(),
        core::field<&BlendRequest::at>(
            "where to leave the first curve and to join the second, from 0 (start) to 1 (end)")
            .within(core::from_to(0, 1)),
        core::field<&BlendRequest::order>("of continuity at both ends"),
        core::field<&BlendRequest::alpha>("slope of the pieces"));
  }
};

struct BlendResult {
  MadeCurve curve;
  std::vector<std::size_t> overridden;
  double absolute_turning = 0;
  double bending_energy = 0;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&BlendResult::curve>(),
        core::field<&BlendResult::overridden>("pieces that got slope -1 instead of the one given"),
        core::field<&BlendResult::absolute_turning>("summed over left and right").in("radian"),
        core::field<&BlendResult::bending_energy>("of the blend").in("1/length"));
  }
};

core::Result<BlendResult> run(const BlendRequest& request, const Context&) {
  auto solved = lac::solve_blend(lac::blend_leaving(request.curves[0], request.at[0]),
                                 lac::blend_joining(request.curves[1], request.at[1]),
                                 request.order, request.alpha);
  if (!solved) {
    core::Failure failure = solved.error();
    if (failure.path == "end") failure.path = "at";
    return std::unexpected(std::move(failure));
  }
  return BlendResult{made({std::move(solved->chain)}), std::move(solved->overridden),
                     solved->absolute_turning, solved->bending_energy};
}

}  // namespace

Operation lac_blend_operation() {
  return declare<run>(
      {.name = "lac.blend",
       .summary = "Draws a log-aesthetic chain from a point of one curve into a point of another, "
                  "with G1, G2 or G3 at both.",
       .examples = {R"({"curves":[{"type":"polyline","points":[[0,0],[1,0]]},
                                  {"type":"polyline","points":[[3,1],[3,2]]}],
                        "order":"G2","alpha":-1})"}});
}

}  // namespace keyline::operations
