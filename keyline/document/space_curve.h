#pragma once

#include <variant>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/bezier.h"
#include "keyline/curve/bspline.h"
#include "keyline/curve/jet.h"
#include "keyline/curve/polyline.h"
#include "keyline/lac/space/space.h"

namespace keyline::document {

/// Any one space curve of the public interface. Models curve::SpaceCurve.
struct SpaceCurve {
  std::variant<curve::Polyline3, curve::Bezier3, curve::BSpline3, lac::SpaceChain> value;
};

core::Point3 evaluate(const SpaceCurve& c, double t);
curve::Jet3 jet(const SpaceCurve& c, double t);
std::vector<double> breakpoints(const SpaceCurve& c);
SpaceCurve reverse(const SpaceCurve& c);
core::Result<void> validate(const SpaceCurve& c);

}  // namespace keyline::document
