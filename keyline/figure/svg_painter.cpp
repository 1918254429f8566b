#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>

#include "keyline/core/angle.h"
#include "keyline/core/markup.h"
#include "keyline/figure/drawing.h"
#include "keyline/figure/encode.h"
#include "keyline/figure/painter.h"
#include "keyline/figure/text.h"

namespace keyline::figure {

using core::Point2;

namespace {

constexpr const char* kFonts =
    "Inter,&quot;Helvetica Neue&quot;,Arial,&quot;Liberation Sans&quot;,&quot;DejaVu Sans&quot;,"
    "sans-serif";

/// Rounded to `digits` decimals, without needless zeros.
std::string number(double value, int digits = 2) {
  const double unit = std::pow(10.0, digits);
  const double rounded = std::round(value * unit) / unit + 0.0;  // + 0.0: never "-0"
  std::array<char, 40> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), rounded);
  return {text.data(), end.ptr};
}

void append(std::string& text, std::initializer_list<std::string_view> parts) {
  for (const std::string_view part : parts) text += part;
}

void append_attribute(std::string& text, std::string_view name, std::string_view value) {
  append(text, {" ", name, "=\"", value, "\""});
}

void append_color(std::string& text, std::string_view name, Color c) {
  constexpr std::string_view kHex = "0123456789abcdef";
  append(text, {" ", name, "=\"#"});
  for (const unsigned v : {c.red, c.green, c.blue}) {
    text += kHex[v / 16];
    text += kHex[v % 16];
  }
  text += '"';
  if (c.alpha < 1) append(text, {" ", name, "-opacity=\"", number(c.alpha, 3), "\""});
}

void append_point(std::string& text, Point2 p) { append(text, {number(p.x), " ", number(p.y)}); }

void append_path_data(std::string& d, const Path& path) {
  PathVerb last = PathVerb::close;
  for (const PathStep& step : path.steps) {
    const auto& p = step.point;
    const bool repeats = step.verb == last;
    last = step.verb;
    if (step.verb == PathVerb::close) {
      d += 'Z';
      continue;
    }
    if (step.verb == PathVerb::cubic) {
      d += repeats ? ' ' : 'C';
      append_point(d, p[0]);
      d += ' ';
      append_point(d, p[1]);
      d += ' ';
    } else if (step.verb == PathVerb::move) {
      d += 'M';
    } else {
      d += repeats ? ' ' : 'L';
    }
    append_point(d, p[2]);
  }
}

class SvgPainter final : public detail::Painter {
 public:
  explicit SvgPainter(std::string prefix) : prefix_(std::move(prefix)) {}

  void begin_group(const Group& group) override {
    std::string attributes;
    if (group.clip) {
      const std::string id = prefix_ + "-clip" + std::to_string(++clips_);
      append(body_, {"<clipPath id=\"", id, "\"><rect"});
      append_box(*group.clip);
      body_ += "/></clipPath>\n";
      append(attributes, {" clip-path=\"url(#", id, ")\""});
    }
    const std::string name = clean_text(group.name);
    if (!name.empty()) append_attribute(attributes, "data-name", core::escape_markup(name));
    append(body_, {"<g", attributes, ">\n"});
  }

  void end_group(const Group&) override { body_ += "</g>\n"; }

  void shape(const Shape& shape) override {
    body_ += "<path d=\"";
    append_path_data(body_, shape.path);
    body_ += '"';
    if (shape.fill) {
      append_color(body_, "fill", *shape.fill);
      body_ += " fill-rule=\"evenodd\"";
    } else {
      body_ += " fill=\"none\"";
    }
    if (shape.stroke) append_stroke(*shape.stroke);
    body_ += "/>\n";
  }

