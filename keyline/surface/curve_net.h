#pragma once

#include <cstddef>
#include <vector>

#include "keyline/core/error.h"
#include "keyline/curve/bspline.h"
#include "keyline/curve/length.h"

/// Internals of room surface: curves that cross like warp and weft.
namespace keyline::surface::detail {

/// What places on a curve are counted in.
enum class Measure { parameter, length };

/// A curve by shares of its parameter or of its length, from 0 to 1.
class Thread {
 public:
  Thread(curve::BSpline3 curve, Measure measure);
  core::Point3 at(double share) const;
  void turn_round();
  /// What lies between two shares.
  void cut(double from, double to);

 private:
  double parameter(double share) const;
  curve::BSpline3 curve_;
  Measure measure_;
  curve::ArcLengthMap map_;  ///< where lengths are counted
};

/// Where two threads come nearest to each other.
struct Crossing {
  double along_u = 0;  ///< share of the curve along u
  double along_v = 0;
  double gap = 0;
  core::Point3 place;  ///< in the middle
};

/// Curves along u in the order of v and the other way round, all running the same way and cut at
/// the outermost; [i][j] of the crossings is that of u[i] with v[j].
struct CurveNet {
  std::vector<Thread> u;
  std::vector<Thread> v;
  std::vector<std::vector<Crossing>> crossings;
  std::vector<double> u_places;  ///< of the curves along v, 0 to 1
  std::vector<double> v_places;  ///< of the curves along u
  double gap = 0;                ///< largest
};

/// Puts curves in order, whatever order and direction they were given in.
///
/// Fails: bad_input with a path for curves that miss each other by more than `gap`, that come as
/// near as that to one of their own direction between the outermost of the others, or cross in
/// different orders.
core::Result<CurveNet> net_of_curves(const std::vector<curve::BSpline3>& along_u,
                                     const std::vector<curve::BSpline3>& along_v, Measure measure,
                                     double gap);

}  // namespace keyline::surface::detail
