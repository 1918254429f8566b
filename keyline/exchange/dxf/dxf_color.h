#pragma once

#include <string>

namespace keyline::exchange::detail {

/// AutoCAD's colour of an index 1 … 255 as "#rrggbb"; empty for others. 7 (black or white,
/// whichever shows) is black; 10 … 249 are hues of 15 degrees in five shades, full and half
/// saturated, to within a unit or two of the printed palette.
std::string aci_color(int index);

/// The index 1 … 255 whose colour is nearest to 0xRRGGBB; the lowest of equals.
int nearest_aci(int rgb);

/// 0xRRGGBB as "#rrggbb".
std::string true_color(int value);

}  // namespace keyline::exchange::detail
