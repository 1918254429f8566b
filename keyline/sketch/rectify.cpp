#include "keyline/sketch/rectify.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace keyline::sketch {
namespace {

using core::Point2;

constexpr double kUsualFocal = 0.75;  ///< of the diagonal: 32 mm of a 35 mm film's 43
constexpr double kFocalSpread = 0.4;  ///< of its logarithm: a factor of 1.5
constexpr double kCornerError = 0.5;  ///< pixels
constexpr double kLeastSide = 8;      ///< pixels
constexpr double kMostBeyond = 1;     ///< of the photo's size that corners may lie outside

std::array<cv::Point2f, 4> as_cv(const SheetCorners& corners, Point2 origin) {
  std::array<cv::Point2f, 4> all;
  for (std::size_t i = 0; i < 4; ++i)
    all[i] = {static_cast<float>(corners[i].x - origin.x),
              static_cast<float>(corners[i].y - origin.y)};
  return all;
}

/// From the rectangle (0, 0) … (width, height) to the corners.
cv::Matx33d homography(const SheetCorners& corners, Point2 origin, double width, double height) {
  const SheetCorners square = {{{0, 0}, {width, 0}, {width, height}, {0, height}}};
  return cv::getPerspectiveTransform(as_cv(square, {}), as_cv(corners, origin));
}

/// What a camera of focal length f sees of the sheet's sides: whether they are at right angles, and
/// the ratio of their lengths.
struct SidesSeen {
  double cosine = 0;
  double ratio = 1;
};

SidesSeen sides_seen(const cv::Matx33d& h, double f) {
  const cv::Vec3d across(h(0, 0) / f, h(1, 0) / f, h(2, 0));
  const cv::Vec3d down(h(0, 1) / f, h(1, 1) / f, h(2, 1));
  const double a = cv::norm(across);
  const double d = cv::norm(down);
  return {across.dot(down) / (a * d), a / d};
}

/// Standard deviation of that cosine for corners as well known as they are.
double cosine_error(const SheetCorners& corners, Point2 middle, double f) {
  const double cosine = sides_seen(homography(corners, middle, 1, 1), f).cosine;
  double square = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (const auto& [dx, dy] : {std::pair{kCornerError, 0.0}, std::pair{0.0, kCornerError}}) {
      SheetCorners moved = corners;
      moved[i] = moved[i] + core::Vector2{dx, dy};
      const double change = sides_seen(homography(moved, middle, 1, 1), f).cosine - cosine;
      square += change * change;
    }
  return std::sqrt(std::max(square, 1e-12));
}

/// Width and height in pixels of the rectified picture.
cv::Size size_of(const SheetCorners& c, double ratio, double most) {
  const double across = std::max(core::distance(c[0], c[1]), core::distance(c[3], c[2]));
  const double down = std::max(core::distance(c[0], c[3]), core::distance(c[1], c[2]));
  double height = std::max(across / ratio, down);
  height *= std::min(1.0, std::sqrt(most / (ratio * height * height)));
  const auto pixels = [](double n) {
    return std::clamp(static_cast<int>(n), static_cast<int>(kLeastSide), kLargestPhoto);
  };
  return {pixels(ratio * height), pixels(height)};
}

/// Copies the rows and columns `rim` within over those without.
void repeat_rim(cv::Mat& sheet, int rim) {
  rim = std::min(rim, (std::min(sheet.rows, sheet.cols) - 1) / 2);
  if (rim <= 0) return;
  const cv::Rect within(rim, rim, sheet.cols - 2 * rim, sheet.rows - 2 * rim);
  cv::copyMakeBorder(sheet(within).clone(), sheet, rim, rim, rim, rim, cv::BORDER_REPLICATE);
}

core::Result<void> check(const Image& photo, const SheetCorners& c) {
  const auto bad = [](const char* what) {
    return core::fail(core::ErrorCode::bad_input, what,
                      "give its corners upper left, upper right, lower right, lower left, in "
                      "pixels from the picture's upper left corner",
                      "sheet");
  };
  if (std::max(photo.width(), photo.height()) > kLargestPhoto)
    return core::fail(core::ErrorCode::bad_input,
                      "photos to rectify are at most 32,000 pixels wide and high",
                      "make the picture smaller", "sheet");
  for (const Point2 p : c)
    if (!is_finite(p) ||
        std::abs(p.x - 0.5 * photo.width()) > (0.5 + kMostBeyond) * photo.width() ||
        std::abs(p.y - 0.5 * photo.height()) > (0.5 + kMostBeyond) * photo.height())
      return bad("a corner of the sheet lies far outside of the picture");
  for (std::size_t i = 0; i < 4; ++i) {
    const core::Vector2 side = c[(i + 1) % 4] - c[i];
    if (core::norm(side) < kLeastSide) return bad("a side of the sheet has no length");
    if (core::cross(side, c[(i + 2) % 4] - c[(i + 1) % 4]) <= 0)
      return bad("the corners are no sheet's");
  }
  return {};
}

}  // namespace

double aspect_of(const SheetCorners& corners, int width, int height) {
  constexpr int kSteps = 60;  // of the focal length, either way
  const Point2 middle{0.5 * width, 0.5 * height};
  const double usual = kUsualFocal * std::hypot(width, height);
  const cv::Matx33d h = homography(corners, middle, 1, 1);
  double best = HUGE_VAL;
  double ratio = 1;
  for (int k = -kSteps; k <= kSteps; ++k) {
    const double off = 3.0 * k / kSteps;  // of the focal length, in spreads
    const double f = usual * std::exp(kFocalSpread * off);
    const SidesSeen seen = sides_seen(h, f);
    const double bent = seen.cosine / cosine_error(corners, middle, f);
    if (bent * bent + off * off >= best) continue;
    best = bent * bent + off * off;
    ratio = seen.ratio;
  }
  return ratio;
}

core::Result<Image> rectified(const Image& photo, const SheetCorners& corners, double rim) {
  if (auto sound = check(photo, corners); !sound) return std::unexpected(sound.error());
  const double pixels = static_cast<double>(photo.luminance.data.size());
  const cv::Size size = size_of(corners, aspect_of(corners, photo.width(), photo.height()), pixels);
  // OpenCV counts from the middle of the first pixel
  const cv::Matx33d to_middle(1, 0, -0.5, 0, 1, -0.5, 0, 0, 1);
  const cv::Matx33d map =
      to_middle * homography(corners, {}, size.width, size.height) * to_middle.inv();
  const cv::Mat from(photo.height(), photo.width(), CV_16U,
                     const_cast<std::uint16_t*>(photo.luminance.data.data()));
  Image image;
  image.luminance = Raster<std::uint16_t>(size.width, size.height);
  cv::Mat sheet(size.height, size.width, CV_16U, image.luminance.data.data());
  cv::warpPerspective(from, sheet, map, size, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                      cv::BORDER_REPLICATE);
  repeat_rim(sheet, static_cast<int>(std::ceil(rim)));
  return image;
}

}  // namespace keyline::sketch
