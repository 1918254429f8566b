#include "keyline/figure/painter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keyline/figure/text.h"

namespace keyline::figure::detail {

using core::Point2;

namespace {

constexpr double kFarAway = 1e6;

bool on_page(Point2 p) { return std::abs(p.x) <= kFarAway && std::abs(p.y) <= kFarAway; }

/// Steps far off the page count as not finite, too: painters work with limited numbers.
Path paintable(const Path& path) {
  Path near = path;
  for (PathStep& step : near.steps)
    for (Point2& p : step.point)
      if (!on_page(p)) p = {NAN, NAN};
  return finite_part(near);
}

void add_marker(Path& path, Marker marker, Point2 c, double size) {
  const double r = size / 2;
  const auto at = [c, r](double x, double y) { return Point2{c.x + r * x, c.y + r * y}; };
  switch (marker) {
    case Marker::dot:
    case Marker::circle: {
      const Path ring = circle(c, r);
      path.steps.insert(path.steps.end(), ring.steps.begin(), ring.steps.end());
      return;
    }
    case Marker::square: {
      const double a = 0.89;
      path.move_to(at(-a, -a)).line_to(at(a, -a)).line_to(at(a, a)).line_to(at(-a, a)).close();
      return;
    }
    case Marker::diamond:
      path.move_to(at(0, -1.2)).line_to(at(1.2, 0)).line_to(at(0, 1.2)).line_to(at(-1.2, 0));
      path.close();
      return;
    case Marker::triangle:
      path.move_to(at(0, -1.1)).line_to(at(1, 0.75)).line_to(at(-1, 0.75)).close();
      return;
    case Marker::cross:
      path.move_to(at(-0.8, -0.8)).line_to(at(0.8, 0.8));
      path.move_to(at(-0.8, 0.8)).line_to(at(0.8, -0.8));
      return;
    case Marker::plus:
      path.move_to(at(-1, 0)).line_to(at(1, 0)).move_to(at(0, -1)).line_to(at(0, 1));
      return;
  }
}

void paint_marks(const Marks& marks, Painter& painter) {
  Marks near = marks;
  std::erase_if(near.points, [](Point2 p) { return !on_page(p); });
  if (near.points.empty() || !(marks.size > 0)) return;
  if (marks.marker == Marker::dot) return painter.dots(near);
  Shape shape;
  for (const Point2& p : near.points) add_marker(shape.path, marks.marker, p, marks.size);
  const bool lines = marks.marker == Marker::cross || marks.marker == Marker::plus;
  shape.stroke = Stroke{marks.color, std::max(0.25 * marks.size, 0.8), {}};
  if (!lines && marks.marker != Marker::circle) {
    shape.stroke.reset();
    shape.fill = marks.color;
  }
  if (marks.marker == Marker::circle) shape.fill = kPaper;
  painter.shape(shape);
}

void paint_items(const std::vector<Item>& items, Painter& painter);

void paint_item(const Shape& shape, Painter& painter) {
  Shape near{paintable(shape.path), shape.stroke, shape.fill};
  if (near.stroke && !(near.stroke->width > 0 && near.stroke->width < kFarAway))
    near.stroke.reset();
  if (!near.path.steps.empty() && (near.stroke || near.fill)) painter.shape(near);
}

void paint_item(const Label& label, Painter& painter) {
  if (!on_page(label.at) || !std::isfinite(label.rotation)) return;
  if (!(label.size > 0 && label.size < kFarAway)) return;
  Label clean = label;
  clean.text = clean_text(label.text);
  if (!(clean.halo > 0 && clean.halo < kFarAway)) clean.halo = 0;
  if (!clean.text.empty()) painter.label(clean);
}

void paint_item(const Marks& marks, Painter& painter) { paint_marks(marks, painter); }

void paint_item(const Picture& picture, Painter& painter) {
  const auto& p = picture;
  if (p.columns < 1 || p.rows < 1 || is_empty(p.box)) return;
  if (!on_page(p.box.min) || !on_page(p.box.max)) return;
  const auto bytes =
      std::size_t{3} * static_cast<std::size_t>(p.columns) * static_cast<std::size_t>(p.rows);
  if (p.rgb.size() == bytes) painter.picture(p);
}

void paint_item(const Group& group, Painter& painter) {
  painter.begin_group(group);
  paint_items(group.items, painter);
  painter.end_group(group);
}

void paint_items(const std::vector<Item>& items, Painter& painter) {
  for (const Item& item : items)
    std::visit([&painter](const auto& value) { paint_item(value, painter); }, item.value);
}

}  // namespace

void paint(const Drawing& drawing, Painter& painter) { paint_items(drawing.items, painter); }

}  // namespace keyline::figure::detail
