#pragma once

#include <array>
#include <optional>
#include <random>
#include <vector>

#include "keyline/core/axis.h"
#include "keyline/core/point.h"
#include "keyline/lac/space/space_hermite.h"
#include "keyline/lac/space/space_shooting.h"

/// Internals of the space Hermite solver: how far a curve is from the data, Newton's method on
/// quick shots, and a search over the whole family (docs/design/space-hermite.md).
namespace keyline::lac::detail::space {

using Miss = std::array<double, 3>;

/// What does not depend on place: both tangents against the chord, and how far the end tangent is
/// turned about the chord out of the plane of the start tangent (0: the arc of a plane curve).
struct Invariants {
  double first = 0;
  double last = 0;
  double twist = 0;
};

/// Data made ready: unit tangents, and what does not depend on place.
struct Setting {
  SpaceHermite data;
  Invariants wanted;      ///< with the twist not negative
  bool planar = false;    ///< all in one plane, to 1e-12
  bool mirrored = false;  ///< the end tangent is turned clockwise about the chord
};
/// bad_input where a number is not finite, the ends coincide or a tangent has no direction.
core::Result<Setting> setting_of(const SpaceHermite& given, double alpha, double beta,
                                 double omega);

/// A curve of the standard frame with the given chord moved so that it starts and ends where it
/// should, or its mirror image.
SpaceChain placed(const SpaceChain& own_chain, core::Vector3 own, const SpaceHermite& data,
                  bool mirrored);

/// Orthonormal, x along the chord.
struct ChordFrame {
  core::Vector3 x, y, z;
};

inline core::Vector3 unit(core::Vector3 v) { return v / norm(v); }
inline core::Vector3 from(const ChordFrame& f, core::Vector3 v) {
  return v.x * f.x + v.y * f.y + v.z * f.z;
}
inline core::Vector3 into(const ChordFrame& f, core::Vector3 v) {
  return {dot(v, f.x), dot(v, f.y), dot(v, f.z)};
}
/// y towards `side` (any direction where that lies along the chord).
ChordFrame chord_frame(core::Vector3 chord, core::Vector3 side);

/// Angle of the start tangent against the chord, and direction of the end tangent, less the wanted
/// ones, for a curve in its standard frame.
Miss miss_of(core::Vector3 chord, core::Vector3 tangent, const Invariants& wanted);
/// Turns and twists by less than 4 pi in all, and is longer than 1e-6.
bool reasonable(double alpha, const SpaceUnknowns& x);

/// How the miss of a shot changes with each unknown.
template <std::size_t N>
std::array<Miss, N> slopes_of(const Shot<N>& shot, const Invariants& wanted) {
  constexpr double kSize = 1e-6;
  std::array<Miss, N> slopes{};
  const Miss base = miss_of(shot.chord, shot.tangent, wanted);
  for (std::size_t i = 0; i < N; ++i) {
    const Miss near = miss_of(shot.chord + kSize * shot.chord_by[i],
                              shot.tangent + kSize * shot.tangent_by[i], wanted);
    for (std::size_t row = 0; row < 3; ++row) slopes[i][row] = (near[row] - base[row]) / kSize;
  }
  return slopes;
}

/// Newton's step for a miss, with the derivatives of a shot; empty where the matrix is singular.
std::optional<Miss> newton_step(const SpaceShot& shot, const Miss& at, const Invariants& wanted);
SpaceUnknowns moved(const SpaceUnknowns& x, const Miss& step, double share);
/// The most that torsion of this slope and rate comes to in all, either way: where the slope is
/// above 1 even torsion that grows without bound comes to so much.
double most_twist(const SpaceStandardForm& form, double length);
/// A share of Newton's step in coordinates without borders: the logarithm of the ratio of the
/// curvatures, the twist as atanh of its part of most_twist, the logarithm of the length.
SpaceUnknowns moved_within(const SpaceStandardForm& form, const SpaceUnknowns& x, const Miss& step,
                           double share);

/// Newton's method on quick shots, with steps shortened until the miss falls: to `enough`, or to
/// what quick shots are off by (1e-7 at most) where no step lessens it any more.
bool steer(const SpaceStandardForm& form, const Invariants& wanted, double enough, SpaceUnknowns& x,
           int& iterations);

/// bend for a ratio of the end's curvature to the start's, negative for an inflection inside
/// (slopes below 0).
double bend_for(double alpha, double ratio);
double between(std::mt19937_64& random, double low, double high);

/// Curves that meet the data found from places all over the family (slopes and omega of `form`),
/// the one that turns and twists least first; empty where none was. 20 to 500 ms.
std::vector<SpaceUnknowns> search_family(const SpaceStandardForm& form, const Invariants& wanted,
                                         int& iterations);

}  // namespace keyline::lac::detail::space
