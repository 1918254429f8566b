#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/core/point.h"
#include "keyline/figure/path.h"
#include "keyline/figure/style.h"

namespace keyline::figure {

/// The display list: what a figure shows, in page coordinates (x to the right, y down, from the
/// top left corner), in the drawing's unit. Model coordinates (y up) enter through a Viewport.

struct Shape {
  Path path = {};
  std::optional<Stroke> stroke = {};
  std::optional<Color> fill = {};  ///< even-odd rule
};

enum class Anchor { start, middle, end };
enum class Baseline { alphabetic, middle, top };

struct Label {
  core::Point2 at = {};
  std::string text = {};  ///< UTF-8, one line; control characters are dropped
  double size = 12;       ///< em height in the drawing's unit
  Color color = kInk;
  Anchor anchor = Anchor::start;
  Baseline baseline = Baseline::alphabetic;
  double rotation = 0;  ///< radians, counter-clockwise as seen on the page, about `at`
  bool bold = false;
  bool italic = false;
  double halo = 0;  ///< width of a paper-coloured rim that keeps text readable over lines
};

enum class Marker { dot, circle, square, diamond, triangle, cross, plus };

/// The same marker at many points.
struct Marks {
  std::vector<core::Point2> points = {};
  Marker marker = Marker::dot;
  double size = 4;  ///< across
  Color color = kInk;
};

/// Pixels stretched over a box: rgb holds 3 * columns * rows bytes, top row first.
struct Picture {
  Box box = {};
  int columns = 0;
  int rows = 0;
  std::vector<std::uint8_t> rgb = {};
  std::string text = {};  ///< what is to be seen, for those who cannot see it
};

struct Item;

/// Items under one name, painted in order and cut at `clip` where given.
struct Group {
  std::string name = {};
  std::optional<Box> clip = {};
  std::vector<Item> items;

  void add(Shape item);
  void add(Label item);
  void add(Marks item);
};

struct Item {
  std::variant<Shape, Label, Marks, Picture, Group> value;
};

enum class PageUnit { px, mm };  ///< 96 px are one inch, 25.4 mm

struct Drawing {
  double width = 640;
  double height = 400;
  PageUnit unit = PageUnit::px;
  std::string title = {};        ///< read by screen readers and PDF viewers, not painted
  std::string description = {};  ///< likewise, longer
  std::optional<Color> background = kPaper;
  std::vector<Item> items = {};

  void add(Shape item);
  void add(Label item);
  void add(Marks item);
  void add(Picture item);
  void add(Group item);
};

/// Uniform scale and flip from the model (y up) to the page (y down).
struct Viewport {
  double scale = 1;
  core::Point2 origin = {};  ///< where the model's (0, 0) lies on the page
  friend bool operator==(const Viewport&, const Viewport&) = default;
};

inline core::Point2 to_page(const Viewport& v, core::Point2 p) {
  return {v.origin.x + v.scale * p.x, v.origin.y - v.scale * p.y};
}
Path to_page(const Viewport& v, const Path& path);
std::vector<core::Point2> to_page(const Viewport& v, const std::vector<core::Point2>& points);

/// The largest model box similar view: `model` centred in `page`. A model of no extent is shown
/// at scale 1; the scale is always positive and finite.
Viewport fit_viewport(const Box& model, const Box& page);

/// Width of one line of text in the drawing's unit, by a built-in table close to DejaVu Sans (wider
/// than Arial, Helvetica and Liberation Sans: what fits by it fits with those).
double text_width(std::string_view text, double size, bool bold = false);

/// Lays drawings out in rows of `columns`, each cell as large as the largest drawing, gap between.
/// All must share one unit (InvalidInput otherwise). Names of their groups stay.
Drawing tile(const std::vector<Drawing>& drawings, int columns, double gap = 16);

/// Lays drawings out below one another, each as high as it is. Units as for tile().
Drawing stack(const std::vector<Drawing>& drawings, double gap = 16);

struct SvgOptions {
  std::string id_prefix = "k";  ///< start of every id, so that several fit in one HTML page
  bool standalone = true;       ///< false: no XML declaration, for inlining in HTML
};

/// SVG 1.1 text, UTF-8, text kept as <text>. Page positions are rounded to 0.01 unit. The same
/// drawing gives the same bytes. What is not finite is left out; names are escaped.
std::string write_svg(const Drawing& drawing, const SvgOptions& options = {});

/// One-page PDF with embedded fonts; no dates, so the same drawing gives the same bytes on one
/// machine. Fails with bad_input where the page is not between 1 px and 14,400 px.
core::Result<std::string> write_pdf(const Drawing& drawing);

/// PNG of `scale` pixels per px (1/96 inch). Fails with bad_input where the picture would be empty
/// or larger than 64 million pixels or 32,767 on a side.
core::Result<std::string> write_png(const Drawing& drawing, double scale = 2);

}  // namespace keyline::figure
