#include <algorithm>

#include "keyline/operations/registry.h"
#include "keyline/operations/surface_value.h"

namespace keyline::operations {
namespace {

struct SavRequest {
  surface::Surface surface;
  classa::CavOptions options;
  bool nearest = true;
  int nearest_patches = 16;
  static constexpr auto describe() {
    return core::fields(
        core::field<&SavRequest::surface>("a polynomial Bezier or B-spline surface").needed(),
        core::flattened<&SavRequest::options>(),
        core::field<&SavRequest::nearest>("beside types 4 and 5 the nearest curve of one matrix"),
        core::field<&SavRequest::nearest_patches>(
            "the nearest curves of at most so many patches; of more, of the worst patch alone")
            .within(core::from_to(1, 1'000'000)));
  }
};

/// The nearest curves of one matrix: of every patch, or of many patches of the worst alone.
void find_nearest(const SavRequest& request, std::vector<surface::PatchValue>& values,
                  const Context& context) {
  const auto find = [&](std::vector<surface::PatchValue>& of) {
    surface::add_nearest(request.surface, of, request.options, context.threads,
                         core::part_of(context.progress, 0.3, 1));
  };
  if (values.size() <= static_cast<std::size_t>(request.nearest_patches)) return find(values);
  const auto worst = std::ranges::max_element(
      values, {}, [](const surface::PatchValue& p) { return p.value.sav; });
  std::vector<surface::PatchValue> alone{*worst};
  find(alone);
  *worst = std::move(alone.front());
}

core::Result<SurfaceValueShown> run(const SavRequest& request, const Context& context) {
  auto values =
      surface::sav_by_patch(request.surface, request.options, context.threads,
                            core::part_of(context.progress, 0, request.nearest ? 0.3 : 1));
  if (!values) return std::unexpected(values.error());
  if (request.nearest) find_nearest(request, *values, context);
  if (context.progress.stop_requested()) return core::fail(core::ErrorCode::cancelled, "cancelled");
  SurfaceValueShown result = shown(*values);
  const classa::LargestValues most = classa::largest_values(request.options.alpha_max);
  const auto count = static_cast<double>(result.curves.size());
  result.steps = {count * most.class_a, count * most.one_matrix, count * most.several,
                  count * most.none};
  return result;
}

}  // namespace

Operation surface_sav_operation() {
  return declare<run>(
      {.name = "surface.sav",
       .summary = "Surface aesthetic value (Oya, Hanafusa, Aoyama): the curve aesthetic values of "
                  "the net's rows and columns, named A1, A2, ... in this order, summed; the worst "
                  "is named. A B-spline surface is valued Bezier patch by Bezier patch.",
       .examples = {R"({"surface":{"type":"bezier-surface","points":[
           [[0,0,0],[1,0,0],[2.2,0,0.4]],[[0,1,0],[1,1,0],[2.2,1,0.4]],
           [[0,2.3,0.5],[1,2.3,0.5],[2.2,2.3,0.9]]]}})"},
       .long_running = true});
}

}  // namespace keyline::operations
