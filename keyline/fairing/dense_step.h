#pragma once

#include <array>
#include <vector>

#include "keyline/fairing/dense_curve.h"
#include "keyline/fairing/dense_places.h"
#include "keyline/fairing/dense_riccati.h"

/// Steps of a dense curve's solver.
namespace keyline::fairing::detail {

/// How the joint after the cell moves with the state before it, and what is missing to it now.
void set_step(Cell& cell, const DenseCurve& curve, const Gaps& gaps, std::size_t i);

/// Adds weight * (d . state)^2 / 2 + slope * (d . state).
void add(Cell& cell, const Vector6& d, double weight, double slope);

/// Weighs moves and turns of all joints: steps that turn the curve far are not what the linear
/// model is good for.
void damp(std::vector<Cell>& cells, const DenseCurve& curve, double damping);

/// The curve after that share of the step; feet stay.
DenseCurve moved(const DenseCurve& curve, const DenseStep& step, double share);

/// Whether poses and curvatures go nearly where those of the other step do, but for that share.
bool alike(const DenseStep& a, const DenseStep& b, double share);

/// By how much the curvatures at each piece's ends change after the whole step.
std::vector<std::array<double, 2>> meant_ends(const DenseCurve& curve, const DenseStep& step);

/// Largest share of the step that keeps curvature on its side where the slope allows no inflection.
double keeps_side(const DenseCurve& curve, const DenseStep& step);

/// Whether a line begins or ends at the cut: its curvature there is 0 and stays it.
bool end_of_line(const DenseCurve& curve, std::size_t cut);

/// How the curve's ends are held: its start is fixed, its end is drawn by that weight to where it
/// belongs, `seam` away, beside the multipliers of that.
DenseBoundary boundary_of(const DenseCurve& curve, const Vector6& seam, const Vector6& multiplier,
                          double weight);

/// What gaps are worth in the merit, for a step to close them: twice the most that any pulls with.
inline double gap_price(const DenseStep& step) { return 2 * step.largest_costate; }

/// The model's least, whose ends come to where they are held: the boundary's weights alone give way
/// where much pulls at them. Source: the method of multipliers, [Nocedal 2006], section 17.3.
DenseStep solve_held(const std::vector<Cell>& cells, DenseBoundary boundary, const Vector6& seam);

}  // namespace keyline::fairing::detail
