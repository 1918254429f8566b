#include "keyline/sketch/ink_radius.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "keyline/numeric/parallel.h"
#include "keyline/sketch/pixel_words.h"

namespace keyline::sketch {
namespace {

constexpr int kBand = 256;        ///< rows at once
constexpr int kFirstMargin = 32;  ///< rows beyond them: wider ink is looked at again
constexpr int kNear = 24;         ///< pixels that paper is searched for around a pixel

// Borgefors's steps along, across and like a knight's, 1/65536: cv::DIST_MASK_5's.
constexpr int kUnit = 65536;
constexpr int kAlong = kUnit;
constexpr int kDiagonal = 91750;
constexpr int kKnight = 143976;

/// The least way between two pixels by such steps.
int way(int dx, int dy) {
  const int most = std::max(dx, dy);
  const int least = std::min(dx, dy);
  return 2 * least <= most ? least * kKnight + (most - 2 * least) * kAlong
                           : (most - least) * kKnight + (2 * least - most) * kDiagonal;
}

/// The way to the next pixel of paper, or a longer one than kNear. Beyond the picture is paper.
int way_to_paper(const Binary& ink, int x, int y) {
  int best = kNear * kUnit + 1;
  const auto look_along = [&](int v, int dy) {
    if (v < 0 || v >= ink.height) {
      best = std::min(best, way(0, dy));
      return;
    }
    const std::uint8_t* row = &ink.data[ink.index(0, v)];
    for (int dx = 0; way(dx, dy) < best; ++dx)
      if (x < dx || !row[x - dx] || x + dx >= ink.width || !row[x + dx]) best = way(dx, dy);
  };
  look_along(y, 0);
  for (int dy = 1; dy * kAlong < best; ++dy) {
    look_along(y - dy, dy);
    look_along(y + dy, dy);
  }
  return best;
}

}  // namespace

InkRadius::InkRadius(const Binary& lines, const Binary& ink)
    : rows_(static_cast<std::size_t>(lines.height)) {
  const std::size_t bands = static_cast<std::size_t>((lines.height + kBand - 1) / kBand);
  numeric::parallel_for(bands, 0, [&](std::size_t k) {
    const int first = static_cast<int>(k) * kBand;
    const int last = std::min(first + kBand, lines.height);
    if (add_near(lines, ink, first, last)) return;
    int margin = kFirstMargin;
    while (!add_rows(lines, ink, first, last, margin)) margin *= 2;
  });
}

bool InkRadius::add_near(const Binary& lines, const Binary& ink, int first, int last) {
  for (int y = first; y < last; ++y) {
    auto& row = rows_[static_cast<std::size_t>(y)];
    row.clear();
    bool all = true;
    visit_set(&lines.data[lines.index(0, y)], static_cast<std::size_t>(lines.width),
              [&](std::size_t at) {
                if (!all) return;
                const auto x = static_cast<int>(at);
                const int to_paper = way_to_paper(ink, x, y);
                all = to_paper <= kNear * kUnit;
                row.emplace_back(x, std::max(0.5F, static_cast<float>(to_paper) / kUnit - 0.5F));
              });
    if (!all) return false;
  }
  return true;
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
