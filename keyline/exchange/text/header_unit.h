#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// Units in the headers of tables: "x [mm]", "y (in)", "z/m", "x_cm", and in lines of text.
namespace keyline::exchange::detail {

/// "mm", "Millimetres", "inch" … as documents have it; empty for anything else.
std::string unit_in_words(std::string_view text);

/// The unit that a line of text says all lengths have: "units: mm", "all dimensions in inches";
/// empty where it says none.
std::string unit_said(std::string_view line);

/// Where a header's cell goes on to its unit, behind "[", "(", or a "/" or "_" before a known one;
/// npos where it has none.
std::size_t start_of_unit(std::string_view cell);

/// What a header's cell says beside its name.
struct HeaderUnit {
  std::string known;    ///< as documents have it; empty: none, or unknown
  std::string unknown;  ///< what stands in brackets and is no unit of documents
  bool round = false;   ///< in ( ), where other words may stand
};
HeaderUnit unit_of(std::string_view cell);
/// The same of a cell that holds a unit alone, in brackets or not.
HeaderUnit unit_alone(std::string_view cell);

}  // namespace keyline::exchange::detail
