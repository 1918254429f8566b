#include "keyline/sketch/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "keyline/core/quantile.h"
#include "keyline/sketch/sheet_sides.h"

namespace keyline::sketch {
namespace {

using core::Point2;
using core::Vector2;
using Sides = std::array<Side, 4>;  // by direction of their normals

constexpr double kReduced = 512;  ///< pixels, about: the longer side that sheets are looked for in
constexpr int kLeastSize = 64;    ///< pixels: in less there is no sheet
constexpr int kLine = 9;          ///< reduced pixels: dark lines up to that width are closed
constexpr double kLeastArea = 0.1;     ///< of the picture
constexpr double kLeastCorner = 0.5;   ///< radians between the normals of neighbouring sides
constexpr double kBeyond = 0.05;       ///< of the picture's size a corner may lie outside
constexpr double kLeastSupport = 0.6;  ///< of a side that has to be a border
constexpr double kLeastInside = 0.5;   ///< of a side that has to lie in the picture
constexpr double kLeastDark = 0.7;     ///< of the ground beyond each side that has to be darker
constexpr double kDarker = 0.15;       ///< of log luminance: that is darker, whatever the step
constexpr double kBand = 4;            ///< reduced pixels beside a side that may be either
constexpr double kUnsupported = 2;     ///< that a pixel of side without border counts against

/// Pixels of the photo, one way, that become one.
int reduction(const Image& image) {
  return std::max(
      1, static_cast<int>(std::lround(std::max(image.width(), image.height()) / kReduced)));
}

/// log luminance (1 to 256) of the picture reduced so many times, its lines closed.
Raster<float> reduced_level(const Image& image, int times) {
  const cv::Mat full(image.height(), image.width(), CV_16U,
                     const_cast<std::uint16_t*>(image.luminance.data.data()));
  const cv::Size size(image.width() / times, image.height() / times);
  cv::Mat small;
  cv::resize(full(cv::Rect({}, size * times)), small, size, 0, 0, cv::INTER_AREA);
  const cv::Mat square = cv::Mat::ones(kLine, kLine, CV_8U);
  cv::morphologyEx(small, small, cv::MORPH_CLOSE, square, {-1, -1}, 1, cv::BORDER_REPLICATE);
  Raster<float> level(small.cols, small.rows);
  cv::Mat target(small.rows, small.cols, CV_32F, level.data.data());
  small.convertTo(target, CV_32F, 255.0 / 65535, 1);
  cv::log(target, target);
  return level;
}

SheetCorners corners_of(const Sides& sides) {
  SheetCorners corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = meeting(sides[i], sides[(i + 1) % 4]);
  return corners;
}

double area_of(const SheetCorners& c) { return 0.5 * core::cross(c[2] - c[0], c[3] - c[1]); }

/// Four sides around a place, none turning too little or too much, of a quadrilateral that is large
/// enough and lies in the picture.
bool is_quadrilateral(const Sides& sides, int width, int height) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2 a = sides[i].normal;
    const Vector2 b = sides[(i + 1) % 4].normal;
    const double turn = std::atan2(core::cross(a, b), core::dot(a, b));
    if (turn < kLeastCorner || turn > std::numbers::pi - kLeastCorner) return false;
  }
  const SheetCorners corners = corners_of(sides);
  for (const Point2 p : corners)
    if (p.x < -kBeyond * width || p.y < -kBeyond * height || p.x > (1 + kBeyond) * width ||
        p.y > (1 + kBeyond) * height)
      return false;
  for (std::size_t i = 0; i < 4; ++i)  // the light side of each is inside
    for (const std::size_t k : {1U, 2U})
      if (core::dot(sides[i].normal, corners[(i + k) % 4] - Point2{}) <= sides[i].offset)
        return false;
  return area_of(corners) >= kLeastArea * width * height;
}

class Finder {
 public:
  explicit Finder(Borders borders) : borders_(std::move(borders)) {}

