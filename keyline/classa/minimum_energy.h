#pragma once

#include <optional>

#include "keyline/classa/control_matrix.h"
#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/core/interval.h"

namespace keyline::classa {

/// alpha_max of [Oya] that reproduces their Eq. 10: radians.
inline constexpr double kDefaultAlphaMax = 1.0982;

/// The two parts of the Class A region: edges grow (s >= 1/cos alpha) or shrink (s <= cos alpha).
enum class Branch { growing, falling };
constexpr auto choices(const Branch*) {
  return core::words<Branch>({{Branch::growing, "growing"}, {Branch::falling, "falling"}});
}

/// What a designer asks of a curve with one matrix: start point (the origin here), start tangent,
/// where it ends, and in which part of the alpha-s plane it may lie.
struct EnergyConditions {
  core::Vector2 tangent = {1, 0};  ///< at the start; its length is the unit of beta
  core::Vector2 chord = {1, 0};    ///< end minus start, document units
  int degree = 3;
  double end_tolerance = 0;  ///< the end may lie this far away from start + chord; < |chord|
  core::Interval alpha = {0, kDefaultAlphaMax};  ///< within [0, pi/2)
  core::Interval s = {0.01, 100};
  Branch branch = Branch::growing;
  /// The curve turns left; empty: to the side on which the chord lies.
  std::optional<bool> left = {};
  /// Of several minima (all straight curves have energy 0) the one nearest to this scale.
  double near_s = 1;
};

struct EnergyMinimum {
  double alpha = 0;  ///< radians, >= 0
  double s = 1;
  double beta = 1;      ///< length of the first edge over that of the tangent
  double energy = 0;    ///< 1/length
  core::Vector2 chord;  ///< reached
  bool left = true;
};

/// The curve of least strain energy (Eq. 7) among all Class A curves with one matrix that meet the
/// conditions: global search over starts (every winding, points around the allowed end, the
/// feasible range of alpha), then NLopt's SLSQP with the end as an equality and Class A as an
/// inequality constraint, then the end met exactly. Deterministic.
///
/// Accuracy: energy to 1e-12 relative, alpha and s to about 1e-7 (the minimum is flat).
/// Errors: bad_input for a tangent or chord without direction, an end_tolerance < 0 or >= |chord|,
/// alpha outside [0, pi/2) or empty, s empty or not positive, a degree outside 2 … 30; undrawable
/// where no Class A curve meets the conditions, with what would have to give. Paths: "tangent",
/// "chord", "degree", "end_tolerance", "alpha_range", "s_range".
core::Result<EnergyMinimum> minimum_energy(const EnergyConditions& conditions);

}  // namespace keyline::classa
