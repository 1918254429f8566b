#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/sketch/trace.h"

namespace keyline::app {

/// The pictures of every stage of a trace (--debug DIR): log, histogram, binary, smoothed, edges,
/// lines, groups with their axes, segments, quadratics, quintics, curvature and derivative plots.
class SketchDebug {
 public:
  /// Takes one stage's picture in.
  void add(const sketch::Stage& stage) { stages_.push_back(stage); }

  /// Writes all pictures into the folder, which is made where it does not exist.
  core::Result<void> write(const std::filesystem::path& folder,
                           const sketch::TraceResult& trace) const;

 private:
  std::vector<sketch::Stage> stages_;
};

}  // namespace keyline::app
