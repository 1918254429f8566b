#include "keyline/exchange/svg/drawing_layers.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/exchange/svg/cubic_path.h"

namespace keyline::exchange {
namespace {

/// One layer per name, in the order of first appearance.
class Layers {
 public:
  SvgLayer& of(const document::NamedPath& named) {
    const std::string own = named.label.name.empty() ? "key-line" : named.label.name;
    const std::string& wanted = named.label.layer.empty() ? own : named.label.layer;
    const auto [at, is_new] = index_.try_emplace(wanted, layers_.size());
    if (is_new) layers_.push_back({.name = wanted});
    return layers_[at->second];
  }
  std::vector<SvgLayer> take() { return std::move(layers_); }

 private:
  std::vector<SvgLayer> layers_;
  std::unordered_map<std::string, std::size_t> index_;
};

}  // namespace

std::vector<SvgLayer> drawing_layers(const document::Document& document, double tolerance,
                                     Written& written) {
  Layers layers;
  for (const document::NamedPath& named : document.paths) {
    CubicPath cubics = cubic_path(named.path, named.label.name, tolerance);
    written.deviation = std::max(written.deviation, cubics.deviation);
    cubics.path.color = named.label.color;
    cubics.path.width = named.stroke_width;
    layers.of(named).paths.push_back(std::move(cubics.path));
  }
  if (!document.space_curves.empty())
    written.notes.push_back(
        core::counted(document.space_curves.size(), "space curve is", "space curves are") +
        " not in the drawing: it is planar");
  if (!document.surfaces.empty())
    written.notes.push_back(core::counted(document.surfaces.size(), "surface is", "surfaces are") +
                            " not in the drawing");
  return layers.take();
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
