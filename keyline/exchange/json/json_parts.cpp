#include "keyline/exchange/json/json_parts.h"

#include <cstdint>

#include "keyline/core/coordinate.h"

namespace keyline::exchange::detail {

using core::ErrorCode;
using core::fail;
using core::Result;
using nlohmann::json;

std::string in(const std::string& where, const std::string& key) {
  return where.empty() ? key : where + "." + key;
}
std::string in(const std::string& where, std::size_t index) {
  return where + "[" + std::to_string(index) + "]";
}

Result<const json*> member(const json& j, const char* key, const std::string& where) {
  const auto it = j.find(key);
  if (it == j.end())
    return fail(ErrorCode::bad_input, std::string("\"") + key + "\" is missing",
                std::string("add \"") + key + "\"", in(where, key));
  return &*it;
}

Result<double> number_member(const json& j, const char* key, const std::string& where) {
  const auto m = member(j, key, where);
  if (!m) return std::unexpected(m.error());
  return number_from_json(**m, in(where, key));
}

Result<std::vector<double>> numbers(const json& j, const std::string& where) {
  if (!j.is_array())
    return fail(ErrorCode::bad_input, "a list of numbers is wanted here", "give [a, b, …]", where);
  std::vector<double> list;
  list.reserve(j.size());
  for (std::size_t i = 0; i < j.size(); ++i) {
    const auto n = number_from_json(j[i], in(where, i));
    if (!n) return std::unexpected(n.error());
    list.push_back(*n);
  }
  return list;
}

Result<std::vector<double>> weights_of(const json& j, const std::string& where) {
  if (!j.contains("weights")) return std::vector<double>{};
  return numbers(j["weights"], in(where, "weights"));
}

Result<std::array<double, 2>> pair_member(const json& j, const char* key,
                                          const std::string& where) {
  const auto m = member(j, key, where);
  if (!m) return std::unexpected(m.error());
  const auto pair = numbers(**m, in(where, key));
  if (!pair) return std::unexpected(pair.error());
  if (pair->size() != 2)
    return fail(ErrorCode::bad_input, "two numbers are wanted here", "give [start, end]",
                in(where, key));
  return std::array{(*pair)[0], (*pair)[1]};
}

Result<std::array<double, 3>> coordinates_of(const json& j, const std::string& where,
                                             const char* hint) {
  if (!j.is_array() || j.size() < 2 || j.size() > 3)
    return fail(ErrorCode::bad_input, "a point is wanted here", hint, where);
  std::array<double, 3> c{};
  for (std::size_t i = 0; i < j.size(); ++i) {
    const auto n = number_from_json(j[i], in(where, i));
    if (!n) return std::unexpected(n.error());
    if (core::is_too_large(*n)) return core::coordinate_too_large(in(where, i));
    c[i] = *n;
  }
  return c;
}

Result<int> degree_from_json(const json& j, const std::string& where) {
  if (!j.is_number_integer())
    return fail(ErrorCode::bad_input, "the degree is not a whole number", "give for example 3",
                where);
  constexpr int kMost = curve::kMaxBezierDegree;
  const auto n = j.get<std::int64_t>();
  if (n < 1 || n > kMost)
    return fail(ErrorCode::bad_input, "the degree is outside 1…" + std::to_string(kMost),
                "use a degree from 1 to " + std::to_string(kMost), where);
  return static_cast<int>(n);
}

Result<bool> closed_of(const json& j, const std::string& where) {
  const auto it = j.find("closed");
  if (it == j.end()) return false;
  if (!it->is_boolean())
    return fail(ErrorCode::bad_input, "true or false is wanted here", "", in(where, "closed"));
  return it->get<bool>();
}

Result<std::string> type_of(const json& j, const std::string& where, const char* what) {
  if (!j.is_object())
    return fail(ErrorCode::bad_input, std::string(what) + " is wanted here", "give {\"type\":…}",
                where);
  const auto type = member(j, "type", where);
  if (!type) return std::unexpected(type.error());
  if (!(*type)->is_string())
    return fail(ErrorCode::bad_input, "the type is not a string", "", in(where, "type"));
  return (*type)->get<std::string>();
}

std::unexpected<core::Failure> placed(core::Failure failure, const std::string& where) {
  failure.path = failure.path.empty() ? where : in(where, failure.path);
  return std::unexpected(std::move(failure));
}

}  // namespace keyline::exchange::detail
