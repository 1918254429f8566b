#pragma once

#include <string>
#include <vector>

#include "keyline/analysis/rhythm.h"
#include "keyline/core/describe.h"

/// Readings of pieces in results.
namespace keyline::operations {

/// One way to read a piece, with its words.
struct Reading {
  analysis::Interpretation reading;
  std::string impression;
  static constexpr auto describe() {
    return core::fields(core::flattened<&Reading::reading>(),
                        core::field<&Reading::impression>("what it says, in [Fairing]'s words"));
  }
};

inline std::vector<Reading> readings_of(const std::vector<analysis::Interpretation>& found) {
  std::vector<Reading> readings;
  for (const analysis::Interpretation& one : found)
    readings.push_back({one, analysis::impression(one.rhythm)});
  return readings;
}

}  // namespace keyline::operations
