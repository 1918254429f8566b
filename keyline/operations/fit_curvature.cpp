#include "keyline/analysis/profile.h"
#include "keyline/core/text.h"
#include "keyline/fit/curvature_drive.h"
#include "keyline/fit/curvature_target.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"
#include "keyline/operations/subject.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;

enum class TargetKind { smooth, rhythm };
constexpr auto choices(const TargetKind*) {
  return core::words<TargetKind>({{TargetKind::smooth, "smooth"}, {TargetKind::rhythm, "rhythm"}});
}

/// A curvature wanted at a place of the path.
struct WantedCurvature {
  std::optional<double> t;
  std::optional<double> along;
  double curvature = 0;
  static constexpr auto describe() {
    return core::fields(
        core::field<&WantedCurvature::t>("parameter over the whole path")
            .within(core::from_to(0, 1)),
        core::field<&WantedCurvature::along>("in place of t: fraction of the whole length")
            .within(core::from_to(0, 1)),
        core::field<&WantedCurvature::curvature>("signed, positive turning left")
            .in("1/length")
            .needed());
  }
  static Result<void> check(const WantedCurvature& wanted) {
    if (wanted.t.has_value() != wanted.along.has_value()) return {};
    return core::fail(ErrorCode::bad_input, "a place is \"t\" or \"along\"",
                      "give one of them with every curvature");
  }
};

struct CurvatureRequest {
  document::Path curve;
  std::variant<TargetKind, std::vector<WantedCurvature>> target;
  std::optional<double> cutoff;
  fit::WantedRhythm rhythm = fit::WantedRhythm::own;
  bool hold_end = false;
  std::optional<double> max_deviation;
  bool keep_monotone = false;
  static constexpr auto describe() {
    using Request = CurvatureRequest;
    return core::fields(
        core::field<&Request::curve>("a path of Beziers of degree 5 or less").needed(),
        core::field<&Request::target>("what the curvature is driven to: \"smooth\", \"rhythm\" or "
                                      "a list of places")
            .needed(),
        core::field<&Request::cutoff>(
            "wavelength that smooth halves; else twice the mean length of a piece")
            .in("length"),
        core::field<&Request::rhythm>(
            "target rhythm: the curve's own, or another to give it (accelerating: slope -0.5 and "
            "less, stable: 0, decelerating: 0.5 and more)"),
        core::field<&Request::hold_end>("the end point stays; else it moves with the lengths"),
        core::field<&Request::max_deviation>(
            "farthest the curve may move, not counting what a free end moves along it; else as far "
            "as the lengths take it")
            .in("length")
            .within(core::kPositive),
        core::field<&Request::keep_monotone>("pieces of monotone curvature stay so"));
  }
  /// Fails: bad_input for a rhythm where the target is none.
  static Result<void> check(const CurvatureRequest& request) {
    const auto* kind = std::get_if<TargetKind>(&request.target);
    if (request.rhythm == fit::WantedRhythm::own || (kind && *kind == TargetKind::rhythm))
      return {};
    return core::fail(ErrorCode::bad_input, "a rhythm is wanted of a target that is none",
                      "give \"target\": \"rhythm\", or leave rhythm out", "rhythm");
  }
};

struct CurvatureAnswer {
  MadeCurve curve;
  double before = 0;
  double after = 0;
  bool converged = false;
  int iterations = 0;
  double share = 1;
  double end_moved = 0;
  double moved = 0;
  std::vector<std::string> report;
  static constexpr auto describe() {
    using Answer = CurvatureAnswer;
    return core::fields(
        core::flattened<&Answer::curve>(),
        core::field<&Answer::before>("rms of curvature less target").in("1/length"),
        core::field<&Answer::after>("the same of the curve returned").in("1/length"),
        core::field<&Answer::converged>("whether the search ended by itself"),
        core::field<&Answer::iterations>("of the search"),
        core::field<&Answer::share>("of the way to the target that keep_monotone allowed"),
        core::field<&Answer::end_moved>("distance of the end point from where it was").in("length"),
        core::field<&Answer::moved>("farthest the curve moved along its normals").in("length"),
        core::field<&Answer::report>("what was done beside it, in words"));
  }
};

Result<curve::PiecewiseBezier> chain_of(const document::Path& path) {
  curve::PiecewiseBezier chain;
  for (std::size_t i = 0; i < path.curves.size(); ++i) {
    const auto* piece = std::get_if<curve::Bezier2>(&path.curves[i].value);
    if (!piece)
      return core::fail(ErrorCode::bad_input, "is no Bézier curve",
                        "give a path of quintics, or convert it",
                        "curve.curves[" + std::to_string(i) + "]");
    chain.pieces.push_back(*piece);
  }
  return chain;
}

fit::RhythmTarget target_of(const CurvatureRequest& request, const curve::PiecewiseBezier& chain) {
  const bool closed = request.curve.closed;
  if (const auto* kind = std::get_if<TargetKind>(&request.target))
    return *kind == TargetKind::smooth
               ? fit::RhythmTarget{fit::smooth_target(chain, closed, request.cutoff.value_or(0))}
               : fit::rhythm_target(chain, closed, request.rhythm);
  const analysis::CurveView view(request.curve);
  const analysis::ArcLengthTable table(view);
  std::vector<fit::CurvatureTarget> list;
  for (const WantedCurvature& wanted : std::get<1>(request.target))
    list.push_back({wanted.t ? *wanted.t : table.parameter_at(*wanted.along * table.length()),
                    wanted.curvature});
  return {std::move(list)};
}

Result<CurvatureAnswer> run(const CurvatureRequest& request, const Context&) {
  if (auto extent = check_extent(request.curve); !extent) return std::unexpected(extent.error());
  const auto chain = chain_of(request.curve);
  if (!chain) return std::unexpected(chain.error());
  fit::CurvatureDriveOptions options;
  options.closed = request.curve.closed;
  options.hold_end = request.hold_end;
  options.keep_monotone = request.keep_monotone;
  options.max_deviation = request.max_deviation.value_or(0);
  const fit::RhythmTarget target = target_of(request, *chain);
  auto driven = fit::drive_curvature(*chain, target.places, options);
  if (!driven) return std::unexpected(driven.error());
  document::Path out{{}, request.curve.closed};
  for (const curve::Bezier2& piece : driven->chain.pieces) out.curves.push_back({piece});
  CurvatureAnswer answer;
  answer.curve.curve = std::move(out);
  answer.before = driven->before;
  answer.after = driven->after;
  answer.converged = driven->converged;
  answer.iterations = driven->iterations;
  answer.share = driven->share;
  answer.end_moved = driven->end_moved;
  answer.moved = driven->moved;
  answer.report = std::move(driven->notes);
  if (target.straight_ended > 0)
    answer.report.push_back(core::counted(target.straight_ended, "stretch", "stretches") +
                            " from or to a straight place can only be accelerating");
  return answer;
}

}  // namespace

Operation fit_curvature_operation() {
  return declare<run>(
      {.name = "fit.curvature",
       .summary = "Modifies a chain of quintic Beziers so that its curvature follows a target: "
                  "directions of the control edges stay, their lengths move, joints stay G2.",
       .examples = {R"({"curve":{"type":"path","curves":[
                  {"type":"bezier","points":[[0,0],[1,0.1],[2,0.4],[3,0.9],[4,1.6],[5,2.5]]},
                  {"type":"bezier",
                   "points":[[5,2.5],[6,3.4],[6.9,4.5],[7.7,5.8],[8.3,7.2],[8.7,8.7]]}]},
                "target":"smooth"})"}});
}

}  // namespace keyline::operations
