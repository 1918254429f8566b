#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "keyline/core/error.h"
#include "keyline/surface/surface.h"

/// The surface values of the public interface as JSON; see json_curve.h for the rules.
namespace keyline::exchange {

/// {"type":"bezier-surface", …} or {"type":"bspline-surface", …}; weights, if any, in rows like
/// the points.
nlohmann::json to_json(const surface::Surface& s);
nlohmann::json to_json(const surface::BezierSurface& s);
nlohmann::json to_json(const surface::BSplineSurface& s);

/// Checked as surface::validate does; the failure names the place, such as
/// "surface.points[2][0]". Points are [x, y, z].
core::Result<surface::Surface> surface_from_json(const nlohmann::json& j, const std::string& where);

/// Whether the value's type is one of the surfaces'.
bool is_surface_json(const nlohmann::json& j);

}  // namespace keyline::exchange
