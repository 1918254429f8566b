#pragma once

#include <cmath>
#include <utility>

namespace keyline::fit {

/// What places cost that keep within their tolerance: minus the logarithm of 1 − u, summed, u the
/// square of the distance as a share of the tolerance's. It rises like the squares far inside and
/// without end towards the rim.
class ToleranceRoom {
 public:
  /// One more place; false where it is not inside.
  bool add(double u) {
    if (!(u < 1)) return false;
    u_ = u;
    product_ *= 1 - u;
    if (product_ < 1e-200) sum_ -= std::log(std::exchange(product_, 1.0));
    const double d = std::sqrt(u);
    taken_ += 2 * d / (1 + d);
    return true;
  }

  /// Of the last place, by its distance, halved, the tolerance for a unit: slope over distance, and
  /// second derivative.
  double pull() const { return 1 / (1 - u_); }
  double stiffness() const { return (1 + u_) / ((1 - u_) * (1 - u_)); }

  double cost() const { return sum_ - std::log(product_); }

  /// Slopes times what is left to the rims: where cost and something else are in balance, so much
  /// of that could be gained yet at most (the duality gap), were both convex.
  double gap() const { return taken_; }

 private:
  double u_ = 0;
  double product_ = 1;
  double sum_ = 0;
  double taken_ = 0;
};

}  // namespace keyline::fit
