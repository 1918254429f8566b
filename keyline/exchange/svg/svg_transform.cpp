#include "keyline/exchange/svg/svg_transform.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>

#include "keyline/core/angle.h"
#include "keyline/exchange/svg/svg_path.h"

namespace keyline::exchange::detail {

core::Point2 apply(const Affine& m, core::Point2 p) {
  return {m.a * p.x + m.c * p.y + m.e, m.b * p.x + m.d * p.y + m.f};
}

Affine combined(const Affine& outer, const Affine& inner) {
  const auto& o = outer;
  const auto& i = inner;
  return {o.a * i.a + o.c * i.b, o.b * i.a + o.d * i.b,       o.a * i.c + o.c * i.d,
          o.b * i.c + o.d * i.d, o.a * i.e + o.c * i.f + o.e, o.b * i.e + o.d * i.f + o.f};
}

bool is_invertible(const Affine& m) {
  const double det = m.a * m.d - m.b * m.c;
  const double size = std::hypot(m.a, m.b) * std::hypot(m.c, m.d);
  return std::isfinite(size) && std::isfinite(m.e) && std::isfinite(m.f) &&
         std::abs(det) > 1e-14 * size && size > 0;
}

curve::Bezier2 transformed(const curve::Bezier2& piece, const Affine& m) {
  curve::Bezier2 mapped = piece;
  for (core::Point2& p : mapped.control) p = apply(m, p);
  return mapped;
}

namespace {

Affine rotation(double degrees, core::Point2 about) {
  const double angle = std::fmod(degrees, 360.0) * core::kPi / 180;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c, s, -s, c, about.x - c * about.x + s * about.y, about.y - s * about.x - c * about.y};
}

/// One function of the list with its arguments.
std::optional<Affine> transform_of(std::string_view name, std::span<const double> v) {
  const std::size_t n = v.size();
  const auto skew = [&v] { return std::tan(std::fmod(v[0], 360.0) * core::kPi / 180); };
  if (name == "matrix" && n == 6) return Affine{v[0], v[1], v[2], v[3], v[4], v[5]};
  if (name == "translate" && (n == 1 || n == 2)) return Affine{1, 0, 0, 1, v[0], n == 2 ? v[1] : 0};
  if (name == "scale" && (n == 1 || n == 2)) return Affine{v[0], 0, 0, n == 2 ? v[1] : v[0], 0, 0};
  if (name == "rotate" && n == 1) return rotation(v[0], {});
  if (name == "rotate" && n == 3) return rotation(v[0], {v[1], v[2]});
  if (name == "skewX" && n == 1) return Affine{1, 0, skew(), 1, 0, 0};
  if (name == "skewY" && n == 1) return Affine{1, skew(), 0, 1, 0, 0};
  return std::nullopt;
}

/// Numbers up to the closing bracket; false where there is none or anything else.
bool read_arguments(SvgScanner& scan, std::array<double, 6>& values, std::size_t& count) {
  scan.skip_space();
  if (scan.peek() != '(') return false;
  scan.take();
  scan.skip_space();
  for (count = 0; count < values.size() && scan.number(values[count]); ++count)
    scan.skip_separator();
  if (scan.peek() != ')') return false;
  scan.take();
  return true;
}

}  // namespace

std::optional<Affine> parse_svg_transform(std::string_view text) {
  SvgScanner scan(text);
  Affine whole;
  scan.skip_separator();
  while (!scan.at_end()) {
    const std::string_view ahead = scan.rest();
    std::size_t letters = 0;
    while (letters < ahead.size() && std::isalpha(static_cast<unsigned char>(ahead[letters])))
      ++letters;
    for (std::size_t i = 0; i < letters; ++i) scan.take();
    std::array<double, 6> values{};
    std::size_t count = 0;
    if (!read_arguments(scan, values, count)) return std::nullopt;
    const auto step = transform_of(ahead.substr(0, letters), std::span(values.data(), count));
    if (!step) return std::nullopt;
    whole = combined(whole, *step);
    scan.skip_separator();
  }
  return whole;
}

std::optional<SvgViewBox> parse_svg_view_box(std::string_view text) {
  SvgScanner scan(text);
  std::array<double, 4> v{};
  scan.skip_space();
  for (double& value : v) {
    if (!scan.number(value)) return std::nullopt;
    scan.skip_separator();
  }
  if (!scan.at_end() || !(v[2] > 0 && v[3] > 0)) return std::nullopt;
  return SvgViewBox{v[0], v[1], v[2], v[3]};
}

namespace {

/// Scales of both axes as preserveAspectRatio asks for: each its own, or one of them for both.
void keep_aspect(double& x, double& y, std::string_view aspect) {
  const auto has = [aspect](std::string_view word) { return aspect.find(word) != aspect.npos; };
  if (!has("none")) x = y = has("slice") ? std::max(x, y) : std::min(x, y);
}

}  // namespace

