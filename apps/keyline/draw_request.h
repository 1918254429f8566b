#pragma once

#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "keyline/core/error.h"

#include "commands.h"

namespace keyline::app {

/// The operation a draw command asks for and its request.
struct DrawRequest {
  std::string operation;
  nlohmann::json request;
};

/// bad_input where options do not go together or a point cannot be read.
core::Result<DrawRequest> draw_request(const DrawCommand& command);

}  // namespace keyline::app
