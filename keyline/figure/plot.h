#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/figure/drawing.h"
#include "keyline/figure/ticks.h"

namespace keyline::figure {

/// A chart over two axes as plain data; draw() lays it out so that no text runs into another.

struct Axis {
  std::string title = {};
  Scale scale = Scale::linear;
  std::optional<double> low = {};   ///< empty: from the data
  std::optional<double> high = {};  ///< empty: from the data
};

enum class SeriesKind { line, points, bars };

/// Points that are not finite (or not positive on a log axis) are left out and break a line.
struct Series {
  std::string name = {};  ///< legend text; empty: not in the legend
  std::vector<core::Point2> points = {};
  SeriesKind kind = SeriesKind::line;
  Color color = kInk;
  double width = 1.6;             ///< of the line, px
  std::vector<double> dash = {};  ///< of the line, px
  Marker marker = Marker::dot;
  double size = 4;         ///< of the markers, px
  double bar_width = 1;    ///< in x axis units
  bool sets_range = true;  ///< false: cut where it leaves the range of the others
};

/// Line across the whole chart at one value.
struct Rule {
  double at = 0;
  bool vertical = true;
  Color color = kFrame;
  std::vector<double> dash = {3, 3};
  std::string name = {};  ///< legend text; may be empty
};

/// Stretch of the x axis, shaded where `shaded`, with its name at the top if it fits.
struct Band {
  double from = 0;
  double to = 0;
  std::string name = {};
  bool shaded = false;
};

/// Text beside a point of the chart.
struct Note {
  core::Point2 at = {};
  std::string text = {};
  Color color = kInk;
  Anchor anchor = Anchor::start;
  core::Vector2 offset{6, -6};  ///< px on the page, y down
  bool bold = false;
};

struct Plot {
  std::string title = {};
  std::string subtitle = {};
  Axis x = {};
  Axis y = {};
  std::vector<Series> series = {};
  std::vector<Rule> rules = {};
  std::vector<Band> bands = {};
  std::vector<Note> notes = {};
  std::vector<Path> regions = {};  ///< filled areas in axis units, under everything
  Color region_color{222, 236, 246};
  bool first_on_top = false;  ///< paint from last to first; the legend keeps its order
  double width = 720;         ///< px, at least 160
  double height = 320;        ///< px, at least 120
};

/// Throws InvalidInput for sizes below the least or a given axis range that is empty.
Drawing draw(const Plot& plot);

}  // namespace keyline::figure
