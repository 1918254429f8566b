#pragma once

#include <optional>
#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/acquire/raw_curve.h"
#include "keyline/core/error.h"
#include "keyline/core/progress.h"

namespace keyline::acquire {

/// Settings of acquire_key_line, most of which it finds out from the points unless they are given.
struct AcquireOptions {
  std::optional<bool> closed;   ///< empty: recognised from the gap between the ends
  std::optional<bool> ordered;  ///< empty: recognised; false: order anew; true: keep
  bool remove_outliers = true;
  bool find_corners = true;
  double corner_angle = 0.6;    ///< radians: a smaller change of direction is no corner
  std::optional<double> noise;  ///< known standard deviation; empty: estimated
  /// Noise is measured on waves shorter than this, in the points' unit; empty: where texture shows.
  std::optional<double> detail;
  std::optional<Plane> plane;                 ///< empty: fitted (3D input) or z = 0 (planar input)
  core::CancellationToken cancellation = {};  ///< asked while points are put in order
};

/// From raw points to a key-line: non-finite points and duplicates dropped, the plane fitted,
/// points put in order where their order makes no sense, strays removed, closed outlines
/// recognised, noise and rounding estimated, corners found. The report lists every step.
///
/// Returns:    bad-input where fewer than two distinct finite points remain, a coordinate exceeds
///             1e100 in size, or weights are negative or do not match the points; cancelled.
/// Invariance: moving, turning, scaling the input moves, turns, scales the answer; reversing it
///             reverses the answer.
/// Cost:       O(n log n).
core::Result<KeyLine> acquire_key_line(const RawCurve& raw, const AcquireOptions& options = {});

}  // namespace keyline::acquire
