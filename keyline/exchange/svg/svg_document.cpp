#include "keyline/exchange/svg/svg_document.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
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

// Members beside the document in the metadata, to tell a drawing that was changed.
constexpr const char* kDrawing = "drawing";
constexpr const char* kLabels = "labels";

/// FNV-1a.
class Fingerprint {
 public:
  void mix(std::uint64_t value) {
    for (int byte = 0; byte < 8; ++byte) {
      hash_ = (hash_ ^ (value & 0xff)) * 1099511628211ULL;
      value >>= 8;
    }
  }
  void mix(double value) { mix(std::bit_cast<std::uint64_t>(value)); }
  void mix(std::string_view text) {
    mix(static_cast<std::uint64_t>(text.size()));
    for (const char c : text) mix(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  }

  std::string text() const {
    static constexpr char kDigits[] = "0123456789abcdef";
    std::string digits;
    for (int shift = 60; shift >= 0; shift -= 4) digits += kDigits[(hash_ >> shift) & 15];
    return digits;
  }

 private:
  std::uint64_t hash_ = 14695981039346656037ULL;
};

/// Of the coordinates as they were read.
std::string drawing_fingerprint(const SvgContents& svg) {
  Fingerprint print;
  for (const SvgCurve& curve : svg.curves) {
    print.mix(static_cast<std::uint64_t>(curve.pieces.size()));
    for (const curve::Bezier2& piece : curve.pieces)
      for (const core::Point2 p : piece.control) {
        print.mix(p.x);
        print.mix(p.y);
      }
  }
  return print.text();
}

/// Of names and looks as they were read.
std::string labels_fingerprint(const SvgContents& svg) {
  Fingerprint print;
  for (const SvgCurve& curve : svg.curves) {
    print.mix(static_cast<std::uint64_t>(curve.subpath));
    for (const std::string* text : {&curve.name, &curve.layer, &curve.color})
      print.mix(std::string_view(*text));
    print.mix(curve.stroke_width);
  }
  return print.text();
}

/// Whether metadata stand for the drawing as it is now, in one respect; true where they say nothing
/// of it.
bool is_current(const json& metadata, const char* member, const std::string& now) {
  if (!metadata.is_object()) return false;
  const auto stated = metadata.find(member);
  return stated == metadata.end() || *stated == now;
}

document::Label label_of(const SvgCurve& curve) { return {curve.name, curve.layer, curve.color}; }

using Elements = std::vector<const SvgCurve*>;

/// The first curve of every element.
Elements elements_of(const SvgContents& svg) {
  Elements elements;
  std::size_t last = 0;
  for (const SvgCurve& curve : svg.curves) {
    if (curve.subpath == 1 || curve.subpath <= last) elements.push_back(&curve);
    last = curve.subpath;
  }
  return elements;
}

/// How the writer would have drawn a document whose elements are those, with that page, in the unit
/// of the drawing.
Result<SvgContents> drawn_again(const Document& document, const Elements& elements,
                                const SvgContents& svg, double scale,
                                const std::optional<curve::Box2>& page) {
  std::vector<SvgLayer> layers;
  auto element = elements.begin();
  for (const DrawnLayer& drawn : drawn_layers(document)) {
    SvgLayer& layer = layers.emplace_back(SvgLayer{.name = drawn.name});
    for (const std::size_t i : drawn.paths) {
      const document::NamedPath& named = document.paths[i];
      SvgPath& path = layer.paths.emplace_back();
      path.name = named.label.name;
      path.color = named.label.color;
      path.width = named.stroke_width / scale;
      // an element's curves follow one another
      const SvgCurve* const end = svg.curves.data() + svg.curves.size();
      const SvgCurve* const next = element + 1 == elements.end() ? end : *(element + 1);
      for (const SvgCurve* curve = *element; curve != next; ++curve)
        path.pieces.insert(path.pieces.end(), curve->pieces.begin(), curve->pieces.end());
      ++element;
    }
  }
  SvgWriteOptions options;
  options.unit = svg.unit;
  options.page = page;
  const auto text = write_svg(layers, options);
  if (!text) return std::unexpected(text.error());
  return read_svg(*text);
}

/// Gives a path what differs of its element from what the writer drew, with one page or another.
void take_changes(document::NamedPath& path, const SvgCurve& now,
                  const std::array<const SvgCurve*, 2>& drawn, double scale) {
  constexpr double kRounding = 1e-9;  // of widths in another unit
  if (now.name != drawn[0]->name) path.label.name = now.name;
  if (now.layer != drawn[0]->layer) path.label.layer = now.layer;
  if (now.color != drawn[0]->color) path.label.color = now.color;
  const bool same_width = std::ranges::any_of(drawn, [&](const SvgCurve* one) {
    return std::abs(now.stroke_width - one->stroke_width) <= kRounding * one->stroke_width;
  });
  if (!same_width) path.stroke_width = now.stroke_width * scale;
}

/// Gives the paths of a document the names and looks of the elements that its drawing shows them
/// as, where these are no longer those that were drawn. False where there are not as many.
bool take_labels(Document& document, const SvgContents& svg, double scale) {
  const Elements elements = elements_of(svg);
  if (elements.size() != document.paths.size()) return false;
  // Lines without a width have one by the size of the page, or of the curves where none was given.
  const auto tight = drawn_again(document, elements, svg, scale, {});
  const auto paged = drawn_again(document, elements, svg, scale, svg.page);
  if (!tight || !paged) return false;
  const Elements in_tight = elements_of(*tight), in_paged = elements_of(*paged);
  if (in_tight.size() != elements.size() || in_paged.size() != elements.size()) return false;
  std::size_t k = 0;
  for (const DrawnLayer& layer : drawn_layers(document))
    for (const std::size_t i : layer.paths) {
      take_changes(document.paths[i], *elements[k], {in_tight[k], in_paged[k]}, scale);
      ++k;
    }
  return true;
}

/// The document in the metadata, as the drawing shows it now; empty where that shows other curves.
std::optional<Document> exact_document(const SvgContents& svg) {
  auto metadata = parse_json(svg.metadata);
  if (!metadata || !is_current(*metadata, kDrawing, drawing_fingerprint(svg))) return {};
  const bool same_labels = is_current(*metadata, kLabels, labels_fingerprint(svg));
  metadata->erase(kDrawing);
  metadata->erase(kLabels);
  auto exact = document_from_json(*metadata);
  if (!exact) return {};
  const double unit = document::millimetres(exact->unit);
  const double scale = unit > 0 ? document::millimetres(svg.unit) / unit : 1;
  const auto scaled = [scale](core::Point2 p) { return core::Point2{scale * p.x, scale * p.y}; };
  if (svg.page) exact->page = curve::Box2{scaled(svg.page->low), scaled(svg.page->high)};
  if (!same_labels && !take_labels(*exact, svg, scale)) return {};
  return std::move(*exact);
}

void tell_skipped(const SvgContents& svg, Document& document) {
  for (const SvgSkipped& skipped : svg.skipped)
    document.skipped.push_back("line " + std::to_string(skipped.line) + ": " + skipped.what);
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
    document::NamedPath named{label_of(curve), {{}, curve.closed}, curve.stroke_width};
    named.path.curves = curves_of(std::exchange(curve.pieces, {}));
    if (!named.path.curves.empty()) document.paths.push_back(std::move(named));
  }
  tell_skipped(svg, document);
  return document;
}

}  // namespace

Result<Document> read_svg_document(std::string_view bytes) {
  auto svg = read_svg(bytes);
  if (!svg) return std::unexpected(svg.error());
  if (svg->metadata.empty()) return document_of(std::move(*svg));
  if (auto exact = exact_document(*svg)) {
    tell_skipped(*svg, *exact);
    return std::move(*exact);
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
  options.metadata = json_text(
      document, -1, {{kDrawing, drawing_fingerprint(*read)}, {kLabels, labels_fingerprint(*read)}});
  auto text = write_svg(layers, options);
  if (!text) return std::unexpected(text.error());
  written.content = std::move(*text);
  return written;
}

}  // namespace keyline::exchange
