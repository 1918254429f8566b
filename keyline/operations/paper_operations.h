#pragma once

#include "keyline/operations/operation.h"

/// Operations that show what single sections of the papers describe (docs/papers.md), beside those
/// of registry.h.
namespace keyline::operations {

Operation curve_deviation_operation();
Operation curve_diagrams_operation();
Operation curve_plane_operation();
Operation lac_drag_operation();
Operation lac_raise_joints_operation();
Operation lac_taylor_operation();
Operation surface_patch_operation();

}  // namespace keyline::operations
