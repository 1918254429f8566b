#include "drawing_generator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "keyline/curve/bezier.h"
#include "keyline/lac/segment/segment.h"
#include "keyline/numeric/random.h"

namespace keyline::sketch::testing {
namespace {

using core::distance;
using core::Point2;
using core::Vector2;
using numeric::Random;

constexpr int kWidth = 480;
constexpr int kHeight = 360;
constexpr double kMargin = 20;

std::vector<Point2> even(const std::vector<Point2>& fine) {
  std::vector<Point2> points = {fine.front()};
  double rest = 0.5;
  for (std::size_t i = 1; i < fine.size(); ++i) {
    Point2 from = fine[i - 1];
    double edge = distance(from, fine[i]);
    while (edge >= rest) {
      from = core::mix(from, fine[i], rest / edge);
      points.push_back(from);
      edge -= rest;
      rest = 0.5;
    }
    rest -= edge;
  }
  return points;
}

std::vector<Point2> log_aesthetic(Random& random) {
  const double length = random.uniform(120, 420);
  const double turn = random.uniform(0.2, 2.4) * (random.chance(0.5) ? 1 : -1);
  const double ratio = random.uniform(0.25, 4);
  static constexpr std::array<double, 5> kSlopes = {-1, 0, 0.5, 1, 2};
  const double k = turn / length;
  const core::Pose2 pose{
      {random.uniform(kMargin, kWidth - kMargin), random.uniform(kMargin, kHeight - kMargin)},
      random.uniform(0, 2 * std::numbers::pi)};
  const lac::Segment segment{pose, kSlopes[random.index(5)], length, k * std::sqrt(ratio),
                             k / std::sqrt(ratio)};
  std::vector<Point2> points;
  for (int i = 0; i <= 800; ++i) points.push_back(evaluate(segment, i / 800.0));
  return points;
}

std::vector<Point2> cubic(Random& random) {
  curve::Bezier2 bezier;
  for (int i = 0; i < 4; ++i)
    bezier.control.push_back(
        {random.uniform(kMargin, kWidth - kMargin), random.uniform(kMargin, kHeight - kMargin)});
  std::vector<Point2> points;
  for (int i = 0; i <= 1500; ++i) points.push_back(evaluate(bezier, i / 1500.0));
  return points;
}

Vector2 tangent(const TrueStroke& s, std::size_t i) {
  const std::size_t a = i < 4 ? 0 : i - 4;
  const std::size_t b = std::min(i + 4, s.points.size() - 1);
  const Vector2 d = s.points[b] - s.points[a];
  return d / core::norm(d);
}

bool is_on_page(const TrueStroke& s) {
  return std::all_of(s.points.begin(), s.points.end(), [&](Point2 p) {
    const double m = kMargin;
    return p.x > m && p.y > m && p.x < kWidth - m && p.y < kHeight - m;
  });
}

/// Bends no more sharply than three widths, and keeps clear of itself.
bool is_plain(const TrueStroke& s) {
  const std::size_t n = s.points.size();
  if (n < 160) return false;
  const double clear = 2 * s.width + 12;
  for (std::size_t i = 8; i + 8 < n; ++i) {
    const Vector2 a = s.points[i] - s.points[i - 8];
    const Vector2 b = s.points[i + 8] - s.points[i];
    const double bend = std::abs(std::atan2(core::cross(a, b), core::dot(a, b))) / 4.0;
    if (bend * std::max(3 * s.width, 12.0) > 1) return false;
  }
  for (std::size_t i = 0; i < n; i += 4)
    for (std::size_t j = i + static_cast<std::size_t>(4 * clear); j < n; j += 4)
      if (distance(s.points[i], s.points[j]) < clear) return false;
  return true;
}

bool near_end(const TrueStroke& s, std::size_t i, double reach) {
  return 0.5 * static_cast<double>(std::min(i, s.points.size() - 1 - i)) < reach;
}

/// Two strokes may meet only where they cross well.
bool get_along(const TrueStroke& a, const TrueStroke& b) {
  const double clear = 0.5 * (a.width + b.width) + 5;
  const double of_ends = 2 * (a.width + b.width) + 10;
  for (std::size_t i = 0; i < a.points.size(); i += 2)
    for (std::size_t j = 0; j < b.points.size(); j += 2) {
      const double d = distance(a.points[i], b.points[j]);
      if (d > of_ends) {
        j += static_cast<std::size_t>(2 * (d - of_ends)) / 2 * 2;
        continue;
      }
      if (near_end(a, i, of_ends) || near_end(b, j, of_ends)) return false;
      if (d < clear && std::abs(core::cross(tangent(a, i), tangent(b, j))) < 0.5) return false;
    }
  return true;
}

std::vector<TrueStroke> make_strokes(Random& random) {
  std::vector<TrueStroke> strokes;
  const std::size_t wanted = 3 + random.index(4);
  const double base = random.uniform(2, 12);
  for (int tries = 0; tries < 400 && strokes.size() < wanted; ++tries) {
    const std::vector<Point2> fine = random.chance(0.6) ? log_aesthetic(random) : cubic(random);
    TrueStroke s{even(fine), std::clamp(base * random.uniform(0.8, 1.25), 2.0, 12.0)};
    if (!is_on_page(s) || !is_plain(s)) continue;
    if (!std::all_of(strokes.begin(), strokes.end(),
                     [&](const auto& t) { return get_along(s, t); }))
      continue;
    strokes.push_back(std::move(s));
  }
  return strokes;
}

using Page = std::vector<double>;  ///< brightness 0 … 1, top row first

std::size_t at(int x, int y) { return static_cast<std::size_t>(y * kWidth + x); }

void lay_paper(Random& random, Page& page) {
  const double high = random.uniform(0.8, 1);
  const double slope = random.uniform(0, 0.35);
  const double direction = random.uniform(0, 2 * std::numbers::pi);
  const double grain = random.chance(0.6) ? random.uniform(0, 0.025) : 0;
  Page noise(page.size());
  for (double& v : noise) v = random.normal();
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double u = (x * std::cos(direction) + y * std::sin(direction)) / kWidth;
      const double near = noise[at(x, y)] + noise[at(std::min(x + 1, kWidth - 1), y)] +
                          noise[at(x, std::min(y + 1, kHeight - 1))];
      page[at(x, y)] = high - slope * (0.5 + 0.5 * std::sin(2 * u)) + grain * near / 1.7;
    }
}

void draw(const TrueStroke& s, double ink, Page& page) {
  std::vector<double> cover(page.size(), 0);
  const double reach = 0.5 * s.width + 1;
  for (const Point2 p : s.points) {
    const double row = kHeight - p.y;
    for (int y = static_cast<int>(row - reach); y <= static_cast<int>(row + reach); ++y)
      for (int x = static_cast<int>(p.x - reach); x <= static_cast<int>(p.x + reach); ++x) {
        const double d = std::hypot(x + 0.5 - p.x, y + 0.5 - row);
        double& c = cover[at(x, y)];
        c = std::max(c, std::clamp(0.5 + 0.5 * s.width - d, 0.0, 1.0));
      }
  }
  for (std::size_t i = 0; i < page.size(); ++i) page[i] *= 1 - ink * cover[i];
}

void sprinkle(Random& random, Page& page) {
  const double share = random.chance(0.5) ? random.uniform(0, 0.01) : 0;
  for (double& v : page)
    if (random.chance(share)) v = random.chance(0.5) ? 0 : 1;
}

/// What JPEG does to the luminance: blocks of 8 × 8, cosine transform, coarse steps (Annex K).
void compress(double quality, Page& page) {
  static constexpr std::array<int, 64> kSteps = {
      16, 11, 10, 16, 24,  40,  51,  61,  12, 12, 14, 19, 26,  58,  60,  55,
      14, 13, 16, 24, 40,  57,  69,  56,  14, 17, 22, 29, 51,  87,  80,  62,
      18, 22, 37, 56, 68,  109, 103, 77,  24, 35, 55, 64, 81,  104, 113, 92,
      49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99};
  const double scale = quality < 50 ? 50 / quality : 2 - quality / 50;
  std::array<double, 64> basis{};
  for (int k = 0; k < 8; ++k)
    for (int i = 0; i < 8; ++i)
      basis[static_cast<std::size_t>(8 * k + i)] =
          (k == 0 ? std::sqrt(0.125) : 0.5) * std::cos((2 * i + 1) * k * std::numbers::pi / 16);
  const auto b = [&](int k, int i) { return basis[static_cast<std::size_t>(8 * k + i)]; };
  std::array<std::array<double, 8>, 8> f{};
  std::array<std::array<double, 8>, 8> g{};
  const auto transform = [&](bool back) {
    for (int pass = 0; pass < 2; ++pass) {
      for (int r = 0; r < 8; ++r)
        for (int k = 0; k < 8; ++k) {
          double sum = 0;
          for (int i = 0; i < 8; ++i) sum += (back ? b(i, k) : b(k, i)) * f[r][i];
          g[k][r] = sum;
        }
      f = g;
    }
  };
  for (int y = 0; y + 8 <= kHeight; y += 8)
    for (int x = 0; x + 8 <= kWidth; x += 8) {
      for (int r = 0; r < 8; ++r)
        for (int c = 0; c < 8; ++c) f[r][c] = 255 * page[at(x + c, y + r)] - 128;
      transform(false);
      for (int r = 0; r < 8; ++r)
        for (int c = 0; c < 8; ++c) {
          const double step = std::max(1.0, kSteps[static_cast<std::size_t>(8 * r + c)] * scale);
          f[r][c] = step * std::round(f[r][c] / step);
        }
      transform(true);
      for (int r = 0; r < 8; ++r)
        for (int c = 0; c < 8; ++c) page[at(x + c, y + r)] = (f[r][c] + 128) / 255;
    }
}

}  // namespace

TrueDrawing make_drawing(std::uint64_t seed) {
  Random random(seed, 4711);
  TrueDrawing drawing;
  drawing.strokes = make_strokes(random);
  Page page(static_cast<std::size_t>(kWidth * kHeight), 1);
  lay_paper(random, page);
  const double ink = random.uniform(0.5, 0.95);
  for (const TrueStroke& s : drawing.strokes) draw(s, ink * random.uniform(0.85, 1), page);
  sprinkle(random, page);
  if (random.chance(0.5)) compress(random.uniform(35, 95), page);
  drawing.image.luminance = Raster<std::uint16_t>(kWidth, kHeight);
  for (std::size_t i = 0; i < page.size(); ++i)
    drawing.image.luminance.data[i] =
        static_cast<std::uint16_t>(257 * std::lround(255 * std::clamp(page[i], 0.0, 1.0)));
  return drawing;
}

}  // namespace keyline::sketch::testing
