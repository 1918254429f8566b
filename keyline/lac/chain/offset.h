#pragma once

#include <utility>
#include <vector>

#include "keyline/core/pose.h"
#include "keyline/curve/jet.h"
#include "keyline/lac/chain/chain.h"

/// What goes with log-aesthetic curves beside the curves themselves: offsets and meets with lines.
/// Their evolutes are segments again (segment.h).
namespace keyline::lac {

/// The curve at a constant distance to the left of a chain (to the right where negative). Models
/// curve::PlanarCurve; parameter t = fraction of the arc length of the chain, not of its own.
/// Where distance times curvature is 1 the offset has a cusp; beyond it runs against the chain.
struct OffsetCurve {
  Chain base;
  double distance = 0;
};

inline OffsetCurve offset(const Segment& base, double distance) {
  return {chain_of(base), distance};
}
inline OffsetCurve offset(Chain base, double distance) { return {std::move(base), distance}; }

core::Point2 evaluate(const OffsetCurve& curve, double t);
/// Exact, by the chain's own law. Terms with an infinite rate of curvature are left out.
curve::Jet2 jet(const OffsetCurve& curve, double t);
/// The chain's, and the cusps.
std::vector<double> breakpoints(const OffsetCurve& curve);
/// Parameters at which distance * curvature = 1, increasing; none for an arc (all or nothing).
std::vector<double> offset_cusps(const OffsetCurve& curve);

/// Parameters at which a curve meets the straight line through a point in a direction, increasing:
/// every one, also where it touches within 1e-13 of its length. A piece that lies on the line
/// counts with its two ends. Between the parameters whose tangent is parallel to the line, known in
/// closed form, the distance from the line is monotone.
std::vector<double> intersections(const Segment& segment, const core::Pose2& line);
std::vector<double> intersections(const Chain& chain, const core::Pose2& line);

}  // namespace keyline::lac
