#include "keyline/exchange/svg/svg_viewport.h"

#include <cmath>

namespace keyline::exchange::detail {

SvgViewport viewport_in(const pugi::xml_node& node, SvgViewport outer) {
  if (const auto box = parse_svg_view_box(node.attribute("viewBox").value()))
    return {box->width, box->height};
  return {svg_length(node, "width", outer.width, outer),
          svg_length(node, "height", outer.height, outer)};
}

void enter_viewport(const pugi::xml_node& node, const pugi::xml_node& sized, Affine& map,
                    SvgViewport& viewport) {
  const SvgViewport outer = viewport;
  const auto length = [&outer](const pugi::xml_node& of, const char* name, double fallback) {
    return svg_length(of, name, fallback, outer);
  };
  const double x = length(node, "x", 0);
  const double y = length(node, "y", 0);
  if (std::isfinite(x) && std::isfinite(y)) map = combined(map, Affine{1, 0, 0, 1, x, y});
  const double w = length(sized, "width", length(node, "width", outer.width));
  const double h = length(sized, "height", length(node, "height", outer.height));
  viewport = {w, h};
  const auto box = parse_svg_view_box(node.attribute("viewBox").value());
  if (!box) return;
  viewport = {box->width, box->height};
  if (w > 0 && h > 0)
    map = combined(map, fit_view_box(*box, w, h, node.attribute("preserveAspectRatio").value()));
}

}  // namespace keyline::exchange::detail
