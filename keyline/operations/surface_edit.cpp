#include "keyline/operations/surface_edit.h"

#include "keyline/exchange/json_surface.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/surface_conditions.h"
#include "keyline/operations/surface_value_json.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;
using nlohmann::json;
using surface::Keep;

Result<Keep> keep_of(const json& request, bool several) {
  const std::string name = string_or(request, "keep", several ? "joints" : "start");
  if (name == "start") return Keep::start;
  if (name == "corners") return Keep::corners;
  if (name == "joints") return Keep::joints;
  if (name == "boundary") return Keep::boundary;
  return core::fail(ErrorCode::bad_input, "\"" + name + "\" cannot be kept",
                    "use start, corners, joints or boundary", "keep");
}

json missed_json(const std::vector<surface::MissedTarget>& missed) {
  json all = json::array();
  for (const surface::MissedTarget& m : missed)
    all.push_back({{"target", m.target}, {"curve", m.curve}, {"why", m.why}});
  return all;
}

Result<json> run(const json& request, const Context& context) {
  const surface::Surface s = surface_of(request, "surface");
  auto options = surface_edit_options(request, surface::patches_of(s).patches.size() > 1);
  if (!options) return std::unexpected(options.error());
  options->progress = context.progress;
  const auto edit = surface::edit_surface(s, *options, context.threads);
  if (!edit) return std::unexpected(edit.error());
  return surface_edit_json(*edit);
}

json patch_edit_json(const surface::SurfaceEdit& edit, std::size_t i) {
  const auto columns = static_cast<std::size_t>(edit.grid.columns);
  const auto& [result, why] = edit.edited.patches[i];
  json j{{"patch", {i / columns, i % columns}}};
  if (!result) {
    j["target"] = "as given";
    j["why"] = why.message;
    return j;
  }
  j["target"] = result->target;
  j["amount"] = result->amount;
  j["sav"] = {result->before.sav, result->after.sav};
  j["departure"] = result->departure;
  j["missed"] = missed_json(result->missed);
  if (!result->unmet.empty()) j["unmet"] = missed_json(result->unmet);
  return j;
}

}  // namespace

Result<surface::EditOptions> surface_edit_options(const json& request, bool several) {
  const auto keep = keep_of(request, several);
  if (!keep) return std::unexpected(keep.error());
  surface::EditOptions options;
  options.keep = *keep;
  options.amount = number_or(request, "amount", options.amount);
  options.limit = optional_number(request, "limit");
  options.alpha_max = number_or(request, "alpha_max", options.alpha_max);
  options.end_tolerance = number_or(request, "end_tolerance", 0);
  auto conditions = surface_conditions(request);
  if (!conditions) return std::unexpected(conditions.error());
  options.conditions = std::move(*conditions);
  return options;
}

json surface_edit_json(const surface::EditResult& edited) {
  json tradeoff = json::array();
  for (const surface::TradeOff& t : edited.tradeoff)
    tradeoff.push_back({{"target", t.name}, {"departure", t.departure}, {"sav", t.sav}});
  json result{{"surface", exchange::to_json(edited.surface)},
              {"before", surface_value_json(edited.before)},
              {"after", surface_value_json(edited.after)},
              {"departure", edited.departure},
              {"amount", edited.amount},
              {"target", edited.target},
              {"tradeoff", std::move(tradeoff)},
              {"missed", missed_json(edited.missed)}};
  if (!edited.unmet.empty()) result["unmet"] = missed_json(edited.unmet);
  return result;
}

json joints_json(const surface::JointSummary& joints) {
  return {{"joints", joints.joints},
          {"G0", joints.order_at_least[0]},
          {"G1", joints.order_at_least[1]},
          {"gap", joints.gap},
          {"angle", joints.angle}};
}

json surface_edit_json(const surface::SurfaceEdit& edit) {
  const surface::PatchesEdit& all = edit.edited;
  if (all.patches.size() == 1) return surface_edit_json(*all.patches.front().result);
  json result{{"before", patch_values_json(values_before(edit))},
              {"after", patch_values_json(values_after(edit))},
              {"departure", all.departure},
              {"patch_edits", json::array()},
              {"joints", {{"before", joints_json(all.before)}, {"after", joints_json(all.after)}}}};
  result["surface"] = edit.whole ? exchange::to_json(*edit.whole) : json(nullptr);
  if (!edit.whole)
    for (const surface::BezierSurface& s : all.surfaces)
      result["surfaces"].push_back(exchange::to_json(s));
  for (std::size_t i = 0; i < all.patches.size(); ++i)
    result["patch_edits"].push_back(patch_edit_json(edit, i));
  return result;
}

Operation surface_edit_operation() {
  using Type = Field::Type;
  return {
      "surface.edit",
      "Takes a Bezier patch to the nearest one whose rows and columns are Class A and of least "
      "energy (Oya, Hanafusa, Aoyama, 4.3), with the trade-off between SAV and departure.",
      {{"surface", Type::surface, true,
        "a polynomial Bezier patch; or a B-spline surface, which is edited patch by patch, its "
        "joints measured before and after"},
       {"keep", Type::string, false,
        "start (the first corner and the tangents of its row and column; the default of one "
        "patch), "
        "corners, joints (corners, boundary curves moving so that neighbours stay joined; the "
        "default of several) or boundary"},
       {"amount", Type::number, false, "0 as given to 1 the target"},
       {"limit", Type::number, false, "largest departure from the given surface, a length"},
       {"alpha_max", Type::number, false, "as in surface.sav"},
       {"end_tolerance", Type::number, false,
        "as in surface.sav, but 0 unless given: ends are held, and a curve at its minimum scores "
        "0"},
       {"conditions", Type::any, false,
        "per network curve: [{\"curve\": \"A1\", \"alpha\": [low, high], \"s\": [low, high], "
        "\"end_tolerance\": length, \"branch\": \"growing\" or \"falling\", \"tangent\": true "
        "(its start direction stays) or false}, ...]; without \"curve\" for every curve"}},
      run,
      {{"surface",
        {{"type", "bezier-surface"},
         {"points",
          {{{0, 0, 0}, {1, 0, 0}, {2.2, 0, 0.4}},
           {{0, 1, 0}, {1, 1.1, 0}, {2.2, 1, 0.4}},
           {{0, 2.3, 0.5}, {1, 2.3, 0.6}, {2.2, 2.3, 0.9}}}}}}}};
}

}  // namespace keyline::operations
