#pragma once

#include <string>

#include "keyline/report/report.h"

namespace keyline::report {

/// One self-contained HTML5 page, also well-formed as XML: figures inline as SVG, no fonts or
/// pictures from elsewhere, readable from phone width up and printable on A4 or Letter. Where a
/// section has a linked curve the page holds one script, which its content policy names by hash;
/// otherwise none may run. Without it, and on paper, every figure is there. The same report gives
/// the same bytes.
std::string html_report(const Report& report);

}  // namespace keyline::report
