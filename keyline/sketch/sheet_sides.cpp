#include "keyline/sketch/sheet_sides.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "keyline/core/second_moments.h"

namespace keyline::sketch {
namespace {

using core::Point2;
using core::Vector2;

constexpr double kLeastStep = 0.06;  ///< of log luminance per pixel: a border is 15 % darker beyond
constexpr int kDirections = 360;     ///< of a normal, by degrees
constexpr double kOffsetBin = 2;     ///< pixels
constexpr int kSpread = 3;           ///< degrees either way that a pixel votes for
constexpr int kMostSides = 20;       ///< that four are chosen from
constexpr double kLeastVotes = 0.1;  ///< of the picture's shorter side
constexpr int kApart = 4;            ///< degrees and bins: nearer sides are one
constexpr double kBeside = 2;        ///< pixels
constexpr double kAligned = 0.966;   ///< cos 15 degrees

Vector2 direction_of(int degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

Point2 meeting(const Side& a, const Side& b) {
  const double det = core::cross(a.normal, b.normal);
  return {(a.offset * b.normal.y - b.offset * a.normal.y) / det,
          (a.normal.x * b.offset - b.normal.x * a.offset) / det};
}

/// Votes of border pixels for sides, by direction of the normal (degrees) and offset.
class Borders::Votes {
 public:
  Votes(int width, int height) : half_(std::hypot(width, height)) {
    bins_ = static_cast<int>(2 * half_ / kOffsetBin) + 3;
    votes_.assign(static_cast<std::size_t>(kDirections) * static_cast<std::size_t>(bins_), 0);
  }

  void add(const Pixel& pixel) {
    const double angle = std::atan2(pixel.towards.y, pixel.towards.x) * 180 / std::numbers::pi;
    const int middle = static_cast<int>(std::lround(angle)) + kDirections;
    for (int d = middle - kSpread; d <= middle + kSpread; ++d) {
      const double offset = core::dot(direction_of(d), pixel.place - Point2{});
      ++at(d % kDirections, bin_of(offset));
    }
  }

  /// The side with most votes, which are taken away with those of sides nearly the same.
  Side take(int& votes) {
    const auto most = std::max_element(votes_.begin(), votes_.end());
    votes = *most;
    const int cell = static_cast<int>(most - votes_.begin());
    const int degrees = cell / bins_;
    const int bin = cell % bins_;
    for (int d = degrees - kApart; d <= degrees + kApart; ++d)
      for (int b = std::max(0, bin - kApart); b <= std::min(bins_ - 1, bin + kApart); ++b)
        at((d + kDirections) % kDirections, b) = 0;
    return {direction_of(degrees), bin * kOffsetBin - half_};
  }

 private:
  int bin_of(double offset) const {
    return static_cast<int>(std::lround((offset + half_) / kOffsetBin));
  }
  int& at(int degrees, int bin) {
    return votes_[static_cast<std::size_t>(degrees) * static_cast<std::size_t>(bins_) +
                  static_cast<std::size_t>(bin)];
  }

  double half_;
  int bins_;
  std::vector<int> votes_;
};

Borders::Borders(Raster<float> level)
    : level_(std::move(level)), index_(level_.width, level_.height, -1) {
  find_pixels();
}

/// Pixels whose slope is the largest along its own direction, and steep enough.
void Borders::find_pixels() {
  cv::Mat smooth;
  const cv::Mat level(level_.height, level_.width, CV_32F, level_.data.data());
  cv::GaussianBlur(level, smooth, {5, 5}, 1);
  cv::Mat across;
  cv::Mat down;
  cv::Sobel(smooth, across, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(smooth, down, CV_32F, 0, 1, 3, 1.0 / 8);
  const auto slope = [&](int x, int y) {
    return Vector2{across.at<float>(y, x), down.at<float>(y, x)};
  };
  for (int y = 2; y + 2 < level_.height; ++y)
    for (int x = 2; x + 2 < level_.width; ++x) {
      const Vector2 here = slope(x, y);
      if (std::abs(here.x) + std::abs(here.y) < kLeastStep) continue;  // most places
      const double steep = core::norm(here);
      if (steep < kLeastStep) continue;
      const Vector2 towards = here / steep;
      const int dx = static_cast<int>(std::lround(towards.x));
      const int dy = static_cast<int>(std::lround(towards.y));
      if (core::norm(slope(x + dx, y + dy)) > steep || core::norm(slope(x - dx, y - dy)) > steep)
        continue;
      index_.at(x, y) = static_cast<int>(pixels_.size());
      pixels_.push_back({{x + 0.5, y + 0.5}, towards});
    }
}

std::vector<Side> Borders::sides() const {
  Votes votes(level_.width, level_.height);
  for (const Pixel& pixel : pixels_) votes.add(pixel);
  const double least = kLeastVotes * std::min(level_.width, level_.height);
  std::vector<Side> sides;
  while (static_cast<int>(sides.size()) < kMostSides) {
    int count = 0;
    const Side side = votes.take(count);
    if (count < least) break;
    sides.push_back(fitted(side));
  }
  return sides;
}

/// The same side through the middle of its pixels: direction of least scatter.
Side Borders::fitted(const Side& side) const {
  std::vector<Point2> own;
  Vector2 sum{};
  for (const Pixel& pixel : pixels_) {
    if (std::abs(core::dot(side.normal, pixel.place - Point2{}) - side.offset) > 1.5 * kBeside ||
        core::dot(side.normal, pixel.towards) < kAligned)
      continue;
    own.push_back(pixel.place);
    sum = sum + (pixel.place - Point2{});
  }
  if (own.size() < 8) return side;
  const Point2 middle = Point2{} + sum / static_cast<double>(own.size());
  core::SecondMoments moments;
  for (const Point2 p : own) moments.add(p - middle);
  Vector2 normal = core::perpendicular_left(moments.direction());
  if (core::dot(normal, side.normal) < 0) normal = -normal;
  return {normal, core::dot(normal, middle - Point2{})};
}

bool Borders::supports(const Side& side, Point2 p) const {
  const int reach = static_cast<int>(kBeside);
  const int x = static_cast<int>(std::floor(p.x));
  const int y = static_cast<int>(std::floor(p.y));
  for (int v = y - reach; v <= y + reach; ++v)
    for (int u = x - reach; u <= x + reach; ++u) {
      if (!index_.contains(u, v) || index_.at(u, v) < 0) continue;
      const Pixel& pixel = pixels_[static_cast<std::size_t>(index_.at(u, v))];
      if (core::dot(side.normal, pixel.towards) >= kAligned) return true;
    }
  return false;
}

}  // namespace keyline::sketch