Affine fit_view_box(const SvgViewBox& box, double width, double height, std::string_view aspect) {
  double x = width / box.width;
  double y = height / box.height;
  keep_aspect(x, y, aspect);
  const auto has = [aspect](std::string_view word) { return aspect.find(word) != aspect.npos; };
  const double right = has("xMin") ? 0 : has("xMax") ? 1 : 0.5;
  const double down = has("YMin") ? 0 : has("YMax") ? 1 : 0.5;
  return {x,
          0,
          0,
          y,
          right * (width - x * box.width) - x * box.x,
          down * (height - y * box.height) - y * box.y};
}

std::optional<SvgLength> parse_svg_length(std::string_view text) {
  struct Unit {
    std::string_view name;
    double factor;
    bool physical;
  };
  static constexpr std::array<Unit, 11> kUnits = {{{"", 1, false},
                                                   {"px", 1, false},
                                                   {"mm", 1, true},
                                                   {"cm", 10, true},
                                                   {"in", 25.4, true},
                                                   {"pt", 25.4 / 72, true},
                                                   {"pc", 25.4 / 6, true},
                                                   {"Q", 0.25, true},
                                                   {"em", 16, false},
                                                   {"rem", 16, false},
                                                   {"ex", 8, false}}};
  SvgScanner scan(text);
  double value = 0;
  scan.skip_space();
  if (!scan.number(value)) return std::nullopt;
  std::string_view name = scan.rest();
  while (!name.empty() && (name.back() == ' ' || name.back() == '\n')) name.remove_suffix(1);
  for (const Unit& unit : kUnits)
    if (unit.name == name) return SvgLength{value * unit.factor, unit.physical};
  return std::nullopt;
}

namespace {

/// Scales of the viewBox in the lengths that the sizes are given in; 0 for one that is not.
Affine scales(double width, double height, const SvgViewBox& box, std::string_view aspect) {
  double x = width > 0 ? width / box.width : height > 0 ? height / box.height : 1;
  double y = height > 0 ? height / box.height : x;
  keep_aspect(x, y, aspect);
  return {x, 0, 0, -y, 0, 0};
}

}  // namespace

SvgFrame outermost_frame(const std::optional<SvgLength>& width,
                         const std::optional<SvgLength>& height,
                         const std::optional<SvgViewBox>& box, std::string_view aspect) {
  SvgFrame frame;
  frame.physical = (width && width->physical) || (height && height->physical);
  const auto size = [&frame](const std::optional<SvgLength>& l) {
    return !l ? 0 : frame.physical ? in_mm(*l) : in_px(*l);
  };
  const double w = size(width);
  const double h = size(height);
  frame.page = box;
  if (box) {
    frame.map = scales(w, h, *box, aspect);
    if (w == 0 || h == 0) return frame;
    const Affine fit = fit_view_box(*box, w, h, aspect);
    frame.page = SvgViewBox{-fit.e / fit.a, -fit.f / fit.d, w / fit.a, h / fit.d};
    return frame;
  }
  const double scale = frame.physical ? kMillimetresPerPx : 1;
  frame.map = {scale, 0, 0, -scale, 0, 0};
  if (w > 0 && h > 0) frame.page = SvgViewBox{0, 0, w / scale, h / scale};
  return frame;
}

SvgFrame moved(SvgFrame frame, const Affine& own) {
  const double px = frame.physical ? kMillimetresPerPx : 1;
  const SvgViewBox page = frame.page.value_or(SvgViewBox{});
  // From user units to px right of and below the middle of the page, and back.
  const Affine in{frame.map.a / px, 0, 0, -frame.map.d / px, 0, 0};
  const core::Point2 middle = apply(in, {page.x + page.width / 2, page.y + page.height / 2});
  const Affine to_middle = combined(Affine{1, 0, 0, 1, -middle.x, -middle.y}, in);
  const Affine from_middle =
      combined(Affine{1 / in.a, 0, 0, 1 / in.d, 0, 0}, Affine{1, 0, 0, 1, middle.x, middle.y});
  frame.map = combined(frame.map, combined(from_middle, combined(own, to_middle)));
  return frame;
}

curve::Box2 box_of(const SvgViewBox& box, const Affine& map) {
  const core::Point2 first = apply(map, {box.x, box.y});
  curve::Box2 all{first, first};
  for (const core::Point2 corner : {core::Point2{box.x + box.width, box.y},
                                    {box.x, box.y + box.height},
                                    {box.x + box.width, box.y + box.height}})
    all = curve::united(all, apply(map, corner));
  return all;
}

}  // namespace keyline::exchange::detail
