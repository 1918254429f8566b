#include "keyline/operations/registry.h"

namespace keyline::operations {

std::vector<Operation> all_operations() {
  return {curve_analyze_operation(),
          curve_cav_operation(),
          curve_continuity_operation(),
          curve_edit_operation(),
          fair_operation(),
          fit_curvature_operation(),
          fit_spline_operation(),
          lac_blend_operation(),
          lac_compound_operation(),
          lac_hermite_operation(),
          lac_quasi_operation(),
          lac_region_operation(),
          lac_segment_operation(),
          lac_space_operation(),
          lac_spline_operation(),
          lac_volume_operation(),
#ifdef KEYLINE_HAS_SKETCH
          sketch_trace_operation(),
#endif
          surface_continuity_operation(),
          surface_edit_operation(),
          surface_interrogate_operation(),
          surface_loft_operation(),
          surface_revolve_operation(),
          surface_sav_operation(),
          surface_sweep_operation()};
}

}  // namespace keyline::operations
