#pragma once

namespace keyline::numeric {

/// Two places between which a function rises through zero, for Newton's method kept between them.
struct NewtonBracket {
  double low = 0;
  double high = 0;

  /// Where to look next, given value and slope at a place within: to where Newton's step leads if
  /// that is within, else to the middle. The place becomes the end on its own side of the zero.
  double next(double place, double value, double slope) {
    (value > 0 ? high : low) = place;
    const double step = place - value / slope;
    return slope > 0 && low <= step && step <= high ? step : 0.5 * (low + high);
  }
};

}  // namespace keyline::numeric
