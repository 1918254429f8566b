#include <fmt/format.h>

#include "session.h"
#include "terminal.h"
#include "words.h"

namespace keyline::app {
namespace {

using core::Result;
using nlohmann::json;

constexpr std::size_t kReading = 0;  // records of the command line
constexpr std::size_t kFormat = 1;

Session new_session() {
  return Session(
      {"convert", "FILE... ", "Converts curves and surfaces from one format to another.",
       "Example: keyline convert faired.json -o faired.dxf --tolerance 0.001"},
      {reading_group(), {"Formats", &core::type_of<operations::FormatOptions>()}, door_group()});
}

Result<presentation::Output> output_of(Session& session, const operations::ReadAnswer& read) {
  presentation::Output output = presentation::output_of(read);
  auto format = session.record<operations::FormatOptions>(kFormat);
  if (!format) return std::unexpected(format.error());
  output.format = *format;
  return output;
}

}  // namespace

int run_convert(const Words& words) {
  Session session = new_session();
  if (const auto status = session.begin(words)) return *status;
  const bool quiet = session.door().quiet;
  if (session.door().output.empty() && !session.door().json)
    return report_failure({core::ErrorCode::bad_input, "no output is named", "add -o FILE", ""});
  if (auto done = session.check_outputs(); !done) return report_failure(done.error());
  auto outcome = read_outcome(session, session.of(kReading), false);
  if (!outcome) return report_failure(outcome.error());
  const auto& read = *outcome->result_as<operations::ReadAnswer>();
  const auto output = output_of(session, read);
  if (!output) return report_failure(output.error());
  say(quiet, session.files().front() + ": " + presentation::contents_of(read));
  say_read(quiet, read);
  presentation::ReportOptions options = session.report_options();
  options.title = "Curves";
  const auto written =
      session.write(presentation::document_pages(output->document, options), *output);
  if (!written) return report_failure(written.error());
  for (const json& one : (*written)["written"])  // the others were told when they were written
    if (one["deviation"] == 0) say(quiet, one["file"].get<std::string>() + ": deviation 0");
  if (!session.door().json) {
    session.note_unused(json::object());
    return kDone;
  }
  auto shown = shown_of(*outcome);
  if (!shown) return report_failure(shown.error());
  (*shown)["written"] = (*written)["written"];
  session.print(*shown, "");
  return kDone;
}

Manual convert_manual() { return new_session().manual(); }

}  // namespace keyline::app
