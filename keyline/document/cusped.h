#pragma once

#include <vector>

#include "keyline/document/planar_curve.h"

/// Paths whose curvature is infinite somewhere.
namespace keyline::operations {

/// A cusp of a log-aesthetic piece.
struct Cusp {
  double t = 0;     ///< of the path's parameter
  double sign = 1;  ///< of the curvature
};
std::vector<Cusp> cusps_of(const document::Path& path);

/// A path whose jets tell its cusps: their second derivative is infinite there, where that of the
/// path's own jets, which hold finite numbers, is 0. Refers to the path. Models curve::PlanarCurve.
class CuspedPath {
 public:
  explicit CuspedPath(const document::Path& path) : placed_(path), cusps_(cusps_of(path)) {}

  const document::PlacedPath& placed() const { return placed_; }
  const std::vector<Cusp>& cusps() const { return cusps_; }

 private:
  document::PlacedPath placed_;
  std::vector<Cusp> cusps_;
};

inline core::Point2 evaluate(const CuspedPath& c, double t) { return evaluate(c.placed(), t); }
curve::Jet2 jet(const CuspedPath& c, double t);
inline std::vector<double> breakpoints(const CuspedPath& c) { return breakpoints(c.placed()); }

}  // namespace keyline::operations
