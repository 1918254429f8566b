#include "keyline/operations/schema.h"

#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "keyline/operations/common.h"
#include "keyline/operations/json_form.h"

namespace keyline::operations {
namespace {

using core::Bounds;
using core::Field;
using core::Type;
using nlohmann::json;
using Kind = Type::Kind;

/// Makes schemas and gathers the definitions they refer to.
class Schemas {
 public:
  json of(const Type& type, const Field& field) {
    switch (type.kind) {
      case Kind::boolean:
        return {{"type", "boolean"}};
      case Kind::integer:
      case Kind::number:
        return number(type.kind == Kind::integer, field.bounds);
      case Kind::text:
        return {{"type", "string"}};
      case Kind::choice:
        return {{"enum", words(type)}};
      case Kind::point:
        return named_value("Point");
      case Kind::point3:
        return named_value("Point3");
      case Kind::interval:
        return list_of(number(false, field.bounds), 2, 2);
      case Kind::optional:
        return of(type.item(), field);
      case Kind::list:
        return list(type, field);
      case Kind::record:
        return record_reference(type);
      case Kind::one_of:
        return one_of(type, field);
      case Kind::value:
        needs_values_ = true;
        return json::parse(static_cast<const ValueForm*>(type.form)->schema);
    }
    return json::object();
  }

  /// The properties and required names of a record, into those given.
  void add_record(const Type& type, const void* owner, json& properties, json& required) {
    core::visit_fields(type, owner, [&](const Field& field, const void* member) {
      const std::string name(field.name);
      json schema = of(field.type(), field);
      if (field.or_null) schema = {{"anyOf", json::array({std::move(schema), {{"type", "null"}}})}};
      schema["description"] = std::string(field.text);
      if (!field.unit.empty()) schema["x-unit"] = std::string(field.unit);
      if (json value = default_of(field, member); !value.is_null())
        schema["default"] = std::move(value);
      properties[name] = std::move(schema);
      if (field.required) required.push_back(name);
    });
  }

  json definitions() const {
    json all = definitions_;
    if (needs_values_) all.update(value_schemas());
    return all;
  }

 private:
  static json words(const Type& type) {
    json list = json::array();
    for (std::size_t i = 0; i < type.word_count; ++i) list.push_back(std::string(type.words[i]));
    return list;
  }

  static json number(bool whole, const Bounds& bounds) {
    json j{{"type", whole ? "integer" : "number"}};
    const auto put = [&](double value, const char* name) {
      if (!std::isfinite(value)) return;
      j[name] = whole ? json(static_cast<std::int64_t>(value)) : json(value);
    };
    put(bounds.low, bounds.low_excluded ? "exclusiveMinimum" : "minimum");
    put(bounds.high, bounds.high_excluded ? "exclusiveMaximum" : "maximum");
    return j;
  }

  static json list_of(json items, std::size_t least, std::size_t most) {
    json j{{"type", "array"}, {"items", std::move(items)}};
    if (least > 0) j["minItems"] = least;
    if (most < std::numeric_limits<std::size_t>::max()) j["maxItems"] = most;
    return j;
  }

  json list(const Type& type, const Field& field) {
    json item = of(type.item(), field);
    if (type.item().kind == Kind::optional)
      item = {{"anyOf", json::array({std::move(item), {{"type", "null"}}})}};
    json all = type.fixed > 0 ? list_of(item, type.fixed, type.fixed)
                              : list_of(item, field.least, field.most);
    if (!field.or_one) return all;
    return {{"anyOf", json::array({std::move(item), std::move(all)})}};
  }

  json one_of(const Type& type, const Field& field) {
    json any = json::array();
    for (std::size_t i = 0; i < type.alternative_count; ++i)
      any.push_back(of(type.alternatives[i](), field));
    return {{"anyOf", std::move(any)}};
  }

  json named_value(const char* name) {
    needs_values_ = true;
    return {{"$ref", std::string("#/$defs/") + name}};
  }

  json record_reference(const Type& type) {
    const std::string name(type.name);
    if (!definitions_.contains(name)) {
      definitions_[name] = json::object();  // ends the recursion of types that hold themselves
      json properties = json::object();
      json required = json::array();
      add_record(type, type.make().get(), properties, required);
      definitions_[name] = {{"type", "object"},
                            {"properties", std::move(properties)},
                            {"required", std::move(required)},
                            {"additionalProperties", false}};
    }
    json reference{{"$ref", "#/$defs/" + name}};
    if (!type.from_text) return reference;
    return {{"anyOf",
             json::array({std::move(reference),
                          {{"type", "string"}, {"description", std::string(type.text_form)}}})}};
  }

