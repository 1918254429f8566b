#include "keyline/operations/fields.h"

#include <cmath>

#include "keyline/exchange/json_curve.h"
#include "keyline/exchange/json_space.h"
#include "keyline/exchange/json_surface.h"

namespace keyline::operations {
namespace {

using core::ErrorCode;
using core::fail;
using core::Result;
using nlohmann::json;

const char* const kCommonFields[] = {"op", "id", "samples", "bezier", "nurbs", "threads"};

Result<void> wrong(const Field& field, const char* wanted) {
  return fail(ErrorCode::bad_input, std::string(wanted) + " is wanted here", field.text,
              field.name);
}

template <class T>
Result<void> discard(const Result<T>& result) {
  if (!result) return std::unexpected(result.error());
  return {};
}

Result<void> check_curves(const json& value, const Field& field) {
  if (!value.is_array() || value.empty()) return wrong(field, "a list of curves");
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto path =
        exchange::path_from_json(value[i], field.name + "[" + std::to_string(i) + "]");
    if (!path) return std::unexpected(path.error());
  }
  return {};
}

Result<void> check_surfaces(const json& value, const Field& field) {
  if (!value.is_array() || value.empty()) return wrong(field, "a list of surfaces");
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto s =
        exchange::surface_from_json(value[i], field.name + "[" + std::to_string(i) + "]");
    if (!s) return std::unexpected(s.error());
  }
  return {};
}

Result<void> check_points3(const json& value, const Field& field) {
  if (!value.is_array()) return wrong(field, "a list of points");
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto p = exchange::point3_from_json(value[i], field.name + "[" + std::to_string(i) + "]");
    if (!p) return std::unexpected(p.error());
  }
  return {};
}

Result<void> check_numbers(const json& value, const Field& field) {
  if (!value.is_array()) return wrong(field, "a list of numbers");
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto n = exchange::number_from_json(value[i], field.name + "[" + std::to_string(i) + "]");
    if (!n) return std::unexpected(n.error());
  }
  return {};
}

Result<void> check_type(const json& value, const Field& field) {
  switch (field.type) {
    case Field::Type::number:
      return discard(exchange::number_from_json(value, field.name));
    case Field::Type::integer:
      return value.is_number_integer() ? Result<void>{} : wrong(field, "a whole number");
    case Field::Type::boolean:
      return value.is_boolean() ? Result<void>{} : wrong(field, "true or false");
    case Field::Type::string:
      return value.is_string() ? Result<void>{} : wrong(field, "a string");
    case Field::Type::point:
      return discard(exchange::point_from_json(value, field.name));
    case Field::Type::points:
      return discard(exchange::points_from_json(value, field.name, 1));
    case Field::Type::point3:
      return discard(exchange::point3_from_json(value, field.name));
    case Field::Type::points3:
      return check_points3(value, field);
    case Field::Type::numbers:
      return check_numbers(value, field);
    case Field::Type::number_or_numbers:
      return value.is_array() ? check_numbers(value, field)
                              : discard(exchange::number_from_json(value, field.name));
    case Field::Type::curve:
      return discard(exchange::path_from_json(value, field.name));
    case Field::Type::curves:
      return check_curves(value, field);
    case Field::Type::surface:
      return discard(exchange::surface_from_json(value, field.name));
    case Field::Type::surfaces:
      return check_surfaces(value, field);
    case Field::Type::any:
      break;
  }
  return {};
}

const Field* field_named(const Operation& operation, const std::string& name) {
  for (const Field& field : operation.fields)
    if (field.name == name) return &field;
  return nullptr;
}

bool is_common(const std::string& name) {
  for (const char* common : kCommonFields)
    if (name == common) return true;
  return false;
}

}  // namespace

