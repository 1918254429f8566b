#include "keyline/operations/references.h"

#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keyline/core/text.h"
#include "keyline/core/version.h"
#include "keyline/operations/common.h"
#include "keyline/operations/json_form.h"
#include "keyline/operations/schema.h"

namespace keyline::operations {
namespace {

using core::Field;
using core::Type;
using nlohmann::json;
using Kind = Type::Kind;

std::string upper_words(const std::string& name) {
  std::string all;
  bool upper = true;
  for (const char c : name) {
    if (c == '.' || c == '_') {
      upper = true;
      continue;
    }
    all += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = false;
  }
  return all;
}

std::string quoted_words(const Type& type, const char* separator) {
  std::string all;
  for (std::size_t i = 0; i < type.word_count; ++i)
    all += fmt::format("{}\"{}\"", i > 0 ? separator : "", type.words[i]);
  return all;
}

/// The records reachable from a type, each once, inner ones first.
class Records {
 public:
  /// An operation's own request or result goes by the operation's name.
  void add_own(const Type& type) {
    own_.insert(&type);
    walk(type);
  }
  void add(const Type& type) {
    held_.insert(&type);
    walk(type);
  }
  /// Whether it needs a name of its own: nothing else is called after it, or others hold it too.
  bool needs_name(const Type& type) const { return !own_.contains(&type) || held_.contains(&type); }
  std::vector<const Type*> all;

 private:
  void walk(const Type& type) {
    if (!seen_.insert(&type).second) return;
    if (type.item) add(type.item());
    for (std::size_t i = 0; i < type.alternative_count; ++i) add(type.alternatives[i]());
    if (type.kind != Kind::record) return;
    core::visit_fields(type, type.make().get(),
                       [this](const Field& field, void*) { add(field.type()); });
    all.push_back(&type);
  }

