#pragma once

#include <optional>
#include <string>
#include <vector>

#include "keyline/document/planar_curve.h"
#include "keyline/operations/operation.h"

/// Reading a request's fields. The functions without `Result` may assume what check_fields
/// has checked: presence of the required ones, types and finiteness.
namespace keyline::operations {

/// Unknown names, missing required fields, wrong types and numbers that are not finite are
/// bad_input with the field's name as path.
core::Result<void> check_fields(const Operation& operation, const nlohmann::json& request);

double number_or(const nlohmann::json& request, const char* name, double otherwise);
std::optional<double> optional_number(const nlohmann::json& request, const char* name);
std::int64_t integer_or(const nlohmann::json& request, const char* name, std::int64_t otherwise);
bool boolean_or(const nlohmann::json& request, const char* name, bool otherwise);
std::string string_or(const nlohmann::json& request, const char* name, std::string otherwise);

/// An integer between low and high, else bad_input.
core::Result<int> integer_between(const nlohmann::json& request, const char* name, int otherwise,
                                  int low, int high);
/// A number greater than zero where given.
core::Result<std::optional<double>> positive_number(const nlohmann::json& request,
                                                    const char* name);

std::vector<core::Point2> points_of(const nlohmann::json& request, const char* name);
std::vector<double> numbers_of(const nlohmann::json& request, const char* name);
document::Path path_of(const nlohmann::json& request, const char* name);

}  // namespace keyline::operations
