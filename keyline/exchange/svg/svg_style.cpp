#include "keyline/exchange/svg/svg_style.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "keyline/exchange/svg/svg_path.h"
#include "keyline/exchange/svg/svg_transform.h"

namespace keyline::exchange::detail {
namespace {

constexpr std::string_view kSpace = " \t\r\n\f";

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(kSpace);
  if (from == text.npos) return {};
  return text.substr(from, text.find_last_not_of(kSpace) - from + 1);
}

std::string named_color(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, const char*>, 30> kNames = {{
      {"black", "#000000"},     {"silver", "#c0c0c0"},   {"gray", "#808080"},
      {"grey", "#808080"},      {"white", "#ffffff"},    {"maroon", "#800000"},
      {"red", "#ff0000"},       {"purple", "#800080"},   {"fuchsia", "#ff00ff"},
      {"magenta", "#ff00ff"},   {"green", "#008000"},    {"lime", "#00ff00"},
      {"olive", "#808000"},     {"yellow", "#ffff00"},   {"navy", "#000080"},
      {"blue", "#0000ff"},      {"teal", "#008080"},     {"aqua", "#00ffff"},
      {"cyan", "#00ffff"},      {"orange", "#ffa500"},   {"brown", "#a52a2a"},
      {"pink", "#ffc0cb"},      {"gold", "#ffd700"},     {"crimson", "#dc143c"},
      {"darkgray", "#a9a9a9"},  {"darkgrey", "#a9a9a9"}, {"lightgray", "#d3d3d3"},
      {"lightgrey", "#d3d3d3"}, {"darkblue", "#00008b"}, {"darkred", "#8b0000"},
  }};
  for (const auto& [known, value] : kNames)
    if (known == name) return value;
  return {};
}

std::string hex(std::string_view digits) {
  static constexpr std::string_view kHex = "0123456789abcdefABCDEF";
  if (digits.find_first_not_of(kHex) != digits.npos) return {};
  std::string color = "#";
  if (digits.size() == 3 || digits.size() == 4)
    for (const char c : digits.substr(0, 3)) color += {c, c};
  else if (digits.size() == 6 || digits.size() == 8)
    color += digits.substr(0, 6);
  else
    return {};
  for (char& c : color)
    if (c >= 'A' && c <= 'F') c = static_cast<char>(c - 'A' + 'a');
  return color;
}

/// What stands in the brackets of rgb().
std::string rgb(std::string_view text) {
  static constexpr char kDigits[] = "0123456789abcdef";
  SvgScanner scan(text);
  std::string color = "#";
  for (int i = 0; i < 3; ++i) {
    double value = 0;
    scan.skip_space();
    if (!scan.number(value)) return {};
    if (scan.peek() == '%') {
      scan.take();
      value = value * 255 / 100;  // 50 % are 127.5: 2.55 would round them down
    }
    const auto byte = static_cast<unsigned>(std::lround(std::clamp(value, 0.0, 255.0)));
    color += {kDigits[byte >> 4], kDigits[byte & 15]};
    scan.skip_separator();
  }
  return color;
}

void declare(SvgPaint& paint, std::string_view name, std::string_view value) {
  value = trimmed(value.substr(0, value.find('!')));
  if (value.empty() || value == "inherit") return;
  if (name == "stroke") paint.stroke = css_color(value);
  if (name == "fill") paint.fill = css_color(value);
  if (name != "stroke-width") return;
  if (const auto width = parse_svg_length(value); width && width->value >= 0)
    paint.width = in_px(*width);
}

/// Calls each(name, value) for every declaration.
template <class Each>
void each_declaration(std::string_view text, Each each) {
  while (!text.empty()) {
    const std::string_view one = text.substr(0, text.find(';'));
    const std::size_t colon = one.find(':');
    if (colon != one.npos) each(trimmed(one.substr(0, colon)), trimmed(one.substr(colon + 1)));
    text.remove_prefix(std::min(text.size(), one.size() + 1));
  }
}

void declare_all(SvgPaint& paint, std::string_view text) {
  each_declaration(text, [&paint](std::string_view name, std::string_view value) {
    declare(paint, name, value);
  });
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

std::string css_color(std::string_view text) {
  if (text.starts_with('#')) return hex(text.substr(1));
  if (text.starts_with("rgb(") || text.starts_with("rgba("))
    return rgb(text.substr(text.find('(') + 1));
  std::string name(text);
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return named_color(name);
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
      const std::string_view name = trimmed(one);
      if (!name.empty() && name.find_first_of(" >+~:[@") == name.npos)
        rules_[std::string(name)].append(";").append(body);
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
    while (!(classes = trimmed(classes)).empty()) {
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
  for (const char* name : {"stroke", "fill", "stroke-width"})
    if (const pugi::xml_attribute own = node.attribute(name)) declare(paint, name, own.value());
  for (const std::string_view some : declarations(node)) declare_all(paint, some);
  return paint;
}

bool SvgStyles::moves(const pugi::xml_node& node) const {
  constexpr std::array kMoving{"transform", "transform-origin", "translate", "rotate", "scale"};
  if (node.attribute("transform-origin")) return true;
  bool moved = false;
  for (const std::string_view some : declarations(node))
    each_declaration(some, [&](std::string_view name, std::string_view value) {
      moved = moved || (value != "none" && std::ranges::find(kMoving, name) != kMoving.end());
    });
  return moved;
}

}  // namespace keyline::exchange::detail
