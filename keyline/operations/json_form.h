#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "keyline/core/describe.h"
#include "keyline/core/error.h"

/// Described types (core/describe.h) as JSON, both ways. Only the .cpp files of this and of the
/// values' forms know the JSON library.
namespace keyline::operations {

/// How a value with a form of its own (a curve, a surface) is read and written: Type::form.
struct ValueForm {
  core::Result<void> (*read)(const nlohmann::json& j, const std::string& where, void* value);
  nlohmann::json (*write)(const void* value);
  const char* schema;  ///< JSON text
};

/// A record to fill from a request.
struct Part {
  const core::Type* type;
  void* record;
};

/// Fills the records from the members of one object, each member read once. Where a member is
/// wrong the failure's path names it ("points[1][0]"); names that no record has are refused, those
/// in `passed` let pass. A record must hold its defaults; it is half filled after a failure.
core::Result<void> read_json(const nlohmann::json& object, std::span<const Part> parts,
                             std::span<const std::string_view> passed, std::string_view subject);

/// The value as JSON. Fails: internal, naming the place, where a number is not finite.
core::Result<nlohmann::json> write_json(const core::Type& type, const void* value);

/// "give a number greater than 0", "give a whole number from 0 to 400".
std::string bounds_in_words(const core::Bounds& bounds, bool whole);

}  // namespace keyline::operations
