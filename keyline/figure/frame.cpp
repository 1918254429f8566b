#include "keyline/figure/frame.h"

#include <algorithm>

#include "keyline/figure/painter.h"
#include "keyline/figure/text.h"

namespace keyline::figure::detail {

using core::Point2;

namespace {

constexpr double kSampleWidth = 22;
constexpr double kRowHeight = 17;

void add_sample(Drawing& drawing, const LegendEntry& entry, Point2 left) {
  const Point2 center{left.x + kSampleWidth / 2, left.y};
  if (entry.sample == LegendEntry::Sample::marker) {
    drawing.add(Marks{{center}, entry.marker, std::max(entry.size, 5.0), entry.color});
  } else if (entry.sample == LegendEntry::Sample::bar) {
    const Box box{{center.x - 6, center.y - 5}, {center.x + 6, center.y + 5}};
    drawing.add(Shape{rectangle(box), std::nullopt, entry.color});
  } else {
    Path line;
    line.move_to(left).line_to({left.x + kSampleWidth, left.y});
    drawing.add(Shape{line, Stroke{entry.color, std::max(entry.width, 1.2), entry.dash}, {}});
  }
}

}  // namespace

std::string shortened(const std::string& text, double width, double size, bool bold) {
  std::string clean = clean_text(text);
  if (text_width(clean, size, bold) <= width) return clean;
  const double room = width - text_width("\u2026", size, bold);
  while (!clean.empty() && text_width(clean, size, bold) > room) {
    while (!clean.empty() && (static_cast<unsigned char>(clean.back()) & 0xC0) == 0x80)
      clean.pop_back();
    if (!clean.empty()) clean.pop_back();
  }
  return clean + "\u2026";
}

double add_heading(Drawing& drawing, const std::string& title, const std::string& subtitle,
                   const std::vector<LegendEntry>& legend) {
  const double room = drawing.width - 2 * kPad;
  double y = kPad;
  if (!title.empty()) {
    const Point2 at{kPad, y + 0.85 * kTitleSize};
    drawing.add(Label{.at = at,
                      .text = shortened(title, room, kTitleSize, true),
                      .size = kTitleSize,
                      .bold = true});
    y += 20;
  }
  if (!subtitle.empty()) {
    const Point2 at{kPad, y + 0.85 * kTextSize};
    drawing.add(Label{.at = at,
                      .text = shortened(subtitle, room, kTextSize),
                      .size = kTextSize,
                      .color = kSoftInk});
    y += 17;
  }
  if (legend.empty()) return y + 2;
  double x = kPad;
  for (const LegendEntry& entry : legend) {
    const std::string name = shortened(entry.name, room - kSampleWidth - 6, kTextSize);
    const double needed = kSampleWidth + 6 + text_width(name, kTextSize);
    if (x > kPad && x + needed > drawing.width - kPad) {
      x = kPad;
      y += kRowHeight;
    }
    add_sample(drawing, entry, {x, y + kRowHeight / 2});
    drawing.add(Label{.at = {x + kSampleWidth + 6, y + kRowHeight / 2},
                      .text = name,
                      .size = kTextSize,
                      .baseline = Baseline::middle});
    x += needed + 18;
  }
  return y + kRowHeight + 4;
}

}  // namespace keyline::figure::detail
