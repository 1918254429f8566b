#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/library/entry.h"
#include "keyline/operations/values.h"

/// Things of the design library in requests and results.
namespace keyline::operations {

struct LibraryEntry {
  library::Kind kind = library::Kind::curve;
  std::string name;
  std::string layer;
  std::string color;
  std::string unit;
  std::string source;
  std::optional<AnyCurve> curve;
  std::optional<surface::Surface> surface;
  library::Measures measures;
  std::vector<double> turning;
  std::string thumbnail;
  std::vector<std::string> notes;
  static constexpr auto describe() {
    using E = LibraryEntry;
    return core::fields(
        core::field<&E::kind>("what it is"), core::field<&E::name>("may be empty"),
        core::field<&E::layer>("may be empty"), core::field<&E::color>("#rrggbb; may be empty"),
        core::field<&E::unit>("of all lengths; empty: none given"),
        core::field<&E::source>("where it comes from"), core::field<&E::curve>("exact"),
        core::field<&E::surface>("exact, whole as without its trims"),
        core::flattened<&E::measures>(),
        core::field<&E::turning>("its profile: 64 differences of turning, even and odd parts")
            .in("radian")
            .count(0, library::kTurningParts),
        core::field<&E::thumbnail>("a small picture, SVG"),
        core::field<&E::notes>("what could not be measured, and why"));
  }
};

LibraryEntry entry_shown(const library::Entry& entry);

/// The inverse. Fails: bad_input where there is neither a curve nor a surface.
core::Result<library::Entry> entry_of(const LibraryEntry& shown);

}  // namespace keyline::operations
