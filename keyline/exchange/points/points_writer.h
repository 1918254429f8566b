#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>

#include "keyline/core/error.h"
#include "keyline/core/point.h"

namespace keyline::exchange {

/// Shortest decimal form that reads back to the same double.
std::string shortest(double value);

/// Comma separated text: a header "x,y" (or "x,y,z", "x,y,weight"), one point per line.
/// weights: empty, or one for each point (throws InvalidInput).
void write_points(std::ostream& out, std::span<const core::Point2> points,
                  std::span<const double> weights = {});
void write_points(std::ostream& out, std::span<const core::Point3> points);

/// The same into a file, which is written whole or not at all; io where it cannot be.
core::Result<void> write_points(const std::filesystem::path& path,
                                std::span<const core::Point2> points,
                                std::span<const double> weights = {});
core::Result<void> write_points(const std::filesystem::path& path,
                                std::span<const core::Point3> points);

}  // namespace keyline::exchange
