#pragma once

#include <functional>

#include "keyline/figure/drawing.h"
#include "keyline/presentation/pages.h"
#include "keyline/report/report.h"

/// Drawings and reports as the content of files. For .cpp files of this room only.
namespace keyline::presentation::detail {

/// Pages of a drawing as .pdf and .png, and of a report as .html, each made when it is asked for.
Pages pages_of(std::function<core::Result<figure::Drawing>()> drawing,
               std::function<core::Result<report::Report>()> report);

/// The same and the drawing as .svg.
Pages pages_with_svg(std::function<core::Result<figure::Drawing>()> drawing,
                     std::function<core::Result<report::Report>()> report);

/// One column while a page holds it, else about as wide as high.
figure::Drawing sheet_of(const std::vector<figure::Drawing>& drawings);

/// The options with the thing's name behind the title.
ReportOptions titled(ReportOptions options, const std::string& title, const std::string& name);

}  // namespace keyline::presentation::detail
