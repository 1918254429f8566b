#include <fmt/format.h>

#include "keyline/operations/references.h"
#include "keyline/operations/schema.h"

#include "session.h"
#include "terminal.h"
#include "words.h"

namespace keyline::app {
namespace {

enum class Reference { schema, result, typescript, python, openapi, markdown };
constexpr auto choices(const Reference*) {
  return core::words<Reference>({{Reference::schema, "schema"},
                                 {Reference::result, "result"},
                                 {Reference::typescript, "typescript"},
                                 {Reference::python, "python"},
                                 {Reference::openapi, "openapi"},
                                 {Reference::markdown, "markdown"}});
}

struct OperationsWords {
  std::optional<Reference> format;
  static constexpr auto describe() {
    return core::fields(core::field<&OperationsWords::format>(
        "of one: schema, result (its schema) or markdown; of all: schema, typescript, python, "
        "openapi or markdown"));
  }
};

Session new_session() {
  OptionGroup door = door_group();
  door.without = {"output", "tolerance", "seed"};
  return Session(
      {"operations", "[NAME] ", "Lists what can be requested; with a name, prints its JSON Schema.",
       "Example: keyline operations lac.segment"},
      {{"Reference", &core::type_of<OperationsWords>(), {}}, door});
}

/// Everything about every operation in one go.
int print_all(Reference format) {
  switch (format) {
    case Reference::typescript:
      fmt::print("{}", operations::typescript_types());
      break;
    case Reference::python:
      fmt::print("{}", operations::python_stubs());
      break;
    case Reference::openapi:
      fmt::print("{}\n", operations::openapi_document().dump(1));
      break;
    case Reference::markdown:
      for (const auto& operation : operations::operations())
        fmt::print("{}\n", operations::reference_page(operation));
      break;
    case Reference::schema:
    case Reference::result:
      nlohmann::json all = nlohmann::json::object();
      for (const auto& operation : operations::operations())
        all[operation.name] = {{"request", operations::request_schema(operation)},
                               {"result", operations::result_schema(operation)}};
      fmt::print("{}\n", all.dump(1));
  }
  return kDone;
}

int print_list(bool as_json) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& operation : operations::operations()) {
    if (as_json)
      list.push_back({{"name", operation.name}, {"summary", operation.summary}});
    else
      fmt::print("{:<22} {}\n", operation.name, operation.summary);
  }
  if (as_json) fmt::print("{}\n", list.dump());
  return kDone;
}

int print_one(const std::string& name, Reference format) {
  const operations::Operation* operation = operations::find_operation(name);
  if (!operation)
    return report_failure({core::ErrorCode::bad_input, "there is no operation \"" + name + "\"",
                           "keyline operations lists them", ""});
  if (format == Reference::markdown)
    fmt::print("{}", operations::reference_page(*operation));
  else if (format == Reference::result)
    fmt::print("{}\n", operations::result_schema(*operation).dump(2));
  else if (format == Reference::schema)
    fmt::print("{}\n", operations::request_schema(*operation).dump(2));
  else
    return report_failure({core::ErrorCode::bad_input, "this format is of all operations",
                           "leave the name out, or use schema, result or markdown", "--format"});
  return kDone;
}

}  // namespace

int run_operations(const Words& words) {
  Session session = new_session();
  if (const auto status = session.begin(words)) return *status;
  const auto asked = session.record<OperationsWords>(0);
  if (!asked) return report_failure(asked.error());
  if (session.files().empty())
    return asked->format ? print_all(*asked->format) : print_list(session.door().json);
  return print_one(session.files().front(), asked->format.value_or(Reference::schema));
}

Manual operations_manual() { return new_session().manual(); }

}  // namespace keyline::app