  json definitions_ = json::object();
  bool needs_values_ = false;
};

json example_of(const Operation& operation, const std::string& text) {
  json example = json::parse(text);
  example["op"] = operation.name;
  return example;
}

json object_schema(const std::string& title, const std::string& text, json properties,
                   json required, const Schemas& schemas) {
  json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", title},
              {"description", text},
              {"type", "object"},
              {"properties", std::move(properties)},
              {"required", std::move(required)},
              {"additionalProperties", false}};
  if (json definitions = schemas.definitions(); !definitions.empty())
    schema["$defs"] = std::move(definitions);
  return schema;
}

constexpr const char* kCurveSchema = R"({"type": "object", "required": ["type"], "oneOf": [
  {"properties": {"type": {"const": "polyline"}, "points": {"$ref": "#/$defs/Points"}},
   "required": ["points"]},
  {"properties": {"type": {"const": "bezier"}, "points": {"$ref": "#/$defs/Points"},
                  "weights": {"$ref": "#/$defs/Numbers"}},
   "required": ["points"]},
  {"properties": {"type": {"const": "bspline"},
                  "degree": {"type": "integer", "minimum": 1, "maximum": 30},
                  "knots": {"$ref": "#/$defs/Numbers"}, "points": {"$ref": "#/$defs/Points"},
                  "weights": {"$ref": "#/$defs/Numbers"}},
   "required": ["degree", "knots", "points"]},
  {"properties": {"type": {"const": "log-aesthetic"}, "start": {"$ref": "#/$defs/Point"},
                  "direction": {"type": "number"}, "closed": {"type": "boolean"},
                  "pieces": {"type": "array", "minItems": 1, "items": {
                    "type": "object", "required": ["alpha", "length"],
                    "properties": {"alpha": {"type": "number"},
                                   "length": {"type": "number", "exclusiveMinimum": 0},
                                   "curvature": {"$ref": "#/$defs/Pair"},
                                   "radius": {"$ref": "#/$defs/Pair"}},
                    "oneOf": [{"required": ["curvature"]}, {"required": ["radius"]}]}}},
   "required": ["start", "direction", "pieces"]},
  {"properties": {"type": {"const": "log-aesthetic-space"},
                  "start": {"$ref": "#/$defs/Point3"},
                  "frame": {"type": "array", "items": {"$ref": "#/$defs/Point3"},
                            "minItems": 3, "maxItems": 3},
                  "pieces": {"type": "array", "minItems": 1, "items": {
                    "type": "object",
                    "required": ["alpha", "beta", "length", "curvature", "torsion"],
                    "properties": {"alpha": {"type": "number"}, "beta": {"type": "number"},
                                   "length": {"type": "number", "exclusiveMinimum": 0},
                                   "curvature": {"$ref": "#/$defs/Pair"},
                                   "torsion": {"$ref": "#/$defs/Pair"}}}}},
   "required": ["start", "frame", "pieces"]},
  {"properties": {"type": {"const": "path"}, "closed": {"type": "boolean"},
                  "curves": {"type": "array", "items": {"$ref": "#/$defs/Curve"},
                             "minItems": 1}},
   "required": ["curves"]}]})";

constexpr const char* kSurfaceSchema =
    R"({"type": "object", "required": ["type", "points"], "oneOf": [
  {"properties": {"type": {"const": "bezier-surface"}, "points": {"$ref": "#/$defs/Grid"},
                  "weights": {"type": "array", "items": {"$ref": "#/$defs/Numbers"}}}},
  {"properties": {"type": {"const": "bspline-surface"}, "points": {"$ref": "#/$defs/Grid"},
                  "degree": {"type": "array", "minItems": 2, "maxItems": 2,
                             "items": {"type": "integer", "minimum": 1, "maximum": 30}},
                  "knots": {"type": "array", "items": {"$ref": "#/$defs/Numbers"},
                            "minItems": 2, "maxItems": 2},
                  "weights": {"type": "array", "items": {"$ref": "#/$defs/Numbers"}}},
   "required": ["degree", "knots"]}]})";

constexpr const char* kListSchemas = R"({
  "Point": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2},
  "Point3": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 3},
  "Points": {"type": "array", "items": {"$ref": "#/$defs/Point3"}, "minItems": 2},
  "Pair": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2},
  "Numbers": {"type": "array", "items": {"type": "number"}},
  "Grid": {"type": "array", "items": {"$ref": "#/$defs/Points"}, "minItems": 2}})";

}  // namespace

json default_of(const core::Field& field, const void* member) {
  const Type& type = field.type();
  if (field.required || type.kind == Kind::one_of || type.kind == Kind::value) return {};
  if (type.kind == Kind::point || type.kind == Kind::point3 || type.kind == Kind::interval)
    return {};
  if (type.kind == Kind::number &&
      !core::contains(field.bounds, *static_cast<const double*>(member)))
    return {};
  if (type.kind == Kind::integer &&
      !core::contains(field.bounds, static_cast<double>(type.integer(member))))
    return {};
  const auto written = write_json(type, member);
  return written && !written->empty() ? *written : json();
}

json request_schema(const Operation& operation) {
  Schemas schemas;
  json properties = json::object();
  json required = json::array({"op"});
  properties["op"] = {{"const", operation.name}};
  properties["id"] = {{"description", "given back with the answer"}};
  detail::Whole whole(operation);
  for (const Part& part : whole.parts(operation))
    schemas.add_record(*part.type, part.record, properties, required);
  json schema = object_schema(operation.name, operation.summary, std::move(properties),
                              std::move(required), schemas);
  for (const std::string& example : operation.examples)
    schema["examples"].push_back(example_of(operation, example));
  return schema;
}

json result_schema(const Operation& operation) {
  Schemas schemas;
  json properties = json::object();
  json required = json::array();
  schemas.add_record(*operation.result, operation.result->make().get(), properties, required);
  return object_schema(operation.name + " result", operation.summary, std::move(properties),
                       std::move(required), schemas);
}

const json& value_schemas() {
  static const json schemas = [] {
    json all = json::parse(kListSchemas);
    all["Curve"] = json::parse(kCurveSchema);
    all["Surface"] = json::parse(kSurfaceSchema);
    return all;
  }();
  return schemas;
}

}  // namespace keyline::operations
