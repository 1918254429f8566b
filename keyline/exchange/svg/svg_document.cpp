#include "keyline/exchange/svg/svg_document.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include <nlohmann/json.hpp>

#include "keyline/exchange/json/json_document.h"
#include "keyline/exchange/json/json_text.h"
#include "keyline/exchange/svg/drawing_layers.h"
#include "keyline/exchange/svg/svg_reader.h"
#include "keyline/exchange/svg/svg_writer.h"

namespace keyline::exchange {
namespace {

using core::Result;
using document::Document;
using nlohmann::json;

constexpr const char* kFingerprint = "drawing";

/// FNV-1a over the coordinates as they were read, to tell a drawing that was changed.
std::string fingerprint(const SvgContents& svg) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto mix = [&hash](std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) {
      hash = (hash ^ (value & 0xff)) * 1099511628211ULL;
      value >>= 8;
    }
  };
  for (const SvgCurve& curve : svg.curves) {
    mix(curve.pieces.size());
    for (const curve::Bezier2& piece : curve.pieces)
      for (const core::Point2 p : piece.control) {
        mix(std::bit_cast<std::uint64_t>(p.x));
        mix(std::bit_cast<std::uint64_t>(p.y));
      }
  }
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[(hash >> shift) & 15];
  return text;
}

/// True for metadata that stand for the drawing as it is now.
bool is_current(const json& metadata, const SvgContents& svg) {
  if (!metadata.is_object()) return false;
  const auto stated = metadata.find(kFingerprint);
  return stated == metadata.end() || *stated == fingerprint(svg);
}

/// The pieces in their order; of many straight lines on end a polyline, which takes a tenth of the
/// room.
std::vector<document::PlanarCurve> curves_of(std::vector<curve::Bezier2> pieces) {
  constexpr std::size_t kMany = 64;
  const auto is_line = [](const curve::Bezier2& piece) { return piece.control.size() == 2; };
  std::vector<document::PlanarCurve> curves;
  for (auto at = pieces.begin(); at != pieces.end();) {
    const auto end = std::find_if_not(at, pieces.end(), is_line);
    if (end - at < static_cast<std::ptrdiff_t>(kMany)) {
      const auto next = std::max(end, at + 1);
      for (; at != next; ++at) curves.emplace_back().value = std::move(*at);
      continue;
    }
    curve::Polyline2 line;
    line.points.reserve(static_cast<std::size_t>(end - at) + 1);
    line.points.push_back(at->control[0]);
    for (; at != end; ++at) line.points.push_back(at->control[1]);
    curves.emplace_back().value = std::move(line);
  }
  return curves;
}

Document document_of(SvgContents svg) {
  Document document;
  document.unit = svg.unit;
  document.page = svg.page;
  for (SvgCurve& curve : svg.curves) {
    document::NamedPath named{
        {curve.name, curve.layer, curve.color}, {{}, curve.closed}, curve.stroke_width};
    named.path.curves = curves_of(std::exchange(curve.pieces, {}));
    if (!named.path.curves.empty()) document.paths.push_back(std::move(named));
  }
  for (const SvgSkipped& skipped : svg.skipped)
    document.skipped.push_back("line " + std::to_string(skipped.line) + ": " + skipped.what);
  return document;
}

}  // namespace

Result<Document> read_svg_document(std::string_view bytes) {
  auto svg = read_svg(bytes);
  if (!svg) return std::unexpected(svg.error());
  if (svg->metadata.empty()) return document_of(std::move(*svg));
  auto metadata = parse_json(svg->metadata);
  if (metadata && is_current(*metadata, *svg)) {
    metadata->erase(kFingerprint);
    auto exact = document_from_json(*metadata);
    if (exact) {
      exact->page = svg->page;
      return exact;
    }
  }
  Document document = document_of(std::move(*svg));
  document.skipped.push_back(
      "the exact curves in the metadata: the drawing was changed after they were written");
  return document;
}

Result<Written> write_svg_document(const Document& document, double tolerance) {
  Written written;
  if (document.paths.empty() && size(document) > 0)
    return core::fail(core::ErrorCode::bad_input, "there is no planar curve to draw",
                      document.surfaces.empty() ? kHoldSpaceCurves : kHoldSurfaces);
  const std::vector<SvgLayer> layers = drawing_layers(document, tolerance, written);
  SvgWriteOptions options = drawing_options(document, written);
  const auto plain = write_svg(layers, options);
  if (!plain) return std::unexpected(plain.error());
  const auto read = read_svg(*plain);
  if (!read) return std::unexpected(read.error());
  options.metadata = json_text(document, -1, {{kFingerprint, fingerprint(*read)}});
  auto text = write_svg(layers, options);
  if (!text) return std::unexpected(text.error());
  written.content = std::move(*text);
  return written;
}

}  // namespace keyline::exchange
