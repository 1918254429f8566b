#include "keyline/exchange/svg/svg_style.h"

#include <algorithm>
#include <array>

#include "keyline/core/leading_number.h"
#include "keyline/core/utf8.h"
#include "keyline/exchange/svg/svg_transform.h"
#include "keyline/exchange/text/ascii.h"

namespace keyline::exchange::detail {
namespace {

constexpr std::string_view kSpace = " \t\r\n\f";

bool paints(std::string_view value) { return value != "none" && value != "transparent"; }

/// The colour of a stroke or of what fills; empty, and told, where it is none that is known. Of a
/// pattern or gradient what stands for it.
std::string paint_of(SvgPaint& paint, std::string_view value) {
  if (!paints(value)) return {};
  if (value == "currentColor" || value == "currentcolor") return paint.current;
  std::string_view color = value;
  if (value.starts_with("url(")) {
    const std::size_t end = value.find(')');
    color = end == value.npos ? std::string_view{} : trimmed(value.substr(end + 1), kSpace);
    if (color == "none") return {};
  }
  std::string found = css_color(color);
  if (found.empty()) paint.unknown = value;
  return found;
}

/// Whether an opacity lets anything be seen; one that is no number is ignored.
bool shows(std::string_view opacity) {
  const auto number = core::leading_number(opacity);
  const bool whole =
      number && (number->length == opacity.size() || opacity.substr(number->length) == "%");
  return !whole || number->value > 0;
}

void declare(SvgPaint& paint, std::string_view name, std::string_view value) {
  value = trimmed(value.substr(0, value.find('!')), kSpace);
  if (value.empty() || value == "inherit") return;
  if (name == "stroke") {
    paint.stroke = paint_of(paint, value);
    paint.stroked = paints(value);
  }
  if (name == "fill") {
    paint.fill = paint_of(paint, value);
    paint.filled = paints(value);
  }
  if (name == "stroke-opacity") paint.stroke_opaque = shows(value);
  if (name == "fill-opacity") paint.fill_opaque = shows(value);
  if (name != "stroke-width") return;
  if (const auto width = parse_svg_length(value); width && width->value >= 0)
    paint.width = in_px(*width);
  else
    paint.unknown_width = value;
}

/// The colour that others call the current one.
void take_current(SvgPaint& paint, std::string_view name, std::string_view value) {
  if (name != "color") return;
  const std::string color = css_color(trimmed(value.substr(0, value.find('!')), kSpace));
  if (!color.empty()) paint.current = color;
}

/// What an element says by itself of being seen; the last that is said counts.
struct Sight {
  bool displayed = true;
  bool opaque = true;

