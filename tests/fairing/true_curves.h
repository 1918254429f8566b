#pragma once

#include <string>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::fairing::testing {

/// A curve known in closed form, as points of it that stand for a measurement.
struct TrueCurve {
  std::string name;
  bool closed = false;
  double noise = 0;                  ///< standard deviation of the points in x and in y
  std::vector<core::Point2> points;  ///< some hundred, evenly spaced
  std::vector<core::Point2> truth;   ///< thousands, without noise
};

/// A dozen curves of textbooks, none of them log-aesthetic but for two spirals: what the judges of
/// real input look at where there is none.
std::vector<TrueCurve> true_curves();

/// Largest and root mean square distance of points on an answer from the truth.
struct Away {
  double largest = 0;
  double rms = 0;
};
Away away_from(const TrueCurve& curve, const std::vector<core::Point2>& answer);

}  // namespace keyline::fairing::testing
