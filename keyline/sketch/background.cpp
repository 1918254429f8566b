#include "keyline/sketch/background.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "keyline/core/quantile.h"
#include "keyline/numeric/parallel.h"
#include "keyline/sketch/rows.h"
#include "keyline/sketch/shadow_edge.h"

namespace keyline::sketch {
namespace {

using Gray = Raster<std::uint16_t>;

constexpr int kBlock = 32;           ///< pixels: wider than a line, narrower than a shadow
constexpr double kPaperShare = 0.7;  ///< percentile of a block that is taken for paper

/// Every other pixel of a box, of every other row.
void sample_box(const Gray& image, int x0, int y0, int x1, int y1,
                std::vector<std::uint16_t>& sample) {
  sample.clear();
  for (int y = y0; y < y1; y += 2) {
    const std::uint16_t* row = &image.at(0, y);
    for (int x = x0; x < x1; x += 2) sample.push_back(row[x]);
  }
}

bool is_even(const std::vector<std::uint16_t>& sample) {
  return std::ranges::all_of(sample, [&](std::uint16_t v) { return v == sample.front(); });
}

/// Value below which the given share of a sample lies.
std::uint16_t percentile_of(std::vector<std::uint16_t>& sample, double share) {
  return is_even(sample) ? sample.front() : core::value_at(sample, share);
}

constexpr int kRim = 4;  ///< blocks around the picture

/// The grid continued beyond its rim by mirroring it in the rim's value: a slope goes on.
cv::Mat with_rim(const cv::Mat& grid) {
  cv::Mat wide(grid.rows + 2 * kRim, grid.cols + 2 * kRim, CV_32F);
  const auto mirror = [](int i, int n) { return n == 1 ? 0 : std::abs(i) % (n - 1); };
  for (int r = 0; r < wide.rows; ++r)
    for (int c = 0; c < wide.cols; ++c) {
      const int y = r - kRim;
      const int x = c - kRim;
      const int v = std::clamp(y, 0, grid.rows - 1);
      const int u = std::clamp(x, 0, grid.cols - 1);
      const int over_y = mirror(y - v, grid.rows);
      const int over_x = mirror(x - u, grid.cols);
      const int back_y = v == 0 ? over_y : v - over_y;
      const int back_x = u == 0 ? over_x : u - over_x;
      wide.at<float>(r, c) = y == v && x == u
                                 ? grid.at<float>(y, x)
                                 : 2 * grid.at<float>(v, u) - grid.at<float>(back_y, back_x);
    }
  return wide;
}

/// Paper's level by blocks, kRim blocks more on every side.
cv::Mat paper_of_blocks(const Gray& level) {
  const int columns = std::max(1, level.width / kBlock);
  const int rows = std::max(1, level.height / kBlock);
  cv::Mat paper(rows, columns, CV_32F);
  numeric::parallel_for(static_cast<std::size_t>(rows), 0, [&](std::size_t row) {
    const auto r = static_cast<int>(row);
    std::vector<std::uint16_t> scratch;
    for (int c = 0; c < columns; ++c) {
      sample_box(level, part_start(level.width, columns, c), part_start(level.height, rows, r),
                 part_start(level.width, columns, c + 1), part_start(level.height, rows, r + 1),
                 scratch);
      paper.at<float>(r, c) = percentile_of(scratch, kPaperShare);
    }
  });
  paper = with_rim(paper);
  const cv::Mat square = cv::Mat::ones(5, 5, CV_8U);
  cv::morphologyEx(paper, paper, cv::MORPH_CLOSE, square, {-1, -1}, 1, cv::BORDER_REPLICATE);
  return paper;
}

/// Paper at a pixel: bilinear between the blocks' centres.
void subtract(Gray& level, const cv::Mat& paper) {
  const double sx = static_cast<double>(paper.cols - 2 * kRim) / level.width;
  const double sy = static_cast<double>(paper.rows - 2 * kRim) / level.height;
  for_rows(0, level.height, [&](int first, int last) {
    std::vector<float> row(static_cast<std::size_t>(paper.cols));
    for (int y = first; y < last; ++y) {
      const double v = std::clamp((y + 0.5) * sy - 0.5 + kRim, 0.0, paper.rows - 1.0);
      const int r0 = static_cast<int>(v);
      const int r1 = std::min(r0 + 1, paper.rows - 1);
      const auto fy = static_cast<float>(v - r0);
      for (int c = 0; c < paper.cols; ++c)
        row[static_cast<std::size_t>(c)] =
            (1 - fy) * paper.at<float>(r0, c) + fy * paper.at<float>(r1, c);
      for (int x = 0; x < level.width; ++x) {
        const double u = std::clamp((x + 0.5) * sx - 0.5 + kRim, 0.0, paper.cols - 1.0);
        const auto c0 = static_cast<std::size_t>(u);
        const std::size_t c1 = std::min(c0 + 1, row.size() - 1);
        const double base = row[c0] + (u - static_cast<double>(c0)) * (row[c1] - row[c0]);
        const double flat = level.at(x, y) - base + Tone::kWhite;
        level.at(x, y) = static_cast<std::uint16_t>(std::clamp(flat, 0.0, 65535.0));
      }
    }
  });
}

}  // namespace

bool is_light_on_dark(const Image& image) {
  const Gray& luminance = image.luminance;
  const int step = std::max(kBlock, std::max(luminance.width, luminance.height) / 64);
  const int rows = (luminance.height + step - 1) / step;
  std::vector<double> lighter(static_cast<std::size_t>(rows));  // by row of blocks
  numeric::parallel_for(lighter.size(), 0, [&](std::size_t row) {
    const int y = static_cast<int>(row) * step;
    std::vector<std::uint16_t> scratch;
    for (int x = 0; x < luminance.width; x += step) {
      sample_box(luminance, x, y, std::min(x + step, luminance.width),
                 std::min(y + step, luminance.height), scratch);
      if (is_even(scratch)) continue;
      const double middle = core::value_at(scratch, 0.5);
      const double dark = middle - core::value_at(scratch, 0.02);
      lighter[row] += core::value_at(scratch, 0.98) - middle - dark;
    }
  });
  return std::accumulate(lighter.begin(), lighter.end(), 0.0) > 0;
}

bool flatten_background(Gray& level, double gain, Flatten flatten) {
  if (flatten == Flatten::off) return false;
  const cv::Mat blocks = paper_of_blocks(level);
  cv::Mat paper;
  cv::GaussianBlur(blocks, paper, {5, 5}, 1.0, 1.0, cv::BORDER_REPLICATE);
  double low = 0;
  double high = 0;
  cv::minMaxLoc(paper, &low, &high);
  const double slack = 0.003 * Tone::kWhite;
  if (flatten == Flatten::automatic && high - low < slack && std::abs(high - Tone::kWhite) < slack)
    return false;
  Raster<float> of_blocks(blocks.cols, blocks.rows);
  blocks.copyTo(cv::Mat(blocks.rows, blocks.cols, CV_32F, of_blocks.data.data()));
  const std::vector<SteppedBox> stepped = flat_at_steps(level, of_blocks, kRim, gain);
  subtract(level, paper);
  for (const SteppedBox& box : stepped)
    for (int y = 0; y < box.flat.height; ++y)
      std::copy_n(&box.flat.at(0, y), box.flat.width, &level.at(box.x, box.y + y));
  return true;
}

}  // namespace keyline::sketch