  /// The quadrilateral with the longest border that is a sheet's.
  std::optional<Sides> find() const {
    std::vector<std::pair<double, Sides>> found;
    std::vector<Side> all = borders_.sides();
    std::sort(all.begin(), all.end(), [](const Side& a, const Side& b) {
      return std::atan2(a.normal.y, a.normal.x) < std::atan2(b.normal.y, b.normal.x);
    });
    const std::size_t n = all.size();
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = a + 1; b < n; ++b)
        for (std::size_t c = b + 1; c < n; ++c)
          for (std::size_t d = c + 1; d < n; ++d) add({all[a], all[b], all[c], all[d]}, found);
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& p, const auto& q) { return p.first > q.first; });
    for (const auto& [score, sides] : found)
      if (lies_on_ground(sides)) return sides;
    return std::nullopt;
  }

 private:
  int width() const { return borders_.level().width; }
  int height() const { return borders_.level().height; }
  bool contains(Point2 p) const { return p.x >= 0 && p.y >= 0 && p.x < width() && p.y < height(); }
  double level(Point2 p) const {
    return borders_.level().at(static_cast<int>(p.x), static_cast<int>(p.y));
  }

  /// Places a pixel apart along side i of those corners.
  static std::vector<Point2> along(const SheetCorners& corners, std::size_t i) {
    const Point2 from = corners[(i + 3) % 4];
    const Point2 to = corners[i];
    const int steps = std::max(1, static_cast<int>(core::distance(from, to)));
    std::vector<Point2> places;
    for (int k = 0; k < steps; ++k) places.push_back(core::mix(from, to, (k + 0.5) / steps));
    return places;
  }

  void add(const Sides& sides, std::vector<std::pair<double, Sides>>& found) const {
    if (!is_quadrilateral(sides, width(), height())) return;
    const SheetCorners corners = corners_of(sides);
    double score = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      double inside = 0;
      double border = 0;
      const std::vector<Point2> places = along(corners, i);
      for (const Point2 p : places) {
        if (!contains(p)) continue;
        ++inside;
        border += borders_.supports(sides[i], p) ? 1 : 0;
      }
      if (border < kLeastSupport * inside ||
          inside < kLeastInside * static_cast<double>(places.size()))
        return;
      score += border - kUnsupported * (inside - border);
    }
    found.emplace_back(score, sides);
  }

  /// Beyond each side everything is darker for the most part than the paper beside that side.
  bool lies_on_ground(const Sides& sides) const {
    const SheetCorners corners = corners_of(sides);
    for (std::size_t i = 0; i < 4; ++i) {
      double seen = 0;
      double dark = 0;
      for (const Point2 p : along(corners, i)) {
        const Point2 within = p + kBand * sides[i].normal;
        const Point2 beyond = p - kBand * sides[i].normal;
        if (!contains(within) || !contains(beyond)) continue;
        const double paper = level(within);
        const double most = std::max(0.5 * (paper + level(beyond)), paper - kDarker);
        for (Point2 q = beyond; contains(q); q = q - 2 * sides[i].normal) {
          ++seen;
          dark += level(q) <= most ? 1 : 0;
        }
      }
      if (seen == 0 || dark < kLeastDark * seen) return false;
    }
    return true;
  }

  Borders borders_;
};

/// Where the border lies in the photo itself.
class Refining {
 public:
  Refining(const Image& image, double reach) : level_(image.luminance), reach_(reach) {}

  /// The side through the places between two corners where the light falls to half; their rms
  /// distance from it goes to `square` and `count`.
  Side refined(const Side& side, Point2 from, Point2 to, double& square, double& count) const {
    constexpr int kPlaces = 160;  // looked at along a side
    std::vector<Point2> places;
    for (int k = 0; k < kPlaces; ++k) {
      const Point2 p = core::mix(from, to, 0.03 + 0.94 * (k + 0.5) / kPlaces);
      if (const auto step = step_at(p, side.normal)) places.push_back(p + *step * side.normal);
    }
    Side line = side;
    for (int round = 0; round < 4 && places.size() >= 8; ++round) {
      line = through(places, side.normal);
      std::vector<double> off;
      for (const Point2 p : places) off.push_back(off_of(line, p));
      const double most = std::max(0.5, 3 * core::quantile(off));
      std::erase_if(places, [&](Point2 p) { return off_of(line, p) > most; });
    }
    for (const Point2 p : places) square += off_of(line, p) * off_of(line, p);
    count += static_cast<double>(places.size());
    return line;
  }

 private:
  static double off_of(const Side& line, Point2 p) {
    return std::abs(core::dot(line.normal, p - Point2{}) - line.offset);
  }

