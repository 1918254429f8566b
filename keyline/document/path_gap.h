#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "keyline/document/planar_curve.h"
#include "keyline/document/space_curve.h"

namespace keyline::document {

/// A member of a path that does not begin where the one before it ends.
struct PathGap {
  std::size_t member = 0;  ///< counted from 0
  double width = 0;
};

/// The first gap wider than 1e-5 of the path's size, within which files of other formats are
/// written; empty where there is none. Precondition: the members are valid.
std::optional<PathGap> first_gap(const Path& path);
std::optional<PathGap> first_gap(const std::vector<SpaceCurve>& curves);

/// Whether the curve ends where it begins, but for less than such a gap.
bool ends_meet(const SpaceCurve& curve);

/// Closes all such gaps, of a closed path also that before its first member, with straight lines (a
/// polyline alone with a vertex).
void close_gaps(Path& path);

/// "begins 0.5 away from where the one before it ends".
std::string in_words(const PathGap& gap);

}  // namespace keyline::document
