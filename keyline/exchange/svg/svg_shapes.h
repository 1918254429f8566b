#pragma once

#include <limits>
#include <pugixml.hpp>
#include <string_view>
#include <vector>

#include "keyline/exchange/svg/svg_path.h"

namespace keyline::exchange::detail {

/// Name of an element without its namespace prefix.
std::string_view local_name(const pugi::xml_node& node);

/// What the drawing calls an element: its label, else its id; may be empty.
std::string name_of(const pugi::xml_node& node);

/// "path \"roof\"".
std::string describe(const pugi::xml_node& node);

/// True for path, rect, circle, ellipse, line, polyline and polygon.
bool is_svg_shape(std::string_view name);

/// Size of the box percentages refer to, in px of the user space; NaN where unknown.
struct SvgViewport {
  double width = std::numeric_limits<double>::quiet_NaN();
  double height = std::numeric_limits<double>::quiet_NaN();
};

/// The outline of a shape in its own user space (px). Sizes that cannot be used and radii or sides
/// that are not positive give nothing, with a reason in `error`.
SvgPathData svg_shape(const pugi::xml_node& node, const SvgViewport& viewport);

/// A length attribute in px, percentages of the viewport's width, height or (radii) diagonal by
/// the square root of 2; `fallback` where it is absent, NaN where it cannot be used.
double svg_length(const pugi::xml_node& node, const char* name, double fallback,
                  const SvgViewport& viewport);

}  // namespace keyline::exchange::detail
