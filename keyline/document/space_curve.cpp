#include "keyline/document/space_curve.h"

namespace keyline::document {

core::Point3 evaluate(const SpaceCurve& c, double t) {
  return std::visit([t](const auto& v) { return evaluate(v, t); }, c.value);
}

curve::Jet3 jet(const SpaceCurve& c, double t) {
  return std::visit([t](const auto& v) { return jet(v, t); }, c.value);
}

std::vector<double> breakpoints(const SpaceCurve& c) {
  return std::visit([](const auto& v) { return breakpoints(v); }, c.value);
}

SpaceCurve reverse(const SpaceCurve& c) {
  return std::visit([](const auto& v) { return SpaceCurve{reverse(v)}; }, c.value);
}

core::Result<void> validate(const SpaceCurve& c) {
  return std::visit([](const auto& v) { return validate(v); }, c.value);
}

}  // namespace keyline::document
