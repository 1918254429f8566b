#include "keyline/exchange/text/foreign_format.h"

#include <algorithm>
#include <array>

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
});

/// The first word of Geomview's OFF, with what its vertices have in front: "OFF", "STCN4nOFF".
bool is_off(std::string_view head) {
  const std::string_view word = head.substr(0, head.find_first_of(" \t\r\n"));
  return word.ends_with("OFF") && word.size() < head.size() &&
         word.find_first_not_of("STCN4n") == word.size() - 3;
}

/// The version, as in "AC1027", and a zero.
bool is_dwg(std::string_view head) {
  constexpr std::size_t kVersion = 6;
  return head.starts_with("AC10") && head.size() > kVersion && head[kVersion] == '\0';
}

}  // namespace

const ForeignFormat* foreign_format(std::string_view head) {
  static constexpr ForeignFormat kOff{"OFF", "this is a mesh in OFF", kMesh};
  static constexpr ForeignFormat kDwg{"AC10", "this is a DWG file", "save it as DXF"};
  if (is_off(head)) return &kOff;
  if (is_dwg(head)) return &kDwg;
  const auto* const found = std::ranges::find_if(
      kFormats, [head](const ForeignFormat& f) { return head.starts_with(f.start); });
  return found == kFormats.end() ? nullptr : found;
}

}  // namespace keyline::exchange::detail
