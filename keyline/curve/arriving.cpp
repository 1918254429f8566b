#include "keyline/curve/arriving.h"

namespace keyline::curve {

double arriving_angle(const Jet2& jet) {
  // For t < t0 the first derivative goes by second (t - t0), where that is not 0, else by the third
  // and (t - t0)^2, whose sign is that of t > t0.
  const bool rests = jet.first == core::Vector2{} && jet.second != core::Vector2{};
  return rests ? core::direction_of(-jet.second) : tangent_angle(jet);
}

core::Vector2 arriving_tangent(const Jet2& jet) {
  return jet.first == core::Vector2{} ? core::unit_vector(arriving_angle(jet)) : unit_tangent(jet);
}

}  // namespace keyline::curve
