#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/describe.h"
#include "keyline/library/library.h"

namespace keyline::library {

/// Which numbers are wanted; an end that is not given is open, both ends belong to the range.
struct Range {
  std::optional<double> low;
  std::optional<double> high;
  static constexpr auto describe() {
    return core::fields(core::field<&Range::low>("the least wanted"),
                        core::field<&Range::high>("the largest wanted"));
  }
  static constexpr std::string_view kTextForm = "-1±0.2, 0..1, <1, <=1, >2, >=2, or one number";
  /// The text form ("-1+-0.2" too). Fails: bad_input for anything else.
  static core::Result<Range> from_text(std::string_view text);
};

/// What is looked for; all that is given must hold. Rhythm, slope and self-affinity must hold for
/// one and the same piece of the curve.
struct Criteria {
  std::string name = {};
  std::string source = {};
  std::string rhythm = {};
  std::optional<Range> slope = {};
  std::optional<Range> self_affinity = {};
  std::optional<Range> cav = {};
  std::optional<Range> nearest_cav = {};
  std::optional<Range> sav = {};
  std::optional<Range> size = {};
  bool mirror = true;
  int limit = 20;
  std::optional<TurningProfile> like =
      {};  ///< nearest first; curves without a profile are left out
  static constexpr auto describe() {
    using C = Criteria;
    return core::fields(
        core::field<&C::name>("with * and ? as in file names; empty: any"),
        core::field<&C::source>("where it came from, likewise"),
        core::field<&C::rhythm>("of a piece: minus, zero, plus, plus+minus, minus+plus, arc, arcs, "
                                "straight, or one of its words, as accelerating"),
        core::field<&C::slope>("of one of the piece's lines"),
        core::field<&C::self_affinity>("of the piece; 0 for log-aesthetic ones"),
        core::field<&C::cav>("curve aesthetic value by the letter"),
        core::field<&C::nearest_cav>("that of the nearest curve of one matrix"),
        core::field<&C::sav>("surface aesthetic value"),
        core::field<&C::size>("diagonal of the box around it").in("length"),
        core::field<&C::mirror>("with like: a mirror image is alike"),
        core::field<&C::limit>("most that are returned").within(core::from_to(1, 1'000'000)));
  }
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
  static constexpr auto describe() {
    using F = Found;
    return core::fields(
        core::field<&F::id>("its number"), core::field<&F::kind>("curve, space-curve or surface"),
        core::field<&F::name>("may be empty"), core::field<&F::source>("where it came from"),
        core::field<&F::rhythm>("of its longest piece; empty: none"),
        core::field<&F::size>("diagonal of the box around it").in("length"),
        core::field<&F::length>("of a curve").in("length"),
        core::field<&F::cav>("curve aesthetic value by the letter"),
        core::field<&F::nearest_cav>("that of the nearest curve of one matrix"),
        core::field<&F::sav>("surface aesthetic value"),
        core::field<&F::match>("with like: how alike, and how laid over it"));
  }
};

struct Findings {
  std::int64_t count = 0;    ///< of all that meet the criteria
  std::vector<Found> found;  ///< the first of them: nearest first, else by number
  static constexpr auto describe() {
    return core::fields(core::field<&Findings::count>("all that meet the criteria"),
                        core::field<&Findings::found>(
                            "the first of them: nearest first with like, else by number"));
  }
};

/// Fails: bad_input for a rhythm there is not or a limit below 1; io.
core::Result<Findings> find(Library& library, const Criteria& criteria);

}  // namespace keyline::library
