#pragma once

#include <array>
#include <vector>

#include "keyline/core/point.h"
#include "keyline/lac/segment/taylor.h"

/// Internals: cubics for a unit piece whose curvature keeps its sign.
namespace keyline::lac::detail {

/// The piece as Taylor polynomials of degree 12 by arc length, stretch by stretch.
class SeriesTable {
 public:
  static constexpr int kDegree = 12;
  struct Stretch {
    double from = 0, to = 1, middle = 0.5;  ///< fractions of the arc length
    double remainder = 0;                   ///< bound of the distance from the curve
    double curvature = 0;                   ///< largest
    int degree = kDegree;                   ///< of the polynomials, at least 2
    std::array<double, kDegree + 1> x{}, y{};
  };

  /// Remainders below `allowed`, a fraction of the length.
  SeriesTable(const UnitPiece& unit, double allowed);
  const std::vector<Stretch>& stretches() const { return stretches_; }
  core::Vector2 point(double v) const;
  /// Not normalised; about of length 1.
  core::Vector2 velocity(double v) const;
  /// Bound of the distance of point(v) from the curve.
  double remainder(double v) const { return at(v).remainder; }

 private:
  const Stretch& at(double v) const;
  void cut(const UnitPiece& unit, double from, double to, double allowed, int depth);
  void add_stretch(const UnitPiece& unit, Stretch s, const TaylorSeries& series, double allowed);
  std::vector<Stretch> stretches_;
};

struct Frame {
  core::Vector2 point, tangent;
};
/// Exact frame of the piece at fraction v.
Frame exact_frame(const UnitPiece& unit, double v);

struct Cubic {
  std::array<core::Vector2, 4> control;
};

inline core::Vector2 value(const Cubic& c, double t) {
  const double s = 1 - t;
  const auto& b = c.control;
  return s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3];
}
inline core::Vector2 slope(const Cubic& c, double t) {
  const double s = 1 - t;
  const auto& b = c.control;
  return 3 * (s * s * (b[1] - b[0]) + 2 * s * t * (b[2] - b[1]) + t * t * (b[3] - b[2]));
}
/// One step of the foot of p on the cubic, against the direction given.
inline double step_foot(const Cubic& c, core::Vector2 p, core::Vector2 direction, double t) {
  const double pace = dot(slope(c, t), direction);
  return pace > 0 ? t - dot(value(c, t) - p, direction) / pace : t;
}

/// True where the numerator of dkappa/dt, (C' x C''')(C' . C') - 3 (C' x C'')(C' . C''), has
/// Bernstein coefficients of one sign, well above rounding: enough for monotone curvature.
bool plainly_monotone(const Cubic& cubic);

struct CubicTry {
  Cubic cubic;
  bool sound = false;  ///< handles of sensible length, feet found
  double tilt = 0;     ///< difference of the handle lengths, of the arc length
  double error = 0;    ///< largest normal distance at the tops of the waves: an estimate
};

struct HandleGuess {
  double tilt = 0;
  double fine = 0;     ///< difference of normal distances not worth another step
  double hopeful = 0;  ///< errors up to which a failed search is worth a scan for other roots
};

/// The cubic over [v0, v1] with the frames as its ends whose normal distance vanishes at 0.337 and
/// 0.663 of the arc length.
CubicTry try_cubic(const SeriesTable& table, double v0, double v1, const Frame& start,
                   const Frame& end, const HandleGuess& guess);

/// Bound of the distance between the piece over [v0, v1] and the cubic, both ways; `wanted` is the
/// bound that matters, to a thousandth of which it need not be exact.
double cubic_bound(const SeriesTable& table, double v0, double v1, const Cubic& cubic,
                   double wanted);

struct CubicPiece {
  Cubic cubic;
  double v0 = 0, v1 = 1;
  double bound = 0;
  bool monotone = false;  ///< certified; not looked into further where not asked for
};

/// As few cubics as the tolerance, a fraction of the length, allows; empty if it cannot be met.
std::vector<CubicPiece> cubics_of(const UnitPiece& unit, double tolerance, bool monotone);

}  // namespace keyline::lac::detail
