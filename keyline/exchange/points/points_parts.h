#pragma once

#include <string>
#include <vector>

#include "keyline/acquire/raw_curve.h"
#include "keyline/exchange/points/points_blocks.h"
#include "keyline/exchange/points/points_sides.h"

/// Several curves of one table: two sides in its columns, blocks and elements in its rows. What is
/// done is told in `left_out`.
namespace keyline::exchange::detail {

/// Where no name in that column (from 0) stands in two rows, they are those of points, which make
/// one curve.
void join_named_points(std::vector<acquire::RawCurve>& curves, int column,
                       std::vector<std::string>& left_out);

/// A curve for each side, named after its column behind the name of both; `second` holds those of
/// the second side.
std::vector<acquire::RawCurve> sides_of(std::vector<acquire::RawCurve> first,
                                        std::vector<acquire::RawCurve> second, const Sides& sides);

/// Of every curve the airfoil or the elements that it is, if its shape may tell them; else the
/// blocks that those lines part.
std::vector<acquire::RawCurve> parts_of(std::vector<acquire::RawCurve> curves, bool by_shape,
                                        const std::vector<BlankLines>& blanks,
                                        std::vector<std::string>& left_out);

}  // namespace keyline::exchange::detail
