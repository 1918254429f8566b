#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "keyline/acquire/plane.h"
#include "keyline/acquire/raw_curve.h"
#include "keyline/core/error.h"

/// Sections of meshes and clouds, straight from their files.
namespace keyline::exchange {

/// A plane across a coordinate axis ("y=0"), or the symmetry plane ("auto").
struct SectionRequest {
  std::optional<acquire::Plane> plane;  ///< empty: the symmetry plane
};

/// Fails: bad_input with path "--section".
core::Result<SectionRequest> parse_section(const std::string& text);

struct FileSection {
  /// Of a mesh: every line of the cut in its order, longest first, in the plane's coordinates. Of a
  /// cloud: the points within the band, moved onto the plane, as acquire::section_curves() sorts
  /// them.
  std::vector<acquire::RawCurve> curves;
  std::vector<bool> closed;  ///< of each curve
  std::string unit;          ///< of documents; empty where the file tells none
  bool ordered = false;      ///< true for a mesh
  acquire::Plane plane;
  std::string description;  ///< of the plane, for example "y = 0 (symmetry plane, found)"
};

/// Cuts the mesh (.obj, .stl, .ply with triangles) or cloud in a file. A cloud is read twice and
/// never kept: only the points within `band` of the plane are (empty: 1/150 of the largest distance
/// from the first point).
/// Fails: as read_mesh(), stream_points(), symmetry_plane() and section_plane(); bad_input where
/// the
///        plane misses the mesh.
core::Result<FileSection> section_of_file(const std::filesystem::path& file,
                                          const SectionRequest& request,
                                          std::optional<double> band = {});

}  // namespace keyline::exchange
