#pragma once

#include <vector>

#include "keyline/analysis/profile.h"

namespace keyline::analysis {

/// A bar of the logarithmic distribution diagram of curvature: the interval
/// [low, low + 0.05) of log10(radius / total length), how many of the curve's points fall into
/// it, and the height log10(share of the length) (meaningless where count is 0).
struct LddcBar {
  double low = 0;
  int count = 0;
  double height = 0;
};

/// Why a bar is not part of the C curve.
enum class LddcNoise { none, partial_end, few_points, spike, stray };

/// The top of a bar that is not empty. x is the middle of the bar's interval.
struct LddcTop {
  double x = 0;
  double y = 0;
  int count = 0;
  LddcNoise noise = LddcNoise::none;
};

/// Logarithmic distribution diagram of curvature, [Fairing] section 2.1.
///
/// bars are the paper's 100 intervals over [-3, 2]; tops links all bars that are not empty, from
/// small to large radius, each marked where it was recognised as noise; c_curve is what remains.
/// gradient and intercept are the least-squares line through c_curve, each top weighted by its
/// count; has_gradient is false with fewer than three tops (a circular arc is one bar).
/// a and b are the ends of the C curve at the smallest and the largest radius, distance_ab their
/// distance in the diagram: the paper's index of volume (the shorter, the fuller the curve).
/// below and above count points whose radius lies outside the diagram, flat ones above.
struct Lddc {
  std::vector<LddcBar> bars;
  std::vector<LddcTop> tops;
  std::vector<LddcTop> c_curve;
  bool has_gradient = false;
  double gradient = 0;
  double intercept = 0;
  LddcTop a;
  LddcTop b;
  double distance_ab = 0;
  int below = 0;
  int above = 0;
};

// The paper's diagram ([Fairing]): its points, and bars of log10(radius / length) over [-3, 2].
inline constexpr int kLddcPoints = 1000;
inline constexpr int kLddcBars = 100;
inline constexpr double kLddcBarWidth = 0.05;
inline constexpr double kLddcLow = -3;

/// Diagram of 1000 points, one in the middle of every thousandth of the length (so that the
/// diagram does not depend on the direction of travel).
///
/// A top is taken for noise, in this order:
///  - partial_end: the first or last bar of the diagram, where the curve's own smallest or
///    largest radius lies inside the bar, so that the bar holds only part of its length;
///  - few_points: fewer than 4 points, whose height is known no better than to a tenth;
///  - stray: a group cut off from the longest by empty bars and less than 5 % of the points;
///  - spike: a top more than 0.3 (a factor of two) off the line between its neighbours.
/// At least two tops are always kept, unless there is only one.
Lddc curvature_distribution_diagram(const CurvatureProfile& profile);

/// Diagram of a whole curve.
template <curve::PlanarCurve C>
Lddc curvature_distribution_diagram(const C& c) {
  return curvature_distribution_diagram(curvature_profile(c, 2 * kLddcPoints + 1));
}

}  // namespace keyline::analysis
