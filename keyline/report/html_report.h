#pragma once

#include <string>

#include "keyline/report/report.h"

namespace keyline::report {

/// One self-contained HTML5 page, also well-formed as XML: figures inline as SVG, no scripts, no
/// fonts or pictures from elsewhere (a content policy forbids them), readable from phone width up
/// and printable on A4 or Letter. The same report gives the same bytes.
std::string html_report(const Report& report);

}  // namespace keyline::report
