#include "keyline/exchange/svg/svg_unseen.h"

#include <algorithm>
#include <array>
#include <set>

#include "keyline/core/text.h"
#include "keyline/exchange/svg/svg_shapes.h"
#include "keyline/exchange/svg/svg_text.h"

namespace keyline::exchange::detail {

bool is_svg_definition(std::string_view name) {
  static constexpr auto kNames =
      std::to_array<std::string_view>({"defs", "symbol", "clipPath", "mask", "marker", "pattern"});
  return std::ranges::find(kNames, name) != kNames.end();
}

void SvgUnseen::take_hidden(const pugi::xml_node& shape) {
  if (hidden_++ == 0) first_hidden_ = shape;
}

std::vector<std::pair<pugi::xml_node, std::string>> SvgUnseen::told(
    const pugi::xml_node& root) const {
  std::vector<std::pair<pugi::xml_node, std::string>> lines;
  if (hidden_ > 0)
    lines.emplace_back(first_hidden_,
                       core::counted(hidden_, "shape") +
                           " that display, visibility or opacity hides, read like the others");
  std::vector<pugi::xml_node> within;  // definitions, outermost first
  std::set<std::string> kinds;
  std::size_t count = 0;
  pugi::xml_node first;
  const auto enter = [&](const pugi::xml_node& node) {
    const std::string_view name = local_name(node);
    if (is_svg_definition(name)) within.push_back(node);
    if (within.empty() || !is_svg_shape(name) || used_.contains(node.internal_object())) return;
    kinds.insert(std::string(local_name(within.back())));
    if (count++ == 0) first = node;
  };
  walk_svg(root, enter, [&](const pugi::xml_node& node) {
    if (!within.empty() && within.back() == node) within.pop_back();
  });
  std::string where;
  for (const std::string& kind : kinds) where += (where.empty() ? "" : ", ") + kind;
  if (count > 0)
    lines.emplace_back(first, core::counted(count, "shape") + " of definitions (" + where +
                                  ") that nothing draws");
  return lines;
}

}  // namespace keyline::exchange::detail
