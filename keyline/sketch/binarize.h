#pragma once

#include <array>
#include <optional>
#include <vector>

#include "keyline/sketch/faint_ink.h"
#include "keyline/sketch/thinning.h"
#include "keyline/sketch/tone.h"

namespace keyline::sketch {

/// Regions of the picture with a threshold of their own: 8 × 8, row by row from the top left.
inline constexpr int kRegions = 8;
inline constexpr int kRegionCount = kRegions * kRegions;

/// Thresholds are levels y of the log picture, 0 … 1: what is darker is ink.
struct BinarizeOptions {
  std::optional<double> threshold;  ///< one for all; empty: by region
  /// By region, over what is found automatically; a region left empty stays automatic. As many as
  /// regions, or none.
  std::vector<std::optional<double>> regions;
};

struct Binarized {
  Binary ink;
  FaintPixels faint;  ///< darker than paper, but no ink; none where one threshold is given for all
  std::array<double, kRegionCount> thresholds{};
  std::array<bool, kRegionCount> empty{};  ///< regions without ink: threshold of their neighbours
};

/// Separates ink from paper.
///
/// Every region's threshold is Otsu's over its pixels near edges (both sides of a line then count
/// alike, however little ink there is), taken over the darkness of the flattened picture, in which
/// an edge lies halfway between ink and paper; regions without ink take their neighbours'
/// thresholds; in between thresholds are blended bilinearly, so that no seam shows. Automatic
/// thresholds work with hysteresis: a fainter line counts where it hangs together with what passes
/// the threshold; and a pixel is ink only if it is about half as dark as the darkest within a few
/// pixels, which keeps faint and dark lines alike at their width.
/// That would part a pale line beside a darker one that crosses it: a pixel is ink, too, where
/// something as faint goes on away from what is darker, which a border does not. (Grain does.)
/// Given thresholds are used as they are.
Binarized binarize(const Tone& tone, const BinarizeOptions& options = {}, bool grainy = false);

}  // namespace keyline::sketch
