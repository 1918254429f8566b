#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/analysis/profile.h"
#include "keyline/exchange/json_curve.h"
#include "keyline/exchange/json_space.h"
#include "keyline/operations/draw_figure.h"
#include "keyline/operations/perform.h"
#include "keyline/operations/space_figure.h"
#include "keyline/report/html_report.h"

#include "commands.h"
#include "draw_request.h"
#include "output.h"
#include "terminal.h"

namespace keyline::app {
namespace {

using core::ErrorCode;
using core::Result;
using nlohmann::json;

/// One line per piece, and what the operation tells beside the curve.
void print_summary(const json& result) {
  const json& curve = result["curve"];
  if (curve.contains("pieces")) {
    fmt::print("{:>5} {:>8} {:>14} {:>14} {:>14}\n", "piece", "slope", "length", "curvature from",
               "to");
    int index = 0;
    for (const json& piece : curve["pieces"]) {
      const bool cusp = piece.contains("radius");
      const json& ends = cusp ? piece["radius"] : piece["curvature"];
      fmt::print("{:>5} {:>8.5g} {:>14.9g} {:>14.9g} {:>14.9g}{}\n", index++,
                 piece["alpha"].get<double>(), piece["length"].get<double>(), ends[0].get<double>(),
                 ends[1].get<double>(), cusp ? "  (radii)" : "");
    }
  }
  std::string line;
  for (const char* name : {"lambda", "nu", "theta", "volume", "deviation", "monotone", "lcg",
                           "joint", "about", "slopes", "reversed"})
    if (result.contains(name) && !result[name].is_null())
      line += fmt::format("{}{} {}", line.empty() ? "" : "  ", name, result[name].dump());
  if (result.contains("report"))
    for (const json& span : result["report"]["overridden"])
      line += fmt::format("{}span {} got slope -1", line.empty() ? "" : "  ", span["span"].dump());
  if (!line.empty()) fmt::print("{}\n", line);
}

Result<std::optional<operations::RegionQuestion>> region_of(const DrawCommand& command,
                                                            const json& request) {
  const bool three = request.contains("points") && request["points"].size() == 3;
  if (!three || command.spline || command.alpha.size() > 2) return std::nullopt;
  const auto points = exchange::points_from_json(request["points"], "points", 3);
  if (!points) return std::unexpected(points.error());
  auto alpha = command.alpha;
  if (alpha.empty()) alpha = {-1};
  auto question = operations::region_question(*points, alpha, command.ratio.value_or(0.5));
  if (!question) return std::unexpected(question.error());
  return *question;
}

operations::ReportOptions report_options(const DrawCommand& command, const char* title) {
  operations::ReportOptions options;
  options.title = title;
  options.command = command.common.command_line;
  options.generator = "Keyline " KEYLINE_VERSION;
  return options;
}

/// Figures in place of the bare curve where the format or --show asks for them.
void add_figures(const DrawCommand& command, const document::Path& path,
                 const operations::DrawShow& show,
                 const std::optional<operations::RegionQuestion>& region, Writers& writers) {
  const auto options = report_options(command, "Curve from handles");
  const auto picture = [=](auto write) -> Writer {
    return [=]() -> Result<std::string> {
      const auto drawing = operations::draw_picture(path, show, region, options);
      if (!drawing) return std::unexpected(drawing.error());
      return write(*drawing);
    };
  };
  if (!command.show.empty())
    writers[".svg"] = picture(
        [](const figure::Drawing& d) -> Result<std::string> { return figure::write_svg(d); });
  writers[".pdf"] = picture([](const figure::Drawing& d) { return figure::write_pdf(d); });
  writers[".png"] = picture([](const figure::Drawing& d) { return figure::write_png(d); });
  writers[".html"] = [=]() -> Result<std::string> {
    const auto report = operations::draw_report(path, show, region, options);
    if (!report) return std::unexpected(report.error());
    return report::html_report(*report);
  };
}

Result<Writers> space_writers(const DrawCommand& command, const json& curve) {
  const auto chain = exchange::space_chain_from_json(curve, "curve");
  if (!chain) return std::unexpected(chain.error());
  if (!command.show.empty())
    return core::fail(ErrorCode::bad_input, "--show has no figures of space curves",
                      "leave it out: pictures show three views, curvature and torsion", "--show");
  const auto options = report_options(command, "Space curve from handles");
  const auto picture = [=, chain = *chain](auto write) -> Writer {
    return
        [=]() -> Result<std::string> { return write(operations::space_picture(chain, options)); };
  };
  document::Document document;
  document.space_curves.push_back({{}, {*chain}});
  const double tolerance = command.common.tolerance.value_or(1e-5 * arc_length(*chain));
  Writers writers = curve_writers(document, tolerance, command.common);
  writers[".json"] = [curve]() -> Result<std::string> { return curve.dump(1) + "\n"; };
  writers[".svg"] =
      picture([](const figure::Drawing& d) -> Result<std::string> { return figure::write_svg(d); });
  writers[".pdf"] = picture([](const figure::Drawing& d) { return figure::write_pdf(d); });
  writers[".png"] = picture([](const figure::Drawing& d) { return figure::write_png(d); });
  writers[".html"] = [=, chain = *chain]() -> Result<std::string> {
    return report::html_report(operations::space_report(chain, options));
  };
  return writers;
}

Result<Writers> writers_of(const DrawCommand& command, const json& request, const json& result) {
  if (result["curve"]["type"] == "log-aesthetic-space")
    return space_writers(command, result["curve"]);
  auto path = exchange::path_from_json(result["curve"], "curve");
  if (!path) return std::unexpected(path.error());
  const auto show = operations::parse_show(command.show);
  if (!show) return std::unexpected(show.error());
  const auto region = region_of(command, request);
  if (!region) return std::unexpected(region.error());
  if (show->region && !*region)
    return core::fail(ErrorCode::bad_input, "a drawable region belongs to three handles",
                      "give --points P0 P1 P2, or leave out region", "--show");
  const double length = analysis::ArcLengthTable(analysis::view(*path)).length();
  Writers writers = curve_writers(document_of("", *path),
                                  command.common.tolerance.value_or(1e-5 * length), command.common);
  add_figures(command, *path, *show, *region, writers);
  return writers;
}

}  // namespace

int run_draw(const DrawCommand& command) {
  const std::vector<std::string> known = curve_extensions({".pdf", ".png", ".html"});
  if (auto can = check_outputs(command.common, known, {}); !can) return report_failure(can.error());
  const auto asked = draw_request(command);
  if (!asked) return report_failure(asked.error());
  const auto result =
      operations::perform(asked->operation, asked->request, {command.common.threads, {}});
  if (!result) return report_failure(result.error());
  const auto writers = writers_of(command, asked->request, *result);
  if (!writers) return report_failure(writers.error());
  if (auto done = write_outputs(command.common, *writers); !done)
    return report_failure(done.error());
  if (command.common.json) {
    fmt::print("{}\n", result->dump());
  } else if (!command.common.quiet) {
    print_summary(*result);
  }
  return kDone;
}

}  // namespace keyline::app
