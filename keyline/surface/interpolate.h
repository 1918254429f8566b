#pragma once

#include <span>
#include <vector>

#include "keyline/core/point.h"

/// Internals of room surface: B-splines through points, many at once.
namespace keyline::surface::detail {

/// Knots (clamped, averaged: de Boor) for a spline of the degree through places at the given
/// increasing parameters from 0 to 1; there have to be more places than the degree.
std::vector<double> averaged_knots(std::span<const double> places, int degree);

/// Control values of splines with these knots that take values[i] at places[i]; values are rows of
/// equal length, one spline for each column.
std::vector<std::vector<core::Vector3>> interpolate(
    std::span<const double> places, std::span<const double> knots, int degree,
    const std::vector<std::vector<core::Vector3>>& values);

}  // namespace keyline::surface::detail
