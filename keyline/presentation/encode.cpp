#include "keyline/presentation/encode.h"

#include <algorithm>
#include <cmath>

#include "keyline/report/html_report.h"

namespace keyline::presentation::detail {

using core::Result;
using figure::Drawing;

namespace {

constexpr double kMostPixels = 60e6;  // of a .png: 240 MB while it is made

Result<std::string> png_of(const Drawing& drawing) {
  const double scale =
      std::min(2.0, std::sqrt(kMostPixels / std::max(drawing.width * drawing.height, 1.0)));
  return figure::write_png(drawing, scale);
}

/// A page that is the drawing, encoded.
template <class Encode>
std::function<Result<std::string>()> encoded(std::function<Result<Drawing>()> make, Encode encode) {
  return [make = std::move(make), encode]() -> Result<std::string> {
    const auto drawing = make();
    if (!drawing) return std::unexpected(drawing.error());
    return encode(*drawing);
  };
}

}  // namespace

Pages pages_of(std::function<Result<Drawing>()> drawing,
               std::function<Result<report::Report>()> report) {
  Pages pages;
  pages[".pdf"] = encoded(drawing, [](const Drawing& d) { return figure::write_pdf(d); });
  pages[".png"] = encoded(drawing, png_of);
  pages[".html"] = [report = std::move(report)]() -> Result<std::string> {
    const auto made = report();
    if (!made) return std::unexpected(made.error());
    return report::html_report(*made);
  };
  return pages;
}

Pages pages_with_svg(std::function<Result<Drawing>()> drawing,
                     std::function<Result<report::Report>()> report) {
  Pages pages = pages_of(drawing, std::move(report));
  pages[".svg"] = encoded(std::move(drawing),
                          [](const Drawing& d) -> Result<std::string> { return write_svg(d); });
  return pages;
}

Drawing sheet_of(const std::vector<Drawing>& drawings) {
  constexpr double kPage = 14400;  // the largest page .pdf allows
  double width = 1;
  double height = 0;
  for (const Drawing& d : drawings) {
    width = std::max(width, d.width);
    height = std::max(height, d.height);
  }
  const auto count = static_cast<double>(drawings.size());
  const bool fits = count * (height + 16) < kPage;
  const int columns = fits ? 1 : static_cast<int>(std::ceil(std::sqrt(count * height / width)));
  return figure::tile(drawings, columns);
}

ReportOptions titled(ReportOptions options, const std::string& title, const std::string& name) {
  options.title = name.empty() ? title : title + ": " + name;
  return options;
}

}  // namespace keyline::presentation::detail
