#pragma once

#include <string>
#include <vector>

#include "keyline/library/library.h"

namespace keyline::library {

/// Quantiles of a measure; count is of the pieces that have it.
struct Spread {
  std::int64_t count = 0;
  double low = 0;  ///< a tenth lies below
  double median = 0;
  double high = 0;  ///< a tenth lies above
};

/// One type of the survey.
struct RhythmCount {
  std::string rhythm;
  std::string impression;
  bool is_of_the_five = false;  ///< of [Fairing] Fig. 8; the others have no line in the diagram
  std::int64_t curves = 0;      ///< whose longest piece it is
  std::int64_t pieces = 0;
  double length = 0;     ///< share of all pieces' length, sizes made equal
  Spread slope;          ///< of the first line, along growing radius
  Spread self_affinity;  ///< deviation; 0: the part corresponds to its parent (Fig. 7)
};

/// The survey of [Fairing] section 2.2 over a library.
struct Statistics {
  std::int64_t things = 0;
  std::int64_t curves = 0;  ///< planar ones
  std::int64_t space_curves = 0;
  std::int64_t surfaces = 0;
  std::int64_t without_rhythm = 0;  ///< curves not measured (polylines, curves out of any plane)
  double in_the_five = 0;           ///< share of the pieces that are of the five types
  std::vector<RhythmCount> rhythms;
  Spread self_affinity;  ///< of all pieces that have a radius that changes
  Spread cav;
  Spread sav;
};

core::Result<Statistics> statistics(Library& library);

}  // namespace keyline::library
