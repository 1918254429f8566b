#pragma once

#include <vector>

#include "keyline/core/describe.h"
#include "keyline/curve/curvature_graph.h"

namespace keyline::analysis {

/// Of a comb's range: a lower extremum is no wave.
inline constexpr double kSeenWave = 0.02;

/// A comb in three figures, the same for a curve of any size.
struct CombFigures {
  int waves = 0;      ///< extrema of curvature whose swing is above 2 % of its range
  double energy = 0;  ///< L^3 * integral of (d curvature / ds)^2 ds
  double jolt = 0;    ///< largest change of curvature within 0.5 % of the length, over its range
  static constexpr auto describe() {
    return core::fields(
        core::field<&CombFigures::waves>("extrema of curvature that rise above 2 % of its range"),
        core::field<&CombFigures::energy>(
            "L^3 times the integral of (d curvature / ds)^2; null at a cusp, where it has no bound")
            .null_if_empty(),
        core::field<&CombFigures::jolt>(
            "largest change of curvature within 0.5 % of the length, as a share of its range; null "
            "at a cusp")
            .null_if_empty());
  }
};

/// Range: from the 0.5th to the 99.5th percentile along the length, so that a needle does not hide
/// waves. Where that range is none, or rounding (it turns the curve by less than 1e-8 radian, or
/// 1e-8 of its turning), all figures are 0. The energy is that of the straight lines
/// between the samples: of a curve whose rate is not finite somewhere it grows with their number.
///
/// Precondition: as many curvatures as arc lengths, at least two, arc lengths never falling.
/// Source: the energy is the variation of curvature of [Moreton 1992] times the length cubed,
///         so that scale does not matter.
CombFigures comb_figures(const curve::CurvatureGraph& graph);

/// Where a comb has something that a finger feels.
struct CombMark {
  bool needle = false;  ///< a rise and at once a fall, or the reverse; else a near-step
  double at = 0;        ///< arc length
  double change = 0;    ///< of curvature within 0.5 % of the length, as a share of its range
};

/// Near-steps: curvature changes at a pace at which its range would be passed within 2 % of the
/// length, which is as short as anything can be and still be seen as a piece of its own
/// (a quarter of the range within 0.5 %). Needles: a turn with such a pace on either side. In
/// order along the curve, the sharpest place of each. A closed curve's seam is an end.
///
/// Precondition: as for comb_figures().
std::vector<CombMark> comb_marks(const curve::CurvatureGraph& graph);

}  // namespace keyline::analysis
