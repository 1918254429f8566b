#include "keyline/operations/paper_operations.h"
#include "keyline/operations/values.h"
#include "keyline/surface/network_patch.h"

namespace keyline::operations {
namespace {

using core::Result;

struct PatchRequest {
  std::vector<AnyCurve> rows;
  AnyCurve column;
  static constexpr auto describe() {
    return core::fields(
        core::field<&PatchRequest::rows>(
            "beziers of one degree: A1, A2… of [Oya], one for each control point of the column")
            .count(2, 31)
            .needed(),
        core::field<&PatchRequest::column>("a bezier: A5, along which the rows are strung")
            .needed());
  }
};

struct PatchAnswer {
  surface::Surface surface;
  std::vector<double> moved;
  static constexpr auto describe() {
    return core::fields(
        core::field<&PatchAnswer::surface>("the patch whose net has these rows and this column"),
        core::field<&PatchAnswer::moved>("how far each row was moved to start on the column")
            .in("length"));
  }
};

Result<curve::Bezier3> bezier_of(const AnyCurve& given, const std::string& path) {
  if (const auto planar = planar_path(given); planar && planar->curves.size() == 1)
    if (const auto* flat = std::get_if<curve::Bezier2>(&planar->curves[0].value)) {
      curve::Bezier3 lifted;
      for (const core::Point2& p : flat->control) lifted.control.push_back({p.x, p.y, 0});
      lifted.weights = flat->weights;
      return lifted;
    }
  const auto* space = std::get_if<document::SpaceCurve>(&given);
  if (const auto* bezier = space ? std::get_if<curve::Bezier3>(&space->value) : nullptr)
    return *bezier;
  return core::fail(core::ErrorCode::unsupported, "only beziers make a net",
                    "convert the curve to one bezier", path);
}

Result<PatchAnswer> run(const PatchRequest& request, const Context&) {
  std::vector<curve::Bezier3> rows;
  for (std::size_t i = 0; i < request.rows.size(); ++i) {
    auto row = bezier_of(request.rows[i], "rows[" + std::to_string(i) + "]");
    if (!row) return std::unexpected(row.error());
    rows.push_back(std::move(*row));
  }
  const auto column = bezier_of(request.column, "column");
  if (!column) return std::unexpected(column.error());
  auto patch = surface::patch_from_network(rows, *column);
  if (!patch) return std::unexpected(patch.error());
  return PatchAnswer{std::move(patch->surface), std::move(patch->moved)};
}

}  // namespace

Operation surface_patch_operation() {
  return declare<run>(
      {.name = "surface.patch",
       .summary =
           "Makes a Bezier patch from its network: profiles A1 to A4 strung along A5, a sweep "
           "whose profile changes on the way; the other curves follow.",
       .examples = {R"({"rows":[{"type":"bezier","points":[[0,0,0],[1,0,1],[2,0,1],[3,0,0]]},
                                {"type":"bezier","points":[[0,0,0],[1,0,1.4],[2,0,1.2],[3,0,0]]}],
                        "column":{"type":"bezier","points":[[0,0,0],[0,2,0.5]]}})"}});
}

}  // namespace keyline::operations
