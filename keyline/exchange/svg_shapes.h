#pragma once

#include <pugixml.hpp>
#include <string_view>
#include <vector>

#include "keyline/exchange/svg_path.h"

namespace keyline::exchange::detail {

/// Name of an element without its namespace prefix.
std::string_view local_name(const pugi::xml_node& node);

/// True for path, rect, circle, ellipse, line, polyline and polygon.
bool is_svg_shape(std::string_view name);

/// The outline of a shape in its own user space (px). Sizes in percent and radii or sides that are
/// not positive give nothing, with a reason in `error`.
SvgPathData svg_shape(const pugi::xml_node& node);

/// A length attribute in px; `fallback` where it is absent, NaN where it cannot be used.
double svg_length(const pugi::xml_node& node, const char* name, double fallback);

}  // namespace keyline::exchange::detail
