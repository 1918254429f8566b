#pragma once

#include <expected>
#include <stdexcept>
#include <string>
#include <utility>

namespace keyline::core {

/// Why an answer is missing; the names are those of the public interface (CONTRACT: error codes).
enum class ErrorCode { bad_input, undrawable, not_converged, unsupported, cancelled, io, internal };

/// "bad-input", "undrawable", …: the code as it is printed in JSON.
const char* code_name(ErrorCode code);

/// The reason there is no answer: an expected outcome, returned, never thrown.
struct Failure {
  ErrorCode code = ErrorCode::internal;
  std::string message;  ///< one line: what is wrong
  std::string hint;     ///< one line: what to do about it; may be empty
  std::string path;     ///< where in the input, for example "points[2]"; may be empty
};

/// An answer or the reason there is none.
template <class T>
using Result = std::expected<T, Failure>;

/// fail(ErrorCode::bad_input, "…", "…") makes the error side of any Result.
inline std::unexpected<Failure> fail(ErrorCode code, std::string message, std::string hint = {},
                                     std::string path = {}) {
  return std::unexpected(Failure{code, std::move(message), std::move(hint), std::move(path)});
}

/// Thrown where the caller broke a stated precondition (a programming error, not a user's).
class InvalidInput : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace keyline::core
