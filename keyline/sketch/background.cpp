#include "keyline/sketch/background.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace keyline::sketch {
namespace {

using Gray = Raster<std::uint16_t>;

constexpr int kBlock = 32;
constexpr double kPaperShare = 0.7;  ///< percentile of a block that is taken for paper

/// Value below which the given share of the pixels of a box lies (every other one is looked at).
std::uint16_t percentile_in(const Gray& image, int x0, int y0, int x1, int y1, double share,
                            std::vector<std::uint16_t>& scratch) {
  scratch.clear();
  for (int y = y0; y < y1; y += 2)
    for (int x = x0; x < x1; x += 2) scratch.push_back(image.at(x, y));
  const auto at =
      scratch.begin() + static_cast<long>(share * static_cast<double>(scratch.size() - 1));
  std::nth_element(scratch.begin(), at, scratch.end());
  return *at;
}

cv::Mat paper_of_blocks(const Gray& level) {
  const int columns = std::max(1, level.width / kBlock);
  const int rows = std::max(1, level.height / kBlock);
  cv::Mat paper(rows, columns, CV_32F);
  std::vector<std::uint16_t> scratch;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const auto cut = [](int size, int parts, int i) {
        return static_cast<int>(static_cast<long>(size) * i / parts);
      };
      paper.at<float>(r, c) = percentile_in(
          level, cut(level.width, columns, c), cut(level.height, rows, r),
          cut(level.width, columns, c + 1), cut(level.height, rows, r + 1), kPaperShare, scratch);
    }
  const cv::Mat square = cv::Mat::ones(5, 5, CV_8U);
  cv::morphologyEx(paper, paper, cv::MORPH_CLOSE, square, {-1, -1}, 1, cv::BORDER_REPLICATE);
  cv::GaussianBlur(paper, paper, {5, 5}, 1.0, 1.0, cv::BORDER_REPLICATE);
  return paper;
}

/// Paper at a pixel: bilinear between the blocks' centres.
void subtract(Gray& level, const cv::Mat& paper) {
  const double sx = static_cast<double>(paper.cols) / level.width;
  const double sy = static_cast<double>(paper.rows) / level.height;
  std::vector<float> row(static_cast<std::size_t>(paper.cols));
  for (int y = 0; y < level.height; ++y) {
    const double v = std::clamp((y + 0.5) * sy - 0.5, 0.0, paper.rows - 1.0);
    const int r0 = static_cast<int>(v);
    const int r1 = std::min(r0 + 1, paper.rows - 1);
    const auto fy = static_cast<float>(v - r0);
    for (int c = 0; c < paper.cols; ++c)
      row[static_cast<std::size_t>(c)] =
          (1 - fy) * paper.at<float>(r0, c) + fy * paper.at<float>(r1, c);
    for (int x = 0; x < level.width; ++x) {
      const double u = std::clamp((x + 0.5) * sx - 0.5, 0.0, paper.cols - 1.0);
      const auto c0 = static_cast<std::size_t>(u);
      const std::size_t c1 = std::min(c0 + 1, row.size() - 1);
      const double base = row[c0] + (u - static_cast<double>(c0)) * (row[c1] - row[c0]);
      const double flat = level.at(x, y) - base + Tone::kWhite;
      level.at(x, y) = static_cast<std::uint16_t>(std::clamp(flat, 0.0, 65535.0));
    }
  }
}

}  // namespace

bool is_light_on_dark(const Image& image) {
  const Gray& luminance = image.luminance;
  std::vector<std::uint16_t> scratch;
  double dark = 0;
  double light = 0;
  const int step = std::max(kBlock, std::max(luminance.width, luminance.height) / 64);
  for (int y = 0; y < luminance.height; y += step)
    for (int x = 0; x < luminance.width; x += step) {
      const int x1 = std::min(x + step, luminance.width);
      const int y1 = std::min(y + step, luminance.height);
      const double middle = percentile_in(luminance, x, y, x1, y1, 0.5, scratch);
      dark += middle - percentile_in(luminance, x, y, x1, y1, 0.02, scratch);
      light += percentile_in(luminance, x, y, x1, y1, 0.98, scratch) - middle;
    }
  return light > dark;
}

bool flatten_background(Gray& level, Flatten flatten) {
  if (flatten == Flatten::off) return false;
  const cv::Mat paper = paper_of_blocks(level);
  double low = 0;
  double high = 0;
  cv::minMaxLoc(paper, &low, &high);
  const double slack = 0.01 * Tone::kWhite;
  if (flatten == Flatten::automatic && high - low < slack && std::abs(high - Tone::kWhite) < slack)
    return false;
  subtract(level, paper);
  return true;
}

}  // namespace keyline::sketch
