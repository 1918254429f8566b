#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "keyline/core/point.h"

/// Long lists of points written from where they are: as values of a JSON tree a million of them
/// take 120 MB. For .cpp files of this room only.
namespace keyline::exchange::detail {

/// Points that a tree of values holds as "points": [], in the order of its text.
using PointLists =
    std::vector<std::variant<const std::vector<core::Point2>*, const std::vector<core::Point3>*>>;

/// The text of a tree, as nlohmann's dump(indent) gives it, with the lists put back in.
/// Precondition: the text holds as many empty lists of "points" as there are lists.
std::string filled(std::string_view text, const PointLists& lists, int indent);

}  // namespace keyline::exchange::detail
