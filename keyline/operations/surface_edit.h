#pragma once

#include "keyline/operations/surface_value.h"
#include "keyline/surface/edit_patches.h"

/// Class A editing of a surface: the operation surface.edit.
namespace keyline::operations {

/// For a limit: as far as the target is.
enum class NoLimit { none };
constexpr auto choices(const NoLimit*) { return core::words<NoLimit>({{NoLimit::none, "none"}}); }

/// How surfaces are edited.
struct SurfaceEditOptions {
  std::optional<surface::Keep> keep;
  double amount = 1;
  std::optional<std::variant<double, NoLimit>> limit;
  double alpha_max = classa::kDefaultAlphaMax;
  double end_tolerance = 0;
  std::vector<surface::CurveCondition> conditions;
  static constexpr auto describe() {
    using Request = SurfaceEditOptions;
    return core::fields(
        core::field<&Request::keep>(
            "what stays. start: the first corner and the tangents of its row and column (default "
            "of one patch); corners; joints: corners, and boundary curves move so that neighbours "
            "stay joined; where joints are held, corners in which patches meet move together "
            "(default of several); boundary"),
        core::field<&Request::amount>("from 0, the given surface, to 1, the target")
            .within(core::from_to(0, 1)),
        core::field<&Request::limit>("largest departure from the given surfaces; an edit that "
                                     "would go farther goes part of the way. Unless given, a "
                                     "single patch has no limit (\"none\"); several may depart by "
                                     "a hundredth of their size (the diagonal of the box around "
                                     "them), and what would go farther stays as given")
            .in("length")
            .within(core::at_least(0)),
        core::field<&Request::alpha_max>("largest rotation, as in surface.sav")
            .in("radian")
            .within(core::between(0, core::kPi / 2)),
        core::field<&Request::end_tolerance>(
            "how far a curve's minimum may end off it; 0: a curve at its minimum scores 0")
            .in("length")
            .within(core::at_least(0)),
        core::field<&Request::conditions>("conditions on network curves").or_bare_item());
  }
};

struct SurfaceEditRequest {
  surface::Surface surface;
  SurfaceEditOptions options;
  static constexpr auto describe() {
    using Request = SurfaceEditRequest;
    return core::fields(
        core::field<&Request::surface>(
            "a polynomial Bezier patch; or a B-spline surface, which is edited patch by patch, its "
            "joints measured before and after")
            .needed(),
        core::flattened<&Request::options>());
  }
};

/// Zebra stripes at joints, over all lights.
struct ZebraShown {
  double jump = 0;
  double mean_jump = 0;
  double turn = 0;
  double mean_turn = 0;
  static constexpr auto describe() {
    using Zebra = ZebraShown;
    return core::fields(
        core::field<&Zebra::jump>("largest, of a mirrored ray where two patches meet").in("radian"),
        core::field<&Zebra::mean_jump>("over the length of joints").in("radian"),
        core::field<&Zebra::turn>("of stripes that cross one tangent joint, in the mean; largest")
            .in("radian"),
        core::field<&Zebra::mean_turn>("of all stripes that cross tangent joints").in("radian"));
  }
};

struct JointsShown {
  std::size_t joints = 0;
  std::size_t g0 = 0;
  std::size_t g1 = 0;
  std::size_t g2 = 0;
  double gap = 0;
  double angle = 0;
  ZebraShown zebra;
  static constexpr auto describe() {
    return core::fields(core::field<&JointsShown::joints>("in all"),
                        core::field<&JointsShown::g0>("at least G0").named("G0"),
                        core::field<&JointsShown::g1>("at least G1").named("G1"),
                        core::field<&JointsShown::g2>("at least G2").named("G2"),
                        core::field<&JointsShown::gap>("largest").in("length"),
                        core::field<&JointsShown::angle>("largest fold").in("radian"),
                        core::field<&JointsShown::zebra>("whatever the light"));
  }
};
JointsShown shown(const surface::JointSummary& joints);

struct JointsChange {
  JointsShown before;
  JointsShown after;
  std::size_t lost = 0;
  std::size_t turned = 0;
  std::size_t folded = 0;
  double fold_growth = 0;
  static constexpr auto describe() {
    return core::fields(core::field<&JointsChange::before>("as given"),
                        core::field<&JointsChange::after>("as edited"),
                        core::field<&JointsChange::lost>(
                            "of lower order than before, of what was to be held; of joints let go "
                            "those that opened"),
                        core::field<&JointsChange::turned>(
                            "tangent joints at which stripes of a zebra turn farther than before"),
                        core::field<&JointsChange::folded>(
                            "patches whose normal turns over: they fold over themselves"),
                        core::field<&JointsChange::fold_growth>("largest").in("radian"));
  }
};

struct TradeOffShown {
  std::string target;
  double departure = 0;
  double sav = 0;
  std::optional<double> stripe_turn;
  static constexpr auto describe() {
    return core::fields(
        core::field<&TradeOffShown::target>("its name"),
        core::field<&TradeOffShown::departure>("at amount 1").in("length"),
        core::field<&TradeOffShown::sav>("value there"),
        core::field<&TradeOffShown::stripe_turn>("of zebra stripes at joints, in the mean")
            .in("radian"));
  }
};

struct MissedShown {
  std::string target;
  std::string curve;
  std::string why;
  static constexpr auto describe() {
    return core::fields(core::field<&MissedShown::target>("that was not found"),
                        core::field<&MissedShown::curve>("in the way"),
                        core::field<&MissedShown::why>("in words"));
  }
};

struct PatchEditShown {
  PatchPlace patch{};
  std::string target;
  std::optional<std::string> why;
  std::optional<double> amount;
  std::optional<std::array<double, 2>> sav;
  std::optional<double> departure;
  std::optional<std::vector<MissedShown>> missed;
  std::optional<std::vector<MissedShown>> unmet;
  static constexpr auto describe() {
    using Patch = PatchEditShown;
    return core::fields(core::field<&Patch::patch>("row and column, from 0"),
                        core::field<&Patch::target>("taken, or \"as given\""),
                        core::field<&Patch::why>("it stays as given"),
                        core::field<&Patch::amount>("as used"),
                        core::field<&Patch::sav>("before and after"),
                        core::field<&Patch::departure>("largest").in("length"),
                        core::field<&Patch::missed>("targets not found"),
                        core::field<&Patch::unmet>("conditions not met part of the way"));
  }
};

struct SurfaceEditAnswer {
  std::optional<surface::Surface> surface;
  std::optional<std::vector<surface::Surface>> surfaces;
  SurfaceValueShown before;
  SurfaceValueShown after;
  double departure = 0;
  std::optional<double> limit;
  std::optional<double> amount;
  std::optional<std::string> target;
  std::optional<std::vector<TradeOffShown>> tradeoff;
  std::optional<std::vector<MissedShown>> missed;
  std::optional<std::vector<MissedShown>> unmet;
  std::optional<std::vector<PatchEditShown>> patch_edits;
  std::optional<JointsChange> joints;
  std::optional<double> sav_apart;

