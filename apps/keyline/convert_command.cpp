#include <algorithm>

#include <fmt/format.h>

#include "keyline/analysis/profile.h"

#include "commands.h"
#include "input.h"
#include "output.h"
#include "terminal.h"

namespace keyline::app {
namespace {

core::Result<document::Document> read_any(const InputOptions& input) {
  if (kind_of(input.files.front()) != InputKind::points) return load_document(input);
  const auto lines = load_key_lines(input);
  if (!lines) return std::unexpected(lines.error());
  document::Document document;
  for (const acquire::KeyLine& line : *lines) {
    document::Path path;
    path.closed = line.closed;
    curve::Polyline2 polyline{line.points};
    if (line.closed) polyline.points.push_back(polyline.points.front());
    path.curves.push_back({std::move(polyline)});
    document.paths.push_back({line.id, "", std::move(path), 0});
  }
  return document;
}

}  // namespace

int run_convert(const ConvertCommand& command) {
  if (command.common.outputs.empty())
    return report_failure({core::ErrorCode::bad_input, "no output is named", "add -o FILE", ""});
  if (auto known = check_outputs(command.common, {".svg", ".json", ".csv"}); !known)
    return report_failure(known.error());
  const auto document = read_any(command.input);
  if (!document) return report_failure(document.error());
  for (const std::string& skipped : document->skipped)
    say(command.common.quiet, "skipped: " + skipped);
  std::vector<OutputCurve> curves;
  double size = 0;
  for (const document::NamedPath& named : document->paths) {
    curves.push_back({named.name, named.path});
    size = std::max(size, analysis::ArcLengthTable(analysis::view(named.path)).length());
  }
  const double tolerance = command.common.tolerance.value_or(1e-5 * size);
  const std::string unit = command.input.unit.empty() ? document->unit : command.input.unit;
  if (auto done = write_outputs(command.common, curve_writers(curves, tolerance, unit)); !done)
    return report_failure(done.error());
  say(command.common.quiet,
      fmt::format("{} curve{} written; cubic Beziers in svg are within {:.3g} of the input",
                  curves.size(), curves.size() == 1 ? "" : "s", tolerance));
  return kDone;
}

}  // namespace keyline::app
