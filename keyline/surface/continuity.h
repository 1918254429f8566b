#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/surface/surface.h"

namespace keyline::surface {

/// Border of a surface: u = 0, u = 1, v = 0 or v = 1, run along growing v or u.
enum class Edge { u0, u1, v0, v1 };
constexpr auto choices(const Edge*) {
  return core::words<Edge>(
      {{Edge::u0, "u0"}, {Edge::u1, "u1"}, {Edge::v0, "v0"}, {Edge::v1, "v1"}});
}

/// How far two surfaces may differ along a common edge and still count as joined. Curvature and its
/// rate across the edge are compared relative to the larger of the two, curvature no smaller than
/// 1 / size, its rate than 1 / size^2, with size the length of what is compared. The angle is the
/// usual one of class A; so is the gap, 0.001 mm of a panel of 100 mm, but in no unit: a share of
/// the size.
struct EdgeTolerance {
  std::optional<double> gap;  ///< unless set, kUsualGap of the size of what is compared
  double angle = 0.016 * 3.14159265358979323846 / 180;
  double curvature = 0.01;       ///< relative
  double curvature_rate = 0.05;  ///< relative
  static constexpr auto describe() {
    return core::fields(
        core::field<&EdgeTolerance::gap>(
            "largest gap that still joins; unless given, 1e-5 of the size of the larger surface "
            "(the diagonal of the box around its control points)")
            .in("length")
            .within(core::at_least(0)),
        core::field<&EdgeTolerance::angle>("largest fold of a G1 joint")
            .in("radian")
            .within(core::at_least(0)),
        core::field<&EdgeTolerance::curvature>("largest relative jump of a G2 joint")
            .within(core::at_least(0)),
        core::field<&EdgeTolerance::curvature_rate>("the same of a G3 joint")
            .within(core::at_least(0)));
  }
};

inline constexpr double kUsualGap = 1e-5;
inline constexpr double kCollapsed = 1e-9;  ///< of the extent: an edge that is but a point

/// With the gap that holds where something of that size is compared.
EdgeTolerance with_gap(EdgeTolerance tolerance, double size);

/// What happens at one place of the edge, from the first surface to the second. `angle` is the
/// fold: between the tangent planes, in [0, pi], pi where the second surface runs back under the
/// first; how far the edges' directions differ is none of it. `curvature_jump` is the largest
/// difference of normal curvature over all directions; `rate_jump` that of the derivative by arc
/// length of the curvature of the normal section across the edge, in 1/length^2; `stripe_turn` and
/// `stripe_density` are what a zebra does where it crosses (stripe_turn.h). All of them need a
/// normal on each side: `defined`.
struct EdgeSample {
  double along = 0;  ///< parameter of the first edge
  core::Point3 position;
  double gap = 0;
  bool defined = true;
  double angle = 0;
  double curvature_jump = 0;
  double rate_jump = 0;
  double relative_curvature_jump = 0;
  double relative_rate_jump = 0;
  double stripe_turn = 0;
  double stripe_density = 0;
};

/// Largest values along the edge and the order they amount to: -1 a gap, 0…3 for G0…G3. The
/// `stripe_turn` is the mean over all stripes of all lights that cross the edge, radians; `turning`
/// the angle by which the normal turns along it, in all: as that grows so does their number. A
/// single place without a normal (a pole at the edge's end) takes nothing from the order, as little
/// as what lies between two places; where two follow each other it is G0 at most.
struct EdgeContinuity {
  std::array<Edge, 2> edges{};
  std::vector<EdgeSample> samples;
  double gap = 0, angle = 0, curvature_jump = 0, rate_jump = 0;
  double relative_curvature_jump = 0, relative_rate_jump = 0;
  double stripe_turn = 0, turning = 0;
  double length = 0;        ///< of the edge compared whole
  int without_normal = 0;   ///< samples that are not `defined`
  EdgeTolerance tolerance;  ///< its gap is set
  int order = -1;
};

/// Compares `count` places of one edge with the nearest ones of the other, in whichever sense that
/// runs. That edge is the first, or the second where it lies nearer along the first than the first
/// along it: of a short edge and a long one the common part is compared, and both orders of the
/// surfaces give the same. Every inner knot of both edges and the middles between are compared as
/// well, of more than 2,048 spans those of every second, third, ... knot. Samples follow the first
/// edge. Without edges the pair with the least gap
/// is taken, of those that are longer than a gap. A gap that is not set is kUsualGap of the larger
/// extent. Fails: bad_input for count < 2 or above 100,000, a tolerance that is negative or not
/// finite.
core::Result<EdgeContinuity> edge_continuity(const Surface& first, const Surface& second,
                                             const std::optional<std::array<Edge, 2>>& edges = {},
                                             const EdgeTolerance& tolerance = {}, int count = 101);

/// Parameters of the surface at `along` in [0, 1] of the edge.
std::array<double, 2> edge_parameters(Edge edge, double along);

}  // namespace keyline::surface
