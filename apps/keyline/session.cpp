#include "session.h"

#include <algorithm>

#include <fmt/format.h>

#include "keyline/core/text.h"
#include "keyline/core/version.h"
#include "keyline/operations/amount.h"
#include "keyline/operations/schema.h"

#include "terminal.h"
#include "words.h"

namespace keyline::app {

using core::ErrorCode;
using core::Result;
using nlohmann::json;
using operations::Operation;

namespace {

/// A word as a shell has to be given it: in quotes where it holds more than plain characters.
std::string as_typed(const std::string& word) {
  constexpr const char* kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./,:=+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::vector<std::string_view> filled_by_files() {
  return {"file",    "curve",   "curves",   "points",  "line",
          "weights", "surface", "surfaces", "along_u", "along_v"};
}

OptionGroup group_of(const Operation& operation, const std::string& title) {
  return {title, operation.request, filled_by_files()};
}

OptionGroup reading_group() {
  return {"Reading the files",
          operations::find_operation("document.read")->request,
          {"file", "planar"}};
}

OptionGroup door_group() { return {"Everywhere", &core::type_of<DoorOptions>()}; }

namespace {

/// The forms of curves go before what every command has.
std::vector<OptionGroup> with_forms(std::vector<OptionGroup> groups, const core::Type* forms) {
  if (forms) groups.insert(groups.end() - 1, {"Further forms of the curve", forms, {}});
  return groups;
}

// What of a file is said, and what stands for the rest of many.
constexpr const char* kSkipped = "skipped: ";
constexpr const char* kNamed = "; keyline list names them";
constexpr const char* kPlanes = " curves in planes";

}  // namespace

Session::Session(Usage usage, const std::vector<OptionGroup>& groups, bool takes_files)
    : usage_(std::move(usage)),
      arguments_(with_forms(groups, usage_.forms), takes_files),
      takes_files_(takes_files),
      door_record_(groups.size() - (usage_.forms ? 0 : 1)) {}

Manual Session::manual() const {
  return {usage_.command, usage_.words, usage_.text, arguments_.texts(), usage_.more};
}

std::string Session::help() const {
  return usage_.text + "\n\nkeyline " + usage_.command + " " + usage_.words + "[options]\n" +
         arguments_.help() + (usage_.more.empty() ? "" : "\n" + usage_.more + "\n");
}

std::optional<int> Session::begin(const Words& words) {
  typed_ = "keyline " + usage_.command;
  for (const std::string& word : words) typed_ += " " + as_typed(word);
  if (auto done = arguments_.parse(words); !done) {
    core::Failure failure = done.error();
    if (const std::string why = explain_ ? explain_(failure.path) : ""; !why.empty())
      failure.hint = why;
    if (failure.hint.empty() || failure.hint.ends_with('?') || failure.hint.ends_with(';'))
      failure.hint += (failure.hint.empty() ? "" : " ") + usage_hint();
    return report_failure(failure);
  }
  auto door = record<DoorOptions>(door_record_);
  if (!door) return report_failure(door.error());
  door_ = std::move(*door);
  if (door_.version) {
    fmt::print("keyline {}\n", core::version());
    return kDone;
  }
  if (door_.help) {
    fmt::print("{}", help());
    return kDone;
  }
  if (!takes_files_ && !files().empty())
    return report_failure(
        {ErrorCode::bad_input, "this word belongs to no option", usage_hint(), files().front()});
  for (const auto& [word, outcome] : arguments_.option_files().read())
    note_read(*outcome.result_as<operations::ReadAnswer>());
  for (const std::string& note : arguments_.option_files().notes()) this->note(note);
  return {};
}

presentation::ReportOptions Session::report_options() const {
  presentation::ReportOptions options;
  for (const std::string& file : files())
    options.subtitle += (options.subtitle.empty() ? "" : ", ") + file;
  options.command = typed_;
  options.generator = std::string("Keyline ") + core::version();
  for (const auto& [name, value] : arguments_.typed())
    if (name != "output" && name != "json" && name != "quiet" && name != "tolerance" &&
        name != "seed")
      options.options.emplace_back(name, value.empty() ? "yes" : value);
  return options;
}

core::Progress Session::progress() const { return interactive_progress(door_.quiet); }

Result<void> Session::check_outputs(const std::vector<std::string>& known) const {
  if (auto done = presentation::check_outputs(door_.output, known, files()); !done) return done;
  const auto streamed = std::ranges::find_if(door_.output, presentation::is_standard_output);
  if (streamed == door_.output.end()) return {};
  if (door_.json)
    return core::fail(ErrorCode::bad_input, "two things go to standard output",
                      "leave out --json, or name a file", *streamed);
  leave_standard_output();
  return {};
}

Result<void> Session::check_outputs() const {
  return check_outputs(presentation::known_extensions());
}

Result<operations::Outcome> Session::perform(const std::string& operation, json request,
                                             const core::Progress& progress) {
  const Operation* named = operations::find_operation(operation);
  if (usage_.forms && operations::further_options(*named))
    request.update(arguments_.of(door_record_ - 1));
  auto outcome = operations::carry_out(operation, request, {door_.threads, progress, true});
  if (outcome) {
    uses_.add(*named->request, request, unused_in(*outcome));
    if (usage_.forms) uses_.add(*usage_.forms, request, {});
    return outcome;
  }
  return std::unexpected(told(outcome.error()));
}

core::Failure Session::told(core::Failure failure) const {
  // A file "points" is no option.
  if (std::ranges::find(files(), failure.path) != files().end()) return failure;
  return as_options(std::move(failure),
                    [this](const std::string& option) { return arguments_.has(option); });
}

Result<json> Session::write(const presentation::Pages& pages, const presentation::Output& output,
                            Ending ending) {
  core::Progress progress = this->progress();
  if (ending == Ending::kept) progress.cancellation = {};
  const auto written = presentation::write_files(door_.output, pages, output, progress);
  end_progress();
  if (!written) return std::unexpected(told(written.error()));
  for (const std::string& name : written->unused)
    uses_.add(core::type_of<operations::FormatOptions>(), {{name, true}}, written->unused);
  for (const operations::WrittenFile& one : written->written) {
    for (const std::string& note : one.notes) say(door_.quiet, one.file + ": " + note);
    if (one.deviation > 0)
      say(door_.quiet, fmt::format("{}: deviation {:.3g}", one.file, one.deviation));
  }
  return operations::write_json(core::type_of<operations::WriteAnswer>(), &*written);
}

Result<json> Session::write(const presentation::Pages& pages, json document, Ending ending) {
  if (door_.output.empty()) return write(pages, presentation::Output{}, ending);
  if (door_.tolerance && !document.contains("tolerance")) document["tolerance"] = *door_.tolerance;
  if (usage_.forms && arguments_.of(door_record_ - 1).contains("samples"))
    document["samples"] = arguments_.of(door_record_ - 1)["samples"];
  const auto output = presentation::output_of(std::move(document));
  if (!output) return std::unexpected(output.error());
  return write(pages, *output, ending);
}

void Session::note(const std::string& text) {
  say(door_.quiet, text);
  notes_.push_back(text);
}

void Session::note_some(const std::string& lead, const std::vector<std::string>& lines,
                        const std::string& rest) {
  say_some(door_.quiet, lead, lines, rest);
  for (const std::string& line : lines) notes_.push_back(lead + line);
}

void Session::note_read(const operations::ReadAnswer& read) {
  note_some("", read.notes, kPlanes);
  note_some(kSkipped, read.skipped, kNamed);
}

void Session::note_unused(const json& result) {
  const json told = result.is_object() ? result.value("unused", json::array()) : json::array();
  for (const auto& [name, what] : uses_.take_unused()) {
    const std::string text = fmt::format("{} has no use here ({})", option_name(name), what);
    if (std::ranges::find(told, json(name)) == told.end())
      note(text);
    else
      say(door_.quiet, text);
  }
}

void Session::print(const json& shown, const std::string& text) {
  note_unused(shown);
  if (door_.json) {
    json whole = shown;
    for (const std::string& note : notes_) whole["notes"].push_back(note);
    fmt::print("{}\n", whole.dump(-1, ' ', false, json::error_handler_t::replace));
  } else if (!door_.quiet) {
    fmt::print("{}", text);
  }
}

Result<operations::Outcome> read_outcome(Session& session, json request, bool planar) {
  if (session.files().empty())
    return core::fail(ErrorCode::bad_input, "no file is named", session.usage_hint());
  request["file"] = session.files();
  if (planar) request["planar"] = true;
  auto outcome = session.perform("document.read", request, session.progress());
  end_progress();
  return outcome;
}

namespace {

core::Failure nothing_planar(const operations::ReadAnswer& read) {
  const std::string what = "there is no planar curve in it";
  if (read.surfaces.empty())
    return {ErrorCode::bad_input, what, "give curves that lie in a plane", ""};
  return {ErrorCode::bad_input,
          fmt::format("{}, but {}", what, core::counted(read.surfaces.size(), "surface")),
          "--trims takes the curves that cut them; analyze and edit take surfaces", ""};
}

}  // namespace

Result<std::vector<json>> planar_things(Session& session, const ReadFiles& read) {
  if (auto few = operations::check_amount(read.answer()); !few) return std::unexpected(few.error());
  std::vector<json> things;
  std::vector<std::string> others;
  const auto& curves = read.answer().curves;
  for (std::size_t i = 0; i < curves.size(); ++i)
    if (curves[i].line || operations::planar_path(*curves[i].curve))
      things.push_back(read.shown["curves"][i]);
    else
      others.push_back(called(curves[i].name, "curve", i, curves.size()) + ": lies in no plane");
  if (things.empty()) return std::unexpected(nothing_planar(read.answer()));
  session.note_some(kSkipped, others, " that lie in no plane");
  if (const std::size_t surfaces = read.answer().surfaces.size(); surfaces > 0)
    session.note(core::counted(surfaces, "surface") + " of the file left out beside its curves");
  return things;
}

void say_read(bool quiet, const operations::ReadAnswer& read) {
  say_some(quiet, "", read.notes, kPlanes);
  say_some(quiet, kSkipped, read.skipped, kNamed);
}

std::string called(const std::string& name, const char* kind, std::size_t index,
                   std::size_t count) {
  return name.empty() && count > 1 ? fmt::format("{} {}", kind, index + 1) : name;
}

Result<ReadFiles> read_files(Session& session, json request, bool planar) {
  auto outcome = read_outcome(session, std::move(request), planar);
  if (!outcome) return std::unexpected(outcome.error());
  auto shown = shown_of(*outcome);
  if (!shown) return std::unexpected(shown.error());
  return ReadFiles{std::move(*outcome), std::move(*shown)};
}

json subject_of(const json& thing) {
  if (thing.contains("line")) return {{"line", thing["line"]}};
  return {{"curve", thing["curve"]}};
}

void take_look(json& to, const json& thing) {
  for (const char* look : {"layer", "color", "stroke_width"})
    if (thing.contains(look)) to[look] = thing[look];
}

json one_or_all(const std::vector<json>& shown, const char* what) {
  if (shown.size() == 1) return shown.front();
  return {{what, shown}};
}

Result<json> shown_of(const operations::Outcome& outcome) {
  return operations::result_json(outcome);
}

Result<void> check_unused(const json& used, const json& unused, const std::string& what) {
  for (const auto& [name, value] : unused.items())
    if (!used.contains(name))
      return core::fail(ErrorCode::bad_input, "this is " + what, "leave it out", option_name(name));
  return {};
}

}  // namespace keyline::app
