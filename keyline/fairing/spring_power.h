#pragma once

#include <cmath>

namespace keyline::fairing {

/// The root of the mean square of the points' offsets falls with a power of the weight of the
/// springs that the points pull with, on logarithms a secant: a quarter until it is measured.
class SpringPower {
 public:
  /// By how much the weight's logarithm is to grow for an rms to become the wanted one.
  double growth(double rms, double wanted) const { return std::log(rms / wanted) / power_; }

  /// What such a growth has come to.
  void learn(double growth, double before, double after) {
    const double power = std::log(before / after) / growth;
    if (power > 0) power_ = power;
  }

 private:
  double power_ = 0.25;
};

}  // namespace keyline::fairing
