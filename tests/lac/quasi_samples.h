#pragma once

#include <algorithm>

#include "keyline/curve/closest_point.h"
#include "keyline/lac/quasi/quasi.h"

/// What the tests of quasi.h share.
namespace keyline::lac {

inline constexpr QuasiForm kForms[] = {QuasiForm::taylor_angle,   QuasiForm::taylor_arc,
                                       QuasiForm::discrete_angle, QuasiForm::discrete_arc,
                                       QuasiForm::rational_cubic, QuasiForm::best};

inline double sampled_deviation(const Segment& s, const curve::Bezier2& b, int n = 40) {
  double largest = 0;
  for (int i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    largest = std::max(largest, curve::closest_point(b, evaluate(s, t)).distance);
    largest = std::max(largest, curve::closest_point(s, evaluate(b, t)).distance);
  }
  return largest;
}

}  // namespace keyline::lac
