#include <algorithm>
#include <cmath>

#include "keyline/fairing/fair.h"
#include "keyline/numeric/normal.h"

namespace keyline::fairing {

double default_tolerance(double noise, double length, std::size_t n) {
  // Three standard deviations are passed by one normal error in 370: of n errors, all stay below
  // the factor taken here in nineteen runs of twenty.
  const double count = std::max<double>(1, static_cast<double>(n));
  const double each = 0.05 / count;
  const double factor = numeric::normal_two_sided(std::min(1.0, each));
  return std::max(noise * std::max(3.0, factor), 5e-4 * length);
}

}  // namespace keyline::fairing
