#include "keyline/exchange/json_curve.h"
#include "keyline/lac/clamped.h"
#include "keyline/lac/g2_hermite.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::Result;
using nlohmann::json;

Result<json> with_tangents(const core::Pose2& start, const core::Pose2& end, double alpha) {
  const auto solved = lac::solve_g1_directions_chain(start, end, alpha);
  if (!solved) return std::unexpected(solved.error());
  const lac::Piece& first = solved->chain.pieces.front();
  const bool inflects = first.curvature_start * first.curvature_end < 0;
  return json{{"curve", exchange::to_json(document::PlanarCurve{solved->chain})},
              {"theta", lac::total_turning(solved->chain)},
              {"shape", inflects ? "S" : "C"},
              {"reversed", solved->reversed},
              {"clamped", solved->clamped}};
}

Result<json> with_curvatures(const lac::CurvatureElement& start, const lac::CurvatureElement& end,
                             double alpha) {
  const auto solved = lac::solve_g2(start, end, alpha);
  if (!solved) return std::unexpected(solved.error());
  return json{{"curve", exchange::to_json(document::PlanarCurve{solved->chain})},
              {"theta", lac::total_turning(solved->chain)},
              {"bending_energy", solved->bending_energy},
              {"residual", solved->residual}};
}

Result<json> run(const json& request, const Context&) {
  const core::Point2 p0 = point_of(request, "start");
  const core::Point2 p1 = point_of(request, "end");
  const auto directions = numbers_of_count(request, "directions", 2, 2);
  if (!directions) return std::unexpected(directions.error());
  const core::Pose2 start{p0, (*directions)[0]};
  const core::Pose2 end{p1, (*directions)[1]};
  const double alpha = number_or(request, "alpha", -1);
  if (!request.contains("curvatures")) return with_tangents(start, end, alpha);
  const auto curvatures = numbers_of_count(request, "curvatures", 2, 2);
  if (!curvatures) return std::unexpected(curvatures.error());
  return with_curvatures({start, (*curvatures)[0]}, {end, (*curvatures)[1]}, alpha);
}

}  // namespace

Operation lac_hermite_operation() {
  using Type = Field::Type;
  return {"lac.hermite",
          "The log-aesthetic curve of slope alpha between two points with given directions: one "
          "segment, C- or S-shaped (S only for alpha < 0); with curvatures as well a G2 chain of "
          "up to three pieces.",
          {{"start", Type::point, true, "where the curve starts"},
           {"end", Type::point, true, "where it ends"},
           {"directions", Type::numbers, true,
            "direction of travel at start and end, radians from the x axis"},
           {"alpha", Type::number, true, "slope of the logarithmic curvature graph; any number"},
           {"curvatures", Type::numbers, false,
            "signed curvature at start and end, positive turning left"}},
          run,
          {{"start", {0, 0}}, {"end", {3, 1}}, {"directions", {0.8, 0.9}}, {"alpha", -1}}};
}

}  // namespace keyline::operations
