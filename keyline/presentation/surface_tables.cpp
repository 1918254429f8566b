#include "keyline/presentation/surface_tables.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "keyline/figure/ticks.h"

namespace keyline::presentation {
namespace {

std::string number(double x, int digits = 4) { return figure::short_number(x, digits); }

/// How far the nearest curve of one matrix lies and what it is worth, after the other cells.
void add_nearest_cells(const surface::NetworkValue& c, std::vector<std::string>& cells) {
  cells.push_back(c.nearest ? number(c.nearest->nearest.distance) : "");
  cells.push_back(c.nearest && c.nearest->value ? number(c.nearest->value->cav) : "");
}

std::vector<std::string> curve_row(const surface::NetworkValue& c) {
  const classa::CurveValue& v = c.value;
  const bool one = v.matrix.has_value();
  return {c.name,
          std::to_string(v.type),
          number(v.cav),
          one ? number(v.matrix->alpha) : "",
          one ? number(v.matrix->s) : "",
          v.minimum ? number(v.minimum->alpha) : "",
          v.minimum ? number(v.minimum->s) : "",
          std::isfinite(v.energy) ? number(v.energy) : "",
          v.minimum ? number(v.minimum->energy) : "",
          v.monotone.answer == curve::MonotoneVerdict::yes  ? "yes"
          : v.monotone.answer == curve::MonotoneVerdict::no ? "no"
                                                            : "undecided"};
}

}  // namespace

report::ReportTable surface_curve_table(const surface::SurfaceValue& value,
                                        const std::string& caption) {
  using report::Alignment;
  report::ReportTable table;
  table.caption = caption;
  table.columns = {{"Curve", Alignment::text},
                   {"Type"},
                   {"CAV"},
                   {"α"},
                   {"s"},
                   {"α least"},
                   {"s least"},
                   {"Energy"},
                   {"Energy least"},
                   {"Monotone", Alignment::text}};
  const bool nearest = std::any_of(value.curves.begin(), value.curves.end(),
                                   [](const auto& c) { return c.nearest.has_value(); });
  if (nearest) {
    table.columns.push_back({"Nearest away"});
    table.columns.push_back({"CAV of nearest"});
  }
  for (const surface::NetworkValue& c : value.curves) {
    table.rows.push_back(curve_row(c));
    if (nearest) add_nearest_cells(c, table.rows.back());
  }
  return table;
}

report::ReportTable surface_patch_table(const std::vector<surface::PatchValue>& values) {
  report::ReportTable table;
  table.caption = "Surface aesthetic value by Bézier patch, counted along u and v";
  table.columns = {{"Patch", report::Alignment::text},
                   {"SAV"},
                   {"Worst curve", report::Alignment::text},
                   {"Its type"},
                   {"Its CAV"}};
  for (const surface::PatchValue& p : values) {
    if (table.rows.size() == kMostPatchRows) break;
    const auto& worst = p.value.curves[p.value.worst];
    table.rows.push_back({fmt::format("{}, {}", p.row, p.column), number(p.value.sav), worst.name,
                          std::to_string(worst.value.type), number(worst.value.cav)});
  }
  return table;
}

}  // namespace keyline::presentation
