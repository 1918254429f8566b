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
  static constexpr auto describe() {
    return core::fields(core::field<&Spread::count>("those that have it"),
                        core::field<&Spread::low>("a tenth lies below"),
                        core::field<&Spread::median>("half lies below"),
                        core::field<&Spread::high>("a tenth lies above"));
  }
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
  static constexpr auto describe() {
    using R = RhythmCount;
    return core::fields(
        core::field<&R::rhythm>("its name"), core::field<&R::impression>("in [Fairing]'s words"),
        core::field<&R::is_of_the_five>("whether it is one of the five types of [Fairing] Fig. 8"),
        core::field<&R::curves>("whose longest piece it is"),
        core::field<&R::pieces>("that read as it"),
        core::field<&R::length>("its share of all curves' length, each curve counting alike"),
        core::field<&R::slope>("of the first line"),
        core::field<&R::self_affinity>("deviation; 0: the part corresponds to its parent"));
  }
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
  static constexpr auto describe() {
    using S = Statistics;
    return core::fields(
        core::field<&S::things>("in the library"), core::field<&S::curves>("planar ones"),
        core::field<&S::space_curves>("curves in space"), core::field<&S::surfaces>("patches"),
        core::field<&S::without_rhythm>("curves that were not measured"),
        core::field<&S::in_the_five>("share of the pieces that are of the five types"),
        core::field<&S::rhythms>("the survey of [Fairing] section 2.2"),
        core::field<&S::self_affinity>("of all pieces whose radius changes"),
        core::field<&S::cav>("curve aesthetic values"),
        core::field<&S::sav>("surface aesthetic values"));
  }
};

core::Result<Statistics> statistics(Library& library);

}  // namespace keyline::library
