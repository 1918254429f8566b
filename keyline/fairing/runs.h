#pragma once

#include <vector>

#include "keyline/fairing/run.h"

namespace keyline::fairing::detail {

/// The key-line cut at its corners into smooth runs; neighbours share the corner's point. A
/// closed line with corners is cut open at the first of them.
std::vector<Run> runs_of(const acquire::KeyLine& line, const FairOptions& options);

/// Points first … last of the key-line as one open run.
Run run_between(const acquire::KeyLine& line, std::size_t first, std::size_t last);

}  // namespace keyline::fairing::detail
