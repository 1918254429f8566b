#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "keyline/core/leading_number.h"
#include "keyline/core/text.h"

#include "list_text.h"
#include "option_files.h"
#include "result_table.h"
#include "session.h"
#include "surface_text.h"
#include "terminal.h"

namespace keyline::app {
namespace {

using core::Field;
using core::Result;
using nlohmann::json;
using operations::Operation;
using Kind = core::Type::Kind;

constexpr Tool kTools[] = {
    {"blend", "lac.blend", "FILE... ",
     "Example: keyline blend bonnet.json roof.json --order G3 -o blend.svg"},
    {"compare", "curve.compare", "FILE... ",
     "Example: keyline compare faired.json examples/bonnet-scan.csv"},
    {"join", "curve.join"},
    {"mirror", "curve.mirror"},
    {"network", "surface.network", "ALONG ACROSS ",
     "ALONG holds two borders and sections between them, ACROSS those that cross them.\n"
     "Example: keyline network examples/hood-along.json examples/hood-across.json -o hood.json"},
    {"offset", "curve.offset"},
    {"raise", "lac.raise_joints"},
    {"reverse", "curve.reverse"},
    {"split", "curve.split"},
    {"transform", "curve.transform"},
    {"trim", "curve.trim"}};

const Operation& named(const std::string& operation) {
  return *operations::find_operation(operation);
}

/// A text for the terminal; of one that is longer than any name (a thumbnail) how it begins.
std::string line_of(const std::string& text) {
  constexpr std::size_t kLongest = 300, kBeginning = 20;
  if (text.size() <= kLongest) return text;
  return fmt::format("{}... ({} characters, which --json prints)", text.substr(0, kBeginning),
                     text.size());
}

/// Single values of a result, one line each, and lists of records as tables; the rest is left to
/// --json.
std::string summary(const core::Type& type, const void* value) {
  std::string text;
  core::visit_fields(type, value, [&](const Field& field, const void* member) {
    const core::Type* its = &field.type();
    if (its->kind == Kind::optional) {
      member = its->held(member);
      its = &its->item();
    }
    if (!member) return;
    if (its->kind == Kind::list) {
      const std::string table = table_of(*its, member);
      if (!table.empty()) text += fmt::format("{} ({}):\n{}", field.name, field.text, table);
    }
    if (its->kind > Kind::choice) return;
    const auto shown = operations::write_json(*its, member);
    if (!shown) return;
    const std::string said = shown->is_number_float() ? core::number_text(shown->get<double>(), 8)
                             : shown->is_string()     ? line_of(shown->get<std::string>())
                                                      : shown->dump();
    if (said.empty()) return;
    text += fmt::format(
        "{:<20} {}{}\n", field.name, said,
        field.unit.empty() || field.unit == "length" ? "" : " " + std::string(field.unit));
  });
  return text;
}

/// Everything of a result that is a "curve", also in its lists.
void gather_curves(const json& result, std::vector<json>& curves) {
  if (result.is_object() && result.contains("curve") && result["curve"].is_object()) {
    curves.push_back(result["curve"]);
    return;
  }
  if (!result.is_object()) return;
  for (const auto& [name, value] : result.items())
    if (value.is_array())
      for (const json& item : value)
        if (item.is_object()) gather_curves(item, curves);
}

/// What was made, to be written and told.
struct Made {
  std::vector<json> shown;
  json document{{"curves", json::array()}, {"surfaces", json::array()}};
  operations::CommonUnit unit;
  std::string text;
};

/// Of what it is done to: `heading` is what that is called on the terminal.
struct Of {
  std::string name;
  std::string heading;
  json look = json::object();  ///< take_look()
};

/// The name of one of several that come of one.
std::string numbered(const std::string& name, std::size_t i) {
  return name.empty() ? std::to_string(i + 1) : fmt::format("{}/{}", name, i + 1);
}

Result<void> run_one(Session& session, const Operation& operation, const json& request,
                     const Of& of, const core::Progress& progress, Made& made) {
  const std::string& name = of.name;
  const auto outcome = session.perform(operation.name, request, progress);
  if (!outcome) return std::unexpected(outcome.error());
  auto result = shown_of(*outcome);
  if (!result) return std::unexpected(result.error());
  std::vector<json> curves;
  gather_curves(*result, curves);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    json written = of.look;
    written["name"] = curves.size() > 1 ? numbered(name, i) : name;
    written["curve"] = curves[i];
    made.document["curves"].push_back(std::move(written));
  }
  if (result->contains("surface") && (*result)["surface"].is_object())
    made.document["surfaces"].push_back({{"name", name}, {"surface", (*result)["surface"]}});
  made.text += (of.heading.empty() ? "" : of.heading + "\n") +
               summary(*operation.result, outcome->result.get());
  if (result->contains("joints") && (*result)["joints"].contains("zebra"))
    made.text += made_joints_text((*result)["joints"]);
  made.shown.push_back(std::move(*result));
  return {};
}

/// Whether a result of that type holds a curve or a surface, also in its lists.
bool makes_shapes(const core::Type& type, int depth = 0) {
  constexpr int kDeepest = 3;  // lists within lists
  bool found = false;
  core::visit_fields(type, type.make().get(), [&](const Field& field, void*) {
    const core::Type& its = field.type();
    const bool list = its.kind == Kind::list && its.item().kind == Kind::record;
    found = found || field.name == "curve" || field.name == "surface" ||
            (list && depth < kDeepest && makes_shapes(its.item(), depth + 1));
  });
  return found;
}

/// The outputs asked for, before anything is computed.
Result<void> check_outputs(const Session& session, const Operation& operation) {
  if (!session.door().output.empty() && !makes_shapes(*operation.result))
    return core::fail(core::ErrorCode::bad_input, "makes no curve that a file could hold",
                      "leave out -o; --json prints the result", operation.name);
  return session.check_outputs();
}

int finish(Session& session, const Made& made) {
  end_progress();
  if (!session.door().output.empty()) {
    const auto output = presentation::output_of(made.document);
    if (!output) return report_failure(output.error());
    presentation::ReportOptions options = session.report_options();
    options.title = made.document["surfaces"].empty() ? "Curves" : "Surface";
    const auto pages = presentation::document_pages(output->document, options);
    if (auto done = session.write(pages, made.document); !done) return report_failure(done.error());
  }
  session.print(one_or_all(made.shown, "results"), made.text);
  const std::size_t shapes = made.document["curves"].size() + made.document["surfaces"].size();
  if (shapes > 0 && session.door().output.empty() && !session.door().json)
    say(session.door().quiet,
        fmt::format("{} made; -o FILE writes {}, --json prints all", core::counted(shapes, "shape"),
                    shapes == 1 ? "it" : "them"));
  return kDone;
}

bool has_field(const Operation& operation, std::string_view name) {
  bool found = false;
  core::visit_fields(*operation.request, operation.request->make().get(),
                     [&](const Field& field, void*) { found = found || field.name == name; });
  return found;
}

/// Whether there are as many curves as the operation takes.
Result<void> check_count(const Session& session, const Operation& operation, std::size_t count) {
  Result<void> good;
  core::visit_fields(
      *operation.request, operation.request->make().get(), [&](const Field& field, void*) {
        if (field.name != "curves" || (count >= field.least && count <= field.most)) return;
        good = core::fail(core::ErrorCode::bad_input, core::counted(count, "curve") + " given",
                          fmt::format("give {}: {}; FILE#NAME takes one of a file's, keyline list "
                                      "tells them",
                                      field.least, field.text),
                          session.files().front());
      });
  return good;
}

Result<void> run_on_curves(Session& session, const Operation& operation,
                           const std::vector<json>& things, Made& made) {
  json request = session.of(0);
  if (has_field(operation, "curves")) {
    if (auto sound = check_count(session, operation, things.size()); !sound) return sound;
    for (const json& thing : things) request["curves"].push_back(curve_of(thing));
    return run_one(session, operation, request, {}, session.progress(), made);
  }
  for (std::size_t i = 0; i < things.size(); ++i) {
    const json& thing = things[i];
    request["curve"] = curve_of(thing);
    const std::string name = thing["name"].get<std::string>();
    Of of{name, called(name, "curve", i, things.size())};
    take_look(of.look, thing);
    if (of.look.contains("stroke_width"))  // what enlarges a curve enlarges its line
      of.look["stroke_width"] = of.look["stroke_width"].get<double>() * request.value("scale", 1.0);
    if (auto done = run_one(session, operation, request, of,
                            one_of_many(session.progress(), i, things.size()), made);
        !done)
      return std::unexpected(told_how_far(done.error(), i, things.size()));
  }
  return {};
}

/// Curves of one file, or what of it a name behind # takes.
Result<json> read_one(Session& session, const std::string& file, Made& made) {
  json request = session.of(1);
  const FileWord word = parted(file);
  request["file"] = word.file;
  if (!word.thing.empty()) request["select"] = word.thing;
  const auto read = session.perform("document.read", request, session.progress());
  end_progress();
  if (!read) return std::unexpected(read.error());
  session.note_read(*read->result_as<operations::ReadAnswer>());
  auto shown = shown_of(*read);
  if (!shown) return std::unexpected(shown.error());
  if ((*shown)["curves"].empty())
    return core::fail(core::ErrorCode::bad_input, "there is no curve in it",
                      "give a file that holds one", file);
  if (auto same = made.unit.take((*shown)["unit"], file); !same)
    return std::unexpected(same.error());
  made.document["unit"] = made.unit.name();
  return std::move((*shown)["curves"]);
}

/// Curves of all files; every file is one of its own here.
Result<std::vector<json>> read_all(Session& session, Made& made) {
  std::vector<json> all;
  for (const std::string& file : session.files()) {
    auto curves = read_one(session, file, made);
    if (!curves) return std::unexpected(curves.error());
    for (json& thing : *curves) all.push_back(std::move(thing));
  }
  return all;
}

/// A failure of the i-th curve along u or v names its file and counts from 1.
core::Failure of_files(const Session& session, core::Failure failure) {
  constexpr std::array<std::string_view, 2> fields{"along_u", "along_v"};
  for (const std::size_t way : {0U, 1U}) {
    if (!failure.path.starts_with(fields[way])) continue;
    std::string_view index = std::string_view(failure.path).substr(fields[way].size());
    index.remove_prefix(index.starts_with('['));
    const int number = core::take_whole<int>(index).value_or(0);
    failure.path = fmt::format("{}: curve {}", session.files()[way], number + 1);
  }
  return failure;
}

/// Two files whose curves cross: those of the first run along u, of the second along v.
Result<void> run_across(Session& session, const Operation& operation, Made& made) {
  if (session.files().size() != 2)
    return core::fail(core::ErrorCode::bad_input, "takes two files",
                      "curves one way in the first, those that cross them in the second", "");
  json request = session.of(0);
  for (const std::size_t way : {0U, 1U}) {
    const auto curves = read_one(session, session.files()[way], made);
    if (!curves) return std::unexpected(curves.error());
    for (const json& thing : *curves)
      request[way == 0 ? "along_u" : "along_v"].push_back(curve_of(thing));
  }
  auto done = run_one(session, operation, request, {}, session.progress(), made);
  if (!done) done = std::unexpected(of_files(session, done.error()));
  return done;
}

Result<void> run_on_files(Session& session, const Operation& operation, Made& made) {
  if (has_field(operation, "along_u")) return run_across(session, operation, made);
  const auto things = read_all(session, made);
  if (!things) return std::unexpected(things.error());
  return run_on_curves(session, operation, *things, made);
}

Session tool_session(const Tool& tool) {
  const Operation& operation = named(tool.operation);
  return Session(
      {tool.name, tool.words, operation.summary, tool.more, operations::further_options(operation)},
      {group_of(operation, "Options"), reading_group(), door_group()});
}

Session list_session() {
  const Operation& operation = named("document.list");
  return Session({"list", "FILE ", operation.summary, "Example: keyline list examples/skin.json"},
                 {{"Reading the files", operation.request, {"file"}}, door_group()});
}

Session plain_session(const Operation& operation) {
  const bool files = has_field(operation, "file") || has_field(operation, "files");
  return Session({operation.name, files ? "[FILE...] " : "", operation.summary, "",
                  operations::further_options(operation)},
                 {{"Options", operation.request, {}}, door_group()}, files);
}

}  // namespace

