#pragma once

#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/core/error.h"
#include "keyline/core/pose.h"
#include "keyline/lac/chain/chain.h"

/// A symmetric key-line folded along its line of symmetry, and the answer unfolded.
namespace keyline::fairing::detail {

/// How a half ends.
enum class HalfEnd {
  free,    ///< where the key-line itself ends, off the line
  square,  ///< on the line, running across it smoothly
  corner   ///< on the line, in a corner or an end of the key-line
};

/// The points of both sides on one, in their order. An own point and another's image that stand
/// side by side are one, their mean.
struct HalfLine {
  acquire::KeyLine line;
  HalfEnd start = HalfEnd::free;
  HalfEnd end = HalfEnd::square;
  std::vector<core::Point2> measured;  ///< own points and images…
  std::vector<std::size_t> belongs;    ///< …and which of the line's points each belongs to
};

/// undrawable where the key-line does not cross the line as a symmetric one does (closed: twice,
/// open: once between its ends), or where a corner of one side has no partner on the other.
core::Result<HalfLine> fold(const acquire::KeyLine& line, const core::Pose2& axis);

/// The chains of the half and their images, in the order in which the key-line runs, joined where
/// they cross the line smoothly.
std::vector<lac::Chain> unfold(const std::vector<lac::Chain>& half, const HalfLine& folded,
                               const core::Pose2& axis, bool closed);

}  // namespace keyline::fairing::detail
