#pragma once

#include <vector>

#include "keyline/fairing/run.h"

namespace keyline::fairing::detail {

/// A run's points in a frame of its own: length 1, first point at the origin, centroid on the x
/// axis; direction of travel by shape (the end farther from the centroid comes last; closed runs
/// turn left and start at the point farthest from the centroid). A half's line of symmetry runs
/// along the x axis instead.
struct RunFrame {
  std::vector<core::Point2> points;
  std::vector<double> weights;     ///< one per point
  std::vector<std::size_t> order;  ///< canonical position -> position in the run
  core::Similarity2 to_canonical;
  bool reversed = false;
};

RunFrame make_frame(const Run& run);

}  // namespace keyline::fairing::detail
