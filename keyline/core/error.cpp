#include "keyline/core/error.h"

namespace keyline::core {

const char* code_name(ErrorCode code) {
  switch (code) {
    case ErrorCode::bad_input:
      return "bad-input";
    case ErrorCode::undrawable:
      return "undrawable";
    case ErrorCode::not_converged:
      return "not-converged";
    case ErrorCode::unsupported:
      return "unsupported";
    case ErrorCode::cancelled:
      return "cancelled";
    case ErrorCode::io:
      return "io";
    case ErrorCode::internal:
      break;
  }
  return "internal";
}

}  // namespace keyline::core
