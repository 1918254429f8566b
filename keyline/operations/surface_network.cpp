#include "keyline/operations/surface_network.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "keyline/operations/spline_input.h"
#include "keyline/operations/surface_edit.h"
#include "keyline/operations/values.h"
#include "keyline/surface/gordon.h"
#include "keyline/surface/network.h"

namespace keyline::operations {
namespace {

using core::Result;

constexpr double kUsualTolerance = 1e-4;  // of the largest curve's size
constexpr double kCurveShare = 0.1;       // of the tolerance, for curves that become splines

struct NetworkRequest {
  std::vector<AnyCurve> along_u;
  std::vector<AnyCurve> along_v;
  std::optional<double> tolerance;
  std::optional<double> gap;
  static constexpr auto describe() {
    using Request = NetworkRequest;
    return core::fields(
        core::field<&Request::along_u>("two borders, and sections between them").count(2).needed(),
        core::field<&Request::along_v>("two borders and sections that cross all of those")
            .count(2)
            .needed(),
        core::field<&Request::tolerance>(
            "largest distance of the curves from the surface; 1e-4 of their size unless given")
            .in("length")
            .within(core::kPositive),
        core::field<&Request::gap>("by which curves may miss each other; else the tolerance")
            .in("length")
            .within(core::kPositive));
  }
};

struct NetworkAnswer {
  surface::Surface surface;
  double deviation = 0;
  double gap = 0;
  std::size_t patches = 0;
  double sav = 0;
  JointsShown joints;
  static constexpr auto describe() {
    using Answer = NetworkAnswer;
    return core::fields(
        core::field<&Answer::surface>("a bicubic B-spline surface; its patches join with equal "
                                      "curvature"),
        core::field<&Answer::deviation>("largest distance of the curves from it, as measured")
            .in("length"),
        core::field<&Answer::gap>("largest by which curves miss each other").in("length"),
        core::field<&Answer::patches>("Bezier patches it consists of"),
        core::field<&Answer::sav>("sum of their surface aesthetic values"),
        core::field<&Answer::joints>("between them, and what a zebra does there"));
  }
};

/// Curves as splines; `off` becomes the largest bound of what that cost.
Result<std::vector<curve::BSpline3>> splines_of(const std::vector<AnyCurve>& curves,
                                                const char* name, double tolerance, double& off) {
  std::vector<curve::BSpline3> all;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    auto c = spline_of(curves[i], tolerance);
    if (!c) {
      core::Failure failure = c.error();
      const std::string member = std::string(name) + "[" + std::to_string(i) + "]";
      failure.path = failure.path.empty() ? member : member + "." + failure.path;
      return std::unexpected(std::move(failure));
    }
    off = std::max(off, c->deviation);
    all.push_back(std::move(c->curve));
  }
  return all;
}

Result<NetworkAnswer> run(const NetworkRequest& request, const Context& context) {
  double size = 0;
  for (const auto* curves : {&request.along_u, &request.along_v})
    for (const AnyCurve& c : *curves) size = std::max(size, size_of(c));
  const double tolerance = request.tolerance.value_or(kUsualTolerance * size);
  double off = 0;
  const auto u = splines_of(request.along_u, "along_u", kCurveShare * tolerance, off);
  if (!u) return std::unexpected(u.error());
  const auto v = splines_of(request.along_v, "along_v", kCurveShare * tolerance, off);
  if (!v) return std::unexpected(v.error());
  auto made = surface::gordon_surface(
      *u, *v, {(1 - kCurveShare) * tolerance, request.gap.value_or(tolerance)});
  if (!made) return std::unexpected(made.error());
  NetworkAnswer answer{std::move(made->surface), made->deviation + off, made->gap, 0, 0, {}};
  const auto values = surface::sav_by_patch(answer.surface, {}, context.threads, context.progress);
  if (!values) return std::unexpected(values.error());
  answer.patches = values->size();
  for (const surface::PatchValue& patch : *values) answer.sav += patch.value.sav;
  const auto patches = surface::patches_of(answer.surface).patches;
  const surface::EdgeTolerance joined = surface::with_gap({}, patches);
  answer.joints =
      shown(surface::measure_joints(surface::joints_of(patches, joined), patches, joined));
  return answer;
}

}  // namespace

Operation surface_network_operation() {
  return declare<run>(
      {.name = "surface.network",
       .summary =
           "Makes a surface through curves that cross like warp and weft (Coons and Gordon): "
           "four borders, and sections between them.",
       .examples = {R"({"along_u":[
           {"type":"bezier","points":[[0,0,0],[1,0,0.6],[2,0,0.6],[3,0,0]]},
           {"type":"bezier","points":[[0,2,0.2],[1,2,0.9],[2,2,0.9],[3,2,0.2]]}],"along_v":[
           {"type":"bezier","points":[[0,0,0],[0,0.7,0.3],[0,1.4,0.4],[0,2,0.2]]},
           {"type":"bezier","points":[[3,0,0],[3,0.7,0.3],[3,1.4,0.4],[3,2,0.2]]}]})"},
       .long_running = true});
}

}  // namespace keyline::operations