  void label(const Label& label) override {
    const double y = label.at.y + detail::baseline_drop(label);
    append(body_, {"<text x=\"", number(label.at.x), "\" y=\"", number(y), "\""});
    append_attribute(body_, "font-size", number(label.size));
    append_color(body_, "fill", label.color);
    if (label.anchor == Anchor::middle) append_attribute(body_, "text-anchor", "middle");
    if (label.anchor == Anchor::end) append_attribute(body_, "text-anchor", "end");
    if (label.bold) append_attribute(body_, "font-weight", "bold");
    if (label.italic) append_attribute(body_, "font-style", "italic");
    if (label.halo > 0) {
      append_color(body_, "stroke", kPaper);
      append_attribute(body_, "stroke-width", number(2 * label.halo));
      body_ += " stroke-linejoin=\"round\" paint-order=\"stroke\"";
    }
    if (label.rotation != 0) {
      append(body_, {" transform=\"rotate(", number(-label.rotation * 180 / core::kPi, 3), " "});
      append_point(body_, label.at);
      body_ += ")\"";
    }
    append(body_, {">", core::escape_markup(label.text), "</text>\n"});
  }

  void dots(const Marks& marks) override {
    body_ += "<path d=\"";
    for (const Point2& p : marks.points) {
      body_ += 'M';
      append_point(body_, p);
      body_ += "h0";
    }
    body_ += "\" fill=\"none\"";
    append_stroke({marks.color, marks.size, {}});
    body_ += " stroke-linecap=\"round\"/>\n";
  }

  void picture(const Picture& picture) override {
    body_ += "<image";
    append_box(picture.box);
    append(body_, {" preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,",
                   detail::base64(detail::png_of_pixels(picture)), "\">"});
    const std::string text = clean_text(picture.text);
    if (!text.empty()) append(body_, {"<title>", core::escape_markup(text), "</title>"});
    body_ += "</image>\n";
  }

  std::string take() { return std::move(body_); }

 private:
  void append_box(const Box& box) {
    append_attribute(body_, "x", number(box.min.x));
    append_attribute(body_, "y", number(box.min.y));
    append_attribute(body_, "width", number(std::max(0.0, width(box))));
    append_attribute(body_, "height", number(std::max(0.0, height(box))));
  }

  void append_stroke(const Stroke& stroke) {
    append_color(body_, "stroke", stroke.color);
    append_attribute(body_, "stroke-width", number(stroke.width, 3));
    if (stroke.dash.empty()) return;
    std::string dash;
    for (const double d : stroke.dash)
      append(dash, {dash.empty() ? "" : " ", number(std::max(0.0, d))});
    append_attribute(body_, "stroke-dasharray", dash);
  }

  std::string prefix_;
  std::string body_;
  int clips_ = 0;
};

/// <title> and <desc>, and the attributes of the root that point at them.
struct Description {
  std::string attributes = " role=\"img\"";
  std::string elements;
};

Description describe(const Drawing& drawing, const std::string& prefix) {
  Description description;
  std::string ids;
  const auto add = [&](std::string_view element, std::string_view text) {
    const std::string clean = clean_text(text);
    if (clean.empty()) return;
    const std::string id = prefix + '-' + std::string(element);
    append(description.elements,
           {"<", element, " id=\"", id, "\">", core::escape_markup(clean), "</", element, ">\n"});
    append(ids, {ids.empty() ? "" : " ", id});
  };
  add("title", drawing.title);
  add("desc", drawing.description);
  if (!ids.empty()) append_attribute(description.attributes, "aria-labelledby", ids);
  return description;
}

}  // namespace

std::string write_svg(const Drawing& drawing, const SvgOptions& options) {
  const std::string prefix = core::escape_markup(clean_text(options.id_prefix));
  SvgPainter painter(prefix);
  if (drawing.background) {
    const Box page{{0, 0}, {drawing.width, drawing.height}};
    painter.shape({rectangle(page), std::nullopt, drawing.background});
  }
  detail::paint(drawing, painter);
  const Description description = describe(drawing, prefix);
  const char* unit = drawing.unit == PageUnit::mm ? "mm" : "";
  const std::string w = number(drawing.width);
  const std::string h = number(drawing.height);
  std::string svg;
  if (options.standalone) svg += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  svg += "<svg xmlns=\"http://www.w3.org/2000/svg\"";
  svg += " xmlns:xlink=\"http://www.w3.org/1999/xlink\"";
  append(svg, {" width=\"", w, unit, "\" height=\"", h, unit, "\" viewBox=\"0 0 ", w, " ", h, "\"",
               description.attributes, " font-family=\"", kFonts, "\">\n"});
  append(svg, {description.elements, painter.take(), "</svg>\n"});
  return svg;
}

}  // namespace keyline::figure
