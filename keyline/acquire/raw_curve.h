#pragma once

#include <string>
#include <vector>

#include "keyline/core/point.h"

namespace keyline::acquire {

/// Points as they came from a file or a scanner: any order, any quality. Planar input has z = 0
/// and has_z false. weights and source_lines are empty or as long as points.
struct RawCurve {
  std::string id;
  std::vector<core::Point3> points;
  bool has_z = false;
  bool scattered = false;  ///< a random sample, cut: the order of close neighbours is chance
  std::vector<double> weights;
  std::vector<int> source_lines;      ///< 1-based line of the file each point came from
  std::vector<std::string> left_out;  ///< lines of the file that are no points: where and what
  std::vector<std::string> notes;     ///< what the reader ignored or decided, one line each
};

}  // namespace keyline::acquire