Result<void> check_fields(const Operation& operation, const json& request) {
  if (!request.is_object())
    return fail(ErrorCode::bad_input, "the request is not a JSON object", "give {…}");
  for (const auto& [name, value] : request.items()) {
    const Field* field = field_named(operation, name);
    if (!field && !is_common(name))
      return fail(ErrorCode::bad_input, "\"" + name + "\" is not a field of " + operation.name,
                  "keyline operations " + operation.name + " lists its fields", name);
    if (!field) continue;
    if (auto sound = check_type(value, *field); !sound) return sound;
  }
  for (const Field& field : operation.fields)
    if (field.required && !request.contains(field.name))
      return fail(ErrorCode::bad_input, "\"" + field.name + "\" is missing", field.text,
                  field.name);
  return {};
}

double number_or(const json& request, const char* name, double otherwise) {
  const auto it = request.find(name);
  return it == request.end() ? otherwise : it->get<double>();
}

std::optional<double> optional_number(const json& request, const char* name) {
  const auto it = request.find(name);
  if (it == request.end()) return std::nullopt;
  return it->get<double>();
}

std::int64_t integer_or(const json& request, const char* name, std::int64_t otherwise) {
  const auto it = request.find(name);
  return it == request.end() ? otherwise : it->get<std::int64_t>();
}

bool boolean_or(const json& request, const char* name, bool otherwise) {
  const auto it = request.find(name);
  return it == request.end() ? otherwise : it->get<bool>();
}

std::string string_or(const json& request, const char* name, std::string otherwise) {
  const auto it = request.find(name);
  return it == request.end() ? std::move(otherwise) : it->get<std::string>();
}

Result<int> integer_between(const json& request, const char* name, int otherwise, int low,
                            int high) {
  const std::int64_t value = integer_or(request, name, otherwise);
  if (value < low || value > high)
    return fail(ErrorCode::bad_input, std::string("\"") + name + "\" is out of range",
                "give a whole number from " + std::to_string(low) + " to " + std::to_string(high),
                name);
  return static_cast<int>(value);
}

Result<std::optional<double>> positive_number(const json& request, const char* name) {
  const auto value = optional_number(request, name);
  if (value && !(*value > 0))
    return fail(ErrorCode::bad_input, std::string("\"") + name + "\" is not greater than zero",
                "give a number greater than zero", name);
  return value;
}

Result<std::vector<double>> numbers_of_count(const json& request, const char* name,
                                             std::size_t least, std::size_t most) {
  const json& value = request.at(name);
  std::vector<double> list =
      value.is_array() ? value.get<std::vector<double>>() : std::vector{value.get<double>()};
  if (list.size() >= least && list.size() <= most) return list;
  const std::string count =
      least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most);
  return fail(ErrorCode::bad_input,
              std::string("\"") + name + "\" holds " + std::to_string(list.size()) + " numbers",
              "give " + count, name);
}

Result<double> share_of(const json& request, const char* name) {
  const double value = request.at(name).get<double>();
  if (value > 0 && value < 1) return value;
  return fail(ErrorCode::bad_input, std::string("\"") + name + "\" is out of range",
              "give a number between 0 and 1, both excluded", name);
}

Result<std::array<core::Point2, 3>> three_handles(const json& request) {
  const std::vector<core::Point2> points = points_of(request, "points");
  if (points.size() == 3) return std::array{points[0], points[1], points[2]};
  return fail(ErrorCode::bad_input, "three handles are wanted",
              "give P0, P1 and P2: the ends and where their tangents meet", "points");
}

core::Point2 point_of(const json& request, const char* name) {
  return exchange::point_from_json(request.at(name), name).value();
}

std::vector<core::Point2> points_of(const json& request, const char* name) {
  const auto it = request.find(name);
  if (it == request.end()) return {};
  return exchange::points_from_json(*it, name, 1).value();
}

std::vector<double> numbers_of(const json& request, const char* name) {
  const auto it = request.find(name);
  if (it == request.end()) return {};
  return it->get<std::vector<double>>();
}

core::Point3 point3_of(const json& request, const char* name) {
  return exchange::point3_from_json(request.at(name), name).value();
}

surface::Surface surface_of(const json& request, const char* name) {
  return exchange::surface_from_json(request.at(name), name).value();
}

document::Path path_of(const json& request, const char* name) {
  return exchange::path_from_json(request.at(name), name).value();
}

}  // namespace keyline::operations
