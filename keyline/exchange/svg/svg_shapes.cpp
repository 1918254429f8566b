#include "keyline/exchange/svg/svg_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/exchange/svg/svg_transform.h"

namespace keyline::exchange::detail {

using core::Point2;
using curve::Bezier2;

std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

std::string name_of(const pugi::xml_node& node) {
  for (const char* attribute : {"inkscape:label", "data-name", "id"})
    if (const char* value = node.attribute(attribute).value(); *value) return value;
  return {};
}

std::string describe(const pugi::xml_node& node) {
  const std::string name = name_of(node);
  return std::string(local_name(node)) + (name.empty() ? "" : " \"" + name + "\"");
}

bool is_svg_shape(std::string_view name) {
  static constexpr std::array<std::string_view, 7> kShapes = {
      "path", "rect", "circle", "ellipse", "line", "polyline", "polygon"};
  return std::find(kShapes.begin(), kShapes.end(), name) != kShapes.end();
}

double svg_length(const pugi::xml_node& node, const char* name, double fallback,
                  const SvgViewport& viewport) {
  const pugi::xml_attribute attribute = node.attribute(name);
  if (!attribute) return fallback;
  if (const auto length = parse_svg_length(attribute.value())) return in_px(*length);
  SvgScanner scan(attribute.value());
  double share = 0;
  scan.skip_space();
  if (!scan.number(share) || scan.peek() != '%') return NAN;
  const std::string_view word = name;
  const bool across = word.find('x') != word.npos || word == "width";
  const bool down = word.find('y') != word.npos || word == "height";
  const double whole = across ? viewport.width
                       : down ? viewport.height
                              : std::hypot(viewport.width, viewport.height) / std::sqrt(2.0);
  return share / 100 * whole;
}

namespace {

SvgPathData nothing(std::string why) { return {{}, std::move(why), 0}; }

void add_line(SvgSubpath& outline, Point2 a, Point2 b) {
  if (a != b) outline.pieces.push_back({{a, b}, {}});
}

void add_arc(SvgSubpath& outline, Point2 a, Point2 b, double rx, double ry) {
  for (Bezier2& piece : svg_arc(a, b, rx, ry, 0, false, true))
    outline.pieces.push_back(std::move(piece));
}

SvgPathData rectangle(const pugi::xml_node& node, const SvgViewport& viewport) {
  const double x = svg_length(node, "x", 0, viewport);
  const double y = svg_length(node, "y", 0, viewport);
  const double w = svg_length(node, "width", 0, viewport);
  const double h = svg_length(node, "height", 0, viewport);
  if (!(w > 0 && h > 0) || !std::isfinite(x) || !std::isfinite(y))
    return nothing("a rectangle without a usable place and size");
  double rx = svg_length(node, "rx", NAN, viewport);
  double ry = svg_length(node, "ry", NAN, viewport);
  if (!(rx >= 0)) rx = ry >= 0 ? ry : 0;
  if (!(ry >= 0)) ry = rx;
  rx = std::min(rx, w / 2);
  ry = std::min(ry, h / 2);
  if (!(rx > 0 && ry > 0)) rx = ry = 0;
  SvgSubpath outline;
  outline.closed = true;
  add_line(outline, {x + rx, y}, {x + w - rx, y});
  add_arc(outline, {x + w - rx, y}, {x + w, y + ry}, rx, ry);
  add_line(outline, {x + w, y + ry}, {x + w, y + h - ry});
  add_arc(outline, {x + w, y + h - ry}, {x + w - rx, y + h}, rx, ry);
  add_line(outline, {x + w - rx, y + h}, {x + rx, y + h});
  add_arc(outline, {x + rx, y + h}, {x, y + h - ry}, rx, ry);
  add_line(outline, {x, y + h - ry}, {x, y + ry});
  add_arc(outline, {x, y + ry}, {x + rx, y}, rx, ry);
  return {{outline}, {}, 0};
}

SvgPathData oval(const pugi::xml_node& node, bool circle, const SvgViewport& viewport) {
  const double cx = svg_length(node, "cx", 0, viewport);
  const double cy = svg_length(node, "cy", 0, viewport);
  const double rx = svg_length(node, circle ? "r" : "rx", 0, viewport);
  const double ry = circle ? rx : svg_length(node, "ry", 0, viewport);
  if (!(rx > 0 && ry > 0) || !std::isfinite(cx) || !std::isfinite(cy))
    return nothing("a circle or ellipse without a usable place and size");
  SvgSubpath outline;
  outline.closed = true;
  const std::array<Point2, 4> p = {{{cx + rx, cy}, {cx, cy + ry}, {cx - rx, cy}, {cx, cy - ry}}};
  for (std::size_t i = 0; i < 4; ++i) add_arc(outline, p[i], p[(i + 1) % 4], rx, ry);
  return {{outline}, {}, 0};
}

SvgPathData line(const pugi::xml_node& node, const SvgViewport& viewport) {
  const Point2 a{svg_length(node, "x1", 0, viewport), svg_length(node, "y1", 0, viewport)};
  const Point2 b{svg_length(node, "x2", 0, viewport), svg_length(node, "y2", 0, viewport)};
  if (!core::is_finite(a) || !core::is_finite(b)) return nothing("a line with unusable ends");
  if (a == b) return {};
  return {{SvgSubpath{{{{a, b}, {}}}, false}}, {}, 0};
}

SvgPathData corners(const pugi::xml_node& node, bool closed) {
  SvgScanner scan(node.attribute("points").value());
  std::vector<Point2> points;
  SvgPathData data;
  scan.skip_space();
  while (!scan.at_end()) {
    Point2 p;
    if (!scan.number(p.x) || (scan.skip_separator(), !scan.number(p.y))) {
      data.error = "a pair of numbers is expected here";
      data.error_at = scan.position();
      break;
    }
    points.push_back(p);
    scan.skip_separator();
  }
  if (closed && points.size() > 1) points.push_back(points.front());
  SvgSubpath outline;
  outline.closed = closed;
  for (std::size_t i = 1; i < points.size(); ++i) add_line(outline, points[i - 1], points[i]);
  if (!outline.pieces.empty()) data.subpaths.push_back(std::move(outline));
  return data;
}

}  // namespace

SvgPathData svg_shape(const pugi::xml_node& node, const SvgViewport& viewport) {
  const std::string_view name = local_name(node);
  if (name == "path") return parse_svg_path(node.attribute("d").value());
  if (name == "rect") return rectangle(node, viewport);
  if (name == "circle" || name == "ellipse") return oval(node, name == "circle", viewport);
  if (name == "line") return line(node, viewport);
  return corners(node, name == "polygon");
}

}  // namespace keyline::exchange::detail
