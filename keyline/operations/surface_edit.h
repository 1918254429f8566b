#pragma once

#include <nlohmann/json_fwd.hpp>

#include "keyline/surface/edit_patches.h"

/// What surface.edit and the command line's edit have in common.
namespace keyline::operations {

/// "keep", "amount", "limit", "alpha_max", "end_tolerance" and "conditions" of a request.
/// Without "keep" the start of a single patch is kept, and the joints of `several`.
core::Result<surface::EditOptions> surface_edit_options(const nlohmann::json& request,
                                                        bool several);

/// The result of surface.edit for one patch, and for any surface.
nlohmann::json surface_edit_json(const surface::EditResult& edited);
nlohmann::json surface_edit_json(const surface::SurfaceEdit& edit);

/// {"joints", "G0", "G1", "gap", "angle"}.
nlohmann::json joints_json(const surface::JointSummary& joints);

}  // namespace keyline::operations
