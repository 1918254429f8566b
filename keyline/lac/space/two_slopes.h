#pragma once

#include <array>
#include <optional>

#include "keyline/lac/space/space_stretch.h"

/// Internals: a law of two slopes, seen from where they meet.
namespace keyline::lac::detail::space {

/// Curvature or torsion over that at the joint, along a curve of length 1 whose first piece takes
/// `share` of it. One number decides the law: its rate at the joint. Where the piece into which it
/// grows has a slope above 0 that piece bears rates up to a bound only, next to which a rate would
/// keep no digits of what is left: there `drawn` (the rate drawn out) is the logarithm of what the
/// law grows to in that piece, over the piece's length, which goes on without bound. The two agree
/// next to 0 and are one otherwise.
struct TwoSlopes {
  std::array<double, 2> slope{-1, 1};
  double share = 0.5;

  double length(int piece) const { return piece == 0 ? share : 1 - share; }
  /// Of the rate, for a slope above 0.
  double bound(int piece) const { return 1 / (slope[piece] * length(piece)); }
  /// The piece into which it grows.
  static int grown(double drawn) { return drawn < 0 ? 0 : 1; }

  double rate(double drawn) const;
  double rate_by(double drawn) const;  ///< d(rate)/d(drawn)
  /// Empty where the piece into which it grows does not bear the rate.
  std::optional<double> drawn(double rate) const;
  /// The rate with which it grows to `high` times that at the joint, drawn out.
  double drawn_to(int piece, double high) const;

  /// At the start and at the end; empty where they leave the doubles.
  std::optional<std::array<double, 2>> ends(double drawn) const;
  /// At a fraction of the length, and its derivative by the rate there.
  double at(double rate, double t) const;
  double by_rate(double value, double t) const;
  /// How it runs along a piece.
  LawRun run(double rate, int piece) const;
};

}  // namespace keyline::lac::detail::space
