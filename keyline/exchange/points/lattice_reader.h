#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "keyline/acquire/lattice.h"
#include "keyline/core/error.h"
#include "keyline/exchange/points/points_reader.h"

namespace keyline::exchange {

/// Reads a lattice of range data: one point (three columns, as in read_points) per line, row after
/// row. The shape is given by a first line of two integers "rows columns" that agrees with the
/// number of points, or by blank lines between rows of equal length. Missing points are written
/// nan.
/// Fails: bad_input where neither gives a shape or the two are not the same, and for points of more
/// than three numbers; else as read_points.
core::Result<acquire::Lattice> read_lattice(const std::filesystem::path& path);
core::Result<acquire::Lattice> read_lattice(std::istream& in, const std::string& name);

}  // namespace keyline::exchange
