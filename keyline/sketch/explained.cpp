#include "keyline/sketch/explained.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>

#include "keyline/core/polygon.h"
#include "keyline/numeric/parallel.h"
#include "keyline/sketch/pixel_words.h"
#include "keyline/sketch/rows.h"

namespace keyline::sketch {
namespace {

using core::Point2;

/// The least whole number from v and 0 on.
int whole_up(double v) {
  if (v <= 0) return 0;
  const int down = static_cast<int>(v);
  return down < v ? down + 1 : down;
}

void take_out(Binary& ink, Point2 p, double reach) {
  const int top = whole_up(p.y - reach - 1);
  for (int y = top; y < ink.height && y <= p.y + reach; ++y) {
    const double rest = reach * reach - (y + 0.5 - p.y) * (y + 0.5 - p.y);
    if (rest < 0) continue;
    const double half = std::sqrt(rest);
    const double end = p.x + half - 0.5;
    if (end < 0) continue;
    const int left = whole_up(p.x - half - 0.5);
    const int right = std::min(ink.width - 1, static_cast<int>(end));
    // other lines may take the same pixel out at the same time
    for (int x = left; x <= right; ++x)
      std::atomic_ref(ink.at(x, y)).store(0, std::memory_order_relaxed);
  }
}

double count(const Binary& ink) {
  std::atomic<std::int64_t> sum = 0;
  for_rows(0, ink.height, [&](int first, int last) {
    sum += count_ink(ink.data.data() + ink.index(0, first), ink.index(0, last - first));
  });
  return static_cast<double>(sum);
}

/// The ink that a line explains.
void take_out(Binary& ink, const Stroke& stroke) {
  const auto far = [](Point2 a, Point2 b) { return dot(b - a, b - a); };
  std::size_t at = 0;  // the point of the stroke beside the curve's
  for (const curve::Bezier2& piece : stroke.curve) {
    const int n = 2 + static_cast<int>(core::polygon_length(piece.control));
    for (int i = 0; i < n; ++i) {
      const Point2 p = evaluate(piece, (i + 0.5) / n);
      while (at + 1 < stroke.points.size() &&
             far(stroke.points[at + 1], p) <= far(stroke.points[at], p))
        ++at;
      take_out(ink, p, 0.5 * std::max(stroke.widths[at], stroke.width) + 1);
    }
  }
}

void take_out(Binary& ink, const FineStroke& stroke) {
  for (std::size_t i = 0; i < stroke.points.size(); ++i)
    take_out(ink, stroke.points[i], 0.5 * std::max(stroke.widths[i], stroke.width) + 1);
}

template <class Line>
double explained_share(Binary& ink, const std::vector<Line>& lines) {
  const double all = count(ink);
  if (!(all > 0)) return 1;
  numeric::parallel_for(lines.size(), 0, [&](std::size_t i) { take_out(ink, lines[i]); });
  return (all - count(ink)) / all;
}

}  // namespace

double explained_ink(Binary& ink, const std::vector<Stroke>& strokes) {
  return explained_share(ink, strokes);
}

double explained_ink(Binary& ink, const std::vector<FineStroke>& strokes) {
  return explained_share(ink, strokes);
}

}  // namespace keyline::sketch
