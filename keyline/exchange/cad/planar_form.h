#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/acquire/plane.h"
#include "keyline/document/document.h"

namespace keyline::exchange {

/// A space curve that lies in a plane, in that plane's coordinates.
struct PlanarForm {
  document::PlanarCurve curve;
  acquire::Plane plane;
  double departure = 0;  ///< largest distance of a control point from it; 0: exact
};

/// How far exact curves may leave their plane by rounding, as a share of their size.
inline constexpr double kExactly = 1e-9;
/// Measured points that leave their best plane by more than this share of their size lie in none.
inline constexpr double kMostOfMeasured = 0.1;

/// Exact: control points go to the plane of acquire::fit_plane() (coordinate axes where it is
/// parallel to them). Empty for curves that leave their plane by more than `most` of their size,
/// and for log-aesthetic space curves.
std::optional<PlanarForm> planar_form(const document::SpaceCurve& curve, double most = kExactly);

/// Where a curve lay in space before it was written in its plane's coordinates.
struct Laid {
  acquire::Plane plane;
  bool half_breadth = false;  ///< see document::NamedSpaceCurve
  double departure = 0;       ///< as of a PlanarForm
};

/// The plane and its coordinates in words: "in the plane z = 1.5; x and y".
std::string in_words(const acquire::Plane& plane);

/// Every space curve that lies in a plane becomes a planar path of the same name; polygons, which
/// may be of measured points, where they leave it by no more than `most` of their size.
/// Returns: where each of them lay, in their order at the end of the document's paths.
std::vector<Laid> flatten(document::Document& document, double most = kExactly);

/// A path of the plane as one curve in space, piecewise cubic within `tolerance` (> 0) of it.
document::SpaceCurve placed(const document::Path& path, const acquire::Plane& plane,
                            double tolerance);

}  // namespace keyline::exchange
