#include "keyline/fairing/leaning_ends.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "keyline/fairing/fair.h"

namespace keyline::fairing::detail {
namespace {

constexpr double kPull = 2;  // times as strong: with four, energy at the ends made answers unfair

/// How many of the offsets, in order from the end, lean most of all beyond chance; 0: none.
std::size_t leaning(const std::vector<double>& from_end, const Residuals& residuals) {
  const double chance = noise_factor(from_end.size()) * residuals.noise;
  double sum = 0;
  double worst = 1;
  std::size_t found = 0;
  for (std::size_t m = 1; m <= from_end.size() / 2; ++m) {
    sum += from_end[m - 1];
    if (!std::has_single_bit(m)) continue;
    const double root = std::sqrt(static_cast<double>(m));
    const double ratio = std::abs(sum) / root / (chance + root * residuals.left);
    if (ratio > worst) {
      worst = ratio;
      found = m;
    }
  }
  return found;
}

}  // namespace

bool pull_leaning_ends(std::vector<FitPoint>& points, DenseCurve curve,
                       const Residuals& residuals) {
  if (curve.closed || residuals.rms == 0) return false;
  const std::vector<CellShape> shapes = shapes_of(curve);
  std::vector<std::size_t> measured;
  std::vector<double> offset;
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (points[j].count == 0) continue;
    measured.push_back(j);
    offset.push_back(offset_of(points[j], place_of(curve, shapes, curve.feet[j])) /
                     points[j].share);
  }
  bool any = false;
  for (const bool at_start : {true, false}) {
    if (!at_start) {
      std::ranges::reverse(measured);
      std::ranges::reverse(offset);
    }
    if ((at_start ? curve.hold_start : curve.hold_end) != Hold::free) continue;
    const std::size_t count = leaning(offset, residuals);
    for (std::size_t m = 0; m < count; ++m) points[measured[m]].pull *= kPull;
    any = any || count > 0;
  }
  return any;
}

}  // namespace keyline::fairing::detail
