#pragma once

#include <span>
#include <vector>

#include "keyline/fairing/chain_fit.h"

namespace keyline::fairing::detail {

/// Points as the chain fit takes them: one each, or, where there are more than `most`, means of
/// equal runs of neighbours that know their spread. weights: empty or one per point.
std::vector<FitPoint> condense(std::span<const core::Point2> points,
                               std::span<const double> weights, std::size_t most);

/// Which of them holds point j of n.
std::size_t condensed_index(std::size_t j, std::size_t n, std::size_t most);

/// Coordinates cut to what matters, so that moved, turned, scaled and reversed points, which differ
/// in their last digits, take the same way through the search, bit by bit.
std::vector<FitPoint> cut_digits(std::vector<FitPoint> points);

}  // namespace keyline::fairing::detail
