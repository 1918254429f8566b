#include "keyline/figure/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace keyline::figure {

using core::Point2;

void Group::add(Shape item) { items.emplace_back(std::move(item)); }
void Group::add(Label item) { items.emplace_back(std::move(item)); }
void Group::add(Marks item) { items.emplace_back(std::move(item)); }

void Drawing::add(Shape item) { items.emplace_back(std::move(item)); }
void Drawing::add(Label item) { items.emplace_back(std::move(item)); }
void Drawing::add(Marks item) { items.emplace_back(std::move(item)); }
void Drawing::add(Picture item) { items.emplace_back(std::move(item)); }
void Drawing::add(Group item) { items.emplace_back(std::move(item)); }

Path to_page(const Viewport& v, const Path& path) {
  Path mapped = path;
  for (PathStep& step : mapped.steps)
    for (Point2& p : step.point) p = to_page(v, p);
  return mapped;
}

std::vector<Point2> to_page(const Viewport& v, const std::vector<Point2>& points) {
  std::vector<Point2> mapped;
  mapped.reserve(points.size());
  for (const Point2& p : points) mapped.push_back(to_page(v, p));
  return mapped;
}

Viewport fit_viewport(const Box& model, const Box& page) {
  const Box box = is_empty(model) ? Box{{0, 0}, {0, 0}} : model;
  const double across = std::min(width(page) / width(box), height(page) / height(box));
  const double scale = std::isfinite(across) && across > 0 ? across : 1;
  const Point2 model_center{box.min.x / 2 + box.max.x / 2, box.min.y / 2 + box.max.y / 2};
  const Point2 page_center = core::mix(page.min, page.max, 0.5);
  return {scale, {page_center.x - scale * model_center.x, page_center.y + scale * model_center.y}};
}

double text_width(std::string_view text, double size, bool bold) {
  // Advance widths of the printable ASCII characters in thousandths of the em.
  static constexpr std::array<short, 95> kAdvance = {
      318,  401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337,
      636,  636, 636, 636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531,
      1000, 684, 686, 698, 770, 632, 575, 775, 752, 295, 295, 656, 557, 863, 748, 787,
      603,  787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838, 500,
      500,  613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612,
      635,  635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636, 337, 636, 838};
  double sum = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7F) sum += kAdvance[byte - 0x20];
    if (byte >= 0xC0) sum += byte >= 0xE3 ? 1000 : 640;  // one per character; wide scripts wide
  }
  return sum * size / 1000 * (bold ? 1.12 : 1);
}

namespace {

Path shifted(const Path& path, core::Vector2 by) {
  Path moved = path;
  for (PathStep& step : moved.steps)
    for (Point2& p : step.point) p = p + by;
  return moved;
}

Box shifted(const Box& box, core::Vector2 by) { return {box.min + by, box.max + by}; }

void shift(Shape& shape, core::Vector2 by) { shape.path = shifted(shape.path, by); }
void shift(Label& label, core::Vector2 by) { label.at = label.at + by; }
void shift(Picture& picture, core::Vector2 by) { picture.box = shifted(picture.box, by); }
void shift(Marks& marks, core::Vector2 by) {
  for (Point2& p : marks.points) p = p + by;
}
void shift(Group& group, core::Vector2 by) {
  if (group.clip) group.clip = shifted(*group.clip, by);
  for (Item& item : group.items) std::visit([by](auto& value) { shift(value, by); }, item.value);
}

}  // namespace

Drawing tile(const std::vector<Drawing>& drawings, int columns, double gap) {
  Drawing page;
  if (drawings.empty()) return page;
  Point2 cell;
  for (const Drawing& d : drawings) {
    if (d.unit != drawings[0].unit) throw core::InvalidInput("tile: drawings differ in unit");
    cell = {std::max(cell.x, d.width), std::max(cell.y, d.height)};
  }
  const auto across = static_cast<std::size_t>(
      std::clamp(columns, 1, static_cast<int>(std::min<std::size_t>(drawings.size(), 1000))));
  const std::size_t down = (drawings.size() + across - 1) / across;
  page.unit = drawings[0].unit;
  page.width = cell.x * static_cast<double>(across) + gap * static_cast<double>(across - 1);
  page.height = cell.y * static_cast<double>(down) + gap * static_cast<double>(down - 1);
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    const std::size_t row = i / across;
    const core::Vector2 by{(cell.x + gap) * static_cast<double>(i % across),
                           (cell.y + gap) * static_cast<double>(row)};
    Group group{drawings[i].title, std::nullopt, drawings[i].items};
    shift(group, by);
    page.add(std::move(group));
  }
  return page;
}

Drawing stack(const std::vector<Drawing>& drawings, double gap) {
  Drawing page;
  if (drawings.empty()) return page;
  page.unit = drawings[0].unit;
  page.width = page.height = 0;
  for (const Drawing& d : drawings) {
    if (d.unit != page.unit) throw core::InvalidInput("stack: drawings differ in unit");
    if (page.height > 0) page.height += gap;
    Group group{d.title, std::nullopt, d.items};
    shift(group, {0, page.height});
    page.add(std::move(group));
    page.width = std::max(page.width, d.width);
    page.height += d.height;
  }
  return page;
}

}  // namespace keyline::figure
