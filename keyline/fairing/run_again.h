#pragma once

#include <vector>

#include "keyline/fairing/run.h"
#include "keyline/fairing/run_frame.h"

/// A solved run looked at as it is laid out, and solved again with other ends or limits.
namespace keyline::fairing::detail {

/// What an end is off along the curve, and cells and means tell only nearly, has to fit into the
/// tolerance as well: so much of it is the band's.
inline constexpr double kBandShare = 0.995;

/// What is held at the canonical start or end of a run: its clamp, by the spline, or its tie.
HeldEnd held_end(const Run& run, const RunFrame& frame, const curve::BSpline2& spline,
                 bool canonical_start);

/// The solved curve as a chain whose pieces meet to the last digit, moved as little as that takes.
FitChain closed_chain(const DenseCurve& curve, const std::vector<FitPoint>& points,
                      double tolerance);

double largest_offset(const RunResult& result, const Run& run);

/// The solved curve anew within that share of the tolerance, its ends held; false where the points
/// leave it.
bool solve_again(RunResult& result, const Run& run, const curve::BSpline2& spline, double share);

/// Limits of the fitted points' own, and guides between them, that keep the run inside its borders.
void watch_borders(RunResult& result, const Run& run, double tolerance);

/// Whether the fit as it stands passes no border.
bool stays_inside(const RunResult& result, const Run& run);

/// The most that the chain as laid out passes a border by.
double passed_most(const RunResult& result, const Run& run);

/// More of a margin where the chain passes a border, between points or by what closing moved.
void add_margin(Run& run, const RunResult& result);

/// The same pieces once more, within the run's margin.
bool solve_inside(RunResult& result, const Run& run, const curve::BSpline2& spline);

}  // namespace keyline::fairing::detail
