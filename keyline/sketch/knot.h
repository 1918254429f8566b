#pragma once

#include <optional>
#include <vector>

#include "keyline/sketch/branch.h"
#include "keyline/sketch/stroke_graph.h"

namespace keyline::sketch {

/// Several lines through a few short edges, between which no direction can be read.
struct Knot {
  std::vector<int> edges;     ///< inside
  std::vector<Branch> exits;  ///< the lines that come out of it
  std::vector<int> mates;     ///< by exit: with which one it goes on; -1: it ends inside
};

/// The knot of these edges as lines through it: exits go on with each other that lie on one arc,
/// whose way through the knot is all ink; least sum of the squares of what they lie off and of
/// their bends. Up to two exits may end inside.
///
/// Empty where that leaves an edge inside that none of these lines runs along, or where no exits or
/// more than kMostBranches come out: then it is no knot, or not that one.
std::optional<Knot> untie(const StrokeGraph& graph, const std::vector<int>& edges);

/// How little two branches go on with each other, in squared pixels: the square of what their
/// points lie off their common arc, within `reach` of the junction, of their bend, and of the turn
/// that the arc's change of curvature makes (half a pixel per radian): where two round lines touch
/// each keeps its side, where they cross each keeps its curvature.
double going_on(const StrokeGraph& graph, const Branch& a, const Branch& b, double reach);

/// Whether two branches lie on one arc so well that a line of half that width goes on in them.
bool on_one_arc(const StrokeGraph& graph, const Branch& a, const Branch& b, double reach,
                double half_width);

/// How far out lines are looked at that have to be told apart over a gap of that length.
double arc_reach(double gap, double half_width);

/// Whether the line ends freely, too near for its own arc to tell where it came from.
bool is_short_end(const StrokeGraph& graph, const Branch& branch);

/// Radians: lines that bend more do not go on with each other through a knot.
inline constexpr double kMostBend = 0.9;

}  // namespace keyline::sketch
