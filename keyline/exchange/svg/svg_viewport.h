#pragma once

#include <pugixml.hpp>

#include "keyline/exchange/svg/svg_shapes.h"
#include "keyline/exchange/svg/svg_transform.h"

namespace keyline::exchange::detail {

/// The user space within an element: that of its viewBox, else its size, else all around it.
SvgViewport viewport_in(const pugi::xml_node& node, SvgViewport outer);

/// What x, y, width, height, viewBox and preserveAspectRatio of a nested <svg> or a <symbol> do to
/// the map and the viewport around it; the size may come from the <use> that shows it (`sized`,
/// else the node itself), and is all around where none is given.
void enter_viewport(const pugi::xml_node& node, const pugi::xml_node& sized, Affine& map,
                    SvgViewport& viewport);

}  // namespace keyline::exchange::detail
