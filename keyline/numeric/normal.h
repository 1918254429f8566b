#pragma once

namespace keyline::numeric {

/// The number of standard deviations that a normal error exceeds, on either side, with the given
/// probability; probability in (0, 1]. normal_two_sided(0.0027) is about 3.
double normal_two_sided(double probability);

}  // namespace keyline::numeric