  std::set<const Type*> seen_;
  std::set<const Type*> own_;
  std::set<const Type*> held_;
};

/// One language: how it writes types and records.
struct Language {
  std::string (*type)(const Type& type, const Field& field);
  std::string (*record)(const std::string& name, const std::vector<Part>& parts);
};

std::string typescript_type(const Type& type, const Field& field) {
  switch (type.kind) {
    case Kind::boolean:
      return "boolean";
    case Kind::integer:
    case Kind::number:
      return "number";
    case Kind::text:
      return "string";
    case Kind::choice:
      return quoted_words(type, " | ");
    case Kind::point:
    case Kind::interval:
      return "[number, number]";
    case Kind::point3:
      return "[number, number] | [number, number, number]";
    case Kind::optional:
      return typescript_type(type.item(), field);
    case Kind::list: {
      const std::string null = type.item().kind == Kind::optional ? " | null" : "";
      const std::string item = typescript_type(type.item(), field) + null;
      const std::string list = "(" + item + ")[]";
      return field.or_one ? item + " | " + list : list;
    }
    case Kind::record:
      return std::string(type.name) + (type.from_text ? " | string" : "");
    case Kind::one_of: {
      std::string all;
      for (std::size_t i = 0; i < type.alternative_count; ++i)
        all += (i > 0 ? " | " : "") + typescript_type(type.alternatives[i](), field);
      return all;
    }
    case Kind::value:
      return std::string(type.name);
  }
  return "unknown";
}

std::string python_type(const Type& type, const Field& field) {
  switch (type.kind) {
    case Kind::boolean:
      return "bool";
    case Kind::integer:
      return "int";
    case Kind::number:
      return "float";
    case Kind::text:
      return "str";
    case Kind::choice:
      return "Literal[" + quoted_words(type, ", ") + "]";
    case Kind::point:
    case Kind::point3:
    case Kind::interval:
      return "Sequence[float]";
    case Kind::optional:
      return python_type(type.item(), field);
    case Kind::list: {
      const std::string null = type.item().kind == Kind::optional ? " | None" : "";
      const std::string item = python_type(type.item(), field) + null;
      return field.or_one ? item + " | Sequence[" + item + "]" : "Sequence[" + item + "]";
    }
    case Kind::record:
      return std::string(type.name) + (type.from_text ? " | str" : "");
    case Kind::one_of: {
      std::string all;
      for (std::size_t i = 0; i < type.alternative_count; ++i)
        all += (i > 0 ? " | " : "") + python_type(type.alternatives[i](), field);
      return all;
    }
    case Kind::value:
      return std::string(type.name);
  }
  return "object";
}

/// Each field of the parts: each(field, member, whether it may be left out).
template <class Each>
void each_field(const std::vector<Part>& parts, const Each& each) {
  for (const Part& part : parts)
    core::visit_fields(*part.type, part.record, [&](const Field& field, void* member) {
      each(field, member, !field.required);
    });
}

std::string typescript_record(const std::string& name, const std::vector<Part>& parts) {
  std::string text = "export interface " + name + " {\n";
  each_field(parts, [&](const Field& field, void*, bool optional) {
    text += fmt::format("  /** {}{} */\n  {}{}: {}{};\n", field.text,
                        field.unit.empty() ? "" : " (" + std::string(field.unit) + ")", field.name,
                        optional ? "?" : "", typescript_type(field.type(), field),
                        field.or_null ? " | null" : "");
  });
  return text + "}\n\n";
}

std::string python_record(const std::string& name, const std::vector<Part>& parts) {
  std::string text = name + " = TypedDict(\"" + name + "\", {\n";
  each_field(parts, [&](const Field& field, void*, bool optional) {
    const std::string type = python_type(field.type(), field) + (field.or_null ? " | None" : "");
    text +=
        fmt::format("    \"{}\": {},\n", field.name, optional ? "NotRequired[" + type + "]" : type);
  });
  return text + "})\n\n";
}

/// All records of all operations in one language, and the request of each whole.
std::string all_records(const Language& language) {
  Records records;
  std::string text;
  for (const Operation& operation : operations()) {
    records.add_own(*operation.request);
    records.add_own(*operation.result);
    records.add(core::type_of<Forms>());
  }
  for (const Type* type : records.all) {
    const auto owner = type->make();
    if (records.needs_name(*type))
      text += language.record(std::string(type->name), {{type, owner.get()}});
  }
  for (const Operation& operation : operations()) {
    const std::string name = upper_words(operation.name);
    detail::Whole whole(operation);
    text += language.record(name + "Request", whole.parts(operation));
    const auto owner = operation.result->make();
    text += language.record(name + "Result", {{operation.result, owner.get()}});
  }
  return text;
}

std::string range_text(const core::Bounds& b) {
  if (b == core::Bounds{}) return "";
  std::string text = bounds_in_words(b, false);
  return text.substr(text.find("number") + 7);
}

/// What a field means beside its name; its kind with unit and range; its default.
std::string field_row(const Field& field, const void* member) {
  const json value = default_of(field, member);
  std::string kind = typescript_type(field.type(), field);
  for (std::size_t at = kind.find('|'); at != std::string::npos; at = kind.find('|', at + 2))
    kind.insert(at, "\\");
  for (const std::string& more : {std::string(field.unit), range_text(field.bounds)})
    if (!more.empty()) kind += ", " + more;
  return fmt::format("| `{}` | {} | {} | {} |\n", field.name, field.text, kind,
                     field.required    ? "needed"
                     : value.is_null() ? ""
                                       : "`" + value.dump() + "`");
}

/// What fields that are left out are, as a constant that costs nothing where it is not used.
std::string typescript_defaults(const Operation& operation) {
  json defaults = json::object();
  detail::Whole whole(operation);
  each_field(whole.parts(operation), [&](const Field& field, void* member, bool) {
    if (json value = default_of(field, member); !value.is_null())
      defaults[std::string(field.name)] = std::move(value);
  });
  return fmt::format("export const defaultsOf{} = {} as const;\n", upper_words(operation.name),
                     defaults.dump());
}

/// Schemas by name, each with the definitions it brought along beside it.
class Definitions {
 public:
  /// Keeps the schema under `name`; returns what refers to it.
  json take(json schema, const std::string& name) {
    if (schema.contains("$defs")) {
      all_.update(schema["$defs"]);
      schema.erase("$defs");
    }
    schema.erase("$schema");
    all_[name] = std::move(schema);
    return json{{"$ref", "#/$defs/" + name}};
  }

  json all() && { return std::move(all_); }

