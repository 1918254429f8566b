#pragma once

#include "keyline/acquire/clean.h"

namespace keyline::acquire::detail {

/// Averages neighbours of points in order between which the way turns back: steps shorter than
/// usual with a turn of more than a third of a half circle at both ends, shortest first, until none
/// is left. In a random sample of a surface such points lie closer together than they scatter, and
/// their order is chance. Weights add. Returns how many points went.
std::size_t average_turnbacks(Working& work);

/// How many turns of more than a third of a half circle the way through the points takes.
std::size_t sharp_turns(const Working& work);

}  // namespace keyline::acquire::detail
