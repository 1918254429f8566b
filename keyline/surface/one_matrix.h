#pragma once

#include <optional>
#include <vector>

#include "keyline/core/interval.h"
#include "keyline/surface/net.h"

/// Internals of room surface: nets all of whose rows and columns have one control matrix each.
///
/// Edges e0, e1, e2 follow from one another by a turn and a scaling in their plane exactly where
///   e2 = 2 (e0.e1)/(e0.e0) e1 - (e1.e1)/(e0.e0) e0,
/// three equations that hold the plane as well. A bicubic net has 24 of them and 36 free
/// coordinates when its corners are held.
namespace keyline::surface::detail {

/// How a control point may move.
enum class Freedom { held, along, free };  ///< along: on the ray from net.at(0, 0) through it

/// What is asked of one curve beside having one matrix.
struct CurveWish {
  std::optional<double> growth;          ///< of its edges, ln(s), signed
  bool firm = false;                     ///< growth is an equation even without `exact_growth`
  std::optional<double> turn;            ///< alpha >= 0: an equation
  std::optional<core::Vector3> tangent;  ///< unit direction of the first edge: equations
  /// Where turn and growth may lie: equations once they are outside.
  std::optional<core::Interval> turn_within, growth_within;
  bool loose = false;  ///< nothing else is asked of it, not even one matrix
};

struct OneMatrixProblem {
  Net net;                        ///< start, and what the result should stay near
  std::vector<Freedom> freedom;   ///< in the order of net.points
  std::vector<CurveWish> wishes;  ///< in the order of network_curves
  double growth_weight = 0;       ///< against the departure of the net as share of its size
};

struct OneMatrixNet {
  Net net;
  double violation = 0;     ///< largest left-over of the equations, lengths as share of the size
  double growth_error = 0;  ///< largest |ln(s) - wanted|
  int worst = 0;            ///< curve of the largest violation
};

/// The net nearest to problem.net (least squares) that meets the equations, from `start`: penalty
/// steps of Levenberg and Marquardt, then Gauss-Newton on the equations alone. With `exact_growth`
/// the wanted growth counts as equations too. Nets with an edge of no length are not changed.
OneMatrixNet solve_one_matrix(const OneMatrixProblem& problem, const Net& start, bool exact_growth);

/// Gauss-Newton alone, wanted growth being equations: the net beside `start` that meets all of
/// them, by shortest steps, wherever problem.net is. What is wanted may then follow the net round
/// by round and come to rest, where penalty steps would seek another net each time among those that
/// meet nearly dependent equations.
OneMatrixNet meet_by_shortest_steps(const OneMatrixProblem& problem, const Net& start);

}  // namespace keyline::surface::detail
