#include "keyline/sketch/ink_radius.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "keyline/numeric/parallel.h"

namespace keyline::sketch {
namespace {

constexpr int kBand = 256;        ///< rows at once
constexpr int kFirstMargin = 32;  ///< rows beyond them: wider ink is looked at again

}  // namespace

InkRadius::InkRadius(const Binary& lines, const Binary& ink)
    : rows_(static_cast<std::size_t>(lines.height)) {
  const std::size_t bands = static_cast<std::size_t>((lines.height + kBand - 1) / kBand);
  numeric::parallel_for(bands, 0, [&](std::size_t k) {
    const int first = static_cast<int>(k) * kBand;
    const int last = std::min(first + kBand, lines.height);
    int margin = kFirstMargin;
    while (!add_rows(lines, ink, first, last, margin)) margin *= 2;
  });
}

bool InkRadius::add_rows(const Binary& lines, const Binary& ink, int first, int last, int margin) {
  const int top = std::max(0, first - margin);
  const int bottom = std::min(ink.height, last + margin);
  const cv::Mat mask(bottom - top, ink.width, CV_8U,
                     const_cast<std::uint8_t*>(ink.data.data() + ink.index(0, top)));
  cv::Mat padded;  // beyond the picture there is paper, beyond the band there is more of it
  const int above = top == 0 ? 1 : 0;
  cv::copyMakeBorder(mask, padded, above, bottom == ink.height ? 1 : 0, 1, 1, cv::BORDER_CONSTANT,
                     0);
  cv::Mat distance;
  cv::distanceTransform(padded, distance, cv::DIST_L2, cv::DIST_MASK_5);
  const bool all = top == 0 && bottom == ink.height;
  for (int y = first; y < last; ++y) {
    auto& row = rows_[static_cast<std::size_t>(y)];
    row.clear();
    for (int x = 0; x < lines.width; ++x) {
      if (!lines.at(x, y)) continue;
      const float to_paper = distance.at<float>(y - top + above, x + 1);
      if (!all && to_paper >= static_cast<float>(margin)) return false;
      // the transform counts from the centre of the next pixel of paper; ink ends half a pixel
      // before
      row.emplace_back(x, std::max(0.5F, to_paper - 0.5F));
    }
  }
  return true;
}

float InkRadius::at(int x, int y) const {
  const auto& row = rows_[static_cast<std::size_t>(y)];
  return std::ranges::lower_bound(row, x, {}, &std::pair<int, float>::first)->second;
}

}  // namespace keyline::sketch
