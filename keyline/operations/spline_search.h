#pragma once

#include <nlohmann/json.hpp>

#include "keyline/core/error.h"
#include "keyline/fit/fit_spline.h"

/// The fields `fit.spline` and `fair` share for the search of a spline's knots.
namespace keyline::operations {

struct OrderRange {
  int least = 2;
  int most = 8;
};

/// Reads `order`, `population`, `generations`, `trials`, `knots` and `parameter` over what
/// `options` holds; bad_input names the field. `knots` = "ga" is [Fairing]'s plain search: random
/// first knots, no polish.
core::Result<void> read_spline_search(const nlohmann::json& request, OrderRange order,
                                      fit::SplineFitOptions& options);

}  // namespace keyline::operations
