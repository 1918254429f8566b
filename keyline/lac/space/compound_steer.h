#pragma once

#include <array>
#include <optional>
#include <random>

#include "keyline/lac/space/space_compound.h"
#include "keyline/lac/space/space_steer.h"
#include "keyline/lac/space/two_slopes.h"

/// Internals: space curves of two slopes as what they are at their joint, Newton's method on quick
/// shots, and a search over the whole family (docs/design/space-hermite.md).
namespace keyline::lac::detail::space {

/// A curve of length 1, in coordinates without borders: all pieces that they tell bear their rates.
struct Joint {
  double bend = 0;   ///< asinh of curvature's rate drawn out (two_slopes.h)
  double size = 0;   ///< ln of curvature
  double twist = 0;  ///< ln of torsion as far as it is large or small
  double flow = 0;   ///< ln of torsion's rate drawn out, as far as it is large or small
  bool left = true;  ///< whether torsion is above 0
};

/// What is missed: the three angles, and the logarithm of omega.
using JointMiss = std::array<double, 4>;

/// Both laws of a rhythm, and where the curves of it end.
class JointFamily {
 public:
  explicit JointFamily(const SpaceRhythm& r);

  /// Empty where a law leaves the doubles or the curve winds by more than 3 pi to either side.
  std::optional<SpaceChain> chain(const Joint& x) const;
  /// What of omega is missed; 0 where it is 0.
  std::optional<double> omega_miss(const Joint& x) const;
  /// The joint of a curve of one slope, where it has both curvature and torsion.
  std::optional<Joint> joint_of(const SpacePiece& piece) const;

  /// Newton's method on quick shots, with steps shortened until the miss falls.
  bool steer(const Invariants& wanted, double enough, Joint& x, int& iterations) const;
  /// From six digits to all of them.
  std::optional<Joint> polished(const Invariants& wanted, Joint x, int& iterations) const;
  /// Of the curves found from places all over the family the one that turns least.
  std::optional<Joint> search(const Invariants& wanted, int& iterations) const;

 private:
  struct Laws;
  struct Aimed;
  std::optional<Laws> laws(const Joint& x) const;
  std::optional<SpaceChain> chain(const Laws& l) const;
  double omega_miss(const Laws& l, const Joint& x) const;
  std::optional<Aimed> aim(const Invariants& wanted, const Joint& x) const;
  std::optional<JointMiss> step(const Aimed& at, const JointMiss& miss,
                                const Invariants& wanted) const;
  std::optional<Joint> with_torsion(Joint x, double growth) const;
  std::optional<Joint> place(std::mt19937_64& random) const;

  SpaceRhythm r_;
  TwoSlopes bend_, twist_;
};

/// To either side: what the tangent turns by, or the frame about it.
double turning_of(const SpaceChain& chain);

}  // namespace keyline::lac::detail::space
