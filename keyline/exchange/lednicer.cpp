#include "keyline/exchange/lednicer.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace keyline::exchange::detail {

bool unfold_lednicer(acquire::RawCurve& c) {
  if (c.has_z) return false;
  const core::Point3 counts = c.points.front();
  const bool whole = counts.x >= 3 && counts.y >= 3 && std::floor(counts.x) == counts.x &&
                     std::floor(counts.y) == counts.y;
  if (!whole || counts.x + counts.y + 1 != static_cast<double>(c.points.size())) return false;
  const bool unit = std::all_of(c.points.begin() + 1, c.points.end(),
                                [](core::Point3 p) { return std::abs(p.x) <= 2 && p.y <= 2; });
  if (!unit) return false;
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

}  // namespace keyline::exchange::detail
