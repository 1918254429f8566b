#pragma once

#include <pugixml.hpp>
#include <string>
#include <utility>
#include <vector>

namespace keyline::exchange::detail {

/// What the parser lets pass though XML forbids it: an attribute twice in one element, of which the
/// first counts, and elements behind the end of the root, which are left out; also style sheets
/// that processing instructions name. A line for each kind, with the first such element.
std::vector<std::pair<pugi::xml_node, std::string>> xml_oddities(const pugi::xml_node& root);

}  // namespace keyline::exchange::detail
