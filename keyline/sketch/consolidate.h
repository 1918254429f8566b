#pragma once

#include <cstddef>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/sketch/group_wishes.h"

/// Designers draw a line several times over; here the one line they meant comes out.
namespace keyline::sketch {

/// A stroke as it was drawn: at least two points.
struct DrawnStroke {
  std::vector<core::Point2> points;
  bool closed = false;
};

struct ConsolidateOptions {
  double width = 1;         ///< of the pen, in the strokes' unit
  bool measured = false;    ///< the width was measured: it is taken as it is
  double apart = 4;         ///< widths: farthest apart two passes of one line lie, at most, and …
  double hand = 0.09;       ///< … the share of their length that the hand errs on top, at most
  double angle = 0.45;      ///< radians: strokes that differ more in direction are different lines
  GroupWishes wishes = {};  ///< numbers are places in the strokes given
};

/// The line that a group of strokes stands for.
struct MeantLine {
  std::vector<core::Point2> points;  ///< half a reach apart or closer
  bool closed = false;
  std::vector<std::size_t> members;  ///< indices of the strokes
  double explained = 0;              ///< of their length, how much runs beside the line
};

/// Groups strokes that are passes of one line (pass_evidence.h), and gives every group the line
/// that meant_line finds; strokes it does not explain are grouped anew among themselves, so that
/// each is a member of one line. Strokes alone stay as they are but for repeated points. Wishes
/// stand above the evidence; strokes that no line lies along stay apart, joined or not.
///
/// A pen that is improbably thin or thick for the drawing (a file scaled without its pen) counts as
/// the nearest probable one.
/// Order: lines by their first member. Throws InvalidInput for a stroke of fewer than two points.
/// Precondition: check_wishes() finds nothing.
std::vector<MeantLine> consolidate(const std::vector<DrawnStroke>& strokes,
                                   const ConsolidateOptions& options = {});

/// About how many lines consolidate() would make of the strokes: groups before their lines are
/// looked for. Same preconditions.
std::size_t count_lines(const std::vector<DrawnStroke>& strokes, const ConsolidateOptions& options);

}  // namespace keyline::sketch
