#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/lac/compound.h"
#include "keyline/lac/region.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Result;
using nlohmann::json;

struct Region {
  core::Interval psi;
  bool open = false;  ///< the curves at the borders cannot be drawn themselves
};

Region region_of(double alpha, double theta) {
  return {lac::drawable_region(alpha, theta), alpha >= 0 && alpha <= 1};
}

Region region_of(const lac::CompoundRhythm& rhythm, double theta) {
  const core::Interval psi = lac::drawable_region(rhythm, theta);
  return {psi, !lac::solve_compound({theta, psi.high, 1, 0}, rhythm).has_value()};
}

Result<lac::CompoundRhythm> rhythm_of(const json& request, const std::vector<double>& alpha) {
  if (!request.contains("ratio"))
    return core::fail(ErrorCode::bad_input, "\"ratio\" is missing",
                      "two slopes need the share of the turning that falls to the first", "ratio");
  const auto ratio = share_of(request, "ratio");
  if (!ratio) return std::unexpected(ratio.error());
  return lac::CompoundRhythm{alpha[0], alpha[1], *ratio};
}

json region_json(const Region& region, bool mirrored) {
  const core::Interval& i = region.psi;
  return {{"psi", mirrored ? json{-i.high, -i.low} : json{i.low, i.high}},
          {"open", {region.open, region.open}}};
}

Result<json> run(const json& request, const Context&) {
  const double theta = number_or(request, "theta", 1);
  if (!(std::abs(theta) > 0 && std::abs(theta) < core::kPi))
    return core::fail(ErrorCode::bad_input, "the turning is out of range",
                      "give an angle between 0 and pi, either way", "theta");
  const auto alpha = numbers_of_count(request, "alpha", 1, 2);
  if (!alpha) return std::unexpected(alpha.error());
  if (alpha->size() == 1) return region_json(region_of((*alpha)[0], std::abs(theta)), theta < 0);
  const auto rhythm = rhythm_of(request, *alpha);
  if (!rhythm) return std::unexpected(rhythm.error());
  return region_json(region_of(*rhythm, std::abs(theta)), theta < 0);
}

}  // namespace

Operation lac_region_operation() {
  using Type = Field::Type;
  return {"lac.region",
          "Which triangles can be met: the interval of angles psi from the start tangent to the "
          "chord that curves of this slope turning by theta can have, whichever end has the "
          "smaller radius. An end marked open is not reached by any curve.",
          {{"theta", Type::number, true, "the turning, from P0P1 to P1P2, in (-pi, pi)"},
           {"alpha", Type::number_or_numbers, true,
            "the slope, or two for a compound rhythm, the first for the end of smaller radius"},
           {"ratio", Type::number, false,
            "with two slopes: share of the turning that falls to the first, between 0 and 1"}},
          run,
          {{"theta", 1.2}, {"alpha", -1}}};
}

}  // namespace keyline::operations
