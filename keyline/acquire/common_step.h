#pragma once

#include <optional>
#include <span>

namespace keyline::acquire::detail {

/// The largest step of which all differences of the values are multiples: what they were rounded
/// to before they were shifted or scaled. error: by how much a value may be off, more than 0.
/// Returns: 0 where there is none, or none that stands clear of the error; nothing for fewer than
///          twelve values that differ, which may have one by chance.
std::optional<double> common_step(std::span<const double> values, double error);

}  // namespace keyline::acquire::detail
