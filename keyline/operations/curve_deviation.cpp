#include <algorithm>
#include <cmath>

#include "keyline/analysis/profile.h"
#include "keyline/document/closest_point.h"
#include "keyline/operations/paper_operations.h"
#include "keyline/operations/values.h"

namespace keyline::operations {
namespace {

using core::Point2;
using core::Result;

struct DeviationRequest {
  document::Path curve;
  std::vector<Point2> points;
  static constexpr auto describe() {
    return core::fields(core::field<&DeviationRequest::curve>("held against the points").needed(),
                        core::field<&DeviationRequest::points>("measured").needed());
  }
};

struct PointDeviation {
  std::vector<double> arc_length;
  std::vector<double> distance;
  std::vector<Point2> feet;
  std::vector<double> direction;
  double max = 0;
  double rms = 0;
  static constexpr auto describe() {
    using Deviation = PointDeviation;
    return core::fields(
        core::field<&Deviation::arc_length>("of the nearest place of the curve to each point")
            .in("length"),
        core::field<&Deviation::distance>("of each point, positive to the left of travel")
            .in("length"),
        core::field<&Deviation::feet>("the nearest places"),
        core::field<&Deviation::direction>("of travel there").in("radian"),
        core::field<&Deviation::max>("largest distance").in("length"),
        core::field<&Deviation::rms>("root mean square").in("length"));
  }
};

Result<PointDeviation> run(const DeviationRequest& request, const Context& context) {
  constexpr std::size_t kLook = 1024;  // points between two looks at whether to go on
  const analysis::CurveView view = analysis::view(request.curve);
  const analysis::ArcLengthTable table(view);
  const document::ClosestSearch nearest(request.curve);
  PointDeviation result;
  double squares = 0;
  for (const Point2& p : request.points) {
    if (const std::size_t done = result.feet.size(); done % kLook == 0) {
      if (context.progress.stop_requested())
        return core::fail(core::ErrorCode::cancelled, "cancelled");
      context.progress.report(
          static_cast<double>(done) / static_cast<double>(request.points.size()),
          "measuring points");
    }
    const curve::ClosestPoint foot = nearest(p);
    const double angle = curve::tangent_angle(jet(view, foot.t));
    const core::Vector2 away = p - foot.point;
    const bool left = std::cos(angle) * away.y >= std::sin(angle) * away.x;
    result.arc_length.push_back(table.length_at(foot.t));
    result.distance.push_back(left ? foot.distance : -foot.distance);
    result.feet.push_back(foot.point);
    result.direction.push_back(angle);
    result.max = std::max(result.max, foot.distance);
    squares += foot.distance * foot.distance;
  }
  if (!request.points.empty())
    result.rms = std::sqrt(squares / static_cast<double>(request.points.size()));
  return result;
}

}  // namespace

Operation curve_deviation_operation() {
  return declare<run>(
      {.name = "curve.deviation",
       .summary = "How far points lie from a curve, each with its place along it: deviation "
                  "against length.",
       .examples = {R"({"curve":{"type":"bezier","points":[[0,0],[1,2],[3,2],[4,0]]},
                        "points":[[0,0.1],[1,1.2],[2,1.5],[3,1.1]]})"},
       .long_running = true});
}

}  // namespace keyline::operations
