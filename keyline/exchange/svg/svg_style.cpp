#include "keyline/exchange/svg/svg_style.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "keyline/core/leading_number.h"
#include "keyline/core/utf8.h"
#include "keyline/exchange/svg/svg_shapes.h"
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
  if (name == "vector-effect") paint.fixed_width = value.contains("non-scaling-stroke");
  if (name != "stroke-width") return;
  if (const auto width = parse_svg_length(value); width && width->value >= 0)
    paint.width = in_px(*width);
  else
    paint.unknown_width = value;
}

/// The colour that others call the current one.
void take_current(SvgPaint& paint, std::string_view name, std::string_view value) {
  if (name != "color") return;
  const std::string color = css_color(value);
  if (!color.empty()) paint.current = color;
}

/// What an element says by itself of being seen; the last that is said counts.
struct Sight {
  bool displayed = true;
  bool opaque = true;

  void take(SvgPaint& paint, std::string_view name, std::string_view value) {
    if (name == "display") displayed = value != "none";
    if (name == "opacity") opaque = shows(value);
    if (name != "visibility") return;
    if (value == "visible") paint.visible = true;
    if (value == "hidden" || value == "collapse") paint.visible = false;
  }
};

std::string_view without_mark(std::string_view value) {
  return trimmed(value.substr(0, value.find('!')), kSpace);
}

/// Whether a value has the mark "!important", or none where that is not wanted.
bool is_marked(std::string_view value, bool wanted) {
  const std::size_t mark = value.find('!');
  if (mark == value.npos) return !wanted;
  return wanted && lower_case(trimmed(value.substr(mark + 1), kSpace)) == "important";
}

