#pragma once

#include <nlohmann/json_fwd.hpp>

#include "keyline/operations/operation.h"

namespace keyline::operations {

/// JSON Schema (2020-12) of an operation's request, with everything it may hold.
nlohmann::json request_schema(const Operation& operation);

/// The same of its result.
nlohmann::json result_schema(const Operation& operation);

/// The schemas of points, curves and surfaces, by name: "Curve", "Surface", …
const nlohmann::json& value_schemas();

/// A field's default as JSON; null where it has none: required fields, empty ones, and numbers
/// that stand for "found by rule" and that a request may not give.
nlohmann::json default_of(const core::Field& field, const void* member);

}  // namespace keyline::operations
