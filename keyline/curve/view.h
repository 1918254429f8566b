#pragma once

#include <memory>
#include <vector>

#include "keyline/curve/concept.h"

namespace keyline::curve {

/// A curve that is evaluated faster in another form offers that as prepared(c), beside its type.
/// The form may refer to the curve, and gives the same values.
template <class C>
concept PreparedPlanarCurve = PlanarCurve<C> && requires(const C& c) {
  { prepared(c) } -> PlanarCurve;
};

/// Any planar curve behind two function pointers, so that long algorithms are compiled once.
/// Refers to the curve it was made from, which must outlive it. Models PlanarCurve.
class PlanarView {
 public:
  template <PlanarCurve C>
  explicit PlanarView(const C& c) : breakpoints_(breakpoints(c)) {
    if constexpr (PreparedPlanarCurve<C>) {
      const auto own = std::make_shared<const decltype(prepared(c))>(prepared(c));
      own_ = own;
      look_at(*own);
    } else {
      look_at(c);
    }
  }

  core::Point2 point(double t) const { return evaluate_(curve_, t); }
  Jet2 jet_at(double t) const { return jet_(curve_, t); }
  const std::vector<double>& breaks() const { return breakpoints_; }

 private:
  template <PlanarCurve C>
  void look_at(const C& c) {
    curve_ = &c;
    evaluate_ = [](const void* self, double t) {
      return evaluate(*static_cast<const C*>(self), t);
    };
    jet_ = [](const void* self, double t) { return jet(*static_cast<const C*>(self), t); };
  }

  std::shared_ptr<const void> own_;  ///< the prepared form, where there is one
  const void* curve_ = nullptr;
  core::Point2 (*evaluate_)(const void*, double) = nullptr;
  Jet2 (*jet_)(const void*, double) = nullptr;
  std::vector<double> breakpoints_;
};

inline core::Point2 evaluate(const PlanarView& c, double t) { return c.point(t); }
inline Jet2 jet(const PlanarView& c, double t) { return c.jet_at(t); }
inline std::vector<double> breakpoints(const PlanarView& c) { return c.breaks(); }

}  // namespace keyline::curve
