#include "keyline/operations/operation.h"

#include <algorithm>
#include <exception>

#include "keyline/exchange/json_text.h"
#include "keyline/operations/derived_forms.h"
#include "keyline/operations/fields.h"
#include "keyline/operations/registry.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::Failure;
using core::Result;
using nlohmann::json;

json point_schema() {
  return {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 3}};
}

json curve_schema() {
  return {{"type", "object"},
          {"required", {"type"}},
          {"properties",
           {{"type", {{"enum", {"polyline", "bezier", "bspline", "log-aesthetic", "path"}}}}}}};
}

json surface_schema() {
  return {{"type", "object"},
          {"required", {"type", "points"}},
          {"properties", {{"type", {{"enum", {"bezier-surface", "bspline-surface"}}}}}}};
}

json list_of(json items) { return {{"type", "array"}, {"items", std::move(items)}}; }

json type_schema(Field::Type type) {
  switch (type) {
    case Field::Type::number:
      return {{"type", "number"}};
    case Field::Type::integer:
      return {{"type", "integer"}};
    case Field::Type::boolean:
      return {{"type", "boolean"}};
    case Field::Type::string:
      return {{"type", "string"}};
    case Field::Type::point:
    case Field::Type::point3:
      return point_schema();
    case Field::Type::points:
    case Field::Type::points3:
      return list_of(point_schema());
    case Field::Type::numbers:
      return list_of({{"type", "number"}});
    case Field::Type::number_or_numbers:
      return {{"oneOf", json::array({{{"type", "number"}}, list_of({{"type", "number"}})})}};
    case Field::Type::curve:
      return curve_schema();
    case Field::Type::curves:
      return list_of(curve_schema());
    case Field::Type::surface:
      return surface_schema();
    case Field::Type::surfaces:
      return list_of(surface_schema());
    case Field::Type::any:
      break;
  }
  return json::object();
}

/// Whether "samples", "bezier" and "nurbs" have a curve to add to.
bool returns_curves(const std::string& name) {
  static constexpr const char* kOthers[] = {"lac.region", "curve.analyze", "curve.cav",
                                            "curve.continuity"};
  return !name.starts_with("surface.") &&
         std::find(std::begin(kOthers), std::end(kOthers), name) == std::end(kOthers);
}

json form_schema(const char* what) {
  return {{"description", std::string("adds the curve as ") + what +
                              " within the tolerance, a length, with the deviation it meets"},
          {"type", "object"},
          {"required", {"tolerance"}},
          {"properties",
           {{"degree", {{"type", "integer"}, {"minimum", 3}, {"maximum", 30}, {"default", 3}}},
            {"tolerance", {{"type", "number"}, {"exclusiveMinimum", 0}}}}}};
}

void add_form_schemas(json& properties) {
  properties["samples"] = {{"description", "adds the curve as a polyline of so many points"},
                           {"type", "integer"},
                           {"minimum", 2},
                           {"maximum", 10'000'000}};
  properties["bezier"] = form_schema("Beziers");
  properties["nurbs"] = form_schema("a B-spline");
}

json failed(const json& id, const Failure& failure) {
  return {{"id", id}, {"ok", false}, {"error", failure_json(failure)}};
}

Result<json> guarded(const Operation& operation, const json& request, const Context& context) {
  try {
    if (auto sound = check_fields(operation, request); !sound)
      return std::unexpected(sound.error());
    Context asked = context;
    if (request.contains("threads")) {
      const auto threads = integer_between(request, "threads", 0, 0, 1024);
      if (!threads) return std::unexpected(threads.error());
      asked.threads = *threads;
    }
    auto result = operation.run(request, asked);
    if (!result) return result;
    if (auto added = add_derived_forms(request, *result); !added)
      return std::unexpected(added.error());
    return result;
  } catch (const core::InvalidInput& e) {
    return core::fail(ErrorCode::bad_input, e.what());
  } catch (const std::bad_alloc&) {
    return core::fail(ErrorCode::internal, "out of memory", "give a smaller input");
  } catch (const std::exception& e) {
    return core::fail(ErrorCode::internal, e.what(), "please report this request");
  }
}

/// What a field is, or where to look, in place of a remedy that was not given.
std::string usual_hint(const Operation& operation, const std::string& path) {
  const std::string name = path.substr(0, path.find_first_of(".["));
  for (const Field& field : operation.fields)
    if (field.name == name && path == name) return field.text;
  return "keyline operations " + operation.name + " tells what it takes";
}

}  // namespace

const std::vector<Operation>& operations() {
  static const std::vector<Operation> all = [] {
    std::vector<Operation> list = all_operations();
    std::sort(list.begin(), list.end(),
              [](const Operation& a, const Operation& b) { return a.name < b.name; });
    return list;
  }();
  return all;
}

const Operation* find_operation(const std::string& name) {
  for (const Operation& operation : operations())
    if (operation.name == name) return &operation;
  return nullptr;
}

json request_schema(const Operation& operation) {
  json properties = json::object();
  json required = json::array({"op"});
  properties["op"] = {{"const", operation.name}};
  properties["id"] = {{"description", "given back with the answer"}};
  properties["threads"] = {{"description", "0: all; the result does not depend on it"},
                           {"type", "integer"},
                           {"minimum", 0},
                           {"maximum", 1024}};
  for (const Field& field : operation.fields) {
    json schema = type_schema(field.type);
    schema["description"] = field.text;
    properties[field.name] = std::move(schema);
    if (field.required) required.push_back(field.name);
  }
  if (returns_curves(operation.name)) add_form_schemas(properties);
  json example = operation.example;
  example["op"] = operation.name;
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"title", operation.name},
          {"description", operation.summary},
          {"type", "object"},
          {"properties", std::move(properties)},
          {"required", std::move(required)},
          {"additionalProperties", false},
          {"examples", json::array({std::move(example)})}};
}

Result<json> perform(const std::string& name, const json& request, const Context& context) {
  const Operation* operation = find_operation(name);
  if (!operation)
    return core::fail(ErrorCode::unsupported, "there is no operation \"" + name + "\"",
                      "keyline operations lists them", "op");
  auto result = guarded(*operation, request, context);
  if (!result && result.error().hint.empty())
    result.error().hint = usual_hint(*operation, result.error().path);
  return result;
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

std::string answer_line(const std::string& line, const Context& context) {
  const auto request = exchange::parse_json(line);
  const json given = request ? answer(*request, context)
                             : failed(nullptr, {ErrorCode::bad_input, request.error().message,
                                                "give one JSON object per line", ""});
  return given.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace keyline::operations
