#pragma once

#include <array>
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
  double size = 0;
  std::optional<double> length;
  std::optional<double> volume;
  std::optional<std::array<double, 2>> curvature;
  std::vector<library::PieceEntry> pieces;
  std::optional<int> cav_type;
  std::optional<double> cav;
  std::optional<double> nearest_cav;
  std::optional<double> nearest_distance;
  std::optional<double> sav;
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
        core::field<&E::size>("diagonal of the box around it").in("length"),
        core::field<&E::length>("of a curve").in("length"),
        core::field<&E::volume>("area over its chord").in("length^2"),
        core::field<&E::curvature>("least and largest").in("1/length"),
        core::field<&E::pieces>("of monotone curvature, in order"),
        core::field<&E::cav_type>("1 … 5").within(core::from_to(1, 5)),
        core::field<&E::cav>("curve aesthetic value"),
        core::field<&E::nearest_cav>("of the nearest curve of one matrix (types 4, 5)"),
        core::field<&E::nearest_distance>("how far away that is").in("length"),
        core::field<&E::sav>("surface aesthetic value, summed over its patches"),
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
