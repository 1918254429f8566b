#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "keyline/operations/operation.h"

/// What other languages and readers need of the operations, made from their declarations.
namespace keyline::operations {

/// Interfaces of every request and result, the values, and a map from name to both.
std::string typescript_types();

/// A module of TypedDicts and one function per operation: the signatures of the Python package.
std::string python_stubs();

/// OpenAPI 3.1: POST /api/v1/NAME takes a request without "op" and gives the answer with "ok".
nlohmann::json openapi_document();

/// The reference page of an operation: fields with kinds, units, ranges and defaults, examples.
std::string reference_page(const Operation& operation);

}  // namespace keyline::operations
