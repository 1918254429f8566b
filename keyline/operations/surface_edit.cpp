#include "keyline/operations/surface_edit.h"

#include "keyline/core/extent.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::Result;

std::vector<MissedShown> missed_shown(const std::vector<surface::MissedTarget>& missed) {
  std::vector<MissedShown> all;
  for (const surface::MissedTarget& m : missed) all.push_back({m.target, m.curve, m.why});
  return all;
}

std::vector<TradeOffShown> tradeoff_shown(const std::vector<surface::TradeOff>& found) {
  std::vector<TradeOffShown> all;
  for (const surface::TradeOff& t : found)
    all.push_back({t.name, t.departure, t.sav, t.stripe_turn});
  return all;
}

PatchEditShown patch_shown(const surface::SurfaceEdit& edit, std::size_t i) {
  const auto columns = static_cast<std::size_t>(edit.grid.columns);
  const auto& [result, why] = edit.edited.patches[i];
  PatchEditShown shown;
  shown.patch = {static_cast<int>(i / columns), static_cast<int>(i % columns)};
  if (!result) {
    shown.target = "as given";
    shown.why = why.message;
    return shown;
  }
  shown.target = result->target;
  shown.amount = result->amount;
  shown.sav = {result->before.sav, result->after.sav};
  shown.departure = result->departure;
  shown.missed = missed_shown(result->missed);
  if (!result->unmet.empty()) shown.unmet = missed_shown(result->unmet);
  return shown;
}

SurfaceEditAnswer answer_of_one(const surface::EditResult& edited) {
  SurfaceEditAnswer answer;
  answer.surface = surface::Surface{edited.surface};
  answer.before = shown(edited.before);
  answer.after = shown(edited.after);
  answer.departure = edited.departure;
  answer.amount = edited.amount;
  answer.target = edited.target;
  answer.tradeoff = tradeoff_shown(edited.tradeoff);
  answer.missed = missed_shown(edited.missed);
  if (!edited.unmet.empty()) answer.unmet = missed_shown(edited.unmet);
  return answer;
}

Result<SurfaceEditAnswer> run(const SurfaceEditRequest& request, const Context& context) {
  surface::EditOptions options =
      surface_edit_options(request.options, std::span(&request.surface, 1));
  options.progress = context.progress;
  const auto edit = surface::edit_surface(request.surface, options, context.threads);
  if (!edit) return std::unexpected(edit.error());
  return surface_edit_answer(*edit, options);
}

}  // namespace

namespace {

/// Unasked patches that go together go no farther than the end of a curve may miss its minimum's
/// unasked (curve.cav's end_tolerance).
constexpr double kUsualShare = 0.01;  // of the size

double size_of(std::span<const surface::Surface> all) {
  core::Box3 box;
  for (const surface::Surface& s : all)
    for (const core::Point3 p : surface::net_of(s).points) box.take(p);
  return diagonal(box);
}

bool several_patches(std::span<const surface::Surface> all) {
  return all.size() > 1 || surface::patches_of(all.front()).patches.size() > 1;
}

}  // namespace

surface::EditOptions surface_edit_options(const SurfaceEditOptions& given,
                                          std::span<const surface::Surface> all) {
  const bool several = several_patches(all);
  surface::EditOptions options;
  options.keep = given.keep.value_or(several ? surface::Keep::joints : surface::Keep::start);
  options.amount = given.amount;
  if (!given.limit && several) {
    options.limit = kUsualShare * size_of(all);
    options.part_of_the_way = false;
  } else if (given.limit && std::holds_alternative<double>(*given.limit)) {
    options.limit = std::get<double>(*given.limit);
  }
  options.alpha_max = given.alpha_max;
  options.end_tolerance = given.end_tolerance;
  options.conditions = given.conditions;
  return options;
}

JointsShown shown(const surface::JointSummary& joints) {
  return {joints.joints,
          joints.order_at_least[0],
          joints.order_at_least[1],
          joints.order_at_least[2],
          joints.gap,
          joints.angle,
          {joints.zebra.jump, joints.zebra.mean_jump, joints.zebra.turn, joints.zebra.mean_turn}};
}

SurfaceEditAnswer surface_edit_answer(const surface::SurfaceEdit& edit,
                                      const surface::EditOptions& options) {
  const surface::PatchesEdit& all = edit.edited;
  if (all.patches.size() == 1) {
    SurfaceEditAnswer answer = answer_of_one(*all.patches.front().result);
    answer.limit = options.limit;
    answer.edit = edit;
    return answer;
  }
  SurfaceEditAnswer answer;
  answer.limit = options.limit;
  answer.before = shown(values_before(edit));
  answer.after = shown(values_after(edit));
  answer.departure = all.departure;
  answer.surface = edit.whole;
  if (!edit.whole) answer.surfaces.emplace(all.surfaces.begin(), all.surfaces.end());
  answer.patch_edits.emplace();
  for (std::size_t i = 0; i < all.patches.size(); ++i)
    answer.patch_edits->push_back(patch_shown(edit, i));
  answer.joints = JointsChange{shown(all.before), shown(all.after), all.lost,
                               all.turned,        all.folded,       all.fold_growth};
  if (!all.tradeoff.empty()) answer.tradeoff = tradeoff_shown(all.tradeoff);
  if (all.sav_apart < all.sav_after)  // both without patches that cannot be edited
    answer.sav_apart = answer.after.sav - (all.sav_after - all.sav_apart);
  answer.edit = edit;
  return answer;
}

Operation surface_edit_operation() {
  return declare<run>(
      {.name = "surface.edit",
       .summary = "Takes a Bezier patch to the nearest one whose rows and columns are Class A and "
                  "of least energy (Oya, Hanafusa, Aoyama, 4.3), with the trade-off between SAV "
                  "and departure.",
       .examples = {R"({"surface":{"type":"bezier-surface","points":[
           [[0,0,0],[1,0,0],[2.2,0,0.4]],[[0,1,0],[1,1.1,0],[2.2,1,0.4]],
           [[0,2.3,0.5],[1,2.3,0.6],[2.2,2.3,0.9]]]}})"},
       .long_running = true});
}

}  // namespace keyline::operations
