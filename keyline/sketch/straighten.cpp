#include "keyline/sketch/straighten.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "keyline/core/text.h"
#include "keyline/sketch/rectify.h"

namespace keyline::sketch {
namespace {

constexpr double kGivenRim = 3;         ///< pixels that corners given by hand may be off
constexpr double kStraightSide = 3e-3;  ///< of its length a straight side may bend

}  // namespace

core::Result<void> straighten(Image& image, const TraceOptions& options, TraceResult& result) {
  if (options.rectify == Rectify::off && !options.sheet) return {};
  std::optional<Sheet> sheet;
  if (options.sheet)
    sheet = Sheet{*options.sheet, 0};
  else if (std::max(image.width(), image.height()) <= kLargestPhoto)
    sheet = find_sheet(image);
  if (!sheet) return {};
  auto seen = rectified(image, sheet->corners, kGivenRim + 2 * sheet->bend);
  if (!seen) return std::unexpected(seen.error());
  image = std::move(*seen);
  result.sheet = sheet->corners;
  std::string places;
  for (const core::Point2 p : sheet->corners)
    places += " " + core::number_text(p.x, 5) + "," + core::number_text(p.y, 5);
  result.notes.push_back("a photo of a sheet, corners" + places +
                         ": its lines are in the sheet's own pixels, " +
                         std::to_string(image.width()) + " x " + std::to_string(image.height()));
  if (sheet->bend > kStraightSide * std::min(image.width(), image.height()))
    result.notes.push_back("warning: the sheet is not flat, its border lies " +
                           core::number_text(sheet->bend, 2) + " pixels off straight sides");
  return {};
}

}  // namespace keyline::sketch
