#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/exchange/dxf/dxf_shape.h"
#include "keyline/exchange/dxf/dxf_tags.h"

namespace keyline::exchange::detail {

/// The groups of an entity (after its type) and, for a POLYLINE, those of its vertices.
struct DxfEntity {
  std::string_view type;
  std::uint32_t place = 0;
  std::vector<DxfTag> tags;
  std::vector<std::vector<DxfTag>> vertices;
};

/// The first group that has to hold a finite number for the geometry and does not; null where all
/// do.
const DxfTag* unreadable(const DxfEntity& entity);

/// The code of a group without which the entity has no place or size, and which is not there: the
/// coordinates of its points, radii, angles. Empty where all are.
std::optional<int> missing_group(const DxfEntity& entity);

/// The code of a group of the geometry that stands there twice, with different values, where there
/// can be one; empty where none does.
std::optional<int> ambiguous_group(const DxfEntity& entity);

/// First value of a code; the fallback where it is absent or no number.
double real(const std::vector<DxfTag>& tags, int code, double fallback = 0);
int integer(const std::vector<DxfTag>& tags, int code, int fallback = 0);
std::string text(const std::vector<DxfTag>& tags, int code);
/// The point of codes code, code + 10, code + 20.
core::Point3 point(const std::vector<DxfTag>& tags, int code);
core::Vector3 vector(const std::vector<DxfTag>& tags, int code, core::Vector3 fallback = {});

/// True for the types dxf_curve_of() knows.
bool is_dxf_curve(std::string_view type);

struct DxfCurve {
  DxfShape shape;
  bool closed = false;
  bool apart = false;  ///< a spline said to be closed whose ends lie apart: it is not
};

/// Geometry in world coordinates. Fails (bad_input, message only) where the numbers make no curve:
/// radius not positive, too few points, knots out of order …
core::Result<DxfCurve> dxf_curve_of(const DxfEntity& entity);

}  // namespace keyline::exchange::detail
