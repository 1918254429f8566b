#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/core/text.h"
#include "keyline/exchange/document_file.h"
#include "keyline/figure/drawing.h"
#include "keyline/operations/fair.h"
#include "keyline/operations/fair_report.h"
#include "keyline/operations/perform.h"
#include "keyline/operations/pictures.h"
#include "keyline/report/html_report.h"

#include "commands.h"
#include "output.h"
#include "reading.h"
#include "terminal.h"
#include "words.h"

namespace keyline::app {
namespace {

using core::Result;

struct Faired {
  acquire::KeyLine line;
  fairing::FairResult result;
  nlohmann::json shown;
};

/// The fields given, as a request of the operation `fair` has them.
nlohmann::json search_request(const SplineSearch& search) {
  nlohmann::json request = nlohmann::json::object();
  if (search.order) request["order"] = *search.order;
  if (search.population) request["population"] = *search.population;
  if (search.generations) request["generations"] = *search.generations;
  if (search.trials) request["trials"] = *search.trials;
  if (!search.knots.empty()) request["knots"] = search.knots;
  if (!search.parameter.empty()) request["parameter"] = search.parameter;
  return request;
}

/// The options given, as fields of the operation.
Result<nlohmann::json> request_of(const FairCommand& command) {
  nlohmann::json request = search_request(command.spline);
  if (command.common.tolerance) request["tolerance"] = *command.common.tolerance;
  request["pieces"] = command.pieces;
  if (!command.criterion.empty()) request["criterion"] = command.criterion;
  request["keep_corners"] = command.keep_corners;
  request["seed"] = command.common.seed;
  request["threads"] = command.common.threads;
  if (!command.must_pass.empty()) request["must_pass"] = command.must_pass;
  if (!command.clamp.empty()) request["clamp"] = command.clamp;
  if (!command.interpretations.empty()) request["interpretation"] = command.interpretations;
  if (command.region.empty()) return request;
  const std::size_t colon = std::min(command.region.find(':'), command.region.size());
  const auto low = core::parse_number(std::string_view(command.region).substr(0, colon));
  const auto high = colon == command.region.size()
                        ? std::nullopt
                        : core::parse_number(std::string_view(command.region).substr(colon + 1));
  if (!low || !high)
    return core::fail(core::ErrorCode::bad_input,
                      "\"" + command.region + "\" is no part of the length",
                      "give a:b with 0 <= a < b <= 1", "--region");
  request["region"] = {*low, *high};
  return request;
}

void print_table(const Faired& faired) {
  const fairing::FairResult& r = faired.result;
  if (!faired.line.id.empty()) fmt::print("{}\n", faired.line.id);
  fmt::print("{:>5} {:>9} {:>11} {:>11} {:>11} {:>11}  {}\n", "piece", "rhythm", "slope", "length",
             "volume", "deviation", "impression");
  for (std::size_t i = 0; i < r.pieces.size(); ++i) {
    const fairing::FairPiece& p = r.pieces[i];
    fmt::print("{:>5} {:>9} {:>11} {:>11.5g} {:>11.4g} {:>11.3g}  {}\n", i,
               analysis::rhythm_name(p.rhythm),
               p.slopes.empty() ? "" : fmt::format("{:.4g}", p.slopes[0]), p.length, p.volume,
               p.deviation, analysis::impression(p.rhythm));
  }
}

void tell(const FairCommand& command, const Faired& faired) {
  const fairing::FairResult& r = faired.result;
  const bool quiet = command.common.quiet;
  const std::string name = faired.line.id.empty() ? "" : faired.line.id + ": ";
  if (!command.common.json && !quiet) print_table(faired);
  for (const std::string& note : r.notes) say(quiet, name + note);
  say(quiet,
      fmt::format("{}{}, {} in {}; largest deviation {:.4g}, rms "
                  "{:.4g}, tolerance {:.4g}, noise {:.3g}",
                  name, core::counted(faired.line.points.size(), "point"),
                  core::counted(r.pieces.size(), "piece"), core::counted(r.curves.size(), "chain"),
                  r.max_deviation, r.rms_deviation, r.tolerance, r.noise));
}

std::string name_of(const Faired& faired) {
  return faired.line.id.empty() ? "" : " (" + faired.line.id + ")";
}

/// One line for all that miss their tolerance: of the one that misses by most tolerances.
int report_missed(const std::vector<const Faired*>& missed, const std::string& file) {
  const auto excess = [](const Faired* f) { return f->result.max_deviation / f->result.tolerance; };
  const Faired& worst = **std::ranges::max_element(missed, {}, excess);
  const fairing::FairResult& r = worst.result;
  const core::Point2 p = worst.line.points[r.worst_point];
  const std::size_t others = missed.size() - 1;
  const std::string more =
      others == 0 ? "" : fmt::format("; {} more key-line{} too", others, others == 1 ? "" : "s");
  return report_failure(
      {core::ErrorCode::not_converged,
       fmt::format("no chain found{} within {:.4g}: the best misses point {} at ({:.6g}, {:.6g}) "
                   "by {:.4g}{}",
                   name_of(worst), r.tolerance, r.worst_point, p.x, p.y, r.max_deviation, more),
       "give a larger --tolerance, or look for strays there", ""},
      file);
}

/// Where the tolerance is missed, or that the work was cut short: after everything is written.
int verdict_of(const std::vector<Faired>& all, const std::string& file) {
  std::vector<const Faired*> missed;
  for (const Faired& faired : all) {
    if (faired.result.cancelled) {
      report_failure({core::ErrorCode::cancelled,
                      "cancelled" + name_of(faired) + "; the best found was kept", "", ""});
      return kCancelled;
    }
    if (!faired.result.within_tolerance) missed.push_back(&faired);
  }
  return missed.empty() ? kDone : report_missed(missed, file);
}

/// What was faired, and where it came from.
struct Session {
  std::vector<Faired> all;
  std::optional<curve::Box2> page;  ///< of a picture
};

Result<Faired> fair_one(const operations::NamedCurve& curve, const FairCommand& command,
                        const nlohmann::json& options, const core::Progress& progress) {
  nlohmann::json request = subject_of(curve, command.input);
  request.update(options);
  const auto outcome = operations::carry_out("fair", request, {command.common.threads, progress});
  if (!outcome) return std::unexpected(as_options(outcome.error()));
  auto shown = operations::result_json(*outcome);
  if (!shown) return std::unexpected(shown.error());
  const auto& answer = *outcome->result_as<operations::FairAnswer>();
  Faired faired{answer.line, answer.faired, std::move(*shown)};
  faired.line.id = curve.name;
  return faired;
}

/// All key-lines of the input.
Result<Session> fair_all(const FairCommand& command) {
  const core::Progress progress = interactive_progress(command.common.quiet);
  const auto options = request_of(command);
  if (!options) return std::unexpected(options.error());
  const auto read = read_files(command.input, progress);
  if (!read) return std::unexpected(read.error());
  Session session;
  if (read->page && read->document.paths.empty())
    session.page = curve::Box2{read->page->low, read->page->high};
  if (!read->skipped.empty())
    say(command.common.quiet, fmt::format("{} in the file were skipped; keyline list names them",
                                          core::counted(read->skipped.size(), "thing")));
  const double count = static_cast<double>(read->curves.size());
  for (std::size_t i = 0; i < read->curves.size(); ++i) {
    auto faired = fair_one(read->curves[i], command, *options,
                           core::part_of(progress, static_cast<double>(i) / count,
                                         static_cast<double>(i + 1) / count));
    if (!faired) return std::unexpected(faired.error());
    session.all.push_back(std::move(*faired));
    if (session.all.back().result.cancelled) break;
  }
  end_progress();
  return session;
}

operations::ReportOptions report_options(const FairCommand& command, const Faired& faired) {
  operations::ReportOptions options;
  std::string files;
  for (const std::string& file : command.input.files) files += (files.empty() ? "" : ", ") + file;
  options.title = faired.line.id.empty() ? "Faired key-line" : "Faired key-line: " + faired.line.id;
  options.subtitle = files;
  options.unit = command.input.unit;
  options.command = command.common.command_line;
  options.generator = "Keyline " KEYLINE_VERSION;
  options.options = {
      {"tolerance", fmt::format("{:.6g}{}", faired.result.tolerance,
                                command.common.tolerance ? "" : " (by the default rule)")},
      {"corners", command.keep_corners ? "kept" : "rounded"},
      {"seed", std::to_string(command.common.seed)}};
  const nlohmann::json search = search_request(command.spline);
  for (const auto& [name, value] : search.items())
    options.options.emplace_back(name + " of the spline",
                                 value.is_string() ? value.get<std::string>() : value.dump());
  if (command.pieces > 0) options.options.emplace_back("pieces", std::to_string(command.pieces));
  if (!command.clamp.empty()) options.options.emplace_back("clamp", command.clamp);
  if (!command.region.empty()) options.options.emplace_back("region", command.region);
  for (const std::string& text : command.interpretations)
    options.options.emplace_back("interpretation", text);
  return options;
}

/// One column while a page holds it, else about as wide as high.
int columns_of(const std::vector<figure::Drawing>& drawings) {
  constexpr double kPage = 14400;
  double width = 1;
  double height = 0;
  for (const figure::Drawing& d : drawings) {
    width = std::max(width, d.width);
    height = std::max(height, d.height);
  }
  const auto count = static_cast<double>(drawings.size());
  if (count * (height + 16) < kPage) return 1;
  return static_cast<int>(std::ceil(std::sqrt(count * height / width)));
}

/// Pages of several key-lines follow each other in one report; pictures stand below each other,
/// many of them side by side too.
void add_pictures(Writers& writers, const FairCommand& command, const std::vector<Faired>& all) {
  writers[".html"] = [&]() -> Result<std::string> {
    std::vector<report::Report> reports;
    for (const Faired& faired : all)
      reports.push_back(
          operations::fair_report(faired.line, faired.result, report_options(command, faired)));
    return report::html_report(operations::joined_report(reports, "Faired key-lines"));
  };
  const auto picture = [&] {
    std::vector<figure::Drawing> drawings;
    for (const Faired& faired : all)
      drawings.push_back(
          operations::fair_picture(faired.line, faired.result, report_options(command, faired)));
    return figure::tile(drawings, columns_of(drawings));
  };
  writers[".pdf"] = [picture] { return figure::write_pdf(picture()); };
  writers[".png"] = [picture] {
    constexpr double kMostPixels = 60e6;
    const figure::Drawing drawing = picture();
    return figure::write_png(
        drawing, std::min(2.0, std::sqrt(kMostPixels / (drawing.width * drawing.height))));
  };
}

nlohmann::json result_json(const std::vector<Faired>& all) {
  if (all.size() == 1) return all.front().shown;
  nlohmann::json list = nlohmann::json::array();
  for (const Faired& faired : all) {
    list.push_back(faired.shown);
    list.back()["id"] = faired.line.id;
  }
  return {{"curves", std::move(list)}};
}

/// On the drawing's own page (y down from its upper edge): curves and drawing lie on each other.
Result<std::string> svg_on_page(document::Document curves, const curve::Box2& page,
                                double tolerance) {
  const double height = page.high.y;
  for (document::NamedPath& named : curves.paths)
    named.path = document::transform(named.path, {1, 0, {0, -height}});
  curves.page = curve::Box2{{0, -height}, {page.high.x, 0}};
  auto written = exchange::format_document(curves, ".svg", {.tolerance = tolerance});
  if (!written) return std::unexpected(written.error());
  return std::move(written->content);
}

}  // namespace

int run_fair(const FairCommand& command) {
  const std::string& file = command.input.files.front();
  if (auto known = check_outputs(command.common, curve_extensions({".html", ".pdf", ".png"}),
                                 command.input.files);
      !known)
    return report_failure(known.error());
  const auto session = fair_all(command);
  if (!session) return report_failure(session.error());
  const std::vector<Faired>* all = &session->all;
  const std::optional<curve::Box2>& page = session->page;
  document::Document curves;
  curves.unit = page && command.input.unit.empty() ? "px" : command.input.unit;
  double tolerance = HUGE_VAL;
  for (const Faired& faired : *all) {
    curves.paths.push_back({{faired.line.id, {}, {}}, operations::fair_curve(faired.result), 0});
    tolerance = std::min(tolerance, 0.1 * faired.result.tolerance);
  }
  Writers writers = curve_writers(curves, tolerance, command.common);
  if (page) writers[".svg"] = [&] { return svg_on_page(curves, *page, tolerance); };
  add_pictures(writers, command, *all);
  if (auto done = write_outputs(command.common, writers); !done)
    return report_failure(done.error());
  if (command.common.json) fmt::print("{}\n", result_json(*all).dump());
  for (const Faired& faired : *all) tell(command, faired);
  return verdict_of(*all, file);
}

}  // namespace keyline::app
