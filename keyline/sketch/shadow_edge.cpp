#include "keyline/sketch/shadow_edge.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "keyline/core/quantile.h"
#include "keyline/numeric/parallel.h"
#include "keyline/sketch/tone.h"

namespace keyline::sketch {
namespace {

/// Of the light: half of it is left on either side of a step by what is smooth, and from a
/// twentieth on that is dark enough for faint ink.
constexpr double kStep = 0.1;
constexpr int kNear = 2;     ///< blocks that smoothing mixes
constexpr int kMedian = 33;  ///< pixels: a block's, so that lines are a small part of them
constexpr int kAround = kMedian / 2;

struct Bounds {
  double low = 0;
  double high = 0;
};

/// The darkest and the lightest paper within kNear blocks.
Bounds paper_near(const cv::Mat& paper, int row, int column) {
  Bounds b;
  cv::minMaxLoc(paper({row - kNear, row + kNear + 1}, {column - kNear, column + kNear + 1}), &b.low,
                &b.high);
  return b;
}

/// Median of the levels about a pixel at the picture's rim. It leaves out as much beyond the pixel
/// as the rim does before it, so that an edge goes straight on to the rim.
float median_at_rim(const cv::Mat& level, int x, int y, int across, int down,
                    std::vector<std::uint16_t>& sample) {
  sample.clear();
  for (int v = y - down; v <= y + down; ++v) {
    const auto* row = level.ptr<std::uint16_t>(v);
    sample.insert(sample.end(), row + x - across, row + x + across + 1);
  }
  return core::value_at(sample, 0.5);
}

/// Medians of the levels about every pixel of a box, in 256 steps of kWhite away from the rim.
cv::Mat medians(const cv::Mat& level, cv::Rect box) {
  constexpr double kToByte = 255 / Tone::kWhite;
  const cv::Point around(kAround, kAround);
  const cv::Rect wide =
      cv::Rect(box.tl() - around, box.br() + around) & cv::Rect(0, 0, level.cols, level.rows);
  cv::Mat bytes;
  level(wide).convertTo(bytes, CV_8U, kToByte);
  cv::medianBlur(bytes, bytes, kMedian);
  cv::Mat all;
  bytes(box - wide.tl()).convertTo(all, CV_32F, 1 / kToByte);
  std::vector<std::uint16_t> sample;
  for (int y = box.y; y < box.br().y; ++y)
    for (int x = box.x; x < box.br().x; ++x) {
      const int across = std::min({kAround, x, level.cols - 1 - x});
      const int down = std::min({kAround, y, level.rows - 1 - y});
      if (across < kAround || down < kAround)
        all.at<float>(y - box.y, x - box.x) = median_at_rim(level, x, y, across, down, sample);
    }
  return all;
}

SteppedBox flat_box(const cv::Mat& level, cv::Rect box, const Bounds& bounds) {
  cv::Mat paper = medians(level, box);
  cv::min(cv::max(paper, bounds.low), bounds.high, paper);
  cv::Mat flat;
  level(box).convertTo(flat, CV_32F);
  flat += Tone::kWhite - paper;
  SteppedBox result{.x = box.x, .y = box.y, .flat = {box.width, box.height}};
  cv::Mat whole(box.height, box.width, CV_16U, result.flat.data.data());
  flat.convertTo(whole, CV_16U);
  return result;
}

}  // namespace

std::vector<SteppedBox> flat_at_steps(const Raster<std::uint16_t>& level,
                                      const Raster<float>& paper, int rim, double gain) {
  const int columns = paper.width - 2 * rim;
  const int rows = paper.height - 2 * rim;
  const double step = -gain * std::log(1 - kStep) * Tone::kWhite;
  const cv::Mat all(level.height, level.width, CV_16U,
                    const_cast<std::uint16_t*>(level.data.data()));  // only read
  const cv::Mat blocks(paper.height, paper.width, CV_32F, const_cast<float*>(paper.data.data()));
  std::vector<std::optional<SteppedBox>> found(static_cast<std::size_t>(rows * columns));
  numeric::parallel_for(found.size(), 0, [&](std::size_t k) {
    const auto at = static_cast<int>(k);
    const int r = at / columns;
    const int c = at % columns;
    const Bounds bounds = paper_near(blocks, r + rim, c + rim);
    if (bounds.high - bounds.low <= step) return;
    const cv::Point first(part_start(level.width, columns, c), part_start(level.height, rows, r));
    const cv::Point last(part_start(level.width, columns, c + 1),
                         part_start(level.height, rows, r + 1));
    found[k] = flat_box(all, {first, last}, bounds);
  });
  std::vector<SteppedBox> boxes;
  for (std::optional<SteppedBox>& box : found)
    if (box) boxes.push_back(std::move(*box));
  return boxes;
}

}  // namespace keyline::sketch
