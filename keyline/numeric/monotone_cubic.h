#pragma once

#include <span>

namespace keyline::numeric {

/// Value at t of the cubics through (x_i, y_i) that rise or fall wherever those do (after
/// [Fritsch 1980]; slopes are harmonic means), level beyond the ends.
/// Precondition: as many x, increasing, as y; at least two.
double monotone_cubic(std::span<const double> x, std::span<const double> y, double t);

}  // namespace keyline::numeric
