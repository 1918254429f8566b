#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "keyline/core/error.h"

/// Members of JSON values that nothing reads: a slip ("weihgts") would change the curve in silence.
/// Requests that have one are refused, files are read and it is told.
namespace keyline::exchange {

struct StrayMember {
  std::string place;  ///< of the value that has it: "curves[1].curve"
  std::string name;
  std::string of;    ///< what it is no field of: "a bezier"
  std::string hint;  ///< which was probably meant, or which there are
};

/// Those of a curve or surface and of all within it. Beside its own a value may carry what it is
/// called in a document ("name", "layer", "color", "stroke_width", "unit", "trims") and, as a form
/// of a result, its "deviation". Values of no known type have none.
std::vector<StrayMember> stray_members(const nlohmann::json& value, const std::string& where);

/// Those of a document in any of its forms (json_document.h). Of the answer of an operation, which
/// has members of its own, those that are nearly one of a document.
std::vector<StrayMember> stray_members_of_document(const nlohmann::json& document);

/// Fails: bad_input with the place of the first stray member of a curve or surface.
core::Result<void> check_members(const nlohmann::json& value, const std::string& where);

/// As documents tell them: one line for each name that things of one kind have, with the first
/// place.
std::vector<std::string> in_words(const std::vector<StrayMember>& strays);

}  // namespace keyline::exchange
