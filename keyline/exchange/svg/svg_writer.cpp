#include "keyline/exchange/svg/svg_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "keyline/core/markup.h"
#include "keyline/core/utf8.h"
#include "keyline/curve/bounding_box.h"

namespace keyline::exchange {

namespace {

using core::ErrorCode;
using core::Point2;
using curve::Bezier2;

void append(std::string& text, std::initializer_list<std::string_view> parts) {
  for (const std::string_view part : parts) text += part;
}

/// Shortest text that reads back to the same double, without an exponent where that stays short.
std::string number(double value) {
  std::array<char, 64> text{};
  const double size = std::abs(value);
  const bool plain = size == 0 || (size > 1e-7 && size < 1e15);
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value + 0.0,
                                 plain ? std::chars_format::fixed : std::chars_format::scientific);
  return {text.data(), end.ptr};
}

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20 || byte == 0x7F;
}

/// Text that may stand in XML and comes back the same.
bool is_storable(std::string_view text) {
  return core::is_utf8(text) && std::none_of(text.begin(), text.end(), [](char c) {
           return is_control(c) && c != '\n' && c != '\t' && c != '\r';
         });
}

/// Names are labels on one line.
std::string label(std::string_view text) {
  std::string line(text);
  for (char& c : line)
    if (is_control(c)) c = '?';
  return core::escape_markup(line);
}

bool is_color(std::string_view text) {
  return text.size() == 7 && text[0] == '#' &&
         text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string_view::npos;
}

/// How a unit is written behind width and height.
struct PageUnit {
  std::string_view name;
  std::string_view suffix;
  double factor;
};

const PageUnit* unit_of(std::string_view name) {
  static constexpr std::array<PageUnit, 9> kUnits = {{{"", "", 1},
                                                      {"px", "", 1},
                                                      {"mm", "mm", 1},
                                                      {"cm", "cm", 1},
                                                      {"in", "in", 1},
                                                      {"pt", "pt", 1},
                                                      {"m", "mm", 1000},
                                                      {"km", "mm", 1e6},
                                                      {"ft", "in", 12}}};
  const auto found = std::find_if(kUnits.begin(), kUnits.end(),
                                  [name](const PageUnit& unit) { return unit.name == name; });
  return found == kUnits.end() ? nullptr : &*found;
}

core::Result<void> check_piece(const Bezier2& piece, const std::string& path) {
  const std::size_t n = piece.control.size();
  if (n < 2 || n > 4 || !piece.weights.empty())
    return core::fail(ErrorCode::unsupported,
                      "SVG holds polynomial Bézier pieces of degree 1 to 3 only",
                      "approximate the curve by cubics first", path);
  for (const Point2& p : piece.control)
    if (!core::is_finite(p))
      return core::fail(ErrorCode::bad_input, "a control point is not finite", {}, path);
  return {};
}

core::Result<void> check_path(const SvgPath& path, const std::string& place) {
  if (!path.color.empty() && !is_color(path.color))
    return core::fail(ErrorCode::bad_input, "a colour is not of the form #rrggbb", {},
                      place + ".color");
  if (!(path.width >= 0 && std::isfinite(path.width)))
    return core::fail(ErrorCode::bad_input, "a line width is negative or not finite", {},
                      place + ".width");
  for (const Bezier2& piece : path.pieces)
    if (auto ok = check_piece(piece, place); !ok) return ok;
  return {};
}

core::Result<void> check(const std::vector<SvgLayer>& layers) {
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::string place = "layers[" + std::to_string(i) + "]";
    if (!is_color(layers[i].color))
      return core::fail(ErrorCode::bad_input, "a colour is not of the form #rrggbb", {},
                        place + ".color");
    if (!(layers[i].width >= 0 && std::isfinite(layers[i].width)))
      return core::fail(ErrorCode::bad_input, "a line width is negative or not finite", {},
                        place + ".width");
    for (std::size_t j = 0; j < layers[i].paths.size(); ++j)
      if (auto ok = check_path(layers[i].paths[j], place + ".paths[" + std::to_string(j) + "]");
          !ok)
        return ok;
  }
  return {};
}

void append_point(std::string& d, Point2 p) { append(d, {number(p.x), " ", number(-p.y)}); }

std::string path_data(const SvgPath& path) {
  std::string d;
  const Bezier2* last = nullptr;
  for (const Bezier2& piece : path.pieces) {
    const auto& c = piece.control;
    if (!last || last->control.back() != c.front()) {
      d += 'M';
      append_point(d, c.front());
      last = nullptr;
    }
    const bool repeats = last && last->control.size() == c.size();
    d += repeats ? ' ' : c.size() == 2 ? 'L' : c.size() == 3 ? 'Q' : 'C';
    for (std::size_t i = 1; i < c.size(); ++i) {
      if (i > 1) d += ' ';
      append_point(d, c[i]);
    }
    last = &piece;
  }
  if (path.closed && last) d += 'Z';
  return d;
}

