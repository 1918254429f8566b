#pragma once

#include <cstddef>
#include <pugixml.hpp>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace keyline::exchange::detail {

/// Calls enter(node) and, behind all that is within it, leave(node), without recursion.
template <class Enter, class Leave>
void walk_svg(const pugi::xml_node& root, Enter enter, Leave leave) {
  pugi::xml_node node = root;
  while (node) {
    enter(node);
    if (node.first_child()) {
      node = node.first_child();
      continue;
    }
    leave(node);
    while (node != root && !node.next_sibling()) {
      node = node.parent();
      leave(node);
    }
    node = node != root ? node.next_sibling() : pugi::xml_node();
  }
}

/// Counts what a viewer does not show: shapes that are read though their style hides them, and
/// those of definitions that nothing shows, which are not.
class SvgUnseen {
 public:
  void take_hidden(const pugi::xml_node& shape);
  /// A shape that <use> has brought in.
  void take_used(const pugi::xml_node& shape) { used_.insert(shape.internal_object()); }
  /// A line for each of both, with the first such shape.
  std::vector<std::pair<pugi::xml_node, std::string>> told(const pugi::xml_node& root) const;

 private:
  std::size_t hidden_ = 0;
  pugi::xml_node first_hidden_;
  std::unordered_set<const void*> used_;
};

/// Whether what is within an element of that name is drawn only where others refer to it.
bool is_svg_definition(std::string_view name);

}  // namespace keyline::exchange::detail
