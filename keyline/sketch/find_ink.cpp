#include "keyline/sketch/find_ink.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keyline/sketch/binarize.h"
#include "keyline/sketch/ink_measure.h"
#include "keyline/sketch/morphology.h"
#include "keyline/sketch/pixel_words.h"

namespace keyline::sketch {
namespace {

/// Where a border's darkness falls to a twentieth, in pixels or widths: of a line all blur at 0.54
/// of its width, of a broader one at 0.7.
constexpr double kSharpRim = 3;
constexpr double kSoftRim = 0.75;

constexpr double kGrainHoles = 0.008;  ///< pinholes per pixel of border from which ink is grainy
constexpr double kGrainRagged = 0.03;  ///< pixels smoothed per pixel of border
constexpr double kGrainBlur = 0.4;     ///< of the lines' width

/// Widths, and pixels for its blur: what is faint and broader is shade, no line.
constexpr double kBroadest = 2;
constexpr double kBroadestBlur = 2;

/// Pieces of fewer pixels are dirt, beside lines of that width.
int specks_of(double width) { return static_cast<int>(std::lround(6 + 1.5 * width * width)); }

/// Smooths the ink's edges and takes dirt out; how many pixels were smoothed.
long clean(Ink& ink, const TraceOptions& options) {
  long ragged = 0;
  if (options.smoothing_by == Smoothing::pixels)
    smooth_pixels(ink.picture, options.smoothing);
  else {
    const Smoothed smoothed = smooth_edges(ink.picture, options.smoothing);
    ragged = smoothed.changed;
    ink.lost.add(smoothed.lost);
  }
  const int pinholes = static_cast<int>(std::lround(1 + ink.width));
  const Removed gone = remove_specks(ink.picture, ink.specks, pinholes);
  ink.dirt.specks.add(gone.specks);
  ink.dirt.pinholes += gone.pinholes;
  return ragged;
}

Ink ink_of(const Tone& tone, const TraceOptions& options, bool grainy = false) {
  Binarized told = binarize(tone, options.binarize, grainy);
  Ink ink{.picture = std::move(told.ink), .faint = std::move(told.faint)};
  show_stage(options, "binary", ink.picture);
  const InkMeasure measured = measure_ink(ink.picture);
  ink.width = measured.width;
  ink.specks = options.specks.value_or(specks_of(ink.width));
  const long ragged = clean(ink, options);
  ink.grainy = ink.dirt.pinholes > kGrainHoles * measured.border &&
               static_cast<double>(ragged) > kGrainRagged * measured.border;
  return ink;
}

/// Blurs the grain of ink away. False, and the ink is not grainy, where none would be left: thin
/// lines beside what is broad and ragged, as a table about a sheet.
bool blur_grain(Tone& tone, Ink& ink, const TraceOptions& options) {
  Tone soft = tone;
  blur_levels(soft, std::clamp(kGrainBlur * ink.width, 1.0, 6.0));
  Ink found = ink_of(soft, options, true);
  if (count_ink(found.picture.data.data(), found.picture.data.size()) == 0) {
    ink.grainy = false;
    return false;
  }
  tone = std::move(soft);
  ink = std::move(found);
  ink.grainy = true;
  return true;
}

/// Pieces that lines lead over are ink again, the others stay in the list.
void put_back_drawn(const std::vector<FineStroke>& lines, InkPieces& pieces, Binary& ink) {
  std::vector<std::pair<std::size_t, std::size_t>> piece_of;  // by pixel
  for (std::size_t k = 0; k < pieces.size(); ++k)
    for (const std::size_t i : pieces[k]) piece_of.emplace_back(i, k);
  std::ranges::sort(piece_of);
  std::vector<bool> drawn(pieces.size());
  for (const FineStroke& line : lines)
    for (const core::Point2 p : line.points) {
      const int x = static_cast<int>(std::floor(p.x));
      const int y = static_cast<int>(std::floor(p.y));
      if (piece_of.empty() || !ink.contains(x, y)) continue;
      const std::size_t i = ink.index(x, y);
      const auto at = std::ranges::lower_bound(piece_of, std::pair{i, std::size_t{0}});
      if (at != piece_of.end() && at->first == i) drawn[at->second] = true;
    }
  InkPieces rest;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (!drawn[k]) rest.add(pieces[k]);
    for (const std::size_t i : pieces[k])
      if (drawn[k]) ink.data[i] = 1;
  }
  pieces = std::move(rest);
}

}  // namespace

FaintLine faint_line(double width, int specks) {
  return {.reach = std::max(kSharpRim, kSoftRim * width),
          .specks = specks,
          .broadest = kBroadest * width + kBroadestBlur};
}

void show_stage(const TraceOptions& options, const Tone& tone) {
  if (!options.stage) return;
  Stage stage{"log", {tone.level.width, tone.level.height}};
  for (std::size_t i = 0; i < tone.level.data.size(); ++i)
    stage.picture.data[i] =
        static_cast<std::uint8_t>(std::min(255.0, 255 * tone.level.data[i] / Tone::kWhite));
  options.stage(stage);
}

void show_stage(const TraceOptions& options, const char* name, const Binary& binary) {
  if (!options.stage) return;
  Stage stage{name, {binary.width, binary.height}};
  for (std::size_t i = 0; i < binary.data.size(); ++i)
    stage.picture.data[i] = binary.data[i] ? 0 : 255;
  options.stage(stage);
}

void put_back_drawn(const std::vector<FineStroke>& lines, Ink& ink) {
  put_back_drawn(lines, ink.dirt.specks, ink.picture);
  put_back_drawn(lines, ink.lost, ink.picture);
}

Ink find_ink(Tone& tone, const TraceOptions& options) {
  Ink ink = ink_of(tone, options);
  const bool blurred = ink.grainy && !options.binarize.threshold && blur_grain(tone, ink, options);
  if (!blurred && options.binarize.regions.empty()) {
    const FaintLine line = faint_line(ink.width, std::max(ink.specks, specks_of(ink.width)));
    if (tone.flattened) drop_shade(ink.picture, tone, line.broadest);
    if (ink_lines(ink.faint, ink.picture, tone, line) > 0) clean(ink, options);
  }
  show_stage(options, "smoothed", ink.picture);
  return ink;
}

}  // namespace keyline::sketch
