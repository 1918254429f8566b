#pragma once

#include <cstddef>
#include <vector>

#include "keyline/sketch/pass_evidence.h"
#include "keyline/sketch/stroke_grid.h"

namespace keyline::sketch {

/// Strokes of two lines, by index.
struct TwoLines {
  std::vector<std::size_t> one;
  std::vector<std::size_t> other;
};

/// Finds groups of strokes that are two lines and not passes of one.
///
/// Strokes of a group are put together anew, nearest first by the mean square of their distance
/// where they run beside each other in the same direction, on the farther three quarters of that
/// way: lines that leave each other may lie on each other before. Two parts are two lines, however
/// often they touch or cross, if their strokes lie more than 3.2 times as far apart as those within
/// the parts, and two widths at least (nearer, no stroke has room between): halves of an even
/// spread lie 2.6 times as far apart, so more is a gap. The usual distance of strokes and parts
/// that are put together in the drawing counts as if found within the parts, along the stretch in
/// which the two run beside each other; two single strokes are judged by it alone. In a drawing
/// with fewer than eight such joins nothing is usual, and no group is parted.
///
/// Lines that go on in each other are two where the hand was lifted between them time and again: a
/// part whose strokes run beside each other, though beside no other stroke for three tenths of the
/// shorter one's length, is a line of its own beside another such part if either was drawn whole at
/// least twice. A line made of short strokes one after the other stays one.
///
/// at_most: strokes farther apart than passes of any hand do not run beside each other.
std::vector<TwoLines> two_lines(const std::vector<SampledStroke>& strokes,
                                const std::vector<std::vector<std::size_t>>& groups,
                                const PassModel& at_most);

}  // namespace keyline::sketch
