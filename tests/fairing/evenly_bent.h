#pragma once

#include <cstddef>
#include <vector>

#include "keyline/fairing/dense_curve.h"

namespace keyline::fairing::detail {

/// Evenly spaced nodes of these curvatures; a closed curve repeats its first.
inline DenseCurve evenly_bent(const std::vector<double>& curvatures, bool closed = false) {
  DenseCurve curve;
  curve.closed = closed;
  for (std::size_t i = 0; i < curvatures.size(); ++i) {
    curve.at.push_back(double(i) / double(curvatures.size() - 1));
    curve.joints.push_back({{}, 0, curvatures[i]});
  }
  return curve;
}

}  // namespace keyline::fairing::detail
