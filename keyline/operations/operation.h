#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "keyline/core/error.h"
#include "keyline/core/progress.h"

/// Every capability once: a named function from a request object to a result object. The command
/// line, batch, the HTTP server and Python all go through here; CONTRACT lists the names.
namespace keyline::operations {

/// How a request is served; nothing in it changes a result.
struct Context {
  int threads = 0;  ///< 0: all of the machine's
  core::Progress progress;
};

/// One field of a request: what the schema says of it and what reading it checks.
struct Field {
  enum class Type {
    number,
    integer,
    boolean,
    string,
    point,
    points,
    point3,
    points3,
    numbers,
    number_or_numbers,
    curve,
    curves,
    surface,
    surfaces,
    any
  };
  std::string name;
  Type type = Type::any;
  bool required = false;
  std::string text;  ///< one sentence for the schema and the help
};

struct Operation {
  std::string name;
  std::string summary;
  std::vector<Field> fields;
  /// Precondition: the request has passed check_fields.
  core::Result<nlohmann::json> (*run)(const nlohmann::json& request, const Context& context);
  nlohmann::json example;  ///< a request that succeeds, without "op"
};

/// All of them, by name. Built once, on first use.
const std::vector<Operation>& operations();

/// Null where there is no such name.
const Operation* find_operation(const std::string& name);

/// JSON Schema (2020-12) of an operation's request.
nlohmann::json request_schema(const Operation& operation);

/// Runs one operation: fields checked, then run, then "samples", "bezier" and "nurbs" added to a
/// result that holds a curve. Never throws: what goes wrong inside is an `internal` failure.
core::Result<nlohmann::json> perform(const std::string& name, const nlohmann::json& request,
                                     const Context& context);

/// The answer to one request object {"op":…, "id":…, …} in the public form with "ok".
nlohmann::json answer(const nlohmann::json& request, const Context& context);

/// The same for one line of text, which need not be JSON at all.
std::string answer_line(const std::string& line, const Context& context);

/// {"code":…, "message":…, "path":…, "hint":…}.
nlohmann::json failure_json(const core::Failure& failure);

}  // namespace keyline::operations
