#include "keyline/exchange/json_curve.h"
#include "keyline/lac/volume.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::Result;
using nlohmann::json;

Result<json> run(const json& request, const Context&) {
  const std::vector<core::Point2> points = points_of(request, "points");
  if (points.size() != 2)
    return core::fail(core::ErrorCode::bad_input, "two points are wanted",
                      "give P0 and P2, the ends", "points");
  const core::Pose2 start{points[0], number_or(request, "direction", 0)};
  const auto solved = lac::solve_volume(start, points[1], number_or(request, "alpha", -1),
                                        number_or(request, "volume", 0));
  if (!solved) return std::unexpected(solved.error());
  const lac::SegmentSolution& s = solved->solution;
  return json{{"curve", exchange::to_json(document::PlanarCurve{lac::chain_of(s.segment)})},
              {"volume", solved->volume},
              {"reachable", {solved->reachable.smallest, solved->reachable.largest}},
              {"lambda", s.lambda},
              {"theta", lac::total_turning(s.segment)},
              {"reversed", s.reversed}};
}

}  // namespace

Operation lac_volume_operation() {
  using Type = Field::Type;
  return {"lac.volume",
          "The log-aesthetic segment with given ends, direction at the start and area over its "
          "chord.",
          {{"points", Type::points, true, "P0 and P2: start and end"},
           {"direction", Type::number, true, "direction of travel at P0, radians"},
           {"alpha", Type::number, true, "slope of the logarithmic curvature graph; any number"},
           {"volume", Type::number, true, "area between curve and chord, 0 or more"}},
          run,
          {{"points", {{0, 0}, {2, 0}}}, {"direction", 0.6}, {"alpha", -1}, {"volume", 0.4}}};
}

}  // namespace keyline::operations
