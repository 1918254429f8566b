#include "keyline/acquire/key_line.h"

#include <algorithm>

namespace keyline::acquire {

core::Result<void> KeyLine::check(const KeyLine& line) {
  const auto wrong = [](const char* message, const char* where) {
    return core::fail(core::ErrorCode::bad_input, message, "give a line as document.read does",
                      where);
  };
  const std::size_t n = line.points.size();
  if (n < 2) return wrong("a line has two points or more", "points");
  if (std::adjacent_find(line.points.begin(), line.points.end()) != line.points.end())
    return wrong("neighbouring points are the same place", "points");
  if (!line.weights.empty() && line.weights.size() != n)
    return wrong("there are not as many weights as points", "weights");
  if (std::any_of(line.weights.begin(), line.weights.end(), [](double w) { return !(w >= 0); }))
    return wrong("a weight is negative", "weights");
  if (!line.sources.empty() && line.sources.size() != n)
    return wrong("there are not as many sources as points", "sources");
  if (!std::is_sorted(line.corners.begin(), line.corners.end(), std::less_equal<>()))
    return wrong("the corners do not increase", "corners");
  if (!line.corners.empty() && line.corners.back() >= n)
    return wrong("there is no such point", "corners");
  return {};
}

}  // namespace keyline::acquire
