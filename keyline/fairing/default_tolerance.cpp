#include <algorithm>
#include <cmath>

#include "keyline/fairing/fair.h"
#include "keyline/numeric/normal.h"

namespace keyline::fairing {
namespace {

constexpr double kLeastShare = 1e-4;  // of the length: 5e-4 was 2.9 m on a track known to 0.13 m

}  // namespace

double noise_factor(std::size_t n) {
  // Three standard deviations are passed by one normal error in 370: of n errors, all stay below
  // the factor taken here in nineteen runs of twenty.
  const double count = std::max<double>(1, static_cast<double>(n));
  const double each = 0.05 / count;
  return std::max(3.0, numeric::normal_two_sided(std::min(1.0, each)));
}

double default_tolerance(double noise, double length, std::size_t n) {
  return std::max(noise * noise_factor(n), kLeastShare * length);
}

}  // namespace keyline::fairing
