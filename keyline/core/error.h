#pragma once

#include <expected>
#include <stdexcept>
#include <string>
#include <utility>

namespace keyline::core {

/// Why an answer is missing; the names are those of the public interface (docs/contract.md).
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

/// An answer or the reason there is none. One that is not looked at is a compiler's warning (an
/// error in this tree): what failed must not go on in silence.
template <class T>
class [[nodiscard]] Result : public std::expected<T, Failure> {
 public:
  using std::expected<T, Failure>::expected;
  // NOLINTNEXTLINE(google-explicit-constructor): what and_then, transform, … of the base return
  Result(std::expected<T, Failure> answer) : std::expected<T, Failure>(std::move(answer)) {}
  Result() = default;
};

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
