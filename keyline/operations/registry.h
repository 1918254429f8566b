#pragma once

#include <vector>

#include "keyline/operations/operation.h"

namespace keyline::operations {

/// One function per operation, each in its own file.
Operation curve_analyze_operation();
Operation curve_cav_operation();
Operation curve_continuity_operation();
Operation curve_edit_operation();
Operation curve_edit_pieces_operation();
Operation curve_compare_operation();
Operation curve_join_operation();
Operation curve_mirror_operation();
Operation curve_offset_operation();
Operation curve_reverse_operation();
Operation curve_show_operation();
Operation curve_split_operation();
Operation curve_transform_operation();
Operation curve_trim_operation();
Operation document_convert_operation();
Operation document_list_operation();
Operation document_read_operation();
Operation document_write_operation();
Operation fair_operation();
Operation fit_curvature_operation();
Operation fit_spline_operation();
Operation lac_blend_operation();
Operation lac_compound_operation();
Operation lac_hermite_operation();
Operation lac_quasi_operation();
Operation lac_region_operation();
Operation lac_segment_operation();
Operation lac_space_operation();
Operation lac_spline_operation();
Operation lac_volume_operation();
Operation library_add_operation();
Operation library_export_operation();
Operation library_find_operation();
Operation library_measure_operation();
Operation library_show_operation();
Operation library_stats_operation();
Operation sketch_trace_operation();
Operation surface_continuity_operation();
Operation surface_edit_operation();
Operation surface_edit_together_operation();
Operation surface_interrogate_operation();
Operation surface_loft_operation();
Operation surface_revolve_operation();
Operation surface_sav_operation();
Operation surface_sweep_operation();

/// All of the above.
std::vector<Operation> all_operations();

}  // namespace keyline::operations
