#include "photo_generator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "keyline/numeric/random.h"

namespace keyline::sketch::testing {
namespace {

using core::Point2;
using core::Vector2;
using core::Vector3;
using numeric::Random;

constexpr int kWide = 1280;
constexpr int kHigh = 960;
constexpr int kFine = 2;  ///< pixels of the drawn sheet per unit
constexpr int kRays = 3;  ///< a pixel's side is looked at in so many places

/// A pinhole camera over the plane of the sheet.
class Camera {
 public:
  Camera(Random& r, double tilt, double width, double height) : middle_{0.5 * width, 0.5 * height} {
    const double diagonal = std::hypot(kWide, kHigh);
    focal_ = r.uniform(0.6, 1.2) * diagonal;
    const double slant = r.uniform(0.3, 1) * tilt;
    const double about = r.uniform(0, 2 * std::numbers::pi);
    const double roll = r.uniform(-0.25, 0.25) * tilt;
    forward_ = {std::sin(slant) * std::cos(about), std::sin(slant) * std::sin(about),
                -std::cos(slant)};
    const Vector3 up{-std::sin(roll), std::cos(roll), 0};
    right_ = cross(forward_, up);
    right_ = right_ / norm(right_);
    down_ = cross(forward_, right_);
    distance_ = focal_ * std::hypot(width, height) / (1.1 * kHigh);
  }

  /// Where a place of the sheet (y up) is seen, pixels with y down.
  Point2 seen(Point2 p) const {
    const Vector3 from = Vector3{p.x - middle_.x, p.y - middle_.y, 0} + distance_ * forward_;
    const double depth = dot(from, forward_);
    return {0.5 * kWide + focal_ * dot(from, right_) / depth,
            0.5 * kHigh + focal_ * dot(from, down_) / depth};
  }

  /// The place of the sheet's plane that is seen there.
  Point2 place(Point2 pixel) const {
    const Vector3 ray =
        focal_ * forward_ + (pixel.x - 0.5 * kWide) * right_ + (pixel.y - 0.5 * kHigh) * down_;
    const Vector3 eye = -distance_ * forward_;
    const double t = -eye.z / ray.z;
    return {middle_.x + eye.x + t * ray.x, middle_.y + eye.y + t * ray.y};
  }

 private:
  Point2 middle_;
  Vector3 forward_{};
  Vector3 right_{};
  Vector3 down_{};
  double focal_ = 1;
  double distance_ = 1;
};

/// In field k of three by two.
TrueStroke arc(Random& r, double width, double height, int k) {
  TrueStroke s{{}, r.uniform(4, 7)};
  const double first = r.uniform(0, 2 * std::numbers::pi);
  const double bend = r.uniform(-1, 1) / 250;
  const Point2 through{width * (k % 3 + 0.5) / 3, height * (k / 3 + 0.5) / 2};
  const double half = 0.2 * height;
  for (double t = -half; t <= half; t += 0.5) {
    const double turn = 0.5 * bend * t;
    const double reach = std::abs(turn) < 1e-9 ? t : t * std::sin(turn) / turn;
    s.points.push_back(through + reach * Vector2{std::cos(first + turn), std::sin(first + turn)});
  }
  return s;
}

/// Ink on the sheet, row by row from its upper side.
struct Drawn {
  int wide, high;
  std::vector<float> cover;

  Drawn(const std::vector<TrueStroke>& strokes, double width, double height)
      : wide(static_cast<int>(kFine * width)),
        high(static_cast<int>(kFine * height)),
        cover(static_cast<std::size_t>(wide) * static_cast<std::size_t>(high), 0) {
    for (const TrueStroke& s : strokes)
      for (const Point2 p : s.points) dot(kFine * p.x, high - kFine * p.y, 0.5 * kFine * s.width);
  }
  void dot(double cx, double cy, double radius) {
    for (int y = std::max(0, static_cast<int>(cy - radius - 1)); y < cy + radius + 1 && y < high;
         ++y)
      for (int x = std::max(0, static_cast<int>(cx - radius - 1)); x < cx + radius + 1 && x < wide;
           ++x) {
        const double reach = radius + 0.5 - std::hypot(x + 0.5 - cx, y + 0.5 - cy);
        float& c = cover[static_cast<std::size_t>(y * wide + x)];
        c = std::max(c, static_cast<float>(std::clamp(reach, 0.0, 1.0)));
      }
  }
  /// Share of ink at a place of the sheet; negative beside the sheet.
  double at(Point2 p) const {
    const int x = static_cast<int>(std::floor(kFine * p.x));
    const int y = static_cast<int>(std::floor(high - kFine * p.y));
    if (x < 0 || y < 0 || x >= wide || y >= high) return -1;
    return cover[static_cast<std::size_t>(y * wide + x)];
  }
};

/// What light falls on it, and what the table is like.
struct Scene {
  double paper, ink, table, grain, shadow, edge, slope, soft;

  explicit Scene(Random& r)
      : paper(r.uniform(0.75, 0.9)),
        ink(r.uniform(0.05, 0.25)),
        table(r.uniform(0.08, 0.35)),
        grain(r.uniform(0, 0.15)),
        shadow(r.uniform(0.45, 0.7)),
        edge(r.uniform(0.3, 0.7) * kWide),
        slope(r.uniform(-0.5, 0.5)),
        soft(r.uniform(15, 60)) {}

  double light(double x, double y) const {
    const double off = (x - edge - slope * (y - 0.5 * kHigh)) / soft;
    const double lit = 1 / (1 + std::exp(-4 * off));
    const double fall = std::hypot(x - 0.5 * kWide, y - 0.5 * kHigh) / kWide;
    return (shadow + (1 - shadow) * lit) * (1 - 0.4 * fall * fall);
  }
  double colour(Point2 place, double cover) const {
    if (cover >= 0) return paper * (1 - cover) + ink * cover;
    return table * (1 + grain * std::sin(0.11 * place.y + 2 * std::sin(0.013 * place.x)));
  }
};

}  // namespace

TruePhoto make_photo(std::uint64_t seed, double tilt) {
  Random random(seed, 67);
  TruePhoto photo;
  photo.width = 1188;
  photo.height = random.chance(0.5) ? 840 : 900;
  for (int k = 0; k < 6; ++k) photo.strokes.push_back(arc(random, photo.width, photo.height, k));
  const Camera camera(random, tilt, photo.width, photo.height);
  const Scene scene(random);
  const Drawn drawn(photo.strokes, photo.width, photo.height);
  photo.corners = {camera.seen({0, photo.height}), camera.seen({photo.width, photo.height}),
                   camera.seen({photo.width, 0}), camera.seen({0, 0})};
  photo.image.luminance = Raster<std::uint16_t>(kWide, kHigh);
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kWide; ++x) {
      double sum = 0;
      for (int i = 0; i < kRays * kRays; ++i) {
        const Point2 p =
            camera.place({x + (i % kRays + 0.5) / kRays, y + (i / kRays + 0.5) / kRays});
        sum += scene.colour(p, drawn.at(p)) / (kRays * kRays);
      }
      const double encoded = std::pow(sum * scene.light(x, y), 1 / 2.2) + 0.006 * random.normal();
      photo.image.luminance.at(x, y) =
          static_cast<std::uint16_t>(std::lround(65535 * std::clamp(encoded, 0.0, 1.0)));
    }
  return photo;
}

}  // namespace keyline::sketch::testing