std::optional<curve::Box2> extent_of(const std::vector<SvgLayer>& layers) {
  std::optional<curve::Box2> extent;
  for (const SvgLayer& layer : layers)
    for (const SvgPath& path : layer.paths)
      for (const Bezier2& piece : path.pieces) {
        const curve::Box2 box = curve::bounding_box(piece);
        extent = extent ? curve::united(*extent, box) : box;
      }
  return extent;
}

std::string page_attributes(const std::vector<SvgLayer>& layers, const SvgWriteOptions& options,
                            const PageUnit& unit, double& stroke) {
  const curve::Box2 box =
      options.page ? *options.page : extent_of(layers).value_or(curve::Box2{{0, 0}, {1, 1}});
  double size = std::max(curve::width(box), curve::height(box));
  if (!(size > 0)) size = 1;
  const double margin = options.page ? 0 : options.margin * size;
  stroke = options.stroke_width > 0 ? options.stroke_width : size / 400;
  const double w = curve::width(box) + 2 * margin;
  const double h = curve::height(box) + 2 * margin;
  std::string text;
  append(text, {" width=\"", number(w * unit.factor), unit.suffix, "\" height=\"",
                number(h * unit.factor), unit.suffix, "\" viewBox=\"", number(box.low.x - margin),
                " ", number(-box.high.y - margin), " ", number(w), " ", number(h), "\""});
  return text;
}

void append_layer(std::string& svg, const SvgLayer& layer, std::size_t index, double stroke) {
  const std::string name = label(layer.name);
  const std::string id = "layer" + std::to_string(index + 1);
  append(svg, {"<g id=\"", id, "\" inkscape:groupmode=\"layer\" inkscape:label=\"",
               name.empty() ? id : name, "\" fill=\"none\" stroke=\"", layer.color,
               "\" stroke-width=\"", number(layer.width * stroke),
               "\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n"});
  for (std::size_t i = 0; i < layer.paths.size(); ++i) {
    const SvgPath& path = layer.paths[i];
    append(svg, {"<path id=\"", id, "-path", std::to_string(i + 1), "\""});
    if (!path.name.empty()) append(svg, {" inkscape:label=\"", label(path.name), "\""});
    if (!path.color.empty()) append(svg, {" stroke=\"", path.color, "\""});
    if (path.width > 0) append(svg, {" stroke-width=\"", number(path.width), "\""});
    append(svg, {" d=\"", path_data(path), "\"/>\n"});
  }
  svg += "</g>\n";
}

}  // namespace

core::Result<std::string> write_svg(const std::vector<SvgLayer>& layers,
                                    const SvgWriteOptions& options) {
  if (auto ok = check(layers); !ok) return std::unexpected(ok.error());
  const PageUnit* unit = unit_of(options.unit);
  if (!unit)
    return core::fail(ErrorCode::bad_input, "the unit of the SVG file is unknown",
                      "use mm, cm, m, in, pt or px", "unit");
  if (!(options.margin >= 0 && options.margin < 100) || !(options.stroke_width >= 0) ||
      !std::isfinite(options.stroke_width))
    return core::fail(ErrorCode::bad_input, "margin or line width is negative or not finite");
  if (!is_storable(options.metadata))
    return core::fail(ErrorCode::bad_input, "the metadata are no plain UTF-8 text", {}, "metadata");
  double stroke = 1;
  const std::string page = page_attributes(layers, options, *unit, stroke);
  if (page.find("inf") != std::string::npos || page.find("nan") != std::string::npos)
    return core::fail(ErrorCode::bad_input, "the drawing is too large for numbers");
  std::string svg = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  append(svg, {"<svg xmlns=\"http://www.w3.org/2000/svg\" "
               "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"",
               page, ">\n"});
  if (!options.title.empty()) append(svg, {"<title>", label(options.title), "</title>\n"});
  if (!options.metadata.empty())
    append(svg, {"<metadata><keyline:document xmlns:keyline=\"urn:keyline:document\">",
                 core::escape_markup(options.metadata), "</keyline:document></metadata>\n"});
  for (std::size_t i = 0; i < layers.size(); ++i) append_layer(svg, layers[i], i, stroke);
  return svg + "</svg>\n";
}

}  // namespace keyline::exchange
