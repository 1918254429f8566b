#include "keyline/exchange/svg/drawing_layers.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/exchange/svg/cubic_path.h"

namespace keyline::exchange {
namespace {

const std::string& layer_of(const document::Label& label) {
  static const std::string kNameless = "key-line";
  if (!label.layer.empty()) return label.layer;
  return label.name.empty() ? kNameless : label.name;
}

}  // namespace

std::vector<DrawnLayer> drawn_layers(const document::Document& document) {
  std::vector<DrawnLayer> layers;
  std::unordered_map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < document.paths.size(); ++i) {
    const std::string& name = layer_of(document.paths[i].label);
    const auto [at, is_new] = index.try_emplace(name, layers.size());
    if (is_new) layers.push_back({.name = name});
    layers[at->second].paths.push_back(i);
  }
  return layers;
}

std::vector<SvgLayer> drawing_layers(const document::Document& document, double tolerance,
                                     Written& written) {
  std::vector<SvgLayer> layers;
  for (DrawnLayer& drawn : drawn_layers(document)) {
    SvgLayer& layer = layers.emplace_back(SvgLayer{.name = std::move(drawn.name)});
    for (const std::size_t i : drawn.paths) {
      const document::NamedPath& named = document.paths[i];
      CubicPath cubics = cubic_path(named.path, named.label.name, tolerance);
      written.deviation = std::max(written.deviation, cubics.deviation);
      cubics.path.color = named.label.color;
      cubics.path.width = named.stroke_width;
      layer.paths.push_back(std::move(cubics.path));
    }
  }
  if (!document.space_curves.empty())
    written.notes.push_back(
        core::counted(document.space_curves.size(), "space curve is", "space curves are") +
        " not in the drawing: it is planar");
  if (!document.surfaces.empty())
    written.notes.push_back(core::counted(document.surfaces.size(), "surface is", "surfaces are") +
                            " not in the drawing");
  return layers;
}

SvgWriteOptions drawing_options(const document::Document& document, const Written& written) {
  SvgWriteOptions options;
  if (!document.unit.empty()) options.unit = document.unit;
  options.page = document.page;
  options.title = "Keyline: cubic B\u00E9ziers within " + core::number_text(written.deviation, 3) +
                  " of the exact curve";
  return options;
}

}  // namespace keyline::exchange
