#pragma once

#include <cstddef>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/sketch/stroke_graph.h"

namespace keyline::sketch {

/// One end of an edge: where the line is itself again, and which way it leaves.
struct Branch {
  int edge = 0;
  bool at_end = false;          ///< the edge's `to` rather than its `from`
  std::size_t anchor = 0;       ///< index of the first point clear of the junction
  core::Point2 place;           ///< that point
  core::Vector2 outward{1, 0};  ///< unit, away from the junction
  int mate = -1;                ///< branch it goes on with
  bool free = false;            ///< ends in paper
};

/// The branch of an edge at one of its ends, `skip` pixels clear of it (at most two fifths of the
/// edge); its direction is that of a parabola through the next few widths of line.
Branch make_branch(const StrokeGraph& graph, int edge, bool at_end, double skip);

/// How much a line has to bend that comes in on one branch and leaves on the other: half its turn,
/// as a plain arc makes it, and all that an arc does not explain. Radians.
double bend_between(const Branch& a, const Branch& b);

/// Root mean square distance of the points of two branches, up to `reach` out from where they are
/// clear of the junction, from the parabola that fits both best.
double off_parabola(const StrokeGraph& graph, const Branch& a, const Branch& b, double reach);

/// Who goes on with whom, of least sum of bends, a branch left over counting half `turn`; -1 for
/// those. Pairs that bend more than `turn` are not made. At most ten branches (more are left over).
std::vector<int> pair_up(const std::vector<Branch>& branches, double turn);

}  // namespace keyline::sketch
