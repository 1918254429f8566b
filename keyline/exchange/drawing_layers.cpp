#include "keyline/exchange/drawing_layers.h"

#include <algorithm>
#include <string>

#include "keyline/exchange/cubic_path.h"

namespace keyline::exchange {
namespace {

/// One layer per name, in the order of first appearance.
SvgLayer& layer_of(std::vector<SvgLayer>& layers, const document::NamedPath& named) {
  const std::string own = named.label.name.empty() ? "key-line" : named.label.name;
  const std::string& wanted = named.label.layer.empty() ? own : named.label.layer;
  const auto found = std::find_if(layers.begin(), layers.end(),
                                  [&](const SvgLayer& layer) { return layer.name == wanted; });
  if (found != layers.end()) return *found;
  layers.push_back({.name = wanted});
  return layers.back();
}

}  // namespace

std::vector<SvgLayer> drawing_layers(const document::Document& document, double tolerance,
                                     Written& written) {
  std::vector<SvgLayer> layers;
  for (const document::NamedPath& named : document.paths) {
    CubicPath cubics = cubic_path(named.path, named.label.name, tolerance);
    written.deviation = std::max(written.deviation, cubics.deviation);
    cubics.path.color = named.label.color;
    cubics.path.width = named.stroke_width;
    layer_of(layers, named).paths.push_back(std::move(cubics.path));
  }
  if (!document.space_curves.empty())
    written.notes.push_back(std::to_string(document.space_curves.size()) +
                            " space curves are not in the drawing: it is planar");
  if (!document.surfaces.empty())
    written.notes.push_back(std::to_string(document.surfaces.size()) +
                            " surfaces are not in the drawing");
  return layers;
}

}  // namespace keyline::exchange
