#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/lac/space/space_stretch.h"
#include "keyline/numeric/quadrature.h"

/// Internals of the space Hermite solvers: Frenet's equations in few steps, and how the end of a
/// curve moves with its laws (docs/design/space-hermite.md).
namespace keyline::lac::detail {

/// A place of the curve and its frame.
struct Motion {
  core::Vector3 at;
  core::Vector3 tangent{1, 0, 0};
  core::Vector3 normal{0, 1, 0};
  core::Vector3 binormal{0, 0, 1};

  core::Vector3 turned(core::Vector3 v) const {
    return v.x * tangent + v.y * normal + v.z * binormal;
  }
  /// After exp of the twist (turn, shift), both in the moving frame.
  Motion moved(core::Vector3 turn, core::Vector3 shift) const;
};

/// Places of the steps' ends, with weights of Simpson's rule over the length.
struct RideNode {
  double place = 0;
  double weight = 0;
};

/// How curvature and torsion at one place change with N unknowns.
template <std::size_t N>
struct Change {
  std::array<double, N> curvature{};
  std::array<double, N> torsion{};
};

/// Both ends of the curve of unit length in its standard frame, with derivatives by N unknowns.
template <std::size_t N>
struct Shot {
  core::Vector3 chord;
  core::Vector3 tangent;  ///< at the end
  std::array<core::Vector3, N> chord_by;
  std::array<core::Vector3, N> tangent_by;
};

/// The curve at the ends of all steps.
struct Ride {
  std::vector<Motion> motions;
  std::vector<RideNode> nodes;

  const Motion& end() const { return motions.back(); }

  /// A change of curvature or torsion turns all that is behind it; one for each node.
  template <std::size_t N>
  Shot<N> shot(std::span<const Change<N>> changes) const {
    Shot<N> shot{end().at, end().tangent, {}, {}};
    for (std::size_t unknown = 0; unknown < N; ++unknown) {
      core::Vector3 turned;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const core::Vector3 turn =
            nodes[i].weight * (changes[i].torsion[unknown] * motions[i].tangent +
                               changes[i].curvature[unknown] * motions[i].binormal);
        turned = turned + turn;
        shot.chord_by[unknown] = shot.chord_by[unknown] + cross(turn, end().at - motions[i].at);
      }
      shot.tangent_by[unknown] = cross(turned, end().tangent);
    }
    return shot;
  }
};

/// One step of Magnus' method of order 4 with Gauss' two nodes. Laws has curvature(t) and
/// torsion(t), times the length, at the fraction t of it.
template <class Laws>
Motion stepped(const Laws& laws, const Motion& m, const Stretch& stretch, double from, double h) {
  constexpr const auto& kPlaces = numeric::gauss_legendre<2>.nodes;
  std::array<core::Vector3, 2> turn;
  std::array<double, 2> speed;
  for (int i = 0; i < 2; ++i) {
    const double s = from + h * kPlaces[i];
    const double t = stretch.place(s);
    speed[i] = stretch.rate(s);
    turn[i] = speed[i] * core::Vector3{laws.torsion(t), 0, laws.curvature(t)};
  }
  const double bracket = h * h * (kPlaces[1] - kPlaces[0]) / 4;
  const core::Vector3 forward{1, 0, 0};
  return m.moved(h / 2 * (turn[0] + turn[1]) + bracket * cross(turn[0], turn[1]),
                 h / 2 * (speed[0] + speed[1]) * forward +
                     bracket * cross(speed[1] * turn[0] - speed[0] * turn[1], forward));
}

/// Along the stretches: 24 steps next to a zero, 32 of one that is all, 12 of each of several.
template <class Laws>
Ride ride_along(const Laws& laws, std::span<const Stretch> stretches) {
  Ride ride;
  Motion end;
  for (const Stretch& stretch : stretches) {
    const int steps = stretch.power != 1 ? 24 : stretches.size() == 1 ? 32 : 12;
    for (int i = 0; i <= steps; ++i) {
      const double s = i / double(steps);
      const double simpson = (i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2) / (3.0 * steps);
      if (i > 0) end = stepped(laws, end, stretch, (i - 1) / double(steps), 1.0 / steps);
      ride.motions.push_back(end);
      ride.nodes.push_back({stretch.place(s), simpson * stretch.rate(s)});
    }
  }
  return ride;
}

/// x^e, kept finite where x vanishes and e < 0.
inline double bounded_power(double x, double e) { return std::pow(std::max(std::abs(x), 1e-9), e); }

}  // namespace keyline::lac::detail
