#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "keyline/document/planar_curve.h"
#include "keyline/operations/operation.h"
#include "keyline/surface/surface.h"

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

/// Between least and most numbers, else bad_input; a bare number counts as a list of one.
core::Result<std::vector<double>> numbers_of_count(const nlohmann::json& request, const char* name,
                                                   std::size_t least, std::size_t most);
/// A number strictly between 0 and 1, else bad_input. Precondition: the field is there.
core::Result<double> share_of(const nlohmann::json& request, const char* name);
/// The three handles P0, P1, P2 of "points", else bad_input.
core::Result<std::array<core::Point2, 3>> three_handles(const nlohmann::json& request);

core::Point2 point_of(const nlohmann::json& request, const char* name);
std::vector<core::Point2> points_of(const nlohmann::json& request, const char* name);
std::vector<double> numbers_of(const nlohmann::json& request, const char* name);
core::Point3 point3_of(const nlohmann::json& request, const char* name);
surface::Surface surface_of(const nlohmann::json& request, const char* name);
document::Path path_of(const nlohmann::json& request, const char* name);

}  // namespace keyline::operations
