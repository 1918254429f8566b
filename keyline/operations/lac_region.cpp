#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/lac/hermite/compound.h"
#include "keyline/lac/hermite/handle_region.h"
#include "keyline/lac/hermite/region.h"
#include "keyline/operations/handles.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;

struct RegionRequest {
  std::optional<double> theta;
  std::vector<double> alpha;
  std::optional<double> ratio;
  std::optional<Handles> points;
  std::optional<int> handle;
  static constexpr auto describe() {
    return core::fields(
        core::field<&RegionRequest::theta>("the turning, from P0P1 to P1P2, in (-pi, pi)")
            .in("radian")
            .within(core::between(-core::kPi, core::kPi)),
        core::field<&RegionRequest::alpha>(
            "the slope, or two for a compound rhythm, the first for the end of smaller radius")
            .count(1, 2)
            .within(core::from_to(-1e100, 1e100))
            .or_bare_item()
            .needed(),
        core::field<&RegionRequest::ratio>(
            "with two slopes: share of the turning that falls to the first, between 0 and 1")
            .within(core::between(0, 1)),
        core::field<&RegionRequest::points>("in place of theta: P0, P1, P2"),
        core::field<&RegionRequest::handle>(
            "with points: also where this one, from 0, may stand while the others stay")
            .within(core::from_to(0, 2)));
  }
};

struct RegionResult {
  std::array<double, 2> psi{};
  std::array<bool, 2> open{};
  std::optional<std::vector<std::vector<core::Point2>>> outlines;
  std::optional<core::Point2> nearest;
  static constexpr auto describe() {
    return core::fields(
        core::field<&RegionResult::psi>("least and largest angle from start tangent to chord")
            .in("radian"),
        core::field<&RegionResult::open>("whether no curve reaches that end itself"),
        core::field<&RegionResult::outlines>(
            "polygons in which the handle may stand, as far as 50 times the others' distance"),
        core::field<&RegionResult::nearest>(
            "where it stands in none of them: the nearest place that does"));
  }
};

/// What one slope or two allow.
struct Allowed {
  lac::RegionOfTurning region;
  bool open = false;  ///< the curves at the borders cannot be drawn themselves
};

Result<Allowed> allowed(const RegionRequest& request, double theta) {
  if (request.alpha.size() == 1) {
    const double alpha = request.alpha[0];
    return Allowed{[alpha](double turning) { return lac::drawable_region(alpha, turning); },
                   alpha >= 0 && alpha <= 1};
  }
  if (!request.ratio)
    return core::fail(ErrorCode::bad_input, "\"ratio\" is missing",
                      "two slopes need the share of the turning that falls to the first", "ratio");
  const lac::CompoundRhythm rhythm{request.alpha[0], request.alpha[1], *request.ratio};
  return Allowed{[rhythm](double turning) { return lac::drawable_region(rhythm, turning); },
                 theta > 0 && !lac::border_is_drawn(rhythm, theta)};
}

/// Signed; 0 for handles on a line alone.
Result<double> turning_of(const RegionRequest& request) {
  if (request.points) {
    const auto& [p0, p1, p2] = *request.points;
    const auto angles = lac::handle_angles(p0, p1, p2);
    if (!angles) return std::unexpected(angles.error());
    if (std::abs(angles->turning) < core::kPi) return angles->turning;
  } else if (request.theta && *request.theta != 0) {
    return *request.theta;
  }
  return core::fail(ErrorCode::bad_input, "the turning is out of range",
                    "give an angle between 0 and pi, either way, or handles that turn by less",
                    request.points ? "points" : "theta");
}

Result<RegionResult> run(const RegionRequest& request, const Context&) {
  const auto theta = turning_of(request);
  if (!theta) return std::unexpected(theta.error());
  const auto can = allowed(request, std::abs(*theta));
  if (!can) return std::unexpected(can.error());
  RegionResult result;
  result.open = {can->open, can->open};
  if (*theta != 0) {
    const core::Interval psi = can->region(std::abs(*theta));
    result.psi = *theta < 0 ? std::array{-psi.high, -psi.low} : std::array{psi.low, psi.high};
  }
  if (!request.points || !request.handle) return result;
  const lac::HandleRegion where = lac::handle_region(*request.points, *request.handle, can->region);
  result.outlines.emplace(where.outlines.begin(), where.outlines.end());
  result.nearest = where.nearest;
  return result;
}

}  // namespace

Operation lac_region_operation() {
  return declare<run>(
      {.name = "lac.region",
       .summary =
           "Tells in which triangles a slope can be drawn: the interval of angles psi from the "
           "start tangent to the chord that curves of this slope turning by theta can have, "
           "whichever end has the smaller radius. No curve reaches an end marked open. For "
           "three handles also tells where one of them may be moved to.",
       .examples = {R"({"theta":1.2,"alpha":-1})",
                    R"({"points":[[0,0],[2,0],[3,1.5]],"handle":2,"alpha":1.5})",
                    R"({"theta":1.2,"alpha":[-1,1.5],"ratio":0.4})"}});
}

}  // namespace keyline::operations
