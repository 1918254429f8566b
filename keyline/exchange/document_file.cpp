#include "keyline/exchange/document_file.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "keyline/core/extent.h"
#include "keyline/core/text.h"
#include "keyline/document/path_gap.h"
#include "keyline/document/units.h"
#include "keyline/exchange/dxf/dxf_reader.h"
#include "keyline/exchange/dxf/dxf_writer.h"
#include "keyline/exchange/file/atomic_file.h"
#include "keyline/exchange/font/font.h"
#include "keyline/exchange/font/glif.h"
#include "keyline/exchange/json/json_document.h"
#include "keyline/exchange/lost_labels.h"
#include "keyline/exchange/mesh/mesh.h"
#include "keyline/exchange/pdf/pdf_document.h"
#include "keyline/exchange/points/csv_writer.h"
#include "keyline/exchange/points/hull_table.h"
#include "keyline/exchange/points/points_reader.h"
#include "keyline/exchange/points/scap_reader.h"
#include "keyline/exchange/step/cad_file.h"
#include "keyline/exchange/svg/svg_document.h"
#include "keyline/exchange/svg/svg_text.h"
#include "keyline/exchange/too_large.h"

namespace keyline::exchange {
namespace {

namespace fs = std::filesystem;
using core::ErrorCode;
using core::fail;
using core::Result;
using document::Document;

/// The points of every curve as a polyline.
Result<Document> points_document(const fs::path& file) {
  const auto read = read_points_file(file);
  if (!read) return std::unexpected(read.error());
  const std::vector<acquire::RawCurve>& curves = read->curves;
  Document document;
  document.unit = read->unit;
  if (!curves.empty()) document.skipped = curves.front().left_out;
  for (const acquire::RawCurve& raw : curves) {
    const document::Label label{raw.id, {}, {}};
    std::vector<core::Point3> points;
    std::copy_if(raw.points.begin(), raw.points.end(), std::back_inserter(points),
                 [](core::Point3 p) { return core::is_finite(p); });
    if (points.size() < raw.points.size())
      document.skipped.push_back(core::counted(raw.points.size() - points.size(), "point") +
                                 " without all coordinates");
    if (points.size() < 2) {
      document.skipped.push_back((raw.id.empty() ? "a curve" : raw.id) + ": fewer than two points");
      continue;
    }
    if (raw.has_z) {
      document.space_curves.push_back({label, {curve::Polyline3{std::move(points)}}});
      continue;
    }
    curve::Polyline2 line;
    for (const core::Point3 p : points) line.points.push_back({p.x, p.y});
    document.paths.push_back({label, {{{std::move(line)}}, false}, 0});
  }
  return document;
}

Result<Document> offsets_document(std::string_view text) {
  const auto hull = read_hull_csv(text);
  if (!hull) return std::unexpected(hull.error());
  return hull_document(*hull);
}

/// Pen strokes, upright, each in the layer of its group.
Result<Document> strokes_document(std::string_view text) {
  const auto drawing = read_scap(text);
  if (!drawing) return std::unexpected(drawing.error());
  Document document;
  document.skipped = drawing->left_out;
  std::size_t dots = 0;
  for (const ScapStroke& stroke : drawing->strokes) {
    curve::Polyline2 line{upright(*drawing, stroke)};
    if (line.points.size() < 2) {
      ++dots;
      continue;
    }
    const document::Label label{std::to_string(stroke.id), std::to_string(stroke.group), {}};
    document.paths.push_back({label, {{{std::move(line)}}, false}, drawing->pen});
  }
  if (dots > 0) document.skipped.push_back(core::counted(dots, "dot") + " of the pen");
  return document;
}

/// The lines a mesh file holds beside its faces.
Result<Document> mesh_document(const fs::path& file) {
  const auto mesh = read_mesh(file);
  if (!mesh) return std::unexpected(mesh.error());
  Document document;
  document.skipped = mesh->skipped;
  for (const auto& indices : mesh->lines) {
    curve::Polyline3 line;
    for (const std::uint32_t i : indices) line.points.push_back(mesh->points[i]);
    const std::string name = "line-" + std::to_string(&indices - mesh->lines.data() + 1);
    if (!std::ranges::all_of(line.points, [](core::Point3 p) { return core::is_finite(p); })) {
      document.skipped.push_back(name + ": a vertex of it is no point");
      continue;
    }
    document.space_curves.push_back({{name, {}, {}}, {std::move(line)}});
  }
  if (mesh->lines.empty()) {
    std::string what = "a mesh or cloud of " + core::counted(mesh->points.size(), "point") +
                       " and " + core::counted(mesh->triangles.size(), "triangle") + " is no curve";
    if (!mesh->skipped.empty()) what += "; skipped: " + mesh->skipped.front();
    return fail(ErrorCode::bad_input, what, "cut it: --section y=0, or --section auto");
  }
  if (!mesh->triangles.empty())
    document.skipped.push_back(core::counted(mesh->triangles.size(), "triangle"));
  return document;
}

Result<Document> document_of(Format format, const fs::path& file, const ReadOptions& options) {
  if (format == Format::points) return points_document(file);
  if (format == Format::mesh) return mesh_document(file);
  if (format == Format::step) return read_cad(file, CadFormat::step, options.cancellation);
  if (format == Format::iges) return read_cad(file, CadFormat::iges, options.cancellation);
  const auto content = read_file(file);
  if (!content) return std::unexpected(content.error());
  switch (format) {
    case Format::json:
      return read_json(*content);
    case Format::svg:
      return read_svg_document(*content);
    case Format::font:
      return read_font(*content, options.glyphs);
    case Format::offsets:
      return offsets_document(*content);
    case Format::scap:
      return strokes_document(*content);
    case Format::glif:
      return read_glif(*content, fs::absolute(file).parent_path());
    case Format::dxf:
      return read_dxf(*content);
    default:
      break;
  }
  return fail(ErrorCode::internal, "no reader for this format");
}

/// Breakpoints and places between them.
template <class C>
void sample_into(core::Box3& box, const C& curve) {
  constexpr int kBetween = 4;
  const auto at = breakpoints(curve);
  for (std::size_t i = 1; i < at.size(); ++i)
    for (int k = 0; k <= kBetween; ++k)
      box.take(evaluate(curve, at[i - 1] + (at[i] - at[i - 1]) * k / kBetween));
}

/// Paths of other programs may have gaps: told, and left.
void tell_gaps(Document& document) {
  for (std::size_t i = 0; i < document.paths.size(); ++i) {
    const auto gap = document::first_gap(document.paths[i].path);
    if (!gap) continue;
    const std::string& name = document.paths[i].label.name;
    document.skipped.push_back((name.empty() ? "curve " + std::to_string(i + 1) : name) +
                               ": nothing closes a gap in it: its part " +
                               std::to_string(gap->member + 1) + " " + in_words(*gap));
  }
}

}  // namespace

Result<Document> read_document(const fs::path& file, const ReadOptions& options) {
  const auto head = head_of(file);
  if (!head) return std::unexpected(head.error());
  auto document = document_of(format_of(file, *head), file, options);
  if (!document) return std::unexpected(in_file(document.error(), file.string()));
  leave_out_too_large(*document);
  if (size(*document) == 0) {
    std::string what = "the file holds no curve";
    constexpr std::size_t kMost = 3;
    for (std::size_t i = 0; i < std::min(kMost, document->skipped.size()); ++i)
      what += (i == 0 ? "; skipped: " : ", ") + document->skipped[i];
    if (document->skipped.size() > kMost) what += " and others";
    return fail(ErrorCode::bad_input, what, "give a file with curves", file.string());
  }
  tell_gaps(*document);
  return document;
}

double extent(const Document& document) {
  core::Box3 box;
  for (const auto& named : document.paths) sample_into(box, prepared(named.path));
  for (const auto& named : document.space_curves) sample_into(box, named.curve);
  for (const auto& named : document.surfaces)
    for (const core::Point3 p : net_of(named.surface).points) box.take(p);
  const double size = diagonal(box);
  return std::isfinite(size) ? size : 0;
}

namespace {

/// Of the extensions that a format has, the one it is known by here.
std::string usual_extension(const std::string& extension) {
  return extension == ".stp"    ? ".step"
         : extension == ".igs"  ? ".iges"
         : extension == ".svgz" ? ".svg"
                                : extension;
}

/// The unit a file of that kind is written in: the document's own where the format has it, else mm.
std::string unit_in(const std::string& extension, const std::string& unit) {
  static const std::map<std::string, std::set<std::string>> kKnown = {
      {".svg", {"mm", "cm", "m", "in", "pt", "px"}},
      {".dxf", {"mm", "cm", "m", "km", "in", "ft"}},
      {".step", {"mm", "cm", "m", "km", "in", "ft"}},
      {".iges", {"mm", "cm", "m", "km", "in", "ft"}}};
  const auto known = kKnown.find(usual_extension(extension));
  if (unit.empty() || known == kKnown.end() || known->second.contains(unit)) return unit;
  return document::millimetres(unit) > 0 ? "mm" : unit;
}

/// Formats whose numbers always have a unit; DXF and JSON can say that there is none.
bool wants_unit(const std::string& extension) {
  static const std::set<std::string> kWith = {".step", ".iges", ".svg", ".pdf"};
  return kWith.contains(usual_extension(extension));
}

Result<Written> format_in_unit(const Document& document, const std::string& extension,
                               const WriteOptions& options);

Result<Written> format_in_its_unit(const Document& document, const std::string& extension,
                                   const WriteOptions& options) {
  const std::string unit = unit_in(extension, document.unit);
  if (unit == document.unit) {
    auto written = format_in_unit(document, extension, options);
    if (written && !unit.empty() && !(document::millimetres(unit) > 0))
      written->notes.push_back("the unit " + unit +
                               " is unknown: the numbers are written as they are");
    const bool has_none = extension == ".csv" || extension == ".glif";
    if (written && has_none && !unit.empty())
      written->notes.push_back("unit of the numbers, which the format does not tell: " + unit);
    if (written && unit.empty() && wants_unit(extension))
      written->notes.emplace_back("no unit is given: the numbers are written as mm");
    return written;
  }
  const double factor = document::millimetres(document.unit);
  WriteOptions in_mm = options;
  in_mm.tolerance *= factor;
  auto written = format_in_unit(document::in_unit(document, unit), extension, in_mm);
  if (!written) return written;
  written->deviation /= factor;
  written->notes.push_back("the file has no " + document.unit + ": written in mm, one " +
                           document.unit + " being " + core::number_text(factor, 6) + " mm");
  return written;
}

}  // namespace

Result<Written> format_document(const Document& document, const std::string& extension,
                                const WriteOptions& options) {
  auto written = format_in_its_unit(document, extension, options);
  const std::string lost = lost_labels(document, extension);
  if (written && !lost.empty()) written->notes.push_back("the format has no place for: " + lost);
  return written;
}

namespace {

Result<Written> format_in_unit(const Document& document, const std::string& extension,
                               const WriteOptions& options) {
  const double size = options.tolerance > 0 ? 0 : extent(document);
  const double tolerance = options.tolerance > 0 ? options.tolerance : size > 0 ? 1e-5 * size : 1;
  if (extension == ".json") return Written{json_text(document, 1) + "\n", 0, {}};
  if (extension == ".csv") return write_csv(document, options.samples);
  if (extension == ".svg") return write_svg_document(document, tolerance);
  if (extension == ".svgz") {
    auto drawn = write_svg_document(document, tolerance);
    if (drawn) drawn->content = detail::compressed_svg(drawn->content);
    return drawn;
  }
  if (extension == ".pdf") return write_pdf_document(document, tolerance);
  if (extension == ".dxf")
    return write_dxf(document, {.tolerance = tolerance, .polylines = options.polylines});
  if (extension == ".glif") {
    const double share = options.tolerance > 0 ? tolerance : 5e-4 * size;
    return write_glif(document, {.tolerance = share, .grid = options.grid});
  }
  if (extension == ".step" || extension == ".stp")
    return write_cad(document, CadFormat::step, tolerance, options.cancellation);
  if (extension == ".iges" || extension == ".igs")
    return write_cad(document, CadFormat::iges, tolerance, options.cancellation);
  std::string list;
  for (const std::string& name : written_extensions()) list += (list.empty() ? "" : " ") + name;
  return fail(ErrorCode::bad_input, "\"" + extension + "\" is no format that can be written",
              "use one of " + list);
}

}  // namespace

Result<Written> write_document(const Document& document, const fs::path& file,
                               const WriteOptions& options) {
  auto written = format_document(document, extension_of(file), options);
  if (!written) return std::unexpected(in_file(written.error(), file.string()));
  if (auto done = write_atomically(file, written->content); !done)
    return std::unexpected(in_file(done.error(), file.string()));
  written->content.clear();
  return written;
}

}  // namespace keyline::exchange
