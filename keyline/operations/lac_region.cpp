#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/lac/compound.h"
#include "keyline/lac/region.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;

struct RegionRequest {
  double theta = 1;
  std::vector<double> alpha;
  std::optional<double> ratio;
  static constexpr auto describe() {
    return core::fields(
        core::field<&RegionRequest::theta>("the turning, from P0P1 to P1P2, in (-pi, pi)")
            .in("radian")
            .within(core::between(-core::kPi, core::kPi))
            .needed(),
        core::field<&RegionRequest::alpha>(
            "the slope, or two for a compound rhythm, the first for the end of smaller radius")
            .count(1, 2)
            .or_bare_item()
            .needed(),
        core::field<&RegionRequest::ratio>(
            "with two slopes: share of the turning that falls to the first, between 0 and 1")
            .within(core::between(0, 1)));
  }
};

struct RegionResult {
  std::array<double, 2> psi{};
  std::array<bool, 2> open{};
  static constexpr auto describe() {
    return core::fields(
        core::field<&RegionResult::psi>("least and largest angle from start tangent to chord")
            .in("radian"),
        core::field<&RegionResult::open>("whether no curve reaches that end itself"));
  }
};

struct Region {
  core::Interval psi;
  bool open = false;  ///< the curves at the borders cannot be drawn themselves
};

Region region_of(double alpha, double theta) {
  return {lac::drawable_region(alpha, theta), alpha >= 0 && alpha <= 1};
}

Region region_of(const lac::CompoundRhythm& rhythm, double theta) {
  return {lac::drawable_region(rhythm, theta), !lac::border_is_drawn(rhythm, theta)};
}

RegionResult shown(const Region& region, bool mirrored) {
  const core::Interval& i = region.psi;
  RegionResult result;
  result.psi = mirrored ? std::array{-i.high, -i.low} : std::array{i.low, i.high};
  result.open = {region.open, region.open};
  return result;
}

Result<RegionResult> run(const RegionRequest& request, const Context&) {
  const double theta = std::abs(request.theta);
  if (theta == 0)
    return core::fail(ErrorCode::bad_input, "the turning is out of range",
                      "give an angle between 0 and pi, either way", "theta");
  const bool mirrored = request.theta < 0;
  if (request.alpha.size() == 1) return shown(region_of(request.alpha[0], theta), mirrored);
  if (!request.ratio)
    return core::fail(ErrorCode::bad_input, "\"ratio\" is missing",
                      "two slopes need the share of the turning that falls to the first", "ratio");
  const lac::CompoundRhythm rhythm{request.alpha[0], request.alpha[1], *request.ratio};
  return shown(region_of(rhythm, theta), mirrored);
}

}  // namespace

Operation lac_region_operation() {
  return declare<run>(
      {.name = "lac.region",
       .summary = "Which triangles can be met: the interval of angles psi from the start tangent "
                  "to the chord that curves of this slope turning by theta can have, whichever end "
                  "has the smaller radius. An end marked open is not reached by any curve.",
       .examples = {R"({"theta":1.2,"alpha":-1})",
                    R"({"theta":1.2,"alpha":[-1,1.5],"ratio":0.4})"}});
}

}  // namespace keyline::operations
