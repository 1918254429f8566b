#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

#include "keyline/acquire/lattice.h"
#include "keyline/core/error.h"
#include "keyline/exchange/points/points_reader.h"

namespace keyline::exchange {

struct LatticeFile {
  acquire::Lattice lattice;
  std::string unit;                   ///< of documents; empty where the header tells none
  std::vector<std::string> left_out;  ///< what of the header and its columns is not taken
};

/// Reads a lattice of range data: one point per line, row after row, in three columns or those that
/// a header or options.columns name x, y and z (as in read_points). The shape is given by a first
/// line of two integers "rows columns" that agrees with the number of points, or by blank lines
/// between rows of equal length. Missing points are written nan.
/// Fails: bad_input where neither gives a shape or the two are not the same, for columns that are
/// not x, y and z, and for points of more than three numbers that no header names; else as
/// read_points.
core::Result<LatticeFile> read_lattice(const std::filesystem::path& path,
                                       const PointsOptions& options = {});
core::Result<LatticeFile> read_lattice(std::istream& in, const std::string& name,
                                       const PointsOptions& options = {});

}  // namespace keyline::exchange
