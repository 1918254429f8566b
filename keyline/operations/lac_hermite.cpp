#include "keyline/lac/g2/g2_hermite.h"
#include "keyline/lac/hermite/clamped.h"
#include "keyline/operations/handles.h"
#include "keyline/operations/made_curve.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::Result;

struct HermiteRequest {
  core::Point2 start;
  core::Point2 end;
  std::array<double, 2> directions{};
  double alpha = -1;
  std::optional<std::array<double, 2>> curvatures;
  static constexpr auto describe() {
    return core::fields(core::field<&HermiteRequest::start>("where the curve starts").needed(),
                        core::field<&HermiteRequest::end>("where it ends").needed(),
                        core::field<&HermiteRequest::directions>(
                            "direction of travel at start and end, from the x axis")
                            .in("radian")
                            .needed(),
                        core::field<&HermiteRequest::alpha>(kSlope).needed(),
                        core::field<&HermiteRequest::curvatures>(
                            "signed curvature at start and end, positive turning left")
                            .in("1/length"));
  }
};

enum class Shape { c, s };
constexpr auto choices(const Shape*) {
  return core::words<Shape>({{Shape::c, "C"}, {Shape::s, "S"}});
}

struct HermiteResult {
  MadeCurve curve;
  double theta = 0;
  std::optional<Shape> shape;
  std::optional<bool> reversed;
  std::optional<bool> clamped;
  std::optional<double> bending_energy;
  std::optional<double> residual;
  static constexpr auto describe() {
    return core::fields(
        core::flattened<&HermiteResult::curve>(),
        core::field<&HermiteResult::theta>("the whole turning, signed").in("radian"),
        core::field<&HermiteResult::shape>("G1: C, or S where curvature changes sign"),
        core::field<&HermiteResult::reversed>("G1: whether the radius falls along the curve"),
        core::field<&HermiteResult::clamped>(
            "G1: two pieces, because one's curvatures would leave the doubles"),
        core::field<&HermiteResult::bending_energy>("G2: of the chain").in("1/length"),
        core::field<&HermiteResult::residual>("G2: distance of the end from the one asked for")
            .in("length"));
  }
};

Result<HermiteResult> with_tangents(const core::Pose2& start, const core::Pose2& end,
                                    double alpha) {
  auto solved = lac::solve_g1_directions_chain(start, end, alpha);
  if (!solved) return std::unexpected(solved.error());
  const lac::Piece& first = solved->chain.pieces.front();
  const bool inflects = first.curvature_start * first.curvature_end < 0;
  HermiteResult result;
  result.theta = lac::total_turning(solved->chain);
  result.shape = inflects ? Shape::s : Shape::c;
  result.reversed = solved->reversed;
  result.clamped = solved->clamped;
  result.curve = made({std::move(solved->chain)});
  return result;
}

Result<HermiteResult> with_curvatures(const lac::CurvatureElement& start,
                                      const lac::CurvatureElement& end, double alpha) {
  auto solved = lac::solve_g2(start, end, alpha);
  if (!solved) return std::unexpected(solved.error());
  HermiteResult result;
  result.theta = lac::total_turning(solved->chain);
  result.bending_energy = solved->bending_energy;
  result.residual = solved->residual;
  result.curve = made({std::move(solved->chain)});
  return result;
}

Result<HermiteResult> run(const HermiteRequest& request, const Context&) {
  const core::Pose2 start{request.start, request.directions[0]};
  const core::Pose2 end{request.end, request.directions[1]};
  if (!request.curvatures) return with_tangents(start, end, request.alpha);
  const auto& [at_start, at_end] = *request.curvatures;
  return with_curvatures({start, at_start}, {end, at_end}, request.alpha);
}

}  // namespace

Operation lac_hermite_operation() {
  return declare<run>(
      {.name = "lac.hermite",
       .summary = "The log-aesthetic curve of slope alpha between two points with given "
                  "directions: one segment, C- or S-shaped (S only for alpha < 0); with "
                  "curvatures as well a G2 chain of up to three pieces.",
       .examples = {R"({"start":[0,0],"end":[3,1],"directions":[0.8,0.9],"alpha":-1})",
                    R"({"start":[0,0],"end":[3,1],"directions":[0.8,0.2],"alpha":-1,
                        "curvatures":[0.1,-0.2]})"}});
}

}  // namespace keyline::operations
