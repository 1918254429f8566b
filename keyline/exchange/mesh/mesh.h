#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/acquire/plane.h"
#include "keyline/core/error.h"
#include "keyline/core/point.h"

/// Triangle meshes and clouds of points, and their sections by a plane: the key-line of a scan
/// ([Fairing] section 3.1).
namespace keyline::exchange {

struct Mesh {
  std::vector<core::Point3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::vector<std::uint32_t>> lines;  ///< OBJ's "l"
  /// What could not be read, with its line or byte; of OBJ and STL the first thousand lines.
  std::vector<std::string> skipped;
};

/// Wavefront OBJ: v, f (polygons as triangles, indices from the front or the back), l; line
/// continuations, UTF-8 or UTF-16. Other statements of the format are let pass; faces that name no
/// vertex, numbers without a statement's name and names that the format has not are skipped and
/// reported.
/// Fails: bad_input with "line N" where a coordinate is no number.
core::Result<Mesh> read_obj(std::string_view bytes);

/// STL, ASCII with any number of solids or binary; vertices of equal coordinates become one.
/// Fails: bad_input with "line N" or "byte N" where triangles are incomplete. Skipped: what is
/// behind the triangles that a binary file counts, lines that are no statement.
core::Result<Mesh> read_stl(std::string_view bytes);

/// PLY, ASCII or binary of either byte order, with any further properties and elements.
/// Fails: bad_input with "line N" (header, ASCII) or "byte N" where the file is none or ends early,
/// or its vertices have not x, y and z, each once. Skipped: elements of other
/// names, and what is behind the last.
core::Result<Mesh> read_ply(std::string_view bytes);

/// The mesh of a file by its extension (.obj, .stl, .ply).
core::Result<Mesh> read_mesh(const std::filesystem::path& file);

/// A line in which a plane cuts a mesh, in the plane's coordinates.
struct SectionLine {
  std::vector<core::Point2> points;  ///< closed: without repeating the first
  bool closed = false;
};

/// All of them, longest first. Vertices on the plane count as above it, so that every triangle is
/// cut in one segment or not at all and lines end at the mesh's border only; where nothing is cut
/// so they count as below, since the plane may be where half a model ends. Where more than two
/// triangles share an edge, lines part there. Points stand on the mesh's edges, in order.
std::vector<SectionLine> section(const Mesh& mesh, const acquire::Plane& plane);

/// What a cloud's file tells beside its points.
struct StreamedPoints {
  /// What in it is no point, in words: text behind the points, points without all coordinates,
  /// counts of others than the points behind them, columns that are not taken.
  std::vector<std::string> left_out;
  std::string unit;  ///< of documents; empty where no header tells one
};

/// Calls `take` for every point of a cloud, in order, without keeping them: memory does not grow
/// with the file. Text (XYZ, PTS, CSV) under the headers of read_points(), without one the first
/// three numbers of a line; or PLY.
/// Fails: io; bad_input with "line N" or "byte N", also where the header does not name x, y and z.
core::Result<StreamedPoints> stream_points(const std::filesystem::path& file,
                                           const std::function<void(core::Point3)>& take);

/// True for files whose points have to be cut before there is a curve: .obj, .stl, .ply.
bool is_mesh_file(const std::filesystem::path& file);

}  // namespace keyline::exchange
