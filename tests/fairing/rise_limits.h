#pragma once

#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "keyline/fairing/rise_barrier.h"

namespace keyline::fairing::detail {

/// Clothoids between these curvatures, evenly spaced.
inline DenseCurve of(const std::vector<double>& values, const std::vector<int>& senses) {
  DenseCurve curve;
  const auto pieces = static_cast<int>(values.size()) - 1;
  for (int i = 0; i <= pieces; ++i) {
    curve.at.push_back(double(i) / pieces);
    curve.cut.push_back(i);
  }
  curve.joints.resize(values.size());
  curve.value = values;
  curve.alpha.assign(static_cast<std::size_t>(pieces), -1);
  curve.sense.assign(senses.begin(), senses.end());
  return curve;
}

/// Of a piece's rise, from its start's to its end's curvature.
inline Pull rise_pull(const RiseBarrier& barrier, std::size_t piece) {
  Pull sum;
  barrier.each_pull(piece, [&](double start, double end, const Pull& pull) {
    EXPECT_EQ(start, -end);
    sum.weight += pull.weight;
    sum.slope += end * pull.slope;
  });
  return sum;
}

/// Ends that change by so much more than starts.
inline RiseBarrier::Ends rises(const std::vector<double>& by) {
  RiseBarrier::Ends ends;
  for (const double rise : by) ends.push_back({0.25, 0.25 + rise});
  return ends;
}

}  // namespace keyline::fairing::detail
