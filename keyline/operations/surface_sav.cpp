#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/surface_value_json.h"

namespace keyline::operations {
namespace {

core::Result<nlohmann::json> run(const nlohmann::json& request, const Context& context) {
  classa::CavOptions options;
  options.alpha_max = number_or(request, "alpha_max", options.alpha_max);
  options.tolerance = number_or(request, "tolerance", options.tolerance);
  options.end_tolerance = optional_number(request, "end_tolerance");
  const surface::Surface s = surface_of(request, "surface");
  const bool nearest = boolean_or(request, "nearest", true);
  auto values = surface::sav_by_patch(s, options, context.threads,
                                      core::part_of(context.progress, 0, nearest ? 0.3 : 1));
  if (!values) return std::unexpected(values.error());
  if (nearest)
    surface::add_nearest(s, *values, options, context.threads,
                         core::part_of(context.progress, 0.3, 1));
  if (context.progress.stop_requested()) return core::fail(core::ErrorCode::cancelled, "cancelled");
  return patch_values_json(*values);
}

}  // namespace

Operation surface_sav_operation() {
  using Type = Field::Type;
  return {
      "surface.sav",
      "Surface aesthetic value (Oya, Hanafusa, Aoyama): the curve aesthetic values of the net's "
      "rows and columns, named A1, A2, ... in this order, summed; the worst is named. A B-spline "
      "surface is valued Bezier patch by Bezier patch.",
      {{"surface", Type::surface, true, "a polynomial Bezier or B-spline surface"},
       {"alpha_max", Type::number, false, "largest rotation angle of Tab. 2 in radians, 1.0982"},
       {"tolerance", Type::number, false, "in the alpha-s plane: when ratios are one, 1e-6"},
       {"end_tolerance", Type::number, false,
        "how far the end of a curve's minimum may lie off, a length; 0.01 of its chord"},
       {"nearest", Type::boolean, false,
        "beside types 4 and 5 the nearest curve of one matrix: true unless given"}},
      run,
      {{"surface",
        {{"type", "bezier-surface"},
         {"points",
          {{{0, 0, 0}, {1, 0, 0}, {2.2, 0, 0.4}},
           {{0, 1, 0}, {1, 1, 0}, {2.2, 1, 0.4}},
           {{0, 2.3, 0.5}, {1, 2.3, 0.5}, {2.2, 2.3, 0.9}}}}}}}};
}

}  // namespace keyline::operations
