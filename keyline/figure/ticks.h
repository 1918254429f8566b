#pragma once

#include <string>
#include <vector>

#include "keyline/core/interval.h"

namespace keyline::figure {

/// signed_root shows sign(v) sqrt|v|: large and small values of both signs in one chart.
enum class Scale { linear, log10, signed_root };

struct Tick {
  double value = 0;
  std::string label = {};  ///< empty: a minor tick
};

/// Ticks at round numbers; labels are the values divided by 10^exponent.
struct Ticks {
  std::vector<Tick> ticks = {};
  int exponent = 0;
};

/// At most `most` (>= 2) ticks at multiples of 1, 2 or 5 times a power of ten inside the range.
/// range must be finite with low < high (InvalidInput otherwise).
Ticks linear_ticks(const core::Interval& range, int most);

/// Powers of ten inside the range, all or every nth labelled, 2 … 9 between them as minor ticks;
/// over less than two decades 2 and 5 are labelled too. Needs 0 < low < high (InvalidInput
/// otherwise).
Ticks log_ticks(const core::Interval& range, int most);

/// At most `most` (>= 2) ticks at 0 and at 1, 2 or 5 times powers of ten of both signs, so chosen
/// that they stand well apart on a signed_root axis. Range as for linear_ticks().
Ticks signed_root_ticks(const core::Interval& range, int most);

/// sign(v) sqrt|v|.
double signed_root(double value);

/// Range of an axis for these values: the finite ones (positive ones on a log axis) with a margin
/// of 4 % on both sides; something sensible around a single value; [0, 1] ([1, 10]) without any.
core::Interval axis_range(const std::vector<double>& values, Scale scale);

/// "0.0123", "1,234,500" as "1.234×10⁶": for captions and labels, with a true minus sign.
std::string short_number(double value, int significant = 4);

/// "10⁻³" is "10" + superscript(-3).
std::string superscript(int value);

/// Largest of 1, 2, 5 times a power of ten that is <= value; value > 0 and finite.
double round_number_below(double value);

}  // namespace keyline::figure
