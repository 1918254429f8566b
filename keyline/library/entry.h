#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "keyline/analysis/rhythm.h"
#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/core/progress.h"
#include "keyline/document/document.h"
#include "keyline/library/turning_profile.h"

namespace keyline::library {

/// One piece of monotone curvature of a stored curve.
struct PieceEntry {
  double share = 0;  ///< of the curve's length
  analysis::Rhythm rhythm = analysis::Rhythm::straight;
  std::vector<double> slopes;  ///< of the best reading, along growing radius
  std::optional<double> lcg_slope;
  std::optional<double> lcg_variance;
  double volume = 0;
  std::optional<double> self_affinity;  ///< deviation; see analysis/self_affinity.h
  static constexpr auto describe() {
    using P = PieceEntry;
    return core::fields(
        core::field<&P::share>("of the curve's length"),
        core::field<&P::rhythm>("what it reads as"),
        core::field<&P::slopes>("of its lines, along growing radius"),
        core::field<&P::lcg_slope>("of the line through its logarithmic curvature graph"),
        core::field<&P::lcg_variance>("mean square of the graph's residuals"),
        core::field<&P::volume>("area over its chord").in("length^2"),
        core::field<&P::self_affinity>(
            "how far its second half, scaled, is from the whole in log radius: 0 where it "
            "corresponds to its parent"));
  }
};

enum class Kind { curve, space_curve, surface };
constexpr auto choices(const Kind*) {
  return core::words<Kind>(
      {{Kind::curve, "curve"}, {Kind::space_curve, "space-curve"}, {Kind::surface, "surface"}});
}

/// What is measured of a curve or surface; what its kind does not have, or could not be measured,
/// is empty.
struct Measures {
  double size = 0;
  std::optional<double> length;
  std::optional<double> volume;
  std::optional<std::array<std::optional<double>, 2>> curvature;
  std::vector<PieceEntry> pieces;
  std::optional<int> cav_type;
  std::optional<double> cav;  ///< [Oya] Tab. 2 by the letter
  std::optional<double> nearest_cav;
  std::optional<double> nearest_distance;
  std::optional<double> sav;
  static constexpr auto describe() {
    using M = Measures;
    return core::fields(
        core::field<&M::size>("diagonal of the box around it").in("length"),
        core::field<&M::length>("of a curve").in("length"),
        core::field<&M::volume>("area over its chord").in("length^2"),
        core::field<&M::curvature>("least and largest; null where it has no bound, at a cusp")
            .in("1/length"),
        core::field<&M::pieces>("of monotone curvature, in order"),
        core::field<&M::cav_type>("1 … 5").within(core::from_to(1, 5)),
        core::field<&M::cav>("curve aesthetic value"),
        core::field<&M::nearest_cav>("of the nearest curve of one matrix (types 4, 5)"),
        core::field<&M::nearest_distance>("how far away that is").in("length"),
        core::field<&M::sav>("surface aesthetic value, summed over its patches"));
  }
};

/// A curve or surface as the library keeps it: exact, with what was measured of it.
struct Entry : Measures {
  Kind kind = Kind::curve;
  document::Document thing;  ///< one thing with its label and unit; trims and all
  std::string source;        ///< where it comes from, as it was given
  std::optional<TurningProfile> turning;
  std::string thumbnail;
  std::vector<std::string> notes;  ///< what could not be measured, and why
};

/// The label of an entry's thing.
const document::Label& label(const Entry& entry);

struct DescribeOptions {
  std::size_t first = 0;                 ///< of the document's things, in its order
  std::optional<std::size_t> most = {};  ///< so many from there on; empty: all
  int threads = 0;  ///< <= 0: all of the machine's; the entries do not depend on it
};

/// Everything in a document as entries, measured: rhythm, slopes and volumes of every piece, CAV,
/// SAV, size, thumbnail. Space curves that lie in a plane count as planar. What cannot be measured
/// is left empty and noted; polylines have no curvature to measure.
/// Fails: cancelled.
core::Result<std::vector<Entry>> describe(const document::Document& document,
                                          const std::string& source,
                                          const DescribeOptions& options = {},
                                          const core::Progress& progress = {});

}  // namespace keyline::library
