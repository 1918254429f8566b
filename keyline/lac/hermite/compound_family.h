#pragma once

#include <vector>

#include "keyline/core/point.h"
#include "keyline/lac/hermite/chord_search.h"
#include "keyline/lac/hermite/compound.h"

/// Internals of the compound solver: the curves of one rhythm and turning.
///
/// Seen from the joint, where the radius of curvature is 1, arc lengths and the common Lambda can
/// leave the doubles although the curve itself does not (slopes of several hundred, or next to 0
/// and 1): they are carried as logarithms and chords relative to the longer side.
namespace keyline::lac::detail {

/// One piece seen from the joint: turning by theta takes the range q with
/// Lambda theta = decay_integral(angle, q), and Lambda times its arc length is
/// decay_integral(arc, q), Lambda being drho/ds at the joint ([Compound] Eqs. 2.2 and 2.3).
struct CompoundSide {
  double alpha = 0;
  double theta = 0;
  double angle = 0;
  double arc = 0;
};

/// All that follows from the joint's Lambda.
struct CompoundShape {
  double log_rate = 0;  ///< ln of Lambda at the joint
  double q0 = 0;
  double q1 = 0;
};

/// The pieces for a chord of length 1, turning left, radius growing.
struct CompoundPieces {
  std::vector<Piece> sharp, flat;
  bool clamped = false;
};

class CompoundFamily {
 public:
  /// theta in (0, pi).
  CompoundFamily(const CompoundRhythm& rhythm, double theta);

  const CompoundSide& sharp() const { return sharp_; }
  const CompoundSide& flat() const { return flat_; }
  /// True where the leading side can run out: it ends in a cusp (sharp) or an inflection (flat).
  bool limit_drawn() const { return sharp_leads_ || flat_.alpha < 0; }

  /// q: range of the side that runs out first.
  CompoundShape shape(double q) const;
  ChordSample sample(double q, core::Vector2 axis) const;
  SearchSetup setup(double psi) const;
  double limit_chord_angle() const;
  CompoundPieces pieces(double q) const;

 private:
  /// Chord from the sharp end, its derivative by q, and the arc length: all over e^log_unit.
  struct Chord {
    core::Vector2 chord;
    core::Vector2 slope;
    double arc = 0;
    double log_unit = 0;
  };
  Chord chord(double q) const;
  const CompoundSide& leading() const { return sharp_leads_ ? sharp_ : flat_; }
  double largest_range() const;

  CompoundSide sharp_;
  CompoundSide flat_;
  double theta_ = 0;
  bool sharp_leads_ = false;
};

}  // namespace keyline::lac::detail
