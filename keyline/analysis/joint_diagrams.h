#pragma once

#include <optional>
#include <span>

#include "keyline/analysis/lddc.h"
#include "keyline/core/interval.h"

/// Diagrams of many sections of one surface, read together ([Fairing] 2.1 and 4.5): the C curves in
/// one frame, and whether the diagrams order the sections by volume as their areas do.
namespace keyline::analysis {

/// What a section shows of its volume: the diagram, and the area over the chord divided by the
/// square of the length, which does not depend on size.
struct SectionVolume {
  const Lddc* diagram = nullptr;
  double relative_volume = 0;
};

struct JointDiagrams {
  core::Interval x;  ///< of all C curves: log10(radius / length)
  core::Interval y;  ///< log10(share of the length)
  /// Share of the pairs of sections whose order by the paper's index, the distance AB (the shorter,
  /// the fuller), is that of their relative volumes; empty where no pair differs in both (by more
  /// than 1e-9 of the larger).
  std::optional<double> agreement;
};

/// Sections without a C curve count for nothing.
JointDiagrams joint_diagrams(std::span<const SectionVolume> sections);

}  // namespace keyline::analysis
