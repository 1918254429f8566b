#include "keyline/operations/spline_search.h"

#include <string>

#include "keyline/operations/fields.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;
using nlohmann::json;

Result<void> read_knots(const json& request, fit::SplineFitOptions& options) {
  if (!request.contains("knots")) return {};
  const std::string knots = string_or(request, "knots", "");
  if (knots != "polished" && knots != "ga")
    return fail(ErrorCode::bad_input, "\"" + knots + "\" is no way to place knots",
                "give \"polished\" or \"ga\"", "knots");
  options.knots = knots == "ga" ? fit::KnotPlacement::ga : fit::KnotPlacement::polished;
  if (knots == "ga") options.smart_start = false;
  return {};
}

Result<void> read_parameter(const json& request, fit::SplineFitOptions& options) {
  if (!request.contains("parameter")) return {};
  const std::string parameter = string_or(request, "parameter", "");
  if (parameter == "chord")
    options.parameter = fit::Parametrization::chord;
  else if (parameter == "centripetal")
    options.parameter = fit::Parametrization::centripetal;
  else if (parameter == "smooth-chord")
    options.parameter = fit::Parametrization::smooth_chord;
  else
    return fail(ErrorCode::bad_input, "\"" + parameter + "\" is no parametrisation",
                "give \"chord\", \"centripetal\" or \"smooth-chord\"", "parameter");
  return {};
}

}  // namespace

Result<void> read_spline_search(const json& request, OrderRange order,
                                fit::SplineFitOptions& options) {
  const auto set = [&](int& target, const char* name, int low, int high) -> Result<void> {
    const auto value = integer_between(request, name, target, low, high);
    if (!value) return std::unexpected(value.error());
    target = *value;
    return {};
  };
  for (const auto& done : {set(options.order, "order", order.least, order.most),
                           set(options.population, "population", 2, 100000),
                           set(options.generations, "generations", 0, 1000000),
                           set(options.trials, "trials", 1, 100000)})
    if (!done) return done;
  if (auto done = read_knots(request, options); !done) return done;
  return read_parameter(request, options);
}

}  // namespace keyline::operations
