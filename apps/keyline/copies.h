#pragma once

#include <cstddef>
#include <vector>

#include <nlohmann/json.hpp>

namespace keyline::app {

/// Whether the values differ in their numbers alone, and in these by no more than rounding: 1e-12
/// of the largest beside them (in lists of lists: of all that are in the list).
bool same_to_rounding(const nlohmann::json& a, const nlohmann::json& b);

/// For each of the values the first one that is the same to rounding: itself where it is the first.
std::vector<std::size_t> originals(const std::vector<nlohmann::json>& values);

}  // namespace keyline::app
