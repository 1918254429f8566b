#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/analysis/profile.h"
#include "keyline/curve/arriving.h"
#include "keyline/document/closest_point.h"
#include "keyline/document/cusped.h"
#include "keyline/operations/ends.h"
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

/// On which side of a curve a point lies, told at the place nearest to it. At a corner, which may
/// be where the curve ends as it begins, that is the outside of its turn, of which either direction
/// of travel alone may be wrong, but not their mean; at a cusp that is none.
class Side {
 public:
  Side(const document::Path& path, double length)
      : cusped_(path),
        view_(cusped_),
        comes_back_(meet(evaluate(path, 0), evaluate(path, 1), length)) {}

  bool is_left(const curve::ClosestPoint& foot, Point2 p) const {
    const auto [before, after] = both_sides(foot.t);
    const core::Vector2 travel =
        unit_tangent(view_.jet_at(before)) + unit_tangent(view_.jet_at(after));
    if (norm(travel) < kCusp) return turns_right(before, after, foot.point);
    return cross(travel, p - foot.point) >= 0;
  }

 private:
  static constexpr double kOnePlace = 1e-12;  // of the parameter
  static constexpr double kCusp = 1e-6;       // radians short of half a turn

  /// Parameters just before and at a breakpoint; the same twice elsewhere.
  std::array<double, 2> both_sides(double t) const {
    const auto at = std::ranges::lower_bound(view_.breaks(), t - kOnePlace);
    if (at == view_.breaks().end() || *at > t + kOnePlace) return {t, t};
    if (*at == 0) return {comes_back_ ? 1.0 : 0.0, 0};
    if (*at == 1) return {1, comes_back_ ? 0.0 : 1.0};
    return {std::nextafter(*at, 0.0), *at};
  }

  /// Of the ways into a cusp and out of it.
  bool turns_right(double before, double after, Point2 cusp) const {
    constexpr double kBeside = 1e-3;
    const Point2 from = evaluate(view_, before - kBeside), to = evaluate(view_, after + kBeside);
    return cross(cusp - from, to - cusp) <= 0;
  }

  document::CuspedPath cusped_;
  analysis::CurveView view_;
  bool comes_back_;
};

Result<PointDeviation> run(const DeviationRequest& request, const Context& context) {
  constexpr std::size_t kLook = 1024;  // points between two looks at whether to go on
  const analysis::CurveView view = analysis::view(request.curve);
  const analysis::ArcLengthTable table(view);
  const document::ClosestSearch nearest(request.curve);
  const Side side(request.curve, table.length());
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
    result.arc_length.push_back(table.length_at(foot.t));
    result.distance.push_back(side.is_left(foot, p) ? foot.distance : -foot.distance);
    result.feet.push_back(foot.point);
    result.direction.push_back(curve::travel_angle(view, foot.t));
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
