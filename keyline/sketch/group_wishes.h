#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/sketch/pass_evidence.h"

namespace keyline::sketch {

/// What a person knows of the strokes and no rule can see. Strokes by their numbers, from 0.
struct GroupWishes {
  std::vector<std::size_t> keep;                ///< each stays a line of its own, as drawn
  std::vector<std::vector<std::size_t>> join;   ///< strokes of each set are one line
  std::vector<std::vector<std::size_t>> split;  ///< no two strokes of a set are one line
  bool empty() const { return keep.empty() && join.empty() && split.empty(); }
};

/// bad_input where a stroke is none of `count`, stands twice in a set, or wishes contradict each
/// other.
core::Result<void> check_wishes(const GroupWishes& wishes, std::size_t count);

/// The same wishes about some of the strokes alone, numbered as they stand in `some`.
GroupWishes wishes_among(const GroupWishes& wishes, const std::vector<std::size_t>& some);

/// Puts the wishes above all evidence. Precondition: check_wishes() found nothing.
void wish(const GroupWishes& wishes, PassEvidence& evidence);

/// The sets of `join` whose strokes are members of no one line of `lines`, in words.
std::vector<std::string> unmet_joins(const GroupWishes& wishes,
                                     const std::vector<std::vector<std::size_t>>& lines);

}  // namespace keyline::sketch