 private:
  json all_ = json::object();
};

json request_body_schema(const Operation& operation) {
  json request = request_schema(operation);
  request["properties"].erase("op");
  request["required"].erase(request["required"].begin());
  for (json& example : request["examples"]) example.erase("op");
  return request;
}

json posted(const Operation& operation, Definitions& definitions) {
  const std::string name = upper_words(operation.name);
  const json answer{{"type", "object"},
                    {"required", {"ok"}},
                    {"properties",
                     {{"ok", {{"type", "boolean"}}},
                      {"id", json::object()},
                      {"result", definitions.take(result_schema(operation), name + "Result")},
                      {"error", {{"$ref", "#/$defs/Error"}}}}}};
  const auto content = [](json schema) {
    return json{{"application/json", {{"schema", std::move(schema)}}}};
  };
  const json request = definitions.take(request_body_schema(operation), name + "Request");
  return {{"operationId", operation.name},
          {"summary", operation.summary},
          {"requestBody", {{"required", true}, {"content", content(request)}}},
          {"responses", {{"200", {{"description", "the answer"}, {"content", content(answer)}}}}}};
}

json error_schema() {
  json codes = json::array();
  for (int code = 0; code <= static_cast<int>(core::ErrorCode::internal); ++code)
    codes.push_back(core::code_name(static_cast<core::ErrorCode>(code)));
  const json text{{"type", "string"}};
  return {{"type", "object"},
          {"required", {"code", "message"}},
          {"properties",
           {{"code", {{"enum", codes}}}, {"message", text}, {"path", text}, {"hint", text}}}};
}

}  // namespace

std::string typescript_types() {
  std::string text =
      "// Made by keyline operations --format typescript. Do not edit.\n\n"
      "export type Curve = { type: string; [member: string]: unknown };\n"
      "export type BoundedCurve = Curve & { deviation: number };\n"
      "export type Surface = { type: string; points: number[][][]; [member: string]: unknown "
      "};\n\n";
  text += all_records({typescript_type, typescript_record});
  text += "export interface Operations {\n";
  for (const Operation& operation : operations()) {
    const std::string name = upper_words(operation.name);
    text += fmt::format("  /** {} */\n  \"{}\": {{ request: {}Request; result: {}Result }};\n",
                        operation.summary, operation.name, name, name);
  }
  text += "}\n\n";
  for (const Operation& operation : operations()) text += typescript_defaults(operation);
  return text;
}

std::string python_stubs() {
  std::string text =
      "# Made by keyline operations --format python. Do not edit.\n"
      "from typing import Any, Literal, NotRequired, Sequence, TypedDict\n\n"
      "Curve = dict[str, Any]\nBoundedCurve = dict[str, Any]\nSurface = dict[str, Any]\n\n";
  text += all_records({python_type, python_record});
  for (const Operation& operation : operations()) {
    std::string name = operation.name;
    std::replace(name.begin(), name.end(), '.', '_');
    text += fmt::format("def {}(request: {}Request) -> {}Result:\n    \"\"\"{}\"\"\"\n    ...\n\n",
                        name, upper_words(operation.name), upper_words(operation.name),
                        operation.summary);
  }
  return text;
}

json openapi_document() {
  json paths = json::object();
  Definitions definitions;
  for (const Operation& operation : operations())
    paths["/api/v1/" + operation.name]["post"] = posted(operation, definitions);
  definitions.take(error_schema(), "Error");
  const json document{{"openapi", "3.1.0"},
                      {"info", {{"title", "Keyline"}, {"version", core::version()}}},
                      {"paths", std::move(paths)},
                      {"components", {{"schemas", std::move(definitions).all()}}}};
  std::string whole = document.dump();
  const std::string from = "#/$defs/";
  const std::string to = "#/components/schemas/";
  for (std::size_t at = whole.find(from); at != std::string::npos; at = whole.find(from, at))
    whole.replace(at, from.size(), to);
  return json::parse(whole);
}

std::string reference_page(const Operation& operation) {
  const char* head = "| field | means | kind, unit, range | default |\n|---|---|---|---|\n";
  std::string text =
      fmt::format("# {}\n\n{}\n\n## Request\n\n{}", operation.name, operation.summary, head);
  detail::Whole whole(operation);
  each_field(whole.parts(operation),
             [&](const Field& field, void* member, bool) { text += field_row(field, member); });
  text += fmt::format("\n## Result\n\n{}", head);
  const auto owner = operation.result->make();
  core::visit_fields(*operation.result, owner.get(),
                     [&](const Field& field, void* member) { text += field_row(field, member); });
  text += "\n## Examples\n\n```json\n";
  for (const std::string& example : operation.examples) {
    json request = json::parse(example);
    request["op"] = operation.name;
    text += request.dump() + "\n";
  }
  return text + "```\n";
}

}  // namespace keyline::operations
