#include "keyline/operations/registry.h"

#include "keyline/operations/paper_operations.h"
#include "keyline/operations/surface_network.h"

namespace keyline::operations {

std::vector<Operation> all_operations() {
  return {
#ifdef KEYLINE_HAS_SKETCH
      sketch_trace_operation(),
#endif
      document_convert_operation(),  surface_edit_together_operation(),
      curve_analyze_operation(),     curve_deviation_operation(),
      curve_diagrams_operation(),    curve_cav_operation(),
      curve_continuity_operation(),  curve_edit_operation(),
      curve_edit_pieces_operation(), curve_compare_operation(),
      curve_join_operation(),        curve_mirror_operation(),
      curve_offset_operation(),      curve_plane_operation(),
      curve_reverse_operation(),     curve_split_operation(),
      curve_show_operation(),        curve_trim_operation(),
      document_list_operation(),     document_read_operation(),
      document_write_operation(),    fair_operation(),
      fit_curvature_operation(),     fit_spline_operation(),
      lac_blend_operation(),         lac_compound_operation(),
      lac_drag_operation(),          lac_hermite_operation(),
      lac_quasi_operation(),         lac_region_operation(),
      lac_segment_operation(),       lac_space_operation(),
      lac_spline_operation(),        lac_taylor_operation(),
      lac_volume_operation(),        library_add_operation(),
      library_export_operation(),    library_find_operation(),
      library_measure_operation(),   library_show_operation(),
      library_stats_operation(),     surface_continuity_operation(),
      surface_edit_operation(),      surface_interrogate_operation(),
      surface_loft_operation(),      surface_network_operation(),
      surface_patch_operation(),     surface_revolve_operation(),
      surface_sav_operation(),       surface_sweep_operation()};
}

}  // namespace keyline::operations
