#include "keyline/numeric/normal.h"

#include <numbers>

#include <boost/math/special_functions/erf.hpp>

namespace keyline::numeric {

double normal_two_sided(double probability) {
  return std::numbers::sqrt2 * boost::math::erfc_inv(probability);
}

}  // namespace keyline::numeric
