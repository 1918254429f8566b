#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "keyline/operations/operation.h"

/// Performs requests given as JSON; the command line, batch, the server and Python call this.
namespace keyline::operations {

/// A request with its typed result, as pictures and reports need them. Others use result_json.
struct Outcome {
  const Operation* operation = nullptr;
  std::shared_ptr<const void> request;
  std::shared_ptr<const void> result;

  /// The result where it is of that type, else null.
  template <class Answer>
  const Answer* result_as() const {
    return operation->result == &core::type_of<Answer>() ? static_cast<const Answer*>(result.get())
                                                         : nullptr;
  }
  template <class Request>
  const Request* request_as() const {
    return operation->request == &core::type_of<Request>()
               ? static_cast<const Request*>(request.get())
               : nullptr;
  }
};

/// Reads and checks the fields, runs the operation and adds the wanted forms to its curves. "op"
/// and "id" are ignored. Never throws: an exception inside becomes an `internal` failure.
core::Result<Outcome> carry_out(const std::string& name, const nlohmann::json& request,
                                const Context& context);

core::Result<nlohmann::json> result_json(const Outcome& outcome);

/// What a request may hold beside the operation's own fields: the further forms of a result's
/// curves; null where there are none.
const core::Type* further_options(const Operation& operation);

/// carry_out and result_json in one.
core::Result<nlohmann::json> perform(const std::string& name, const nlohmann::json& request,
                                     const Context& context);

/// The answer to one request object {"op":…, "id":…, …} in the public form with "ok".
nlohmann::json answer(const nlohmann::json& request, const Context& context);

/// A text as a request: bad_input for what is not JSON or names a member twice, is nested too deep,
/// or has a number no double holds.
core::Result<nlohmann::json> parse_request(std::string_view text);

/// The same for one line of text, which need not be JSON at all.
std::string answer_line(const std::string& line, const Context& context);
/// `defaults` {"seed":…, "tolerance":…} stand for what a request leaves out, where its operation
/// has such a field; a tolerance only where it is a length.
std::string answer_line(const std::string& line, const Context& context,
                        const nlohmann::json& defaults);

/// The failure as the answer to a line, with its id where the line has one.
std::string failed_line(const std::string& line, const core::Failure& failure);

/// {"code":…, "message":…, "path":…, "hint":…}.
nlohmann::json failure_json(const core::Failure& failure);

}  // namespace keyline::operations
