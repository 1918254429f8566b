#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "keyline/acquire/plane.h"
#include "keyline/core/describe.h"
#include "keyline/core/point.h"

namespace keyline::acquire {

/// What was done to the points on their way to a key-line, in counts and in words.
struct AcquireReport {
  std::size_t points_read = 0;
  std::size_t non_finite = 0;                ///< dropped: a coordinate was NaN or infinite
  std::size_t duplicates = 0;                ///< dropped: same place as a neighbour
  std::size_t outliers = 0;                  ///< dropped: stray, far off a smooth run
  std::size_t apart = 0;                     ///< dropped: in a cluster away from the key-line
  std::size_t averaged = 0;                  ///< points replaced by means of a band
  std::vector<std::size_t> outlier_sources;  ///< indices into the raw points, increasing
  bool reordered = false;                    ///< the order of the input was not used
  double plane_departure = 0;                ///< largest distance from the fitted plane
  double plane_departure_rms = 0;
  std::vector<std::string> notes;  ///< everything above and every decision, one line each
};

/// An ordered planar curve of measured points, ready for fitting. At least two points, no two
/// neighbours equal.
struct KeyLine {
  std::string id;
  std::vector<core::Point2> points;  ///< coordinates in `plane`
  std::vector<double> weights;       ///< empty: all one
  /// Smoothly closed: the last point is followed by the first, which is not repeated. False where
  /// the ends meet in a corner (a sharp trailing edge); see ends_meet.
  bool closed = false;
  bool ends_meet = false;  ///< open, but first and last point are the same place
  double noise = 0;        ///< standard deviation of position error normal to the curve
  double rounding = 0;     ///< step the coordinates are rounded to; 0: not rounded
  double length = 0;       ///< of the polygon, closed where closed; of means where steps are noise
  std::vector<std::size_t> corners;  ///< increasing indices into points; ends of open curves not
  std::vector<std::size_t> sources;  ///< index into the raw points; empty where averaged
  Plane plane;
  AcquireReport report;
  static constexpr auto describe() {
    return core::fields(
        core::field<&KeyLine::points>("in their order, in the line's plane").count(2).needed(),
        core::field<&KeyLine::weights>("one per point; none: all one"),
        core::field<&KeyLine::closed>("smoothly: the last point is followed by the first"),
        core::field<&KeyLine::ends_meet>("open, but the ends are the same place"),
        core::field<&KeyLine::noise>("standard deviation normal to the curve")
            .in("length")
            .within(core::at_least(0)),
        core::field<&KeyLine::rounding>("step of the coordinates; 0: not rounded")
            .in("length")
            .within(core::at_least(0)),
        core::field<&KeyLine::length>("of the polygon").in("length"),
        core::field<&KeyLine::corners>("indices of points, from 0"),
        core::field<&KeyLine::sources>("index of each point in what was read; none: averaged"),
        core::field<&KeyLine::report, &AcquireReport::notes>("what was done, in words"));
  }
  /// bad_input where lists do not match the points or indices do not exist.
  static core::Result<void> check(const KeyLine& line);
};

}  // namespace keyline::acquire
