#pragma once

#include <vector>

#include "keyline/sketch/stroke_grid.h"

namespace keyline::sketch {

/// Strokes of one line laid along it: every sample has its place on the way the line takes.
struct Strip {
  std::vector<std::vector<double>> at;  ///< by stroke and sample; grows, falls where turned
  std::vector<bool> turned;             ///< the stroke was drawn against the others
  std::vector<bool> placed;             ///< false: it lies beside none of the others
  double first = 0;                     ///< the places of all lie between these
  double last = 0;
};

/// Lays strokes beside each other, the order of passage deciding (align_strokes.h), so that lines
/// may wind and cross themselves: from the longest on, always the stroke that runs longest beside
/// one already laid; then the places of all samples together by least squares, so that samples keep
/// their distance along the stroke and lie across from those beside them. Parts of a closed line
/// are laid one after the other: it comes out cut open.
/// `reach`: farthest apart samples beside each other lie. `step` between the strokes' samples.
Strip lay_strip(const std::vector<SampledStroke>& strokes, double reach, double step);

/// How far the strokes of a strip lie from its middle, at nine of ten places.
double spread_of(const Strip& strip, const std::vector<SampledStroke>& strokes, double step);

/// Ends a strip in the middle of the ends of those strokes that end within `near` of it: of a wide
/// strip the outer strokes reach past the others wherever its end is cut askew.
void cut_ends(Strip& strip, double near);

/// The line along the middle of a strip, `step` between points: it goes as the strokes beside each
/// of its places go on average, and where they are on average, over `ramp` of its length.
std::vector<core::Point2> middle_of(const Strip& strip, const std::vector<SampledStroke>& strokes,
                                    double step, double ramp);

}  // namespace keyline::sketch