std::span<const Tool> tools() { return kTools; }

int run_tool(const Tool& tool, const Words& words) {
  Session session = tool_session(tool);
  if (const auto status = session.begin(words)) return *status;
  if (session.files().empty())
    return report_failure(
        {core::ErrorCode::bad_input, "no file is named", session.usage_hint(), ""});
  const Operation& operation = named(tool.operation);
  if (auto done = check_outputs(session, operation); !done) return report_failure(done.error());
  Made made;
  if (auto done = run_on_files(session, operation, made); !done)
    return report_failure(done.error());
  return finish(session, made);
}

Manual tool_manual(const Tool& tool) { return tool_session(tool).manual(); }

int run_list(const Words& words) {
  Session session = list_session();
  if (const auto status = session.begin(words)) return *status;
  if (session.files().empty())
    return report_failure(
        {core::ErrorCode::bad_input, "no file is named", session.usage_hint(), ""});
  if (auto done = check_outputs(session, named("document.list")); !done)
    return report_failure(done.error());
  session.of(0)["file"] = session.files();
  const auto outcome = session.perform("document.list", session.of(0), session.progress());
  end_progress();
  if (!outcome) return report_failure(outcome.error());
  const auto listed = shown_of(*outcome);
  if (!listed) return report_failure(listed.error());
  session.print(*listed, list_text(*listed));
  return kDone;
}

Manual list_manual() { return list_session().manual(); }

int run_plain(const std::string& name, const Words& words) {
  const Operation& operation = named(name);
  Session session = plain_session(operation);
  if (const auto status = session.begin(words)) return *status;
  if (auto done = check_outputs(session, operation); !done) return report_failure(done.error());
  json request = session.of(0);
  const auto& files = session.files();
  if (!files.empty()) request["file"] = files.size() == 1 ? json(files.front()) : json(files);
  Made made;
  made.document["unit"] = session.arguments().option_files().unit();
  if (auto done = run_one(session, operation, request, {}, session.progress(), made); !done)
    return report_failure(done.error());
  return finish(session, made);
}

Manual plain_manual(const std::string& operation) {
  return plain_session(named(operation)).manual();
}

}  // namespace keyline::app
