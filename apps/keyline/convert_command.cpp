#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/core/text.h"
#include "keyline/exchange/atomic_file.h"
#include "keyline/exchange/document_file.h"
#include "keyline/exchange/json_document.h"
#include "keyline/exchange/planar_form.h"

#include "commands.h"
#include "output.h"
#include "reading.h"
#include "terminal.h"

namespace keyline::app {
namespace {

using core::Result;

/// What was read as a document; points as acquired: sorted, without strays.
document::Document document_of(const operations::ReadAnswer& read) {
  document::Document document = read.document;
  document.unit = read.unit;
  for (const operations::NamedCurve& named : read.curves) {
    if (!named.line) continue;
    curve::Polyline2 polyline{named.line->points};
    if (named.line->closed) polyline.points.push_back(polyline.points.front());
    document.paths.push_back(
        {{named.name, {}, {}}, {{{std::move(polyline)}}, named.line->closed}, 0});
  }
  return document;
}

std::string contents(const document::Document& document) {
  std::string text;
  for (const auto& [count, thing] : {std::pair{document.paths.size(), "planar curve"},
                                     std::pair{document.space_curves.size(), "space curve"},
                                     std::pair{document.surfaces.size(), "surface"}})
    if (count > 0) text += (text.empty() ? "" : ", ") + core::counted(count, thing);
  return text + (document.unit.empty() ? "" : " in " + document.unit);
}

/// What formats of the plane can hold: where there is no planar curve, space curves in the
/// coordinates of their own planes.
document::Document planar_of(const document::Document& document, bool quiet) {
  document::Document planar = document;
  if (!planar.paths.empty() || planar.space_curves.empty()) return planar;
  std::vector<std::string> notes;
  exchange::flatten(planar, notes);
  if (!planar.paths.empty())
    say(quiet, core::counted(planar.paths.size(), "curve") +
                   " in space: pictures, SVG and glyphs show them in the coordinates of their "
                   "planes");
  return planar;
}

bool is_planar_format(const std::string& extension) {
  return extension == ".svg" || extension == ".glif" || extension == ".pdf";
}

}  // namespace

int run_convert(const ConvertCommand& command) {
  const CommonOptions& common = command.common;
  if (common.outputs.empty() && !common.json)
    return report_failure({core::ErrorCode::bad_input, "no output is named", "add -o FILE", ""});
  if (auto known =
          check_outputs(common, curve_extensions({".pdf", ".png", ".html"}), command.input.files);
      !known)
    return report_failure(known.error());
  const auto read = read_files(command.input, interactive_progress(common.quiet), false);
  if (!read) return report_failure(read.error());
  end_progress();
  document::Document made = document_of(*read);
  document::Document* const document = &made;
  if (command.trims) document::add_trim_curves(*document);
  say(common.quiet, fmt::format("{}: {}", command.input.files.front(), contents(*document)));
  for (const std::string& skipped : document->skipped) say(common.quiet, "skipped: " + skipped);
  exchange::WriteOptions options;
  options.tolerance = common.tolerance.value_or(0);
  options.polylines = command.polylines;
  options.grid = command.grid;
  Writers pictures;
  const bool planar_wanted =
      std::any_of(common.outputs.begin(), common.outputs.end(), [&](const std::string& file) {
        const std::string extension = exchange::extension_of(file);
        return is_planar_format(extension) || extension == ".png" || extension == ".html";
      });
  const document::Document planar =
      planar_wanted ? planar_of(*document, common.quiet) : document::Document{};
  add_picture_writers(pictures, planar, "Curves", command.input.files.front(), common);
  if (!planar.paths.empty()) pictures.erase(".pdf");  // the drawing itself, in real size
  exchange::OutputFiles files;
  for (const std::string& file : common.outputs) {
    if (const auto picture = pictures.find(exchange::extension_of(file));
        picture != pictures.end()) {
      if (auto done = add_output(files, file, picture->second); !done)
        return report_failure(done.error());
      continue;
    }
    const bool flat = is_planar_format(exchange::extension_of(file));
    const auto written =
        exchange::format_document(flat ? planar : *document, exchange::extension_of(file), options);
    if (!written) return report_failure(exchange::in_file(written.error(), file));
    if (auto done = files.add(file, written->content); !done) return report_failure(done.error());
    for (const std::string& note : written->notes)
      say(common.quiet, fmt::format("{}: {}", file, note));
    say(common.quiet, fmt::format("{}: deviation {:.3g}", file, written->deviation));
  }
  if (auto done = files.commit(); !done) return report_failure(done.error());
  if (common.json) fmt::print("{}\n", exchange::to_json(*document).dump());
  return kDone;
}

}  // namespace keyline::app
