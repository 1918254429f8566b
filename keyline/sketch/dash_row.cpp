#include "keyline/sketch/dash_row.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "keyline/core/angle.h"
#include "keyline/core/point.h"
#include "keyline/core/second_moments.h"

namespace keyline::sketch {
namespace {

using core::Point2;
using core::Vector2;

constexpr double kSlender = 6 / kEven;  ///< lengths of a dash, in its widths

/// Of an end of a dash, the nearest other end ahead.
struct Next {
  double gap = HUGE_VAL;
  std::size_t dash = 0;
  std::size_t end = 0;
};

/// Turn from the end of one dash over the gap into another; more than any where that goes back.
double turn_between(const Dash& a, std::size_t end_a, const Dash& b, std::size_t end_b) {
  const Vector2 out = end_a == 1 ? a.along : -a.along;
  const Vector2 in = end_b == 0 ? b.along : -b.along;
  const Vector2 over = b.end[end_b] - a.end[end_a];
  return std::max(std::abs(core::angle_between(out, over)),
                  std::abs(core::angle_between(over, in)));
}

/// For both ends of every dash; `dashes` from left to right by their first end.
std::vector<std::array<Next, 2>> nearest_of(const std::vector<Dash>& dashes) {
  std::vector<std::array<Next, 2>> next(dashes.size());
  double longest = 0;
  for (const Dash& d : dashes) longest = std::max(longest, d.length);
  const double reach = (kRowGap + 2) * longest;  // a gap and both dashes
  for (std::size_t i = 0; i < dashes.size(); ++i)
    for (std::size_t j = i + 1; j < dashes.size(); ++j) {
      if (dashes[j].end[0].x - dashes[i].end[0].x > reach) break;
      const double shorter = std::min(dashes[i].length, dashes[j].length);
      for (const std::size_t a : {0U, 1U})
        for (const std::size_t b : {0U, 1U}) {
          const double gap = core::distance(dashes[i].end[a], dashes[j].end[b]);
          if (gap > kRowGap * shorter) continue;
          const double unsure = 2 * kGrid / shorter;
          if (turn_between(dashes[i], a, dashes[j], b) > kRowTurn + unsure) continue;
          if (gap < next[i][a].gap) next[i][a] = {gap, j, b};
          if (gap < next[j][b].gap) next[j][b] = {gap, i, a};
        }
    }
  return next;
}

}  // namespace

Dash dash_of(std::span<const std::size_t> piece, std::size_t number, std::size_t width) {
  const auto place = [width](std::size_t i) {
    return Point2{static_cast<double>(i % width) + 0.5, static_cast<double>(i / width) + 0.5};
  };
  const auto count = static_cast<double>(piece.size());
  Vector2 sum{};
  for (const std::size_t i : piece) sum = sum + (place(i) - Point2{});
  const Point2 mean = Point2{} + sum / count;
  core::SecondMoments moments;
  for (const std::size_t i : piece) moments.add(place(i) - mean);
  Dash dash{.piece = number, .middle = mean, .along = moments.direction()};
  double low = 0;
  double high = 0;
  for (const std::size_t i : piece) {
    const double way = core::dot(place(i) - mean, dash.along);
    low = std::min(low, way - 0.5);
    high = std::max(high, way + 0.5);
  }
  dash.length = high - low;
  dash.end = {mean + low * dash.along, mean + high * dash.along};
  return dash;
}

bool is_even(double gap, double other) {
  return std::max(gap, other) < kEven * std::min(gap, other) + 2 * kGrid;
}

std::vector<bool> dashes_in_rows(const InkPieces& pieces, int width) {
  std::vector<Dash> dashes;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Dash dash = dash_of(pieces[i], i, static_cast<std::size_t>(width));
    const double broad = static_cast<double>(pieces[i].size()) / dash.length;
    if (dash.length >= kSlender * broad) dashes.push_back(dash);
  }
  std::ranges::sort(dashes, {}, [](const Dash& d) { return d.end[0].x; });
  const auto next = nearest_of(dashes);
  std::vector<bool> in_row(pieces.size());
  for (std::size_t i = 0; i < dashes.size(); ++i) {
    const auto mutual = [&](std::size_t end) {
      const Next& n = next[i][end];
      return std::isfinite(n.gap) && next[n.dash][n.end].dash == i &&
             next[n.dash][n.end].end == end;
    };
    if (!mutual(0) || !mutual(1) || !is_even(next[i][0].gap, next[i][1].gap)) continue;
    for (const std::size_t k : {i, next[i][0].dash, next[i][1].dash})
      in_row[dashes[k].piece] = true;
  }
  const auto drawn = static_cast<std::size_t>(std::ranges::count(in_row, true));
  if (2 * drawn <= dashes.size()) return std::vector<bool>(pieces.size());  // rows by chance
  return in_row;
}

}  // namespace keyline::sketch
