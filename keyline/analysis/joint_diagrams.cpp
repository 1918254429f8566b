#include "keyline/analysis/joint_diagrams.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace keyline::analysis {
namespace {

void take(core::Interval& range, double value) {
  range.low = std::min(range.low, value);
  range.high = std::max(range.high, value);
}

bool differ(double a, double b) {
  constexpr double kSame = 1e-9;  // what rounding leaves of equal sections
  return std::abs(a - b) > kSame * std::max(std::abs(a), std::abs(b));
}

bool is_drawn(const SectionVolume& s) { return s.diagram && !s.diagram->c_curve.empty(); }

std::optional<double> agreement(std::span<const SectionVolume> sections) {
  int pairs = 0;
  int agreeing = 0;
  for (std::size_t i = 0; i < sections.size(); ++i)
    for (std::size_t k = i + 1; k < sections.size(); ++k) {
      const SectionVolume& a = sections[i];
      const SectionVolume& b = sections[k];
      if (!is_drawn(a) || !is_drawn(b)) continue;
      const double ab = a.diagram->distance_ab;
      const double other = b.diagram->distance_ab;
      if (!differ(ab, other) || !differ(a.relative_volume, b.relative_volume)) continue;
      ++pairs;
      agreeing += (ab < other) == (a.relative_volume > b.relative_volume);
    }
  if (pairs == 0) return std::nullopt;
  return static_cast<double>(agreeing) / pairs;
}

}  // namespace

JointDiagrams joint_diagrams(std::span<const SectionVolume> sections) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  JointDiagrams joint{{kInfinity, -kInfinity}, {kInfinity, -kInfinity}, {}};
  for (const SectionVolume& section : sections) {
    if (!is_drawn(section)) continue;
    for (const LddcTop& top : section.diagram->c_curve) {
      take(joint.x, top.x);
      take(joint.y, top.y);
    }
  }
  if (joint.x.low > joint.x.high) joint.x = joint.y = {0, 0};
  joint.agreement = agreement(sections);
  return joint;
}

}  // namespace keyline::analysis