  std::optional<surface::SurfaceEdit> edit;  ///< not part of the public form: for pictures

  static constexpr auto describe() {
    using Answer = SurfaceEditAnswer;
    return core::fields(
        core::field<&Answer::surface>("edited; null where its patches no longer meet")
            .null_if_empty(),
        core::field<&Answer::surfaces>("then: the patches one by one"),
        core::field<&Answer::before>("value of the given surface"),
        core::field<&Answer::after>("value of the edited one"),
        core::field<&Answer::departure>("largest, from the given surface").in("length"),
        core::field<&Answer::limit>("of the departure, as used; null: none")
            .in("length")
            .null_if_empty(),
        core::field<&Answer::amount>("as used, of one patch"),
        core::field<&Answer::target>("that was taken, of one patch"),
        core::field<&Answer::tradeoff>(
            "every target found, by departure: of one patch, or of several with joints held"),
        core::field<&Answer::missed>("others, of one patch"),
        core::field<&Answer::unmet>("conditions not met part of the way, of one patch"),
        core::field<&Answer::patch_edits>("of several patches, one by one"),
        core::field<&Answer::joints>("between several patches"),
        core::field<&Answer::sav_apart>(
            "with joints held at a price: what each patch for itself would come to"));
  }
};
SurfaceEditAnswer surface_edit_answer(const surface::SurfaceEdit& edit,
                                      const surface::EditOptions& options);

/// The options of room surface for all these surfaces, at least one.
surface::EditOptions surface_edit_options(const SurfaceEditOptions& given,
                                          std::span<const surface::Surface> all);

/// One of several surfaces: edited, or why it stays as it is.
struct OneOfSurfaces {
  std::optional<SurfaceEditAnswer> edit;
  std::optional<std::string> why;
  static constexpr auto describe() {
    return core::fields(core::field<&OneOfSurfaces::edit>("as of surface.edit"),
                        core::field<&OneOfSurfaces::why>("it stays as given"));
  }
};

struct SurfacesEditAnswer {
  std::vector<OneOfSurfaces> surfaces;
  JointsChange joints;
  static constexpr auto describe() {
    using Answer = SurfacesEditAnswer;
    return core::fields(
        core::field<&Answer::surfaces>("in their order"),
        core::field<&Answer::joints>("between all patches, also of different surfaces"));
  }
};

}  // namespace keyline::operations
