#include "keyline/operations/perform.h"

#include <exception>

#include <nlohmann/json.hpp>

#include "keyline/exchange/format/format.h"
#include "keyline/exchange/json/json_text.h"
#include "keyline/operations/common.h"
#include "keyline/operations/sound_result.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Failure;
using core::Result;
using nlohmann::json;

json failed(const json& id, const Failure& failure) {
  return {{"id", id}, {"ok", false}, {"error", failure_json(failure)}};
}

/// Fails where a request names the door's own input or output that is not its to use.
Result<void> check_streams(const Operation& operation, const json& request,
                           const Context& context) {
  if (context.standard_streams || !(operation.reads_files || operation.writes_files)) return {};
  for (const char* field : {"file", "to"}) {
    const auto at = request.find(field);
    if (at == request.end()) continue;
    for (const json& name : at->is_array() ? *at : json::array({*at}))
      if (name.is_string() && exchange::is_standard_stream(name.get<std::string>()))
        return core::fail(ErrorCode::bad_input, "\"-\" carries the requests here, it holds no file",
                          "name a file", field);
  }
  return {};
}

Result<Outcome> run_typed(const Operation& operation, const json& request, Context context) {
  detail::Whole whole(operation);
  const std::vector<Part> parts = whole.parts(operation);
  if (auto read = read_json(request, parts, detail::kEnvelope, operation.name); !read)
    return std::unexpected(std::move(read.error()));
  if (auto own = check_streams(operation, request, context); !own)
    return std::unexpected(std::move(own.error()));
  if (context.progress.stop_requested())
    return core::fail(ErrorCode::cancelled, "cancelled before it began");
  if (operation.long_running) context.progress.report(0, operation.name);
  if (whole.common.threads > 0) context.threads = whole.common.threads;
  auto result = operation.run(whole.own.get(), context);
  if (!result) return std::unexpected(std::move(result.error()));
  if (whole.with_forms)
    if (auto added = add_forms(*operation.result, result->get(), whole.forms); !added)
      return std::unexpected(std::move(added.error()));
  // What files hold was looked at when they were read.
  if (!operation.reads_files)
    if (auto sound = check_values(*operation.result, result->get()); !sound)
      return std::unexpected(explained(std::move(sound.error()), request));
  return Outcome{&operation, std::move(whole.own), std::move(*result)};
}

/// What a field is, or where to look, in place of a remedy that was not given.
std::string usual_hint(const Operation& operation, const std::string& path) {
  std::string hint;
  core::visit_fields(*operation.request, operation.request->make().get(),
                     [&](const core::Field& field, void*) {
                       if (field.name == path) hint = field.text;
                     });
  return hint.empty() ? "keyline operations " + operation.name + " tells what it takes" : hint;
}

/// The work with everything that is thrown inside as a failure, and a remedy to every failure.
template <class Answer, class Work>
Result<Answer> guarded(const Operation& operation, const Work& work) {
  auto result = [&]() -> Result<Answer> {
    try {
      return work();
    } catch (const core::InvalidInput& e) {
      return core::fail(ErrorCode::bad_input, e.what());
    } catch (const std::bad_alloc&) {
      return core::fail(ErrorCode::internal, "out of memory", "give a smaller input");
    } catch (const std::exception& e) {
      return core::fail(ErrorCode::internal, e.what(), "please report this request");
    }
  }();
  if (!result && result.error().hint.empty() && result.error().code != ErrorCode::cancelled)
    result.error().hint = usual_hint(operation, result.error().path);
  return result;
}

std::string text_of(const json& j) {
  return j.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// What the request leaves out and its operation takes.
void fill_in(json& request, const json& defaults) {
  if (!request.is_object()) return;
  const auto op = request.find("op");
  if (op == request.end() || !op->is_string()) return;
  const Operation* operation = find_operation(op->get<std::string>());
  if (!operation) return;
  core::visit_fields(*operation->request, operation->request->make().get(),
                     [&](const core::Field& field, void*) {
                       const std::string name(field.name);
                       if (!defaults.contains(name) || request.contains(name)) return;
                       if (name == "tolerance" && field.unit != "length") return;
                       request[name] = defaults[name];
                     });
}

std::unexpected<Failure> unknown(const std::string& name) {
  return core::fail(ErrorCode::unsupported, "there is no operation \"" + name + "\"",
                    "keyline operations lists them", "op");
}

}  // namespace

const core::Type* further_options(const Operation& operation) {
  return holds_made_curve(*operation.result) ? &core::type_of<Forms>() : nullptr;
}

Result<Outcome> carry_out(const std::string& name, const json& request, const Context& context) {
  const Operation* operation = find_operation(name);
  if (!operation) return unknown(name);
  return guarded<Outcome>(*operation, [&] { return run_typed(*operation, request, context); });
}

Result<json> result_json(const Outcome& outcome) {
  return write_json(*outcome.operation->result, outcome.result.get());
}

Result<json> perform(const std::string& name, const json& request, const Context& context) {
  const Operation* operation = find_operation(name);
  if (!operation) return unknown(name);
  return guarded<json>(*operation, [&]() -> Result<json> {
    const auto outcome = run_typed(*operation, request, context);
    if (!outcome) return std::unexpected(outcome.error());
    auto result = result_json(*outcome);
    if (!result) return std::unexpected(explained(std::move(result.error()), request));
    return result;
  });
}

json failure_json(const Failure& failure) {
  json j{{"code", core::code_name(failure.code)}, {"message", failure.message}};
  if (!failure.path.empty()) j["path"] = failure.path;
  if (!failure.hint.empty()) j["hint"] = failure.hint;
  return j;
}

json answer(const json& request, const Context& context) {
  const json id = request.is_object() && request.contains("id") ? request["id"] : json();
  if (!request.is_object())
    return failed(
        id, {ErrorCode::bad_input, "the request is not a JSON object", "give {\"op\":…}", ""});
  const auto op = request.find("op");
  if (op == request.end() || !op->is_string())
    return failed(id, {ErrorCode::bad_input, "\"op\" is missing", "name an operation", "op"});
  auto result = perform(op->get<std::string>(), request, context);
  if (!result) return failed(id, result.error());
  return {{"id", id}, {"ok", true}, {"result", std::move(*result)}};
}

Result<json> parse_request(std::string_view text) { return exchange::parse_json(text); }

std::string answer_line(const std::string& line, const Context& context) {
  return answer_line(line, context, json::object());
}

std::string answer_line(const std::string& line, const Context& context, const json& defaults) {
  auto request = parse_request(line);
  if (!request)
    return text_of(failed(nullptr, {ErrorCode::bad_input, request.error().message,
                                    request.error().hint + "; a line is one JSON object", ""}));
  if (!defaults.empty()) fill_in(*request, defaults);
  return text_of(answer(*request, context));
}

std::string failed_line(const std::string& line, const Failure& failure) {
  const auto request = exchange::parse_json(line);
  const bool named = request && request->is_object() && request->contains("id");
  return text_of(failed(named ? (*request)["id"] : json(), failure));
}

}  // namespace keyline::operations
