#include "keyline/exchange/svg/xml_oddities.h"

#include <algorithm>
#include <string_view>

#include "keyline/core/text.h"
#include "keyline/exchange/svg/svg_unseen.h"

namespace keyline::exchange::detail {
namespace {

/// `names` only saves memory from being taken anew for every element.
bool has_attribute_twice(const pugi::xml_node& node, std::vector<std::string_view>& names) {
  names.clear();
  for (const pugi::xml_attribute& attribute : node.attributes()) names.push_back(attribute.name());
  std::ranges::sort(names);
  return std::adjacent_find(names.begin(), names.end()) != names.end();
}

}  // namespace

std::vector<std::pair<pugi::xml_node, std::string>> xml_oddities(const pugi::xml_node& root) {
  std::vector<std::pair<pugi::xml_node, std::string>> lines;
  pugi::xml_node first;
  std::size_t twice = 0;
  std::vector<std::string_view> names;
  const auto enter = [&](const pugi::xml_node& node) {
    if (!has_attribute_twice(node, names)) return;
    if (twice++ == 0) first = node;
  };
  walk_svg(root, enter, [](const pugi::xml_node&) {});
  if (twice > 0)
    lines.emplace_back(first, core::counted(twice, "element") +
                                  " with an attribute twice, the first of which is taken");
  for (const pugi::xml_node& before : root.parent().children())
    if (before.type() == pugi::node_pi && std::string_view(before.name()) == "xml-stylesheet")
      lines.emplace_back(before, "a style sheet that <?xml-stylesheet?> names: not followed");
  for (pugi::xml_node next = root.next_sibling(); next; next = next.next_sibling()) {
    if (next.type() != pugi::node_element) continue;
    lines.emplace_back(next, "what stands behind the end of <" + std::string(root.name()) + '>');
    break;
  }
  return lines;
}

}  // namespace keyline::exchange::detail
