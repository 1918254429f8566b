#include "keyline/exchange/svg/svg_unseen.h"

#include <algorithm>
#include <array>
#include <set>

#include "keyline/core/text.h"
#include "keyline/exchange/svg/svg_shapes.h"

namespace keyline::exchange::detail {

bool is_svg_definition(std::string_view name) {
  static constexpr auto kNames =
      std::to_array<std::string_view>({"defs", "symbol", "clipPath", "mask", "marker", "pattern"});
  return std::ranges::find(kNames, name) != kNames.end();
}

bool may_switch_to(const pugi::xml_node& child) {
  const std::string_view language = child.attribute("systemLanguage").value();
  const bool spoken = !child.attribute("systemLanguage") || language.find("en") != language.npos;
  return spoken && *child.attribute("requiredExtensions").value() == '\0';
}

void SvgUnseen::take_alternative(const pugi::xml_node& child) {
  const auto enter = [this](const pugi::xml_node& node) {
    if (is_svg_shape(local_name(node))) alternatives_.take(node);
  };
  walk_svg(child, enter, [](const pugi::xml_node&) {});
}

std::vector<std::pair<pugi::xml_node, std::string>> SvgUnseen::told(
    const pugi::xml_node& root) const {
  std::vector<std::pair<pugi::xml_node, std::string>> lines;
  const auto tell = [&lines](const Shapes& shapes, const char* what) {
    if (shapes.count > 0)
      lines.emplace_back(shapes.first, core::counted(shapes.count, "shape") + what);
  };
  tell(hidden_, " that display, visibility or opacity hides, read like the others");
  tell(unpainted_, " that neither stroke nor fill paints, read like the others");
  tell(alternatives_, " of alternatives that a switch does not show");
  std::vector<pugi::xml_node> within;  // definitions, outermost first
  std::set<std::string> kinds;
  Shapes defined;
  const auto enter = [&](const pugi::xml_node& node) {
    const std::string_view name = local_name(node);
    if (is_svg_definition(name)) within.push_back(node);
    if (within.empty() || !is_svg_shape(name) || used_.contains(node.internal_object())) return;
    kinds.insert(std::string(local_name(within.back())));
    defined.take(node);
  };
  walk_svg(root, enter, [&](const pugi::xml_node& node) {
    if (!within.empty() && within.back() == node) within.pop_back();
  });
  std::string where;
  for (const std::string& kind : kinds) where += (where.empty() ? "" : ", ") + kind;
  tell(defined, (" of definitions (" + where + ") that nothing draws").c_str());
  return lines;
}

}  // namespace keyline::exchange::detail
