#include "keyline/sketch/tell_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "keyline/core/text.h"
#include "keyline/sketch/ink_measure.h"
#include "keyline/sketch/pixel_words.h"

namespace keyline::sketch {
namespace {

constexpr double kTold = 0.01;  ///< of what is drawn: how much left out is told

/// Margins that were left out are told.
void tell_margins(const Margins& margins, TraceResult& result) {
  if (!margins.any()) return;
  static constexpr std::array kSides = {"left", "upper", "right", "lower"};
  std::string sides;
  for (std::size_t k = 0; k < kSides.size(); ++k) {
    const int deep = margins.deepest[k];
    if (deep == 0) continue;
    sides += (sides.empty() ? "" : ", ") + std::string(kSides[k]) + " " + std::to_string(deep);
  }
  result.notes.push_back("dark margins, as a scanner leaves them, are left out; pixels: " + sides);
}

}  // namespace

void tell_ground(const Tone& tone, bool on_black, TraceResult& result) {
  tell_margins(tone.margins, result);
  if (tone.light_on_dark)
    result.notes.push_back(on_black ? "light lines on transparent ground"
                                    : "light lines on dark ground");
  if (tone.flattened) result.notes.push_back("the paper's shades were taken out");
}

void tell_dirt(const Ink& found, TraceResult& result) {
  const auto ink =
      static_cast<double>(count_ink(found.picture.data.data(), found.picture.data.size()) +
                          found.dirt.specks.pixels.size());
  const double share = static_cast<double>(found.dirt.specks.pixels.size()) / std::max(ink, 1.0);
  if (share < kTold) return;
  result.notes.push_back(std::to_string(std::lround(100 * share)) + " % of the ink, " +
                         core::counted(found.dirt.specks.size(), "piece") + " of fewer than " +
                         std::to_string(found.specks) +
                         " pixels, is left out as dirt (specks 0 keeps it)");
}

void tell_light(const LightShare& light, TraceResult& result) {
  const auto tell = [&](double share, const std::string& what) {
    if (share >= kTold)
      result.notes.push_back(std::to_string(std::lround(100 * share)) +
                             " % of what is drawn on the transparent ground is " + what);
  };
  tell(light.lines, "light lines: traced like dark ones (polarity dark leaves them out)");
  tell(light.rest, "light areas or rims of dark lines: left out, as paper");
}

void warn_of_photograph(const Tone& tone, const Ink& found, Edge edge, TraceResult& result) {
  const Binary& ink = found.picture;
  const auto dark = static_cast<double>(count_ink(ink.data.data(), ink.data.size()));
  const double share = dark / static_cast<double>(ink.data.size());
  const bool in_shade = edge == Edge::center && result.explained >= kEnoughExplained;
  const double most = in_shade ? share : std::max(share, tone.shaded);
  if (most > (is_broad(found.width, ink.width, ink.height) ? 0.15 : 0.25))
    result.notes.push_back("warning: " + std::to_string(std::lround(100 * most)) +
                           " % of the picture is dark; is it a drawing?");
}

}  // namespace keyline::sketch
