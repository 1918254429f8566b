#include "keyline/exchange/points/airfoil_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "keyline/core/text.h"

namespace keyline::exchange::detail {

namespace {

using Side = std::span<const core::Point3>;

/// The half way between the least and the largest x; NaN where there is none.
struct Middle {
  double low = HUGE_VAL;
  double high = -HUGE_VAL;

  explicit Middle(Side points) {
    for (const core::Point3& p : points) {
      if (p.x < low) low = p.x;
      if (p.x > high) high = p.x;
    }
  }
  double x() const { return low + (high - low) / 2; }
};

/// True for points that lead from the nose to the tail, in whatever unit: the first is nearer to
/// the least x of all than to the largest, the last the other way round.
bool leads_aft(Side side, double middle) {
  return side.front().x < middle && side.back().x > middle;
}

/// Number of points before the one place where they go back from the aft half to the fore one; 0
/// where they never or more than once do.
std::size_t before_the_way_back(Side points, double middle) {
  std::size_t found = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!(points[i - 1].x > middle && points[i].x < middle)) continue;
    if (found > 0) return 0;
    found = i;
  }
  return found;
}

/// Number of points of the upper side: what the counts say, or what the points do where a count is
/// one off or could be no point, beyond twice the length of the airfoil. 0 where there are no
/// sides.
std::size_t upper_side(core::Point3 counts, Side points) {
  const Middle middle(points);
  const auto sides = [&](std::size_t above) {
    return above > 0 && above < points.size() && leads_aft(points.first(above), middle.x()) &&
           leads_aft(points.subspan(above), middle.x());
  };
  const auto size = static_cast<double>(points.size());
  if (counts.x + counts.y == size && sides(static_cast<std::size_t>(counts.x)))
    return static_cast<std::size_t>(counts.x);
  const std::size_t above = before_the_way_back(points, middle.x());
  if (!sides(above)) return 0;
  const double off = std::max(std::abs(counts.x - static_cast<double>(above)),
                              std::abs(counts.y - (size - static_cast<double>(above))));
  return off <= 1 || counts.x > middle.high + (middle.high - middle.low) ? above : 0;
}

std::string plain(double count) { return std::to_string(static_cast<long long>(count)); }

}  // namespace

bool unfold_lednicer(acquire::RawCurve& c, std::vector<std::string>& left_out) {
  if (c.has_z || c.points.size() < 7) return false;
  const core::Point3 counts = c.points.front();
  const bool whole = counts.x >= 3 && counts.y >= 3 && std::floor(counts.x) == counts.x &&
                     std::floor(counts.y) == counts.y && std::max(counts.x, counts.y) < 1e9;
  if (!whole) return false;
  const std::size_t above = upper_side(counts, Side(c.points).subspan(1));
  if (above == 0) return false;
  const double below = static_cast<double>(c.points.size() - 1 - above);
  if (counts.x != static_cast<double>(above) || counts.y != below)
    left_out.push_back("line " + std::to_string(c.source_lines.front()) + ": the counts " +
                       plain(counts.x) + " and " + plain(counts.y) + " of sides that have " +
                       plain(static_cast<double>(above)) + " and " +
                       core::counted(static_cast<std::size_t>(below), "point"));
  const auto unfold = [&](auto& values) {
    values.erase(values.begin());
    std::reverse(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(above));
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
