// Formats that need libraries which Debian has for its own processors alone: refused here, each by
// its name. An SVG is written as the drawing alone.
#include <string>

#include "keyline/exchange/font/font.h"
#include "keyline/exchange/font/glif.h"
#include "keyline/exchange/image/image_reader.h"
#include "keyline/exchange/pdf/pdf_document.h"
#include "keyline/exchange/step/cad_file.h"
#include "keyline/exchange/svg/drawing_layers.h"
#include "keyline/exchange/svg/svg_document.h"
#include "keyline/exchange/svg/svg_text.h"
#include "keyline/operations/curve_registry.h"
#include "keyline/operations/registry.h"

namespace keyline {
namespace {

std::unexpected<core::Failure> absent(const std::string& what) {
  return core::fail(core::ErrorCode::unsupported, what + " is not for a page without a server",
                    "open it with an installed Keyline: keyline studio");
}

}  // namespace

namespace exchange {

using core::Result;
using document::Document;

Result<Document> read_svg_document(std::string_view) { return absent("SVG to be read"); }
Result<Document> read_font(std::string_view, const std::string&) { return absent("a font"); }
Result<Document> read_glif(std::string_view, const std::filesystem::path&) {
  return absent("GLIF");
}
Result<Written> write_glif(const Document&, const GlifOptions&) { return absent("GLIF"); }
Result<Document> read_cad(const std::filesystem::path&, CadFormat, const core::CancellationToken&) {
  return absent("STEP or IGES");
}
Result<Written> write_cad(const Document&, CadFormat, double, const core::CancellationToken&) {
  return absent("STEP or IGES");
}
Result<Written> write_pdf_document(const Document&, double) { return absent("PDF"); }

/// Without the exact curves that read_svg_document() would find in it, and says so.
Result<Written> write_svg_document(const Document& document, double tolerance) {
  Written written;
  const std::vector<SvgLayer> layers = drawing_layers(document, tolerance, written);
  auto text = write_svg(layers, drawing_options(document, written));
  if (!text) return std::unexpected(text.error());
  written.content = std::move(*text);
  written.notes.emplace_back("the drawing alone: no exact curves in it");
  return written;
}

namespace detail {

std::string compressed_svg(std::string_view) {
  throw core::InvalidInput("SVGZ is not for a page without a server: write SVG");
}

Result<sketch::Image> read_png(std::string_view) { return absent("PNG to be traced"); }
Result<sketch::Image> read_jpeg(std::string_view) { return absent("JPEG to be traced"); }
Result<sketch::Image> read_tiff(std::string_view) { return absent("TIFF to be traced"); }
Result<sketch::Image> read_webp(std::string_view) { return absent("WebP to be traced"); }

}  // namespace detail
}  // namespace exchange

namespace operations {

std::vector<Operation> all_operations() { return curve_operations(); }

}  // namespace operations
}  // namespace keyline
