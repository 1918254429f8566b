#include "keyline/operations/registry.h"
#include "keyline/operations/surface_edit.h"

namespace keyline::operations {
namespace {

using core::Result;
using surface::SurfaceEdit;

enum class Joints { free, g1, g2, zebra };
constexpr auto choices(const Joints*) {
  return core::words<Joints>(
      {{Joints::free, "free"}, {Joints::g1, "G1"}, {Joints::g2, "G2"}, {Joints::zebra, "zebra"}});
}

struct TogetherRequest {
  std::vector<surface::Surface> surfaces;
  Joints joints = Joints::zebra;
  SurfaceEditOptions options;
  static constexpr auto describe() {
    using Request = TogetherRequest;
    return core::fields(
        core::field<&Request::surfaces>("polynomial Bezier or B-spline surfaces").count(1).needed(),
        core::field<&Request::joints>(
            "what an edit of several patches keeps at their joints: common tangent planes (G1), "
            "common curvature too (G2), also how far stripes of a zebra turn (zebra), or nothing "
            "(free)"),
        core::flattened<&Request::options>());
  }
};

surface::HoldJoints held(Joints joints) {
  switch (joints) {
    case Joints::free:
      return surface::HoldJoints::free;
    case Joints::g1:
      return surface::HoldJoints::g1;
    case Joints::g2:
      return surface::HoldJoints::g2;
    case Joints::zebra:
      break;
  }
  return surface::HoldJoints::zebra;
}

/// One of them; or why none of its patches could be edited.
Result<SurfaceEdit> taken(SurfaceEdit& edit) {
  for (const surface::PatchEdit& p : edit.edited.patches)
    if (p.result) return std::move(edit);
  return std::unexpected(edit.edited.patches.front().why);
}

/// All as one problem, so that joints between them hold too; nothing where that has no answer or
/// there is one alone.
std::vector<SurfaceEdit> as_one_problem(const TogetherRequest& request, const Context& context) {
  if (request.surfaces.size() < 2) return {};
  surface::EditOptions options = surface_edit_options(request.options, request.surfaces);
  options.progress = core::part_of(context.progress, 0, 0.5);
  auto edits =
      surface::edit_surfaces(request.surfaces, options, context.threads, {}, held(request.joints));
  return edits ? std::move(*edits) : std::vector<SurfaceEdit>{};
}

Result<SurfaceEdit> alone(const TogetherRequest& request, std::size_t i, const Context& context) {
  const auto count = static_cast<double>(request.surfaces.size());
  const auto at = static_cast<double>(i);
  const surface::Surface& one = request.surfaces[i];
  surface::EditOptions options = surface_edit_options(request.options, request.surfaces);
  options.progress = core::part_of(context.progress, at / count, (at + 1) / count);
  return surface::edit_surface(one, options, context.threads, {}, held(request.joints));
}

/// Joints between all patches that were edited.
JointsChange joints_between(const std::vector<OneOfSurfaces>& all, surface::HoldJoints hold) {
  std::vector<surface::BezierSurface> given;
  std::vector<surface::BezierSurface> edited;
  for (const OneOfSurfaces& one : all) {
    if (!one.edit) continue;
    const SurfaceEdit& e = *one.edit->edit;
    given.insert(given.end(), e.grid.patches.begin(), e.grid.patches.end());
    edited.insert(edited.end(), e.edited.surfaces.begin(), e.edited.surfaces.end());
  }
  const surface::EdgeTolerance joined = surface::with_gap({}, given);
  const auto joints = surface::joints_of(given, joined);
  std::size_t folded = 0;
  for (const OneOfSurfaces& one : all)
    if (one.edit) folded += one.edit->edit->edited.folded;
  return {shown(measure_joints(joints, given, joined)),
          shown(measure_joints(joints, edited, joined)),
          lost_orders(joints, given, edited, order_of(hold), joined),
          turned_farther(joints, given, edited, joined),
          folded,
          fold_growth(joints, given, edited, joined)};
}

/// One that cannot be edited stays as given among others; alone it is a failure.
Result<SurfacesEditAnswer> run(const TogetherRequest& request, const Context& context) {
  std::vector<SurfaceEdit> together = as_one_problem(request, context);
  const surface::EditOptions used = surface_edit_options(request.options, request.surfaces);
  SurfacesEditAnswer answer;
  std::optional<core::Failure> failure;
  bool any = false;
  for (std::size_t i = 0; i < request.surfaces.size(); ++i) {
    auto edit = together.empty() ? alone(request, i, context) : taken(together[i]);
    OneOfSurfaces one;
    if (edit) {
      one.edit = surface_edit_answer(*edit, used);
      any = true;
    } else if (edit.error().code == core::ErrorCode::cancelled) {
      return std::unexpected(edit.error());
    } else {
      one.why = edit.error().message;
      if (!failure) failure = edit.error();
    }
    answer.surfaces.push_back(std::move(one));
  }
  if (!any) return std::unexpected(*failure);
  answer.joints = joints_between(answer.surfaces, held(request.joints));
  return answer;
}

}  // namespace

Operation surface_edit_together_operation() {
  return declare<run>(
      {.name = "surface.edit_together",
       .summary = "surface.edit for all surfaces of a model as one problem, so that joints between "
                  "them hold; one that cannot be edited stays as given.",
       .examples = {R"({"surfaces":[{"type":"bezier-surface","points":[
           [[0,0,0],[1,0,0],[2.2,0,0.4]],[[0,1,0],[1,1.1,0],[2.2,1,0.4]],
           [[0,2.3,0.5],[1,2.3,0.6],[2.2,2.3,0.9]]]}]})"},
       .long_running = true});
}

}  // namespace keyline::operations
