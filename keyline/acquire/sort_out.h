#pragma once

#include "keyline/acquire/acquire.h"
#include "keyline/acquire/clean.h"

namespace keyline::acquire::detail {

/// Puts the points in order along the curve where the order of the input makes no sense (or the
/// options ask for it): duplicates anywhere merged, isolated points and clusters apart dropped, a
/// thick band averaged to a line. Does nothing to points whose order is sensible, except that whole
/// runs of them in the wrong order or direction are put end to end. Tells in the report.
void put_in_order(Working& work, const AcquireOptions& options, KeyLine& line);

}  // namespace keyline::acquire::detail
