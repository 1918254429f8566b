#pragma once

#include <string>

#include "keyline/document/planar_curve.h"
#include "keyline/exchange/svg/svg_writer.h"

namespace keyline::exchange {

/// A path as one SVG path of cubic Béziers, G1 but at its corners, as few as the tolerance allows.
struct CubicPath {
  SvgPath path;
  double deviation = 0;  ///< bound of the distance from the exact path
};

/// Throws InvalidInput unless tolerance > 0. Straight lines stay lines and Béziers of degree 1 to 3
/// what they are. A path that closes to within 1e-9 of its size ends exactly where it starts.
CubicPath cubic_path(const document::Path& path, const std::string& name, double tolerance);

}  // namespace keyline::exchange
