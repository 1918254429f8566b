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

/// Counts what a viewer does not show: shapes that are read though their style hides them or paints
/// nothing of them, and those of definitions that nothing shows and of a switch's other
/// alternatives, which are not.
class SvgUnseen {
 public:
  void take_hidden(const pugi::xml_node& shape) { hidden_.take(shape); }
  void take_unpainted(const pugi::xml_node& shape) { unpainted_.take(shape); }
  /// A child of a switch that is not the one shown.
  void take_alternative(const pugi::xml_node& child);
  /// A shape that <use> has brought in.
  void take_used(const pugi::xml_node& shape) { used_.insert(shape.internal_object()); }
  /// A line for each kind, with the first such shape.
  std::vector<std::pair<pugi::xml_node, std::string>> told(const pugi::xml_node& root) const;

 private:
  struct Shapes {
    std::size_t count = 0;
    pugi::xml_node first;

    void take(const pugi::xml_node& shape) {
      if (count++ == 0) first = shape;
    }
  };

  Shapes hidden_;
  Shapes unpainted_;
  Shapes alternatives_;
  std::unordered_set<const void*> used_;
};

/// Whether the conditions of a switch's child hold: no extensions; of languages, all or English.
bool may_switch_to(const pugi::xml_node& child);

/// Whether what is within an element of that name is drawn only where others refer to it.
bool is_svg_definition(std::string_view name);

}  // namespace keyline::exchange::detail
