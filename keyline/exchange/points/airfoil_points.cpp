#include "keyline/exchange/points/airfoil_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

namespace keyline::exchange::detail {

namespace {

/// True for points that lead from the nose to the tail, in whatever unit: the first is nearer to
/// the least x of all than to the largest, the last the other way round.
bool leads_aft(std::span<const core::Point3> side, double low, double high) {
  const double middle = low + (high - low) / 2;
  return side.front().x < middle && side.back().x > middle;
}

}  // namespace

bool unfold_lednicer(acquire::RawCurve& c) {
  if (c.has_z) return false;
  const core::Point3 counts = c.points.front();
  const bool whole = counts.x >= 3 && counts.y >= 3 && std::floor(counts.x) == counts.x &&
                     std::floor(counts.y) == counts.y;
  if (!whole || counts.x + counts.y + 1 != static_cast<double>(c.points.size())) return false;
  const std::span<const core::Point3> points(c.points.begin() + 1, c.points.end());
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [](core::Point3 a, core::Point3 b) { return a.x < b.x; });
  const auto above = static_cast<std::size_t>(counts.x);
  if (!leads_aft(points.first(above), low->x, high->x) ||
      !leads_aft(points.subspan(above), low->x, high->x))
    return false;
  const auto upper = static_cast<std::ptrdiff_t>(counts.x);
  const auto unfold = [&](auto& values) {
    values.erase(values.begin());
    std::reverse(values.begin(), values.begin() + upper);
  };
  unfold(c.points);
  unfold(c.source_lines);
  c.notes.emplace_back("Lednicer airfoil: both sides joined at the nose into one curve");
  return true;
}

namespace {

bool is_mark(core::Point3 p) { return p.x == 999 && p.y == 999; }

/// True where 999 lies outside the points' box, enlarged by its size, in x and in y.
bool stands_apart(const std::vector<core::Point3>& points) {
  for (const double core::Point3::* axis : {&core::Point3::x, &core::Point3::y}) {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (const core::Point3& p : points) {
      if (is_mark(p) || !std::isfinite(p.*axis)) continue;
      low = std::min(low, p.*axis);
      high = std::max(high, p.*axis);
    }
    if (!(high + (high - low) < 999)) return false;
  }
  return true;
}

}  // namespace

void part_elements(std::vector<acquire::RawCurve>& curves) {
  const acquire::RawCurve whole = curves.front();
  const auto& points = whole.points;
  if (whole.has_z || std::none_of(points.begin(), points.end(), is_mark) || !stands_apart(points))
    return;
  curves.clear();
  bool open = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_mark(points[i])) {
      open = false;
      continue;
    }
    if (!std::exchange(open, true)) {
      curves.emplace_back();
      if (curves.size() == 1) curves.back().id = whole.id;
      curves.back().notes = whole.notes;
      curves.back().notes.emplace_back("a point (999, 999) parts the elements of the airfoil");
    }
    curves.back().points.push_back(points[i]);
    curves.back().source_lines.push_back(whole.source_lines[i]);
  }
}

}  // namespace keyline::exchange::detail
