#pragma once

#include <cstddef>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/sketch/stroke_graph.h"

namespace keyline::sketch {

/// One end of an edge: where the line is itself again, and which way it leaves.
struct Branch {
  int edge = -1;                  ///< -1: none
  bool at_end = false;            ///< the edge's `to` rather than its `from`
  std::size_t anchor = 0;         ///< index of the first point clear of the junction
  core::Point2 place;             ///< that point
  core::Vector2 outward{1, 0};    ///< unit, away from the junction
  int mate = -1;                  ///< branch it goes on with
  bool free = false;              ///< ends in paper
  std::vector<core::Point2> way;  ///< to its mate through a knot, about a pixel apart
  double tail = 0;                ///< without a mate: how far it goes on into its junction
};

/// The branch of an edge at one of its ends, `skip` pixels clear of it (at most two fifths of the
/// edge); its direction is that of a parabola through the next few widths of line.
Branch make_branch(const StrokeGraph& graph, int edge, bool at_end, double skip);

/// Where a line ends: as far along its direction as its last point, which may lie in a corner, and
/// how far the ink goes on beyond that, with what thinning took.
struct LineEnd {
  core::Point2 at;
  double radius = 0;
};
LineEnd line_end(const StrokeGraph& graph, const Branch& end);

/// The edge's points from where it is clear of the junction, up to `reach` out.
std::vector<core::Point2> arm_of(const StrokeGraph& graph, const Branch& branch, double reach);

/// Where the last part of a line lies and which way it goes. It is read as a straight line, half
/// way along: the direction at an end itself is known four times less well, and an arc meets the
/// chord between any two of its places at equal angles.
struct Way {
  core::Point2 middle;
  core::Vector2 outward{1, 0};  ///< towards the end
};
Way way_of(const StrokeGraph& graph, const Branch& end);

/// The way a line of points leaves its first one: that of the parabola through them all.
core::Vector2 direction_of(const std::vector<core::Point2>& points);

/// How much a line has to bend that comes in on one branch and leaves on the other: half its turn,
/// as a plain arc makes it, and all that an arc does not explain. Radians.
double bend_between(const Branch& a, const Branch& b);

/// The arc (with a curvature that changes evenly) nearest to the points of two lines.
struct CommonArc {
  double off = 0;                 ///< root mean square distance of the points
  double turn = 0;                ///< radians by which its change of curvature turns it, either way
  std::vector<core::Point2> gap;  ///< along it between the first points, about a pixel apart
};
CommonArc common_arc(const std::vector<core::Point2>& a, const std::vector<core::Point2>& b);

/// How far beside a place the line passes that comes in on an arm and goes on as the parabola
/// through its points does; infinite behind it, and farther ahead than twice the arm's length.
double passes_beside(const StrokeGraph& graph, const Branch& arm, core::Point2 place);

/// Branches that are paired at most: the cost is 2 to their number.
inline constexpr std::size_t kMostBranches = 18;

/// Who goes on with whom, of least sum of bends, a branch left over counting half `turn`; -1 for
/// those. Pairs that bend more than `turn` are not made. At most kMostBranches (more are left
/// over).
std::vector<int> pair_up(const std::vector<Branch>& branches, double turn);

/// The same for costs given: of every pair (a row each, infinite: never), and of one left over.
std::vector<int> pair_up(const std::vector<std::vector<double>>& costs, double alone);

}  // namespace keyline::sketch
