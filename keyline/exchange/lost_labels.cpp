#include "keyline/exchange/lost_labels.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace keyline::exchange {
namespace {

using document::Document;
using document::Label;

bool any_label(const Document& document, std::string Label::* part) {
  return std::ranges::any_of(labels(document),
                             [part](const Label& label) { return !(label.*part).empty(); });
}

}  // namespace

std::string lost_labels(const Document& document, std::string_view extension) {
  const bool table = extension == ".csv";
  const bool page = extension == ".pdf";
  const bool glyph = extension == ".glif";
  const bool cad =
      extension == ".dxf" || extension.starts_with(".st") || extension.starts_with(".ig");
  const bool wide =
      std::ranges::any_of(document.paths, [](const auto& named) { return named.stroke_width > 0; });
  // A table names its curves where there are several.
  const bool lone = document.paths.size() + document.space_curves.size() == 1;
  const std::vector<std::pair<const char*, bool>> lost = {
      {"names", (glyph || page || (table && lone)) && any_label(document, &Label::name)},
      {"layers", (glyph || table) && any_label(document, &Label::layer)},
      {"colours", (glyph || table) && any_label(document, &Label::color)},
      {"widths of strokes", (glyph || table || cad) && wide}};
  std::string words;
  for (const auto& [what, is_lost] : lost)
    if (is_lost) words += (words.empty() ? "" : ", ") + std::string(what);
  return words;
}

}  // namespace keyline::exchange