  static Side through(const std::vector<Point2>& places, Vector2 normal) {
    const Vector2 tangent = core::perpendicular_left(normal);
    double n = 0;
    double s = 0;
    double h = 0;
    double ss = 0;
    double sh = 0;
    for (const Point2 p : places) {
      const double u = core::dot(tangent, p - places.front());
      const double v = core::dot(normal, p - places.front());
      n += 1, s += u, h += v, ss += u * u, sh += u * v;
    }
    const double slope = (n * sh - s * h) / std::max(1e-9, n * ss - s * s);
    const Vector2 turned = normal - slope * tangent;
    const Vector2 unit = turned / core::norm(turned);
    const Point2 middle = places.front() + (s / n) * tangent + (h / n) * normal;
    return {unit, core::dot(unit, middle - Point2{})};
  }

  double at(Point2 p) const {
    const double x = std::clamp(p.x - 0.5, 0.0, level_.width - 1.0);
    const double y = std::clamp(p.y - 0.5, 0.0, level_.height - 1.0);
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, level_.width - 1);
    const int y1 = std::min(y0 + 1, level_.height - 1);
    const double u = x - x0;
    const double v = y - y0;
    return (1 - v) * ((1 - u) * level_.at(x0, y0) + u * level_.at(x1, y0)) +
           v * ((1 - u) * level_.at(x0, y1) + u * level_.at(x1, y1));
  }

  /// How far along the normal the steepest step from dark to light is half done.
  std::optional<double> step_at(Point2 p, Vector2 normal) const {
    constexpr double kStep = 0.5;  // pixels
    constexpr int kFlank = 4;      // steps that a soft border takes
    const int n = static_cast<int>(reach_ / kStep);
    std::vector<double> value;
    for (int k = -n - kFlank; k <= n + kFlank; ++k) {
      const Point2 q = p + k * kStep * normal;
      if (q.x < 0 || q.y < 0 || q.x >= level_.width || q.y >= level_.height) return std::nullopt;
      value.push_back(at(q));
    }
    std::size_t best = kFlank;
    for (std::size_t k = kFlank; k + kFlank < value.size(); ++k)
      if (value[k + kFlank] - value[k - kFlank] > value[best + kFlank] - value[best - kFlank])
        best = k;
    const double half = 0.5 * (value[best + kFlank] + value[best - kFlank]);
    for (std::size_t k = best - kFlank; k < best + kFlank; ++k)
      if (value[k] <= half && value[k + 1] > half)
        return kStep * (static_cast<double>(k) + (half - value[k]) / (value[k + 1] - value[k]) - n -
                        kFlank);
    return std::nullopt;
  }

  const Raster<std::uint16_t>& level_;
  double reach_;
};

/// The upper left corner first: where the upper side goes most to the right.
SheetCorners turned_least(const SheetCorners& c) {
  SheetCorners best = c;
  double most = -HUGE_VAL;
  for (std::size_t k = 0; k < 4; ++k) {
    const SheetCorners turned = {c[k], c[(k + 1) % 4], c[(k + 2) % 4], c[(k + 3) % 4]};
    const double right = turned[1].x - turned[0].x + turned[2].x - turned[3].x;
    if (right > most) most = right, best = turned;
  }
  return best;
}

}  // namespace

std::optional<Sheet> find_sheet(const Image& image) {
  if (std::min(image.width(), image.height()) < kLeastSize) return std::nullopt;
  const int times = reduction(image);
  auto sides = Finder(Borders(reduced_level(image, times))).find();
  if (!sides) return std::nullopt;
  for (Side& side : *sides) side.offset *= times;
  double square = 0;
  double count = 0;
  for (const double reach : {3.0 * times + 2, 4.0}) {
    const SheetCorners corners = corners_of(*sides);
    const Refining refining(image, reach);
    Sides finer = *sides;
    square = count = 0;
    for (std::size_t i = 0; i < 4; ++i)
      finer[i] = refining.refined((*sides)[i], corners[(i + 3) % 4], corners[i], square, count);
    *sides = finer;
  }
  return Sheet{turned_least(corners_of(*sides)), std::sqrt(square / std::max(1.0, count))};
}

}  // namespace keyline::sketch