/// Calls each(name, value) for every declaration that is important, or for every other.
template <class Each>
void each_declaration(std::string_view text, bool important, Each each) {
  while (!text.empty()) {
    const std::string_view one = text.substr(0, text.find(';'));
    const std::size_t colon = one.find(':');
    if (colon != one.npos && is_marked(one.substr(colon + 1), important))
      each(trimmed(one.substr(0, colon), kSpace), without_mark(one.substr(colon + 1)));
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

/// Where one of `wanted` stands outside of strings and round brackets, not behind a backslash; the
/// size where none does. A string ends at the end of its line (CSS Syntax 3, 4.3.5).
std::size_t find_bare(std::string_view css, std::string_view wanted, std::size_t from) {
  int brackets = 0;
  char quote = 0;
  for (std::size_t at = from; at < css.size(); ++at) {
    const char c = css[at];
    if (c == '\\') {
      ++at;
      continue;
    }
    if (quote != 0) {
      if (c == quote || c == '\n' || c == '\r' || c == '\f') quote = 0;
      continue;
    }
    if (c == '"' || c == '\'') quote = c;
    if (brackets == 0 && wanted.contains(c)) return at;
    if (c == '(') ++brackets;
    if (c == ')' && brackets > 0) --brackets;
  }
  return css.size();
}

/// The length of a mark that hides sheets from old readers of HTML, and says nothing; else 0.
std::size_t html_mark(std::string_view css) {
  return css.starts_with("<!--") ? 4 : css.starts_with("-->") ? 3 : 0;
}

/// Where the block that begins at `open` is closed; the size where it is not.
std::size_t end_of_block(std::string_view css, std::size_t open) {
  std::size_t at = open;
  for (int depth = 1; depth > 0 && at < css.size();) {
    at = find_bare(css, "{}", at + 1);
    if (at < css.size()) depth += css[at] == '{' ? 1 : -1;
  }
  return at;
}

/// Whether a rule with @ styles nothing by itself.
bool is_declarative(std::string_view rule) {
  static constexpr auto kNames =
      std::to_array<std::string_view>({"@charset", "@namespace", "@font-face"});
  const std::string name = lower_case(rule.substr(0, rule.find_first_of(" \t\r\n\f{;\"'")));
  return std::ranges::find(kNames, name) != kNames.end();
}

/// Of names in CSS those without escapes.
bool is_plain_name(std::string_view text) {
  const auto is_part = [](unsigned char c) {
    return c >= 0x80 || c == '-' || c == '_' || std::isalnum(c) != 0;
  };
  return !text.empty() && std::ranges::all_of(text, is_part);
}

/// "*", "name", ".class", "name.class" and "#id".
bool is_followed(std::string_view selector) {
  if (selector == "*" || is_plain_name(selector)) return true;
  const std::size_t mark = selector.find_first_of(".#");
  if (mark == selector.npos || !is_plain_name(selector.substr(mark + 1))) return false;
  return mark == 0 || (selector[mark] == '.' && is_plain_name(selector.substr(0, mark)));
}

void add_once(std::vector<std::size_t>& ascending, std::size_t value) {
  if (ascending.empty() || ascending.back() != value) ascending.push_back(value);
}

/// Each once.
std::vector<std::string_view> classes_of(const pugi::xml_node& node) {
  std::vector<std::string_view> all;
  std::string_view rest = node.attribute("class").value();
  while (!(rest = trimmed(rest, kSpace)).empty()) {
    all.push_back(rest.substr(0, rest.find_first_of(kSpace)));
    rest.remove_prefix(all.back().size());
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
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
  const std::string text = without_comments(css);
  for (std::string_view rest = text; !(rest = trimmed(rest, kSpace)).empty();) {
    if (const std::size_t mark = html_mark(rest); mark > 0) {
      rest.remove_prefix(mark);
      continue;
    }
    const bool at_rule = rest.front() == '@';
    const std::size_t open = find_bare(rest, at_rule ? "{;" : "{", 0);
    const bool block = open < rest.size() && rest[open] == '{';
    const std::size_t end = block ? end_of_block(rest, open) : open;
    if (at_rule)
      passed_ += !is_declarative(rest);
    else if (block)  // the last may be closed by the end alone
      add_rule(rest.substr(0, open), rest.substr(open + 1, end - open - 1));
    else
      ++passed_;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

void SvgStyles::add_sheet(const pugi::xml_node& style) {
  std::string css;
  for (const pugi::xml_node& part : style.children())
    if (part.type() == pugi::node_pcdata || part.type() == pugi::node_cdata) css += part.value();
  add_sheet(css);
}

void SvgStyles::add_rule(std::string_view selectors, std::string_view body) {
  constexpr std::size_t kMost = 10'000;
  if (body.find('{') != body.npos) {  // rules within a rule
    ++passed_;
    return;
  }
  bodies_.emplace_back(body);
  while (!selectors.empty()) {
    const std::string_view one = selectors.substr(0, selectors.find(','));
    const std::string_view selector = trimmed(one, kSpace);
    const bool taken = is_followed(selector) && taken_ < kMost;
    taken_ += taken;
    passed_ += !taken;
    if (taken) add_once(rules_[std::string(selector)], bodies_.size() - 1);
    selectors.remove_prefix(std::min(selectors.size(), one.size() + 1));
  }
}

std::vector<std::string_view> SvgStyles::declarations(const pugi::xml_node& node) const {
  std::vector<std::string_view> all;
  std::vector<std::size_t> found;
  const auto find = [&](const std::string& selector) {
    const auto rules = rules_.find(selector);
    if (rules != rules_.end())
      found.insert(found.end(), rules->second.begin(), rules->second.end());
  };
  // Of selectors that are equally specific the order in the sheets decides.
  const auto take_found = [&] {
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    for (const std::size_t body : found) all.push_back(bodies_[body]);
    found.clear();
  };
  if (!rules_.empty()) {
    const std::string name(local_name(node));
    find("*");
    take_found();
    find(name);
    take_found();
    const std::vector<std::string_view> classes = classes_of(node);
    for (const std::string& before : {std::string(), name}) {
      for (const std::string_view one : classes) find(before + "." + std::string(one));
      take_found();
    }
    if (const char* id = node.attribute("id").value(); *id) find("#" + std::string(id));
    take_found();
  }
  if (const pugi::xml_attribute style = node.attribute("style")) all.push_back(style.value());
  return all;
}

SvgPaint SvgStyles::paint(const pugi::xml_node& node, SvgPaint paint) const {
  paint.unknown.clear();
  paint.unknown_width.clear();
  paint.fixed_width = false;
  const auto declared = declarations(node);
  const auto each = [&](auto take) {
    for (const char* name : {"color", "stroke", "fill", "stroke-width", "stroke-opacity",
                             "fill-opacity", "vector-effect", "display", "visibility", "opacity"})
      if (const pugi::xml_attribute own = node.attribute(name))
        take(paint, name, without_mark(own.value()));
    for (const bool important : {false, true})
      for (const std::string_view some : declared)
        each_declaration(some, important, [&](std::string_view name, std::string_view value) {
          take(paint, name, value);
        });
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
  const auto take = [&](std::string_view name, std::string_view value) {
    found = found || (value != "none" && std::ranges::find(names, name) != names.end());
  };
  for (const std::string_view some : declarations(node))
    for (const bool important : {false, true}) each_declaration(some, important, take);
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
