#include "keyline/operations/registry.h"

#include <iterator>

#include "keyline/operations/curve_registry.h"
#include "keyline/operations/paper_operations.h"
#include "keyline/operations/surface_network.h"

namespace keyline::operations {

std::vector<Operation> all_operations() {
  std::vector<Operation> all = curve_operations();
  const Operation others[] = {
#ifdef KEYLINE_HAS_SKETCH
      sketch_trace_operation(),
#endif
      curve_cav_operation(),
      curve_edit_operation(),
      curve_edit_pieces_operation(),
      curve_plane_operation(),
      library_add_operation(),
      library_export_operation(),
      library_find_operation(),
      library_measure_operation(),
      library_show_operation(),
      library_stats_operation(),
      surface_continuity_operation(),
      surface_edit_operation(),
      surface_edit_together_operation(),
      surface_interrogate_operation(),
      surface_loft_operation(),
      surface_network_operation(),
      surface_patch_operation(),
      surface_revolve_operation(),
      surface_sav_operation(),
      surface_sweep_operation()};
  all.insert(all.end(), std::begin(others), std::end(others));
  return all;
}

}  // namespace keyline::operations
