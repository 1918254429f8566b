#pragma once

#include <array>
#include <vector>

#include "keyline/curve/stops.h"
#include "keyline/document/planar_curve.h"

/// Paths whose curvature cannot be told from their derivatives somewhere.
namespace keyline::document {

/// Where the path's curves stop, and the cusps of its chains, in order; t is the path's.
/// Precondition: the path is valid.
std::vector<curve::Stop> stops_of(const Path& path);

/// Whether curvature is infinite somewhere: of either sign, of that one.
bool has_cusp(const std::vector<curve::Stop>& stops);
bool has_cusp(const std::vector<curve::Stop>& stops, int sign);

/// A path whose jets have the curvature that its points come near to: where it stops, or has a
/// cusp, they go at speed 1, with a second derivative that may be infinite, and a third that is
/// unless curvature stays the same. Each of those places is a breakpoint. Refers to the path.
/// Models curve::PlanarCurve.
class CuspedPath {
 public:
  explicit CuspedPath(const Path& path);

  const PlacedPath& placed() const { return placed_; }
  const std::vector<curve::Stop>& stops() const { return stops_; }
  const std::vector<double>& breakpoints() const { return breaks_; }
  /// Sign of the curvature's rate before and after that stop.
  const std::array<double, 2>& rates(std::size_t stop) const { return rates_[stop]; }

 private:
  PlacedPath placed_;
  std::vector<curve::Stop> stops_;
  std::vector<std::array<double, 2>> rates_;
  std::vector<double> breaks_;
};

inline core::Point2 evaluate(const CuspedPath& c, double t) { return evaluate(c.placed(), t); }
curve::Jet2 jet(const CuspedPath& c, double t);
inline std::vector<double> breakpoints(const CuspedPath& c) { return c.breakpoints(); }

}  // namespace keyline::document
