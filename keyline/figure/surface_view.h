#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/figure/drawing.h"

namespace keyline::figure {

/// Part of a surface on a grid of points, row after row; all lists rows * columns long
/// (InvalidInput otherwise).
struct SurfaceMesh {
  int rows = 0;
  int columns = 0;
  std::vector<core::Point3> points = {};
  std::vector<core::Vector3> normals = {};  ///< unit; zero where there is none
  std::vector<double> values = {};          ///< NaN: none; empty for a lit surface
};

/// lit: shaded as matt plaster. zebra: white where the value's fraction is below 1/2, black above.
/// map: values in the colours of sequential() from `low` to `high`, shaded a little.
/// lines: the lit surface with dark lines where the value is whole.
enum class SurfacePaint { lit, zebra, map, lines };

struct SurfaceView {
  std::string title = {};
  std::string subtitle = {};
  std::vector<SurfaceMesh> meshes = {};
  SurfacePaint paint = SurfacePaint::lit;
  core::Vector3 view = {-1, -1.6, 1.2};  ///< from the surface to the eye, far away; not zero
  core::Vector3 up = {0, 0, 1};          ///< upwards on the page; not along the view
  double low = 0;                        ///< map: value of the first colour …
  double high = 1;                       ///< … and of the last
  std::string scale_title = {};          ///< map: what the colour scale shows
  std::string unit = {};                 ///< of length, at the scale bar; empty: none stated
  int grid_lines = 0;                    ///< lines of constant u and v drawn over each mesh
  double width = 480;                    ///< of the figure, px
};

/// A picture of surfaces by parallel projection, nearer parts hiding farther ones, with a bar of
/// round length. Throws InvalidInput as said above, for a view that does not stand (zero, or along
/// `up`) and a width outside 160 … 4096.
Drawing surface_view(const SurfaceView& view);

}  // namespace keyline::figure
