#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "keyline/classa/control_matrix.h"
#include "keyline/core/interval.h"

/// Internals of the search for the minimum of strain energy: which (alpha, s) reach the end.
namespace keyline::classa::detail {

/// The conditions in the frame of the first edge, turning left, chord of length 1.
struct Frame {
  int degree = 3;
  double angle = 0;  // of the chord from the tangent, in [0, 2 pi)
  double slack = 0;  // end_tolerance over the chord
  core::Interval alpha;
  core::Interval s;
  bool growing = true;

  double lowest_s(double a) const { return growing ? std::max(s.low, 1 / std::cos(a)) : s.low; }
  double highest_s(double a) const { return growing ? s.high : std::min(s.high, std::cos(a)); }
  double lowest_angle(double a) const { return end_angle({a, lowest_s(a)}, degree); }
  double highest_angle(double a) const { return end_angle({a, highest_s(a)}, degree); }
};

/// Where on the rim of the allowed disc the end lies, and how often the curve winds before.
struct Rim {
  double direction = 0;
  int winding = 0;
};

struct Target {
  double angle = 0;   // end_angle to be reached
  double length = 1;  // of the chord
};
Target target_at(const Frame& f, const Rim& rim);

struct Candidate {
  double alpha = 0;
  double s = 1;
  Rim rim;
  double energy = HUGE_VAL;  // with a chord of length 1
};

/// The one curve of this alpha that ends there; alpha has to be feasible for the rim's angle.
Candidate candidate_at(const Frame& f, const Rim& rim, double alpha);

/// End angles at the two ends of the range of s, over alpha; where the upper one has a top between
/// two cells, that alpha is among the nodes.
struct ReachTable {
  std::vector<double> alpha, lowest, highest;
};

ReachTable tabulate(const Frame& f);

/// Ranges of alpha in which some s of the range reaches the target angle.
std::vector<core::Interval> feasible_alpha(const Frame& f, const ReachTable& table, double target);

}  // namespace keyline::classa::detail
