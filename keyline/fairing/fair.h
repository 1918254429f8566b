#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "keyline/acquire/key_line.h"
#include "keyline/analysis/continuity.h"
#include "keyline/analysis/rhythm.h"
#include "keyline/analysis/split.h"
#include "keyline/core/describe.h"
#include "keyline/core/error.h"
#include "keyline/core/progress.h"
#include "keyline/curve/bspline.h"
#include "keyline/fairing/bound.h"
#include "keyline/fairing/fairness.h"
#include "keyline/fairing/symmetric.h"
#include "keyline/fit/fit_spline.h"
#include "keyline/lac/chain/chain.h"

/// The main job, [Fairing]: from a key-line's points to a faired chain and its verdict.
namespace keyline::fairing {

/// What is held at an end of an open key-line: its position, also its direction, also its
/// curvature, as the spline through the points (or the given curve) has them.
enum class Clamp { none, g0, g1, g2 };
constexpr auto choices(const Clamp*) {
  return core::words<Clamp>(
      {{Clamp::none, "none"}, {Clamp::g0, "G0"}, {Clamp::g1, "G1"}, {Clamp::g2, "G2"}});
}

/// What the chain is to be, within the tolerance: as short as possible, or of least variation of
/// curvature (L^3 * integral of (d curvature / ds)^2 ds, Moreton and Sequin), with no wave of
/// curvature that the points do not ask for. A wanted number of pieces asks for the first.
enum class Criterion { fewest_pieces, least_variation };
constexpr auto choices(const Criterion*) {
  return core::words<Criterion>({{Criterion::fewest_pieces, "fewest-pieces"},
                                 {Criterion::least_variation, "least-variation"}});
}

/// What joints of the calmest chain are to be: of one curvature, or also of one rate at which it
/// changes wherever curvature runs one way through them. Where it turns the rate cannot be one.
enum class JointOrder { g2, g3 };
constexpr auto choices(const JointOrder*) {
  return core::words<JointOrder>({{JointOrder::g2, "G2"}, {JointOrder::g3, "G3"}});
}

struct EndClamps {
  Clamp start = Clamp::none;
  Clamp end = Clamp::none;
  static constexpr auto describe() {
    return core::fields(core::field<&EndClamps::start>("held at the start"),
                        core::field<&EndClamps::end>("held at the end"));
  }
  static constexpr std::string_view kTextForm = "start:G1,end:G2, either one alone, G0 to G2";
  static core::Result<EndClamps> from_text(std::string_view text);
};

/// A reading of one piece of the answer that replaces the one found.
struct InterpretationOverride {
  int piece = 0;  ///< index into FairResult::pieces
  std::optional<analysis::Rhythm> rhythm;
  std::optional<double> slope;
  static constexpr auto describe() {
    return core::fields(
        core::field<&InterpretationOverride::piece>("which, from 0")
            .within(core::from_to(0, 1'000'000))
            .needed(),
        core::field<&InterpretationOverride::rhythm>("how it is to read; or a slope"),
        core::field<&InterpretationOverride::slope>("of its logarithmic curvature graph"));
  }
  static constexpr std::string_view kTextForm =
      "PIECE:RHYTHM with straight, arc, minus, zero, plus, plus+minus or minus+plus, or "
      "PIECE:slope=NUMBER, pieces counted from 0";
  static core::Result<InterpretationOverride> from_text(std::string_view text);
  static core::Result<void> check(const InterpretationOverride& asked);
};

struct FairOptions {
  double tolerance =
      0;  ///< largest distance of a point, in the points' unit; 0: by the default rule
  std::optional<double> sigmas;  ///< the tolerance in standard deviations of the points
  /// From 0, as near as the noise of the points, to 1, as calm as the tolerance allows; between
  /// them what the tolerance holds beyond the noise is the curve's to depart by. Empty: 0.5, and
  /// more where that answer is not fair (see until_fair).
  std::optional<double> smoothness;
  /// Waves of curvature between corners, at most; empty: as many as the points ask for.
  std::optional<int> waves;
  /// Fastest that curvature may change along the curve, |dkappa/ds|, in 1/unit^2: undrawable where
  /// that is not found within the tolerance. Of the calmest chain alone.
  std::optional<double> max_rate;
  core::Interval slopes{-3, 3};  ///< of the pieces' logarithmic curvature graphs
  JointOrder joints = JointOrder::g2;
  int pieces = 0;  ///< number of pieces; 0: what the criterion leads to
  Criterion criterion = Criterion::least_variation;
  /// Sides of lines that the curve stays on, beside those that the key-line itself has.
  std::vector<Bound> keep_inside;
  Symmetric symmetric;
  bool keep_corners = true;
  EndClamps clamp;
  std::optional<core::Interval> region;  ///< fractions of the length: fair only this part
  std::vector<InterpretationOverride> interpretations;
  std::vector<std::size_t> must_pass;  ///< indices into the key-line's points
  /// The spline of step 2: order (4 to 6), budget, knots and parameter. What else it needs
  /// (seed, threads, closing, points to pass, rounding, progress) comes from here and the points.
  fit::SplineFitOptions spline = fit::SplineFitOptions::for_fairing();
  std::uint64_t seed = 1;
  int threads = 0;
  core::Progress progress;
  static constexpr auto describe() {
    return core::fields(
        core::field<&FairOptions::tolerance>(
            "largest distance of a point from the curve; unless given three times the noise, and "
            "0.01 % of the length at least")
            .in("length")
            .within(core::kPositive),
        core::field<&FairOptions::sigmas>(
            "the tolerance as so many standard deviations of the points, in place of a length")
            .within(core::kPositive),
        core::field<&FairOptions::smoothness>(
            "from 0, as near as the noise of the points, to 1, as calm as the tolerance allows; "
            "unless given 0.5, and more where that is not fair")
            .within(core::from_to(0, 1)),
        core::field<&FairOptions::waves>(
            "most waves of curvature between corners; unless given as many as the points require")
            .within(core::at_least(0)),
        core::field<&FairOptions::max_rate>(
            "how fast curvature may change along the curve; refused where no curve within the "
            "tolerance is so calm")
            .in("1/length^2")
            .within(core::kPositive),
        core::field<&FairOptions::slopes>("range of the slopes of pieces")
            .within(core::from_to(-12, 12)),
        core::field<&FairOptions::joints>(
            "continuity at joints where curvature does not turn: G2, or G3 (also equal rates of "
            "curvature) as far as tolerance and slopes allow, with more pieces and variation"),
        core::field<&FairOptions::pieces>("number of pieces; 0: what the criterion leads to")
            .within(core::from_to(0, 400)),
        core::field<&FairOptions::criterion>(
            "what to look for within the tolerance: the shortest chain, or the calmest"),
        core::field<&FairOptions::keep_inside>(
            "lines that the curve stays on one side of, as in x>=0 or y<=2.5; half-breadths of a "
            "hull keep to their side unasked")
            .or_bare_item(),
        core::field<&FairOptions::symmetric>(
            "make the answer exactly symmetric about the line in which the points mirror within "
            "their noise (auto) or about a given one; off: such a line is only reported"),
        core::field<&FairOptions::keep_corners>("keep corners of the points; chains end there"),
        core::field<&FairOptions::clamp>(
            "what is held at the ends: G0 position, G1 also direction, G2 also curvature"),
        core::field<&FairOptions::region>(
            "fair only this part of the length, as fractions of it; of a closed line from below 0 "
            "or to above 1 where the part runs over its start")
            .within(core::from_to(-1, 2)),
        core::field<&FairOptions::interpretations>("readings that replace those found, by piece")
            .named("interpretation")
            .or_bare_item(),
        core::field<&FairOptions::must_pass>("indices of points the curve must pass, from 0"),
        core::flattened<&FairOptions::spline>().narrow("order", core::from_to(4, 6)),
        core::field<&FairOptions::seed>(
            "seed of the search for knots; the same seed gives the same result"));
  }
};

/// One log-aesthetic piece of the answer and how it reads.
struct FairPiece {
  int curve = 0;     ///< which of FairResult::curves
  int piece = 0;     ///< which of its pieces
  double start = 0;  ///< arc length from the start of the whole
  double length = 0;
  analysis::Rhythm rhythm = analysis::Rhythm::straight;
  std::vector<double> slopes;
  double volume = 0;
  double deviation = 0;                                   ///< largest distance of its points
  std::vector<analysis::Interpretation> interpretations;  ///< of the points' spline, best first
  bool overridden = false;
  int points = 0;    ///< that are nearest to it
  double noise = 0;  ///< theirs, or how far they lie off where that is more
  bool told = true;  ///< whether the points tell the slope
  bool seen = true;  ///< whether the piece is long enough to be seen as something of its own
  static constexpr auto describe() {
    return core::fields(
        core::field<&FairPiece::curve>("which member of the curve, from 0"),
        core::field<&FairPiece::piece>("which of its pieces, from 0"),
        core::field<&FairPiece::start>("arc length from the start of the whole").in("length"),
        core::field<&FairPiece::length>("of the piece").in("length"),
        core::field<&FairPiece::rhythm>("what it reads as"),
        core::field<&FairPiece::slopes>("of its logarithmic curvature graph"),
        core::field<&FairPiece::volume>("area over its chord").in("length^2"),
        core::field<&FairPiece::deviation>("largest distance of its points").in("length"),
        core::field<&FairPiece::told>("whether its points tell the slope"),
        core::field<&FairPiece::seen>("whether it is long enough to leave an impression"));
  }
};

/// Impression words of [Fairing]; none where the points do not tell the slope or the piece is too
/// short to be seen.
const char* impression(const FairPiece& piece);

/// A member of the answer: a faired chain, or a part of the given curve that was kept.
using FairCurve = std::variant<lac::Chain, curve::BSpline2>;

/// Joints inside the faired chains by the rate at which curvature changes.
struct JointRates {
  int g3 = 0;     ///< it is one
  int turns = 0;  ///< it changes its sign: curvature turns, and along a piece it never vanishes
  int jumps = 0;  ///< it jumps where it could be one
  static constexpr auto describe() {
    return core::fields(
        core::field<&JointRates::g3>("of one rate of curvature"),
        core::field<&JointRates::turns>("where curvature turns: the rate cannot be one there"),
        core::field<&JointRates::jumps>("where the rate jumps although curvature runs one way"));
  }
};

struct FairResult {
  std::vector<FairCurve> curves;  ///< end to end; corners between them
  bool closed = false;
  std::vector<curve::BSpline2> splines;  ///< step 2, one per run between corners
  double spline_bic = 0;
  std::vector<analysis::MonotonePiece> monotone;  ///< step 3, of all splines in order
  std::vector<int> monotone_spline;               ///< which spline each belongs to
  std::vector<FairPiece> pieces;
  /// Of every point, positive left of the curve; not a number outside a region.
  std::vector<double> offsets;
  double length = 0;  ///< of the curves together
  double noise = 0;
  double tolerance = 0;
  double max_deviation = 0;
  double rms_deviation = 0;
  std::size_t worst_point = 0;
  bool within_tolerance = false;
  double smoothness = 0;  ///< that was taken
  /// Whether another would give another answer: not where noise fills the tolerance, or is none.
  bool smoothness_counts = true;
  /// No calmest chain came out for any run: shortest ones stand in, whatever the smoothness.
  bool calm_missed = false;
  bool all_single = false;  ///< every run is one piece that reproduces its points to rounding
  FairFigures fairness;
  double rate = 0;  ///< fastest that curvature changes in the faired curves, see FairOptions
  std::optional<FoundSymmetry> symmetry;
  double outside = 0;  ///< by how much the answer passes a bound; 0 where it keeps them
  bool cancelled = false;
  std::vector<analysis::JointContinuity> joints;  ///< inside chains and between curves
  JointRates joint_rates;
  std::vector<std::string> notes;  ///< everything dropped, merged, overridden, in words
};

/// Fairs a key-line: corners become ends of chains; each run gets its spline (genetic knots), its
/// split and its G2 chain of log-aesthetic pieces, the calmest within the tolerance (or the
/// shortest).
///
/// Default tolerance: the larger of three times the noise (more for many points, so that one
/// normal error in twenty runs exceeds it) and 0.01 % of the length.
/// Returns: bad_input for fewer than two points or options out of range. A chain that misses the
///          tolerance is returned with within_tolerance false. Cancelled work returns the best
///          found with cancelled true, or a `cancelled` failure where there is nothing yet.
/// Invariance: moving, turning, scaling or reversing the points changes the answer by rounding.
/// Source:  [Fairing] sections 2 to 5; docs/design/fairness.md, chain-fit.md for step 5.
core::Result<FairResult> fair(const acquire::KeyLine& line, const FairOptions& options = {});

/// Standard deviations that all of n normal errors stay below in nineteen runs of twenty; three at
/// least.
double noise_factor(std::size_t n);

/// The default tolerance for n points of a curve of that length.
double default_tolerance(double noise, double length, std::size_t n);

}  // namespace keyline::fairing
