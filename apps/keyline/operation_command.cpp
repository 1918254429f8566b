#include "operation_command.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/core/text.h"
#include "keyline/operations/json_form.h"
#include "keyline/operations/perform.h"

#include "arguments.h"
#include "result_table.h"
#include "terminal.h"
#include "words.h"

namespace keyline::app {
namespace {

using core::ErrorCode;
using core::fail;
using core::Field;
using core::Result;
using nlohmann::json;
using operations::Operation;
using Kind = core::Type::Kind;

/// A command on curves of files: its operation takes them as "curve", one by one, or as "curves".
struct Tool {
  const char* name;
  const char* operation;
  const char* text;
};
constexpr Tool kTools[] = {
    {"blend", "lac.blend", "a log-aesthetic curve from one curve into another"},
    {"compare", "curve.compare", "deviation and combs of two curves"},
    {"join", "curve.join", "curves end to end as one path"},
    {"list", "document.list", "what a file holds"},
    {"mirror", "curve.mirror", "the mirror image of curves"},
    {"offset", "curve.offset", "curves at a constant distance"},
    {"reverse", "curve.reverse", "curves from end to start"},
    {"split", "curve.split", "curves cut into parts"},
    {"trim", "curve.trim", "a part of curves"}};

const Tool* tool_named(const std::string& name) {
  const auto* const at = std::find_if(std::begin(kTools), std::end(kTools),
                                      [&](const Tool& tool) { return name == tool.name; });
  return at == std::end(kTools) ? nullptr : at;
}

/// What stands beside an operation's own fields on every such command line.
struct DoorOptions {
  std::vector<std::string> output;
  bool json = false;
  bool quiet = false;
  bool help = false;
  static constexpr auto describe() {
    return core::fields(
        core::field<&DoorOptions::output>("file to write; may be repeated"),
        core::field<&DoorOptions::json>("print the result object on standard output"),
        core::field<&DoorOptions::quiet>("no messages but errors"),
        core::field<&DoorOptions::help>("this text"));
  }
};

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
    if (member && its->kind == Kind::list) text += table_of(*its, member);
    if (!member || its->kind > Kind::choice) return;
    const auto shown = operations::write_json(*its, member);
    if (!shown) return;
    const std::string said = shown->is_number_float() ? core::number_text(shown->get<double>(), 8)
                             : shown->is_string()     ? shown->get<std::string>()
                                                      : shown->dump();
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

/// What a command did, to be written and told.
struct Session {
  json shown = json::array();
  json named = json::array();     ///< curves to write
  json surfaces = json::array();  ///< surfaces to write
  std::string text;
  std::string unit;
};

Result<void> run_one(const Operation& operation, const json& request, const std::string& name,
                     Session& session) {
  const auto outcome =
      operations::carry_out(operation.name, request, {0, interactive_progress(true)});
  if (!outcome) return std::unexpected(as_options(outcome.error()));
  auto result = operations::result_json(*outcome);
  if (!result) return std::unexpected(result.error());
  std::vector<json> curves;
  gather_curves(*result, curves);
  for (std::size_t i = 0; i < curves.size(); ++i)
    session.named.push_back({{"name", curves.size() > 1 ? fmt::format("{}/{}", name, i + 1) : name},
                             {"curve", curves[i]}});
  if (result->contains("surface") && (*result)["surface"].is_object())
    session.surfaces.push_back({{"name", name}, {"surface", (*result)["surface"]}});
  session.text +=
      (name.empty() ? "" : name + "\n") + summary(*operation.result, outcome->result.get());
  session.shown.push_back(std::move(*result));
  return {};
}

Result<void> write_files(const json& door, const Session& session, const json& tolerance) {
  if (!door.contains("output")) return {};
  json request{{"file", door["output"]}, {"curves", session.named}, {"surfaces", session.surfaces}};
  if (!session.unit.empty()) request["unit"] = session.unit;
  if (!tolerance.is_null()) request["tolerance"] = tolerance;
  const auto written = operations::perform("document.write", request, {});
  if (!written) return std::unexpected(written.error());
  for (const json& one : (*written)["written"])
    for (const json& note : one["notes"])
      say(door.value("quiet", false),
          one["file"].get<std::string>() + ": " + note.get<std::string>());
  return {};
}

int finish(const json& door, const Session& session, const json& tolerance) {
  if (auto done = write_files(door, session, tolerance); !done) return report_failure(done.error());
  const json shown =
      session.shown.size() == 1 ? session.shown[0] : json{{"results", session.shown}};
  if (door.value("json", false))
    fmt::print("{}\n", shown.dump());
  else if (!door.value("quiet", false))
    fmt::print("{}", session.text);
  return kDone;
}

/// An operation by its own name: every field an option.
int run_plain(const Operation& operation, const std::vector<std::string>& words) {
  Arguments arguments({operation.request, &core::type_of<DoorOptions>()});
  if (auto done = arguments.parse(words); !done) return report_failure(done.error());
  if (arguments.of(1).value("help", false)) {
    fmt::print("{}\n\nkeyline {} [options]\n\n{}\n{}", operation.summary, operation.name,
               arguments.help(0), arguments.help(1));
    return kDone;
  }
  if (!arguments.files.empty()) {
    if (!operation.reads_files)
      return report_failure({ErrorCode::bad_input, "this word belongs to no option",
                             "see keyline " + operation.name + " --help", arguments.files.front()});
    arguments.of(0)["file"] =
        arguments.files.size() == 1 ? json(arguments.files.front()) : json(arguments.files);
  }
  Session session;
  if (auto done = run_one(operation, arguments.of(0), "", session); !done)
    return report_failure(done.error());
  return finish(arguments.of(1), session, json());
}

/// A curve of document.read as a request has it.
json curve_of(const json& thing) {
  if (thing.contains("curve")) return thing["curve"];
  json points = thing["line"]["points"];
  if (thing["line"].value("closed", false)) points.push_back(points.front());
  return {{"type", "polyline"}, {"points", std::move(points)}};
}

Result<json> read_all(const std::vector<std::string>& files, const json& input, Session& session) {
  json all = json::array();
  for (const std::string& file : files) {
    json request = input;
    request["file"] = file;
    const auto read = operations::perform("document.read", request, {});
    if (!read) return std::unexpected(as_options(read.error()));
    if ((*read)["curves"].empty())
      return fail(ErrorCode::bad_input, "there is no curve in it", "give a file that holds one",
                  file);
    for (const json& thing : (*read)["curves"]) all.push_back(thing);
    session.unit = (*read)["unit"].get<std::string>();
  }
  return all;
}

bool has_field(const Operation& operation, std::string_view name) {
  bool found = false;
  core::visit_fields(*operation.request, operation.request->make().get(),
                     [&](const Field& field, void*) { found = found || field.name == name; });
  return found;
}

Result<void> run_on_curves(const Operation& operation, const json& request, const json& things,
                           Session& session) {
  if (has_field(operation, "curves")) {
    json whole = request;
    for (const json& thing : things) whole["curves"].push_back(curve_of(thing));
    return run_one(operation, whole, "", session);
  }
  for (const json& thing : things) {
    json one = request;
    one["curve"] = curve_of(thing);
    if (auto done = run_one(operation, one, thing["name"].get<std::string>(), session); !done)
      return done;
  }
  return {};
}

void print_things(const json& listed) {
  const auto text = [](const json& j) { return j.is_string() ? j.get<std::string>() : ""; };
  fmt::print("{:>4} {:<12} {:<24} {:<26} {:>12}  {}\n", "", "kind", "name", "type", "length",
             "bounding box" + (listed["unit"] == "" ? "" : " in " + text(listed["unit"])));
  int number = 0;
  for (const json& thing : listed["things"]) {
    const json& low = thing["box"]["low"];
    const json& high = thing["box"]["high"];
    fmt::print(
        "{:>4} {:<12} {:<24} {:<26} {:>12}  {:.6g},{:.6g},{:.6g} to {:.6g},{:.6g},{:.6g}\n",
        ++number, text(thing["kind"]),
        text(thing["name"]) + (thing["layer"] == "" ? "" : " [" + text(thing["layer"]) + "]"),
        text(thing["type"]),
        thing.contains("length") ? core::number_text(thing["length"].get<double>(), 6) : "",
        low[0].get<double>(), low[1].get<double>(), low[2].get<double>(), high[0].get<double>(),
        high[1].get<double>(), high[2].get<double>());
  }
  for (const json& skipped : listed["skipped"]) fmt::print("skipped: {}\n", text(skipped));
}

int run_list(const Operation& operation, const std::vector<std::string>& words) {
  Arguments arguments({operation.request, &core::type_of<DoorOptions>()});
  if (auto done = arguments.parse(words); !done) return report_failure(done.error());
  if (arguments.of(1).value("help", false) || arguments.files.empty()) {
    fmt::print("{}\n\nkeyline list FILE [options]\n\n{}", operation.summary, arguments.help(0));
    return arguments.files.empty() && !arguments.of(1).value("help", false) ? kBadInput : kDone;
  }
  arguments.of(0)["file"] = arguments.files;
  const auto listed = operations::perform(operation.name, arguments.of(0), {});
  if (!listed) return report_failure(as_options(listed.error()));
  if (arguments.of(1).value("json", false))
    fmt::print("{}\n", listed->dump());
  else
    print_things(*listed);
  return kDone;
}

int run_tool(const Tool& tool, const std::vector<std::string>& words) {
  const Operation& operation = *operations::find_operation(tool.operation);
  if (tool.operation == std::string_view("document.list")) return run_list(operation, words);
  const Operation& reader = *operations::find_operation("document.read");
  Arguments arguments({operation.request, &core::type_of<DoorOptions>(), reader.request});
  if (auto done = arguments.parse(words); !done) return report_failure(done.error());
  const json& door = arguments.of(1);
  if (door.value("help", false)) {
    fmt::print("{}\n\nkeyline {} FILE... [options]\n\n{}\n{}\nReading the files:\n{}",
               operation.summary, tool.name, arguments.help(0), arguments.help(1),
               arguments.help(2));
    return kDone;
  }
  if (arguments.files.empty())
    return report_failure({ErrorCode::bad_input, "no file is named",
                           fmt::format("see keyline {} --help", tool.name), ""});
  Session session;
  const auto things = read_all(arguments.files, arguments.of(2), session);
  if (!things) return report_failure(things.error());
  if (auto done = run_on_curves(operation, arguments.of(0), *things, session); !done)
    return report_failure(done.error());
  return finish(door, session, arguments.of(0).value("tolerance", json()));
}

}  // namespace

bool is_operation_command(const std::string& name) {
  return tool_named(name) || operations::find_operation(name);
}

int run_operation_command(const std::string& name, const std::vector<std::string>& arguments) {
  if (const Tool* tool = tool_named(name)) return run_tool(*tool, arguments);
  return run_plain(*operations::find_operation(name), arguments);
}

std::string tools_help() {
  std::string text = "On curves of files (keyline NAME --help tells more):\n";
  for (const Tool& tool : kTools) text += fmt::format("  {:<27} {}\n", tool.name, tool.text);
  return text +
         "Every operation is a command too (keyline perform NAME, or its name alone):\n"
         "  keyline lac.segment --points 0,0 2,0 3,1.5 --alpha -1\n"
         "  keyline library find --rhythm accelerating --slope -1±0.2\n";
}

std::string bash_completion(const std::vector<std::string>& other_commands) {
  std::string names;
  for (const std::string& name : other_commands) names += name + " ";
  for (const Tool& tool : kTools) names += std::string(tool.name) + " ";
  std::string cases;
  for (const Operation& operation : operations::operations()) {
    names += operation.name + " ";
    std::string options = "--output --json --quiet --help";
    core::visit_fields(
        *operation.request, operation.request->make().get(),
        [&](const Field& field, void*) { options += " " + option_name(field.name); });
    std::string labels = operation.name;
    for (const Tool& tool : kTools)
      if (operation.name == tool.operation) labels += std::string("|") + tool.name;
    cases += fmt::format("    {}) words=\"{}\" ;;\n", labels, options);
  }
  return "_keyline() {\n  local words=\"\"\n  case \"${COMP_WORDS[1]}\" in\n" + cases +
         "  esac\n  [ \"$COMP_CWORD\" -eq 1 ] && words=\"" + names +
         "\"\n  COMPREPLY=($(compgen -W \"$words\" -- \"${COMP_WORDS[COMP_CWORD]}\"))\n}\n"
         "complete -o default -F _keyline keyline\n";
}

}  // namespace keyline::app
