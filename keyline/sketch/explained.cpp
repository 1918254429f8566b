#include "keyline/sketch/explained.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace keyline::sketch {
namespace {

using core::Point2;

void take_out(Binary& ink, Point2 p, double reach) {
  const int top = std::max(0, static_cast<int>(std::floor(p.y - reach)));
  const int bottom = std::min(ink.height - 1, static_cast<int>(std::floor(p.y + reach)));
  for (int y = top; y <= bottom; ++y) {
    const double rest = reach * reach - (y + 0.5 - p.y) * (y + 0.5 - p.y);
    if (rest < 0) continue;
    const double half = std::sqrt(rest);
    const int left = std::max(0, static_cast<int>(std::ceil(p.x - half - 0.5)));
    const int right = std::min(ink.width - 1, static_cast<int>(std::floor(p.x + half - 0.5)));
    for (int x = left; x <= right; ++x) ink.at(x, y) = 0;
  }
}

double count(const Binary& ink) {
  return static_cast<double>(
      std::accumulate(ink.data.begin(), ink.data.end(), std::int64_t{0},
                      [](std::int64_t sum, std::uint8_t v) { return sum + (v ? 1 : 0); }));
}

}  // namespace

double explained_ink(Binary& ink, const std::vector<Stroke>& strokes) {
  const double all = count(ink);
  if (!(all > 0)) return 1;
  for (const Stroke& stroke : strokes) {
    std::size_t at = 0;  // the point of the stroke beside the curve's
    for (const curve::Bezier2& piece : stroke.curve) {
      const double chord = distance(piece.control.front(), piece.control.back());
      const int n = 2 + static_cast<int>(2 * chord);
      for (int i = 0; i < n; ++i) {
        const Point2 p = evaluate(piece, (i + 0.5) / n);
        while (at + 1 < stroke.points.size() &&
               distance(stroke.points[at + 1], p) <= distance(stroke.points[at], p))
          ++at;
        take_out(ink, p, 0.5 * std::max(stroke.widths[at], stroke.width) + 1);
      }
    }
  }
  return (all - count(ink)) / all;
}

}  // namespace keyline::sketch
