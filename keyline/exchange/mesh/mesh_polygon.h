#pragma once

#include <cstdint>
#include <span>

#include "keyline/exchange/mesh/mesh.h"

namespace keyline::exchange::detail {

/// Longer faces that are no fan about their first corner would take too long: time grows with the
/// square.
inline constexpr std::size_t kMostCorners = 5'000;

/// Adds a face as triangles between its corners, two fewer than these, turning as it does: about
/// the first corner where they do not overlap, else by cutting off ears in the face's plane
/// (Meisters, "Polygons have ears", 1975). Of a face that crosses itself what is left without an
/// ear becomes a fan.
///
/// Returns:      false where a face of more than kMostCorners became a fan whose triangles overlap.
/// Precondition: at least three corners, all of them points of the mesh.
bool add_polygon(Mesh& mesh, std::span<const std::uint32_t> corners);

}  // namespace keyline::exchange::detail
