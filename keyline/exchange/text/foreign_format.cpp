#include "keyline/exchange/text/foreign_format.h"

#include <algorithm>
#include <array>

#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange::detail {
namespace {

constexpr const char* kMesh = "export it as .ply, .obj or .stl";
constexpr const char* kSolid = "export it as STEP";

constexpr auto kFormats = std::to_array<ForeignFormat>({
    {"PK\3\4", "this is a zip archive",
     "unpack it; of a FreeCAD document export STEP, of a spreadsheet CSV"},
    {"%PDF-", "this is a PDF file", "convert it to SVG, as Inkscape does"},
    {"%!PS-AdobeFont", "this is a Type 1 font", "convert it to .otf, as FontForge does"},
    {"%!FontType1", "this is a Type 1 font", "convert it to .otf, as FontForge does"},
    {"\x80\1", "this is a Type 1 font", "convert it to .otf, as FontForge does"},
    {"%!PS", "this is PostScript", "convert it to SVG, as Inkscape does"},
    {"wOFF", "this is a font packed for the web", "unpack it to .ttf or .otf"},
    {"wOF2", "this is a font packed for the web", "unpack it to .ttf or .otf"},
    {"3D Geometry File Format", "this is a Rhino file", kSolid},
    {"DBRep_DrawableShape", "this is a BREP file of OCCT", kSolid},
    {"CASCADE Topology", "this is a BREP file of OCCT", kSolid},
    {"#FIG ", "this is a drawing of Xfig", "export it as SVG"},
    {"# vtk DataFile", "this is a VTK file", kMesh},
    {"# .PCD", "this is a PCD cloud", "save it as .ply or .xyz"},
    {"$MeshFormat", "this is a mesh of Gmsh", kMesh},
    {"#VRML", "this is a VRML scene", kMesh},
    {"AC3D", "this is a mesh of AC3D", kMesh},
    {"*3DSMAX_ASCIIEXPORT", "this is a scene of 3ds Max", kMesh},
    {"HIERARCHY", "this is recorded motion (BVH)", "write the places wanted as .csv"},
    {"**ABCDEFGHIJKLMNOPQRSTUVWXYZ", "this is a Parasolid file", kSolid},
    {"ncols ", "this is a grid of heights", "write it with x, y and height on each line"},
});

constexpr const char* kPoints = "write its points as .csv, or its curves as .dxf or .svg";

constexpr auto kGeomview = std::to_array<ForeignFormat>({
    {"OFF", "this is a mesh in OFF", kMesh},
    {"VECT", "this is a list of polylines of Geomview", kPoints},
    {"SKEL", "this is a list of polylines of Geomview", kPoints},
    {"QUAD", "this is a mesh of Geomview", kMesh},
    {"MESH", "this is a mesh of Geomview", kMesh},
    {"BEZ", "this is a list of patches of Geomview", kSolid},
    {"BBP", "this is a list of patches of Geomview", kSolid},
});

/// Whether the word is the name, with what vertices have in front ("STCN4nOFF") and, of patches,
/// the degrees behind ("BEZ333").
bool is_geomview(std::string_view word, std::string_view name) {
  if (name == "BEZ") {
    const std::size_t degrees = word.find_last_not_of("0123456789") + 1;
    if (degrees == word.size()) return false;
    word = word.substr(0, degrees);
  }
  return word.ends_with(name) && word.find_first_not_of("STCNZ4n") >= word.size() - name.size();
}

/// Of a file that begins with one of Geomview's words, numbers or nothing behind it in its line: as
/// a title has words.
const ForeignFormat* geomview_format(std::string_view head) {
  const std::size_t end = head.find_first_of("\r\n");
  const std::string_view line = head.substr(0, std::min(end, head.find('#')));
  const std::string_view word = line.substr(0, line.find_first_of(" \t"));
  const std::string_view behind = trimmed(line.substr(word.size()));
  if (word.size() == head.size()) return nullptr;
  if (behind != "BINARY" && behind.find_first_not_of("0123456789 \t") != behind.npos)
    return nullptr;
  const auto* const found = std::ranges::find_if(
      kGeomview, [word](const ForeignFormat& f) { return is_geomview(word, f.start); });
  return found == kGeomview.end() ? nullptr : found;
}

/// The version, as in "AC1027", and a zero.
bool is_dwg(std::string_view head) {
  constexpr std::size_t kVersion = 6;
  return head.starts_with("AC10") && head.size() > kVersion && head[kVersion] == '\0';
}

}  // namespace

const ForeignFormat* foreign_format(std::string_view head) {
  static constexpr ForeignFormat kDwg{"AC10", "this is a DWG file", "save it as DXF"};
  if (const auto* const format = geomview_format(head)) return format;
  if (is_dwg(head)) return &kDwg;
  const auto* const found = std::ranges::find_if(
      kFormats, [head](const ForeignFormat& f) { return head.starts_with(f.start); });
  return found == kFormats.end() ? nullptr : found;
}

}  // namespace keyline::exchange::detail
