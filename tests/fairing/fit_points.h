#pragma once

#include <vector>

#include "keyline/fairing/chain_fit.h"

namespace keyline::fairing::detail {

/// Points to be fitted, each of which counts once.
inline std::vector<FitPoint> fit_points(const std::vector<core::Point2>& points) {
  std::vector<FitPoint> all;
  for (const core::Point2 p : points) all.push_back({.position = p});
  return all;
}

}  // namespace keyline::fairing::detail
