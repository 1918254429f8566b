#pragma once

#include <nlohmann/json_fwd.hpp>

#include "keyline/surface/edit.h"

/// What surface.edit and the command line's edit have in common.
namespace keyline::operations {

/// A B-spline surface that is one Bezier patch counts as that; unsupported for several.
core::Result<surface::BezierSurface> one_patch(const surface::Surface& s);

/// "keep", "amount", "limit", "alpha_max", "end_tolerance" and "conditions" of a request.
core::Result<surface::EditOptions> surface_edit_options(const nlohmann::json& request);

/// The result of surface.edit.
nlohmann::json surface_edit_json(const surface::EditResult& edited);

}  // namespace keyline::operations
