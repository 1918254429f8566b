#pragma once

#include <vector>

#include "keyline/curve/concept.h"

namespace keyline::curve {

/// Any planar curve behind two function pointers, so that long algorithms are compiled once.
/// Refers to the curve it was made from, which must outlive it. Models PlanarCurve.
class PlanarView {
 public:
  template <PlanarCurve C>
  explicit PlanarView(const C& c)
      : curve_(&c),
        evaluate_(
            [](const void* self, double t) { return evaluate(*static_cast<const C*>(self), t); }),
        jet_([](const void* self, double t) { return jet(*static_cast<const C*>(self), t); }),
        breakpoints_(breakpoints(c)) {}

  core::Point2 point(double t) const { return evaluate_(curve_, t); }
  Jet2 jet_at(double t) const { return jet_(curve_, t); }
  const std::vector<double>& breaks() const { return breakpoints_; }

 private:
  const void* curve_;
  core::Point2 (*evaluate_)(const void*, double);
  Jet2 (*jet_)(const void*, double);
  std::vector<double> breakpoints_;
};

inline core::Point2 evaluate(const PlanarView& c, double t) { return c.point(t); }
inline Jet2 jet(const PlanarView& c, double t) { return c.jet_at(t); }
inline std::vector<double> breakpoints(const PlanarView& c) { return c.breaks(); }

}  // namespace keyline::curve