  void take(SvgPaint& paint, std::string_view name, std::string_view value) {
    value = trimmed(value.substr(0, value.find('!')), kSpace);
    if (name == "display") displayed = value != "none";
    if (name == "opacity") opaque = shows(value);
    if (name != "visibility") return;
    if (value == "visible") paint.visible = true;
    if (value == "hidden" || value == "collapse") paint.visible = false;
  }
};

/// Calls each(name, value) for every declaration.
template <class Each>
void each_declaration(std::string_view text, Each each) {
  while (!text.empty()) {
    const std::string_view one = text.substr(0, text.find(';'));
    const std::size_t colon = one.find(':');
    if (colon != one.npos)
      each(trimmed(one.substr(0, colon), kSpace), trimmed(one.substr(colon + 1), kSpace));
    text.remove_prefix(std::min(text.size(), one.size() + 1));
  }
}

std::string without_comments(std::string_view css) {
  std::string result;
  for (std::size_t at = 0; at < css.size();) {
    const std::size_t start = css.find("/*", at);
    result += css.substr(at, start - at);
    if (start == css.npos) break;
    const std::size_t end = css.find("*/", start + 2);
    if (end == css.npos) break;
    at = end + 2;
  }
  return result;
}

}  // namespace

std::vector<std::string> SvgPaint::unread() const {
  std::vector<std::string> all;
  const auto tell = [&all](const char* what, std::string_view value, const char* why) {
    if (!value.empty())
      all.push_back(std::string(what) + " \"" + std::string(core::whole_characters(value, 40)) +
                    "\" " + why);
  };
  tell("the paint", unknown, "is no plain colour: none taken");
  tell("the stroke-width", unknown_width, "is no length: let pass");
  return all;
}

void SvgStyles::add_sheet(std::string_view css) {
  constexpr std::size_t kMost = 10'000;
  const std::string text = without_comments(css);
  std::string_view rest = text;
  while (rules_.size() < kMost) {
    const std::size_t open = rest.find('{');
    const std::size_t close = open == rest.npos ? open : rest.find('}', open);
    if (close == rest.npos) return;
    std::string_view selectors = rest.substr(0, open);
    const std::string_view body = rest.substr(open + 1, close - open - 1);
    while (!selectors.empty()) {
      const std::string_view one = selectors.substr(0, selectors.find(','));
      const std::string_view name = trimmed(one, kSpace);
      const bool plain = name.find_first_of(" >+~:[@") == name.npos;
      passed_ += !plain;
      if (!name.empty() && plain) rules_[std::string(name)].append(";").append(body);
      selectors.remove_prefix(std::min(selectors.size(), one.size() + 1));
    }
    rest.remove_prefix(close + 1);
  }
}

std::vector<std::string_view> SvgStyles::declarations(const pugi::xml_node& node) const {
  std::vector<std::string_view> all;
  const auto add_rule = [&](const std::string& selector) {
    if (const auto rule = rules_.find(selector); rule != rules_.end()) all.push_back(rule->second);
  };
  if (!rules_.empty()) {
    add_rule(node.name());
    std::string_view classes = node.attribute("class").value();
    while (!(classes = trimmed(classes, kSpace)).empty()) {
      const std::string_view one = classes.substr(0, classes.find_first_of(kSpace));
      add_rule("." + std::string(one));
      classes.remove_prefix(one.size());
    }
    if (const char* id = node.attribute("id").value(); *id) add_rule("#" + std::string(id));
  }
  if (const pugi::xml_attribute style = node.attribute("style")) all.push_back(style.value());
  return all;
}

SvgPaint SvgStyles::paint(const pugi::xml_node& node, SvgPaint paint) const {
  paint.unknown.clear();
  paint.unknown_width.clear();
  const auto declared = declarations(node);
  const auto each = [&](auto take) {
    for (const char* name : {"color", "stroke", "fill", "stroke-width", "stroke-opacity",
                             "fill-opacity", "display", "visibility", "opacity"})
      if (const pugi::xml_attribute own = node.attribute(name)) take(paint, name, own.value());
    for (const std::string_view some : declared)
      each_declaration(
          some, [&](std::string_view name, std::string_view value) { take(paint, name, value); });
  };
  each(take_current);
  each(declare);
  Sight sight;
  each([&sight](SvgPaint& own, std::string_view name, std::string_view value) {
    sight.take(own, name, value);
  });
  paint.cut_out = paint.cut_out || !sight.displayed || !sight.opaque;
  return paint;
}

bool SvgStyles::declares(const pugi::xml_node& node, std::span<const char* const> names) const {
  bool found = false;
  for (const std::string_view some : declarations(node))
    each_declaration(some, [&](std::string_view name, std::string_view value) {
      found = found || (value != "none" && std::ranges::find(names, name) != names.end());
    });
  return found;
}

bool SvgStyles::moves(const pugi::xml_node& node) const {
  static constexpr std::array kMoving{"transform", "transform-origin", "translate", "rotate",
                                      "scale"};
  return node.attribute("transform-origin") || declares(node, kMoving);
}

bool SvgStyles::clips(const pugi::xml_node& node) const {
  static constexpr std::array kClipping{"clip-path", "mask"};
  const auto by_attribute = [&node](const char* name) {
    const std::string_view value = node.attribute(name).value();
    return !value.empty() && value != "none";
  };
  return std::ranges::any_of(kClipping, by_attribute) || declares(node, kClipping);
}

}  // namespace keyline::exchange::detail
