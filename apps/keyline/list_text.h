#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace keyline::app {

/// What document.list answered, as a table, and below it how the file was read and what was left
/// out.
std::string list_text(const nlohmann::json& listed);

}  // namespace keyline::app
