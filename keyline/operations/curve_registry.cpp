#include "keyline/operations/curve_registry.h"

#include "keyline/operations/paper_operations.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {

std::vector<Operation> curve_operations() {
  return {curve_analyze_operation(),   curve_compare_operation(),    curve_continuity_operation(),
          curve_deviation_operation(), curve_diagrams_operation(),   curve_join_operation(),
          curve_mirror_operation(),    curve_offset_operation(),     curve_reverse_operation(),
          curve_show_operation(),      curve_split_operation(),      curve_transform_operation(),
          curve_trim_operation(),      document_convert_operation(), document_list_operation(),
          document_read_operation(),   document_write_operation(),   fair_operation(),
          fit_curvature_operation(),   fit_spline_operation(),       lac_blend_operation(),
          lac_compound_operation(),    lac_drag_operation(),         lac_hermite_operation(),
          lac_quasi_operation(),       lac_raise_joints_operation(), lac_region_operation(),
          lac_segment_operation(),     lac_space_operation(),        lac_spline_operation(),
          lac_taylor_operation(),      lac_volume_operation()};
}

}  // namespace keyline::operations
