#pragma once

#include <vector>

#include "keyline/analysis/profile.h"

namespace keyline::analysis {

/// What is noise to a split.
///
/// A wave of curvature with swing D (from trough to crest) and wavelength w moves the curve
/// sideways by D w^2 / (8 pi^2) (integrate a cosine twice). The other way round, a position
/// known only to within `noise` leaves curvature known to 8 pi^2 noise / w^2 over a stretch w: the
/// shorter the wave the less its curvature means. A wave that moves the curve by no more than
/// `noise` is merged into its surroundings. Likewise a lobe of curvature of height h and length l
/// between two inflections, which moves the curve by h l^2 / pi^2.
struct SplitOptions {
  double noise = 0;        ///< sideways movement taken for noise, in the curve's unit
  double rounding = 1e-9;  ///< swings below this share of the largest |curvature| are rounding
  double corner = 1e-4;  ///< a turn of the tangent at a breakpoint above this is a corner, radians
  int samples = 1200;    ///< of the whole curve, at least; no stretch gets fewer than 16
};

/// Where curvature turns from growing to falling (maximum) or the other way, or changes sign.
struct CurvatureEvent {
  enum class Kind { maximum, minimum, inflection, corner };
  Kind kind = Kind::maximum;
  double t = 0;
  double arc_length = 0;
  double curvature = 0;
  core::Interval flat{0, 0};  ///< interval in t over which curvature stays the same (exact arcs,
                              ///< straight stretches); both ends equal t elsewhere
};

/// A wave or lobe that was taken for noise; displacement <= the threshold.
struct MergedWave {
  core::Interval t;
  double swing = 0;         ///< of curvature
  double wavelength = 0;    ///< along the curve (a lobe: twice its length)
  double displacement = 0;  ///< sideways movement of the curve it amounts to
};

/// A stretch over which curvature is monotone and keeps its sign, but for merged noise.
struct MonotonePiece {
  core::Interval t;
  core::Interval arc_length;
  double curvature_start = 0;  ///< from inside the piece
  double curvature_end = 0;
};

struct Split {
  std::vector<MonotonePiece> pieces;    ///< in order, covering [0, 1]
  std::vector<CurvatureEvent> extrema;  ///< inside (0, 1), in order
  std::vector<CurvatureEvent> inflections;
  std::vector<CurvatureEvent> corners;
  std::vector<MergedWave> merged;
  double threshold = 0;  ///< the sideways movement below which a wave was merged
};

/// Whether the tangent turns by more than that angle at a breakpoint, or at any other parameter.
bool is_corner(const CurveView& curve, double t, double angle = SplitOptions{}.corner);

/// Splits a curve at corners, inflections and extrema of curvature, and where exact circular arcs
/// or straight stretches end (arcs of growing or falling curvature that follow each other stay one
/// piece). Smallest waves are merged first, each judged after its neighbours are gone.
///
/// Works on any curve, also where curvature or its rate jumps at breakpoints. Events between
/// breakpoints are refined to the last bits of t by a bracketed root of curvature or its rate; they
/// are found where the samples see the change of sign, of the rate at them too.
Split split_monotone(const CurveView& curve, const SplitOptions& options = {});

template <curve::PlanarCurve C>
Split split_monotone(const C& c, const SplitOptions& options = {}) {
  return split_monotone(view(c), options);
}

}  // namespace keyline::analysis
