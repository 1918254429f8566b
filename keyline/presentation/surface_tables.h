#pragma once

#include <string>
#include <vector>

#include "keyline/report/report.h"
#include "keyline/surface/network.h"

/// Tables of surface values for reports.
namespace keyline::presentation {

/// More patches than this a table does not show.
inline constexpr std::size_t kMostPatchRows = 400;

/// Type, CAV, place and minimum of every network curve; with the nearest curves where there are.
report::ReportTable surface_curve_table(const surface::SurfaceValue& value,
                                        const std::string& caption);

/// SAV and worst curve of every patch.
report::ReportTable surface_patch_table(const std::vector<surface::PatchValue>& values);

}  // namespace keyline::presentation
