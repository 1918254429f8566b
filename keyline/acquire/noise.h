#pragma once

#include <cstddef>
#include <span>

#include "keyline/acquire/raw_curve.h"
#include "keyline/core/point.h"

namespace keyline::acquire {

/// Standard deviation of the position error of ordered points, normal to the curve, from the
/// residuals of local polynomials of several degrees and window widths: the mean of the least two
/// thirds of each kind's variances, since the rest may hold corners or strays; of the kinds, those
/// that agree with the least, since curvature can only enlarge them. 0 for fewer than 5 points, and
/// of the order of 1e-12 of the size for points exactly on a smooth, densely sampled curve. Waves
/// longer than about ten points are shape to this estimate, not noise.
double estimate_noise(std::span<const core::Point2> points, bool closed);

/// The same from points that many apart: waves longer than about ten times that are shape.
double estimate_noise(std::span<const core::Point2> points, bool closed, std::size_t stride);

/// What of that noise, told by points `stride` apart, cannot be bends: errors stay as they are
/// between points twice as far apart, residuals of bends grow eightfold there, and windows that
/// turn too far to be the graph of a function are bends. The quietest third of the windows tells:
/// features make the others grow. 0 where all may be bends; the noise where they are little of it.
double noise_beyond_bends(std::span<const core::Point2> points, bool closed, std::size_t stride,
                          double noise);

/// Noise whose neighbours err alike, as a scanned surface's roughness does.
struct Texture {
  double noise = 0;
  std::size_t stride = 1;   ///< points apart at which it shows whole
  std::size_t nearest = 1;  ///< the least stride, see noise_stride: there errors are chance
};

/// Looks farther and farther apart, by doubling, until the estimate stays as it is: there roughness
/// shows whole, and what grows on is shape. At most to where windows are a tenth of the
/// curve; where nothing stays before that, the estimate of neighbours is all there is.
Texture estimate_texture(std::span<const core::Point2> points, bool closed);

/// Whether points twice as far apart err by about as much as that: else neighbours err alike, or
/// what counts as noise is shape that few points tell.
bool noise_stays(std::span<const core::Point2> points, bool closed, double noise);

/// Number of points from one window point to the next at which steps along the curve stand clear
/// of the noise: 1 for ordinary data, larger where points are denser than their noise.
std::size_t noise_stride(std::span<const core::Point2> points, bool closed);

/// Decimal step the coordinates are rounded to (1 for integer pixels, 1e-5 for five decimals), or
/// 0 where x, y or z carries 13 or more significant digits (the others may be an even grid). The
/// finest of the steps found in x, y and z, each the one that four fifths of the values satisfy.
/// The standard deviation of the rounding error is rounding / sqrt(12).
double estimate_rounding(const RawCurve& raw);

/// Step of any size that the coordinates are multiples of, wherever these start, as whole pixels in
/// millimetres are: the finest of those of x, y and z (see detail::common_step); 0 where one of
/// them has none. Exact coordinates may have one too, such as squares of multiples.
double estimate_common_step(const RawCurve& raw);

}  // namespace keyline::acquire
