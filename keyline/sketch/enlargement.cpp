#include "keyline/sketch/enlargement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "keyline/sketch/pixel_words.h"
#include "keyline/sketch/rows.h"

namespace keyline::sketch {
namespace {

constexpr double kSmallest = 1.5;     ///< times: less is left as it is
constexpr double kLargest = 16;       ///< times: more leaves no picture
constexpr double kAboveChance = 0.8;  ///< of the steps that chance would put elsewhere
constexpr double kByChance = 1e-6;    ///< that a drawing's steps all lie so, for any size tried
/// Of a pixel's middle or its corner; halves are rounded either way.
constexpr std::array kShifts = {0.5, 0.499, 0.0};
constexpr double kSurely = 1 - 1e-9;  ///< for the rounding of sums
constexpr std::size_t kLooks = 1024;  ///< rows, or columns, that are looked at

/// Sums of squared differences between neighbouring columns, and rows.
struct Steps {
  std::vector<double> columns;
  std::vector<double> rows;
};

Steps steps_of(const Raster<std::uint16_t>& level) {
  const auto width = static_cast<std::size_t>(level.width);
  const auto height = static_cast<std::size_t>(level.height);
  const auto square = [](std::uint16_t a, std::uint16_t b) -> std::uint64_t {
    const std::uint32_t d = a > b ? a - b : b - a;
    return d * d;
  };
  std::vector<std::uint64_t> columns(width, 0);
  std::vector<std::uint64_t> rows(height, 0);
  const std::size_t every_row = 1 + height / kLooks;
  const std::size_t every_column = 1 + width / kLooks;
  const std::size_t looked_at = (3 + every_column) / every_column * every_column;  // of four
  std::mutex adding;  // whole numbers: their sum is the same in any order
  for_rows(0, level.height, [&](int first, int last) {
    std::vector<std::uint64_t> across(width, 0);
    for (auto y = static_cast<std::size_t>(first); y < static_cast<std::size_t>(last); ++y) {
      const std::uint16_t* row = level.data.data() + y * width;
      if (y % every_row == 0)
        for (std::size_t x = 1; x < width; ++x) {
          while (x + 4 < width && word_at(row + x) == word_at(row + x - 1)) x += 4;  // paper
          across[x] += square(row[x], row[x - 1]);
        }
      if (y == 0) continue;
      const std::uint16_t* above = row - width;
      for (std::size_t x = 0; x < width; x += every_column) {
        while (x + 4 + every_column < width && word_at(row + x) == word_at(above + x))
          x += looked_at;  // paper
        rows[y] += square(row[x], above[x]);
      }
    }
    const std::scoped_lock lock(adding);
    for (std::size_t x = 1; x < width; ++x) columns[x] += across[x];
  });
  return {{columns.begin(), columns.end()}, {rows.begin(), rows.end()}};
}

/// Where pixel k of `own` begins among `all`.
int begin_of(int k, int own, int all, double shift) {
  const double at = static_cast<double>(k) * all / own - shift;
  return std::clamp(static_cast<int>(std::ceil(at - 1e-9)), 0, all);
}

/// The steps of one direction, and what they weigh.
class Line {
 public:
  explicit Line(const std::vector<double>& steps) : steps_(steps), largest_(steps) {
    double squares = 0;
    for (const double s : steps) {
      sum_ += s;
      squares += s * s;
    }
    if (squares > 0) places_ = sum_ * sum_ / squares;
    std::ranges::sort(largest_, std::greater());
    after_.resize(steps.size());
    double after = 0;
    for (std::size_t i = steps.size(); i-- > 0; after += steps[i]) after_[i] = after;
    for (std::size_t i = 1; i < largest_.size(); ++i) largest_[i] += largest_[i - 1];
  }

  /// Whether enough of the steps lies where pixels of `own` begin, and no few steps by chance.
  bool are_of(int own, double shift) const {
    const int all = static_cast<int>(steps_.size());
    const double share = (own - 1.0) / (all - 1.0);
    if (own < 2 || places_ * std::log(share) > std::log(kByChance / all)) return false;
    const double enough = sum_ * (share + kAboveChance * (1 - share));
    if (largest_[static_cast<std::size_t>(own) - 2] < enough) return false;  // wherever they begin
    double there = 0;
    for (int k = 1; k < own; ++k) {
      const auto at = static_cast<std::size_t>(std::min(begin_of(k, own, all, shift), all - 1));
      there += steps_[at];
      if (there + after_[at] < kSurely * enough) return false;  // whatever comes
    }
    return there >= enough;
  }

 private:
  const std::vector<double>& steps_;
  std::vector<double> after_;    ///< what the steps after each weigh
  std::vector<double> largest_;  ///< so many of the largest steps weigh, from one on
  double sum_ = 0;
  double places_ = 0;  ///< so many equal steps weigh the same
};

}  // namespace

OwnSize own_size(const Image& image) {
  const int width = image.width();
  const int height = image.height();
  const OwnSize as_it_is{width, height, 0};
  if (width < 2 * kLargest || height < 2 * kLargest) return as_it_is;
  const Steps steps = steps_of(image.luminance);
  const Line columns(steps.columns);
  const Line rows(steps.rows);
  const int least = static_cast<int>(std::ceil(width / kLargest));
  for (int own = least; own <= width / kSmallest; ++own)
    for (const double shift : kShifts) {
      if (!columns.are_of(own, shift)) continue;
      const double other = static_cast<double>(own) * height / width;
      for (const double n : {std::floor(other), std::ceil(other)})
        if (rows.are_of(static_cast<int>(n), shift)) return {own, static_cast<int>(n), shift};
    }
  return as_it_is;
}

Image reduced(const Image& image, const OwnSize& size) {
  Image small;
  small.luminance = Raster<std::uint16_t>(size.width, size.height);
  small.pixels_per_mm = image.pixels_per_mm * size.width / image.width();
  small.on_black = image.on_black;
  for (int y = 0; y < size.height; ++y) {
    const int top = begin_of(y, size.height, image.height(), size.shift);
    const int bottom = begin_of(y + 1, size.height, image.height(), size.shift);
    for (int x = 0; x < size.width; ++x) {
      const int left = begin_of(x, size.width, image.width(), size.shift);
      const int right = begin_of(x + 1, size.width, image.width(), size.shift);
      std::int64_t sum = 0;
      for (int v = top; v < bottom; ++v)
        for (int u = left; u < right; ++u) sum += image.luminance.at(u, v);
      const std::int64_t count = std::int64_t{bottom - top} * (right - left);
      small.luminance.at(x, y) = static_cast<std::uint16_t>(sum / std::max<std::int64_t>(1, count));
    }
  }
  return small;
}

void enlarge(TraceResult& trace, int to_width, int to_height) {
  const double across = static_cast<double>(to_width) / trace.width;
  const double down = static_cast<double>(to_height) / trace.height;
  const auto grow = [across, down](core::Point2& p) { p = {across * p.x, down * p.y}; };
  if (trace.sheet)
    for (core::Point2& p : *trace.sheet) grow(p);
  trace.width = to_width;
  trace.height = to_height;
  for (DrawnStroke& pass : trace.passes)
    for (core::Point2& p : pass.points) grow(p);
  for (Stroke& stroke : trace.strokes) scale(stroke, across, down);
}

}  // namespace keyline::sketch
