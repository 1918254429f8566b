#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "keyline/acquire/plane.h"
#include "keyline/core/progress.h"
#include "keyline/document/document.h"
#include "keyline/fairing/bound.h"
#include "keyline/operations/subject.h"

/// Files as operations: document.read, document.list, document.write.
namespace keyline::operations {

/// Where curves, points or surfaces come from and how they are to be read.
struct InputRequest {
  /// What a file turned out to be, several at once: a table that is cut is a cloud too.
  static constexpr unsigned kTable = 1;
  static constexpr unsigned kCloud = 2;
  static constexpr unsigned kLatticeRow = 4;
  static constexpr unsigned kLatticeColumn = 8;
  static constexpr unsigned kMesh = 16;
  static constexpr unsigned kFont = 32;
  static constexpr unsigned kSurfaces = 64;
  static constexpr unsigned kAlone = 128;  ///< one file, not several that are parts of one key-line

  std::vector<std::string> file;
  std::vector<std::string> columns;
  std::string weight_column;
  std::string id_column;
  std::string select;
  std::string glyphs;
  std::string section;
  std::optional<double> band;
  std::optional<long> row;
  std::optional<long> column;
  Acquiring acquiring;
  std::string unit;
  bool planar = false;
  bool trims = false;
  static constexpr auto uses() {
    using Request = InputRequest;
    constexpr unsigned kLattice = kLatticeRow | kLatticeColumn;
    constexpr unsigned kPoints = kTable | kCloud | kLattice;
    return std::array{use<&Request::columns>(kTable | kLattice),
                      use<&Request::weight_column>(kTable),
                      use<&Request::id_column>(kTable),
                      use<&Request::select>(kAlone),
                      use<&Request::glyphs>(kFont),
                      use<&Request::section>(kCloud | kMesh),
                      use<&Request::band>(kCloud),
                      use<&Request::row>(kLatticeRow),
                      use<&Request::column>(kLatticeColumn),
                      use<&Request::acquiring>(kPoints),
                      use<&Request::trims>(kSurfaces)};
  }
  static constexpr auto describe() {
    using Request = InputRequest;
    return core::fields(
        core::field<&Request::file>(
            "points (csv, tsv, dat, xyz, pts), curves (svg, dxf, step, iges, glif, json), fonts "
            "(ttf, otf; with glyphs), meshes (obj, stl, ply; with section), drawings (png, jpeg, "
            "tiff, webp); several files are parts of one key-line")
            .count(1)
            .or_bare_item()
            .needed(),
        core::field<&Request::columns>(
            "of a table of points: names or numbers of the columns of x, y and maybe z")
            .count(0, 3),
        core::field<&Request::weight_column>("of a table of points: column of weights"),
        core::field<&Request::id_column>(
            "of a table of points: column that names the curve a point belongs to"),
        core::field<&Request::select>(
            "take only the curves of this name, on this layer, or of this number, counted from 1"),
        core::field<&Request::glyphs>("of a font, which to read: characters, /name or U+0053"),
        core::field<&Request::section>(
            "cut a cloud or mesh with a plane, as in y=0; auto: with its plane of symmetry"),
        core::field<&Request::band>("of a cloud that is cut: half thickness of its section")
            .in("length")
            .within(core::kPositive),
        core::field<&Request::row>("of a lattice of range data, which row to take, from 0")
            .within(core::at_least(0)),
        core::field<&Request::column>("of a lattice of range data, which column to take, from 0")
            .within(core::at_least(0)),
        core::flattened<&Request::acquiring>(),
        core::field<&Request::unit>("unit of the coordinates; the file's own unless given"),
        core::field<&Request::planar>(
            "curves in space that lie in a plane as planar ones; others stay as they are"),
        core::field<&Request::trims>(
            "of surfaces: also read the curves that trim them, as curves"));
  }
};

/// Where a plane curve lies in space.
struct Placement {
  core::Point3 origin;
  core::Point3 axis_x{1, 0, 0};
  core::Point3 axis_y{0, 1, 0};
  static constexpr auto describe() {
    return core::fields(core::field<&Placement::origin>("the place of the plane's (0, 0)"),
                        core::field<&Placement::axis_x>("way to (1, 0); of length 1"),
                        core::field<&Placement::axis_y>("way to (0, 1); of length 1"));
  }
};

/// None for the plane z = 0 with the axes x and y.
std::optional<Placement> placement_of(const acquire::Plane& plane);

/// A curve, or points, with its label.
struct NamedCurve {
  std::string name;
  std::string layer;
  std::string color;
  double stroke_width = 0;
  std::optional<AnyCurve> curve;
  std::optional<acquire::KeyLine> line;
  std::optional<Placement> plane = {};
  std::vector<fairing::Bound> keep_inside = {};
  static constexpr auto describe() {
    return core::fields(
        core::field<&NamedCurve::name>("in the file; may be empty"),
        core::field<&NamedCurve::layer>("may be empty"),
        core::field<&NamedCurve::color>("#rrggbb; may be empty"),
        core::field<&NamedCurve::stroke_width>("0: none given")
            .in("length")
            .within(core::at_least(0)),
        core::field<&NamedCurve::curve>("the curve, exact"),
        core::field<&NamedCurve::line>("measured points, put in order and cleaned"),
        core::field<&NamedCurve::plane>("in which a plane curve lies, where it is not z = 0"),
        core::field<&NamedCurve::keep_inside>(
            "what it does not pass when it is faired: a hull's centre plane"));
  }
};

struct NamedSurfaceValue {
  std::string name;
  std::string layer;
  std::string color;
  surface::Surface surface;
  int trims = 0;
  static constexpr auto describe() {
    using Named = NamedSurfaceValue;
    return core::fields(core::field<&Named::name>("in the file; may be empty"),
                        core::field<&Named::layer>("may be empty"),
                        core::field<&Named::color>("#rrggbb; may be empty"),
                        core::field<&Named::surface>("whole, as without its trims").needed(),
                        core::field<&Named::trims>("edges that cut a face out of it"));
  }
};

struct Page {
  core::Point2 low;
  core::Point2 high;
  static constexpr auto describe() {
    return core::fields(core::field<&Page::low>("lower left"),
                        core::field<&Page::high>("upper right"));
  }
};

struct ReadAnswer {
  std::string unit;
  std::vector<NamedCurve> curves;
  std::vector<NamedSurfaceValue> surfaces;
  std::optional<Page> page;
  std::vector<std::string> notes;
  std::vector<std::string> skipped;
  std::vector<std::string> unused;

  document::Document document;  ///< not part of the public form: for pictures
  unsigned kind = 0;            ///< likewise: kinds of InputRequest

  static constexpr auto describe() {
    using Answer = ReadAnswer;
    return core::fields(
        core::field<&Answer::unit>("of all lengths; empty: none given"),
        core::field<&Answer::curves>("planar, then in space, in the file's order"),
        core::field<&Answer::surfaces>("in the file's order"),
        core::field<&Answer::page>("what a drawing shows"),
        core::field<&Answer::notes>("how it was read: planes of curves in space, the "
                                    "order of points, what a picture shows"),
        core::field<&Answer::skipped>("what the file holds beside, in words"),
        core::field<&Answer::unused>(kUnusedText));
  }
};

/// The things of a file: measured points as acquired lines, all else as curves and surfaces.
core::Result<ReadAnswer> read_input(const InputRequest& request, const core::Progress& progress);

}  // namespace keyline::operations
