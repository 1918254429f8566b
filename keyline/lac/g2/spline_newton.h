#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "keyline/lac/segment/piece_shape.h"

/// Internals of the G2 spline: Newton's method for the curvatures at its points and the lengths of
/// its spans at once (docs/design/g2-chains.md).
namespace keyline::lac::detail {

/// What holds at an end of an open spline, in units of the problem.
struct SplineEndRule {
  std::optional<double> angle;      ///< from the end tangent to the chord (start), chord to tangent
  std::optional<double> curvature;  ///< given
  bool both() const { return angle && curvature; }
};

/// A spline with its size and place taken away: chords and the turns between them.
struct SplineProblem {
  bool closed = false;
  std::vector<double> chord;  ///< per span
  std::vector<double> alpha;  ///< per span
  std::vector<double> turn;   ///< per point, from the chord before to the chord after; open: the
                              ///< first and the last are not used
  SplineEndRule start;
  SplineEndRule end;
  double fold = 1;  ///< share of all turns, angles and given curvatures that is asked for
  std::size_t spans() const { return chord.size(); }
  std::size_t slots() const { return closed ? chord.size() : chord.size() + 1; }
};

/// One curvature per point (at an end with both conditions: of the joint in the end span) and the
/// length of every span.
struct SplineState {
  std::vector<double> curvature;
  std::vector<double> length;
};

SplineState straight_state(const SplineProblem& problem);
/// A cheap guess: curvature at a point from the turn there.
SplineState guessed_state(const SplineProblem& problem);

/// Improves the state until direction is continuous within 2e-13 and chords are met; false where
/// the damped iteration does not get there (state is then of no use). Counts its steps.
bool solve_spline_newton(const SplineProblem& problem, SplineState& state, int& iterations);

/// The pieces of a span: one, or two where the end has both conditions.
std::vector<Piece> pieces_of_span(const SplineProblem& problem, const SplineState& state,
                                  std::size_t span);

}  // namespace keyline::lac::detail
