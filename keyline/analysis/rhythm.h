#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "keyline/analysis/profile.h"
#include "keyline/core/describe.h"

namespace keyline::analysis {

/// What a piece of monotone curvature reads as: the five types of [Fairing] Fig. 8 (one line or
/// two in the diagram of curvature, named by the sign of their slope along growing radius) and
/// the three that have no line there.
enum class Rhythm { straight, arc, arcs, minus, zero, plus, plus_minus, minus_plus };

constexpr auto choices(const Rhythm*) {
  return core::words<Rhythm>({{Rhythm::straight, "straight"},
                              {Rhythm::arc, "arc"},
                              {Rhythm::arcs, "arcs"},
                              {Rhythm::minus, "minus"},
                              {Rhythm::zero, "zero"},
                              {Rhythm::plus, "plus"},
                              {Rhythm::plus_minus, "plus+minus"},
                              {Rhythm::minus_plus, "minus+plus"}});
}

/// "straight" "arc" "arcs" "minus" "zero" "plus" "plus+minus" "minus+plus".
const char* rhythm_name(Rhythm rhythm);

/// Inverse of rhythm_name; empty for any other text.
std::optional<Rhythm> parse_rhythm(std::string_view name);

/// Impression words of [Fairing], for example "sharp, forceful, accelerating"; of the types
/// without a line only the paper's "single R" is known.
const char* impression(Rhythm rhythm);

/// How to read a profile.
struct RhythmOptions {
  double noise = 0;           ///< standard deviation of positions, in the curve's unit
  double resolution = 2e-5;   ///< smallest deviation that matters, as a fraction of the length
  double observations = 100;  ///< independent measurements behind the piece; counts against noise
  double zero_band = 0.1;     ///< slopes of at most this size are called zero
  double slope_limit = 8;     ///< largest |slope| fitted
  int max_arcs = 4;           ///< most arcs tried for "arcs"
};

/// One way to read a piece.
///
/// slopes: none, one, or two along growing radius. breaks: where the lines or arcs meet, as
/// fractions of the length from the start of the piece in its own direction. curvatures: signed,
/// in the direction of travel, at the start, at each break, and at the end; for arc and arcs one
/// per arc. slope_errors: standard deviations of the slopes, given noise and resolution, at most
/// 1000, which means that the piece does not determine the slope (0 where it was given).
/// deviation: root mean square distance between the piece and the best curve of this kind (of the
/// same length, after the best rigid motion, at equal arc length), in the curve's unit.
/// score: lower is better (see docs/design/rhythm-choice.md); plausibility: its share among all
/// interpretations listed, in [0, 1].
/// minus and plus may have two slopes of one sign, where two lines fit so much better.
struct Interpretation {
  Rhythm rhythm = Rhythm::straight;
  std::vector<double> slopes;
  std::vector<double> slope_errors;
  std::vector<double> breaks;
  std::vector<double> curvatures;
  int parameters = 0;
  double deviation = 0;
  double score = 0;
  double plausibility = 0;
  static constexpr auto describe() {
    return core::fields(
        core::field<&Interpretation::rhythm>("what the piece reads as"),
        core::field<&Interpretation::slopes>("none, one, or two along growing radius"),
        core::field<&Interpretation::slope_errors>("their standard deviations"),
        core::field<&Interpretation::breaks>(
            "where lines or arcs meet, as fractions of the piece's length"),
        core::field<&Interpretation::curvatures>("at the start, at each break and at the end")
            .in("1/length"),
        core::field<&Interpretation::deviation>("rms distance from the best curve of this kind")
            .in("length"),
        core::field<&Interpretation::score>("lower is better"),
        core::field<&Interpretation::plausibility>("share among all readings listed"));
  }
};

/// Interpretations of one piece, best first, one per rhythm (and number of slopes).
struct RhythmReading {
  std::vector<Interpretation> interpretations;
  const Interpretation& best() const { return interpretations.front(); }
};

/// Fits every kind of curve to a piece of monotone curvature without inflection inside and ranks
/// them: score = N ln(1 + (deviation / sigma)^2) + parameters ln N, with N the observations and
/// sigma^2 = noise^2 + (resolution length)^2.
///
/// Turning, moving, scaling (with the noise) and reversing the piece change nothing but rounding
/// (and, reversed, the order of breaks and curvatures). Fails as complete() does.
core::Result<RhythmReading> classify_rhythm(const CurvatureProfile& piece,
                                            const RhythmOptions& options = {});

/// The best reading of the piece as one line of the given slope.
core::Result<Interpretation> interpret_with_slope(const CurvatureProfile& piece, double slope,
                                                  const RhythmOptions& options = {});

}  // namespace keyline::analysis
