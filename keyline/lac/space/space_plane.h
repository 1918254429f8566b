#pragma once

#include <array>

#include "keyline/lac/chain/chain.h"
#include "keyline/lac/space/space_hermite.h"
#include "keyline/lac/space/space_steer.h"

/// Internals: plane curves as answers to data in space that lie in one plane.
namespace keyline::lac::detail::space {

/// The plane of the data: x along the chord, y towards the side to which it is left by the tangent
/// that leaves it more.
ChordFrame plane_of(const Setting& setting);
/// Directions of both tangents in that plane, against the chord.
std::array<double, 2> directions_in(const ChordFrame& plane, const SpaceHermite& data);

/// A curve over a chord of length 1 along x laid into the plane, with positive curvature at its
/// start, or, where there is none, in the rest. An end next to which the inflection lies within
/// rounding of the tangents has no curvature: what is left there has a random sign, and the rate of
/// its radius a random size. beta: of each piece.
SpaceSolution in_plane(const ChordFrame& plane, const SpaceHermite& data, Chain curve,
                       const std::array<double, 2>& beta);

}  // namespace keyline::lac::detail::space
