#include <string_view>

#include "keyline/core/angle.h"
#include "keyline/core/error.h"

int main() {
  using namespace keyline::core;
  const bool code = code_name(ErrorCode::bad_input) == std::string_view("bad-input");
  return code && wrap_angle(3 * kPi) > 0 ? 0 : 1;
}
