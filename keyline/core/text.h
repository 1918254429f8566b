#pragma once

#include <string>

namespace keyline::core {

/// value with so many significant digits (1 to 17), for messages: the shorter of plain and
/// scientific notation, no trailing zeros ("0.25", "1.5e-09", "nan", "inf"), whatever the locale.
std::string number_text(double value, int significant_digits);

}  // namespace keyline::core
