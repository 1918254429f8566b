#include "keyline/operations/sketch_target.h"

#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "keyline/analysis/profile.h"
#include "keyline/core/text.h"
#include "keyline/document/document.h"
#include "keyline/fit/curvature_drive.h"
#include "keyline/operations/sketch_run.h"

namespace keyline::operations {
namespace {

using core::Result;

using ByLine = std::map<std::size_t, std::vector<fit::CurvatureTarget>>;  ///< t: share of length

Result<ByLine> by_line(const std::vector<WantedPlace>& wanted, std::size_t lines, double scale) {
  const auto bad = [](const std::string& what, std::size_t i) {
    return core::fail(core::ErrorCode::bad_input, what,
                      "give line, fraction of its length, curvature, as 0,0.5,0.01",
                      "target[" + std::to_string(i) + "]");
  };
  ByLine all;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto [line, along, curvature] = wanted[i];
    if (line < 0 || line >= static_cast<double>(lines) || line != std::floor(line))
      return bad("there are lines 0 to " + std::to_string(lines - 1), i);
    if (along < 0 || along > 1) return bad("fractions of a length are 0 to 1", i);
    all[static_cast<std::size_t>(line)].push_back({along, scale * curvature});
  }
  for (const auto& [line, places] : all)
    if (places.size() < 2)
      return bad("line " + std::to_string(line) + " has a single place wanted", 0);
  return all;
}

Result<void> follow(std::vector<fit::CurvatureTarget> target, sketch::Stroke& stroke,
                    double& moved) {
  const document::Path path = path_of(stroke, {1, 0, {}});
  const analysis::CurveView view(path);
  const analysis::ArcLengthTable table(view);
  for (fit::CurvatureTarget& t : target) t.t = table.parameter_at(t.t * table.length());
  auto driven = fit::drive_curvature({stroke.curve, 0}, std::move(target),
                                     {.closed = stroke.closed, .hold_end = true});
  if (!driven) return std::unexpected(driven.error());
  moved = driven->moved;
  stroke.curve = std::move(driven->chain.pieces);
  stroke.target = std::move(driven->target);
  stroke.driven = sketch::DriveReport{driven->before, driven->after};
  return {};
}

}  // namespace

Result<void> follow_wanted(const std::vector<WantedPlace>& wanted,
                           std::vector<sketch::Stroke>& strokes, double scale,
                           const std::string& unit, std::vector<std::string>& notes) {
  const auto lines = by_line(wanted, strokes.size(), scale);
  if (!lines) return std::unexpected(lines.error());
  for (const auto& [line, target] : *lines) {
    sketch::Stroke& stroke = strokes[line];
    if (!stroke.corners.empty())
      return core::fail(core::ErrorCode::unsupported,
                        "line " + std::to_string(line) + " has corners",
                        "split it there; curvatures are followed by lines without", "target");
    double moved = 0;
    if (auto done = follow(target, stroke, moved); !done) return done;
    notes.push_back("line " + std::to_string(line) + " moved by up to " +
                    core::number_text(scale * moved, 3) + " " + unit +
                    " to follow the curvature wanted of it");
  }
  return {};
}

}  // namespace keyline::operations
