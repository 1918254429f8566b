#pragma once

#include <span>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/core/point.h"

/// Parameters of ordered points, in [0, 1].
namespace keyline::fit {

enum class Parametrization {
  chord,        ///< cumulative chord length
  centripetal,  ///< cumulative square roots of the chords
  /// Cumulative length of the points' running average, the points at their feet on it. For dense
  /// noisy points, whose own polygon runs in zigzag: the average is taken over as many neighbours
  /// as make noise 2 % of their extent, at most a fortieth of the points; with less noise than
  /// that between single points this is chord length.
  smooth_chord
};
constexpr auto choices(const Parametrization*) {
  return core::words<Parametrization>({{Parametrization::smooth_chord, "smooth-chord"},
                                       {Parametrization::chord, "chord"},
                                       {Parametrization::centripetal, "centripetal"}});
}

/// One parameter per point: 0 at the first and 1 at the last, increasing except that feet of
/// smooth_chord may change places by about the noise. Empty where the total length is zero or
/// not finite. The same for moved, turned and scaled points; 1 - t for reversed ones.
std::vector<double> parametrize(std::span<const core::Point2> points, Parametrization kind);

}  // namespace keyline::fit
