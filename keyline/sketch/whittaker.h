#pragma once

#include <vector>

#include "keyline/core/point.h"

namespace keyline::sketch {

/// Points smoothed by their second differences (Whittaker 1923): the z of least
/// Σ w_i |p_i − z_i|² + λ Σ |z_{i−1} − 2 z_i + z_{i+1}|². Where weights are 0 the answer is the
/// cubic that continues its neighbours. Waves of length (2π) λ^(1/4) points are halved.
///
/// Weights: as many as points, ≥ 0, at least two positive (InvalidInput otherwise).
/// closed:  the last point is followed by the first.
std::vector<core::Point2> smooth_points(const std::vector<core::Point2>& points,
                                        const std::vector<double>& weights, double lambda,
                                        bool closed);

/// λ that halves waves of the given length in points.
double lambda_of_wavelength(double wavelength);

}  // namespace keyline::sketch
