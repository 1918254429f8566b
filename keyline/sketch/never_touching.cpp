#include "keyline/sketch/never_touching.h"

#include <cmath>
#include <map>

#include "keyline/core/disjoint_sets.h"

namespace keyline::sketch {
namespace {

/// Strokes of a group, by index, put together where they touch.
std::vector<std::vector<std::size_t>> touching(const std::vector<SampledStroke>& some, double near,
                                               double angle) {
  core::DisjointSets sets(some.size());
  const StrokeGrid grid(some, near);
  const double least = std::cos(angle);
  for (std::size_t a = 0; a < some.size(); ++a)
    for (std::size_t k = 0; k < some[a].points.size(); ++k)
      grid.visit_others(some[a].points[k], near, a, [&](std::size_t b, std::size_t m) {
        if (std::abs(dot(some[a].tangents[k], some[b].tangents[m])) >= least) sets.join(a, b);
      });
  std::map<std::size_t, std::size_t> place;  // of the part that a stroke stands for
  std::vector<std::vector<std::size_t>> parts;
  for (std::size_t a = 0; a < some.size(); ++a) {
    const std::size_t i = place.try_emplace(sets.find(a), parts.size()).first->second;
    if (i == parts.size()) parts.emplace_back();
    parts[i].push_back(a);
  }
  return parts;
}

}  // namespace

std::vector<TwoLines> never_touching(const std::vector<SampledStroke>& strokes,
                                     const std::vector<std::vector<std::size_t>>& groups,
                                     double near, double angle) {
  std::vector<TwoLines> found;
  for (const auto& group : groups) {
    std::vector<SampledStroke> some;
    for (const std::size_t s : group) some.push_back(strokes[s]);
    auto parts = touching(some, near, angle);
    for (auto& part : parts)
      for (std::size_t& s : part) s = group[s];
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t j = i + 1; j < parts.size(); ++j) found.push_back({parts[i], parts[j]});
  }
  return found;
}

}  // namespace keyline::sketch
