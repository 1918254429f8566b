#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/interval.h"
#include "keyline/library/library.h"

namespace keyline::library {

/// "-1±0.2" ("-1+-0.2" too), "0..1", "<1", "<=1", ">2", ">=2" or one number, which means itself;
/// the ends that are left open are infinite and belong to the interval, as finite ones do.
/// Fails: bad_input for anything else.
core::Result<core::Interval> parse_range(std::string_view text);

/// What is looked for; all that is given must hold. Rhythm, slope and self-affinity must hold for
/// one and the same piece of the curve.
struct Criteria {
  std::string name = {};    ///< with * and ? as in file names; empty: any
  std::string source = {};  ///< likewise
  /// A rhythm's name (analysis/rhythm.h) or one of its words: "minus", "accelerating", "sharp".
  std::string rhythm = {};
  std::optional<core::Interval> slope = {};  ///< of one of the piece's lines
  std::optional<core::Interval> self_affinity = {};
  std::optional<core::Interval> cav = {};
  std::optional<core::Interval> nearest_cav = {};
  std::optional<core::Interval> sav = {};
  std::optional<core::Interval> size = {};
  std::optional<TurningProfile> like =
      {};              ///< nearest first; curves without a profile are left out
  bool mirror = true;  ///< a mirror image is alike
  int limit = 20;      ///< most that are returned
};

/// One that was found, in short.
struct Found {
  std::int64_t id = 0;
  std::string kind;
  std::string name;
  std::string source;
  std::string rhythm;  ///< of its longest piece
  double size = 0;
  std::optional<double> length;
  std::optional<double> cav;
  std::optional<double> nearest_cav;
  std::optional<double> sav;
  std::optional<TurningMatch> match;  ///< with `like`
};

struct Findings {
  std::int64_t count = 0;    ///< of all that meet the criteria
  std::vector<Found> found;  ///< the first of them: nearest first, else by number
};

/// Fails: bad_input for a rhythm there is not or a limit below 1; io.
core::Result<Findings> find(Library& library, const Criteria& criteria);

}  // namespace keyline::library
