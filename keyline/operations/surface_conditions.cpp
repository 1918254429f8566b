#include "keyline/operations/surface_conditions.h"

#include <charconv>
#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "keyline/exchange/json_curve.h"

namespace keyline::operations {

using core::ErrorCode;
using core::fail;
using core::Result;
using nlohmann::json;
using surface::CurveCondition;

namespace {

Result<core::Interval> interval_of(const json& value, const std::string& where) {
  if (!value.is_array() || value.size() != 2)
    return fail(ErrorCode::bad_input, "this is no range", "give [low, high]", where);
  core::Interval range;
  for (const std::size_t i : {0, 1}) {
    const auto number = exchange::number_from_json(value[i], where + "[" + std::to_string(i) + "]");
    if (!number) return std::unexpected(number.error());
    (i == 0 ? range.low : range.high) = *number;
  }
  return range;
}

Result<void> read_range(const json& value, const std::string& where,
                        std::optional<core::Interval>& range) {
  const auto read = interval_of(value, where);
  if (!read) return std::unexpected(read.error());
  range = *read;
  return {};
}

Result<void> read_branch(const json& value, const std::string& where, CurveCondition& c) {
  if (value == "growing") {
    c.branch = classa::Branch::growing;
  } else if (value == "falling") {
    c.branch = classa::Branch::falling;
  } else {
    return fail(ErrorCode::bad_input, "there is no such branch",
                "use growing (s >= 1/cos alpha) or falling (s <= cos alpha)", where);
  }
  return {};
}

Result<void> read_member(const std::string& name, const json& value, const std::string& where,
                         CurveCondition& c) {
  if (name == "alpha") return read_range(value, where, c.alpha);
  if (name == "s") return read_range(value, where, c.s);
  if (name == "branch") return read_branch(value, where, c);
  if (name == "end_tolerance") {
    const auto number = exchange::number_from_json(value, where);
    if (!number) return std::unexpected(number.error());
    c.end_tolerance = *number;
  } else if (name == "curve" && value.is_string()) {
    c.curve = value.get<std::string>();
  } else if (name == "tangent" && value.is_boolean()) {
    c.tangent = value.get<bool>();
  } else {
    return fail(ErrorCode::bad_input,
                "\"" + name + "\" is no member of a condition, or not its type",
                "give curve, alpha, s, end_tolerance, branch or tangent", where);
  }
  return {};
}

/// "1.1..1.4" as [1.1, 1.4]; a single number as both ends.
std::optional<json> range_from_text(const std::string& text) {
  const auto number = [](const std::string& t) -> std::optional<double> {
    double x = 0;
    const auto [end, error] = std::from_chars(t.data(), t.data() + t.size(), x);
    if (error != std::errc{} || end != t.data() + t.size() || !std::isfinite(x)) return {};
    return x;
  };
  const auto dots = text.find("..");
  const auto low = number(text.substr(0, dots));
  const auto high = dots == std::string::npos ? low : number(text.substr(dots + 2));
  if (!low || !high) return {};
  return json{*low, *high};
}

/// One "name=value" of the command line put into the condition; false where it is none.
bool put_text(const std::string& name, const std::string& value, json& condition) {
  if (name == "branch" || name == "tangent") {
    if (name == "branch") condition[name] = value;
    if (name == "tangent") condition[name] = value == "kept";
    return name == "branch" || value == "kept" || value == "free";
  }
  const auto range = range_from_text(value);
  if (!range) return false;
  if (name == "end") condition["end_tolerance"] = (*range)[0];
  if (name == "alpha" || name == "s") condition[name] = *range;
  return name == "end" || name == "alpha" || name == "s";
}

}  // namespace

Result<std::vector<CurveCondition>> surface_conditions(const json& request) {
  std::vector<CurveCondition> conditions;
  if (!request.contains("conditions")) return conditions;
  const json& list = request.at("conditions");
  if (!list.is_array())
    return fail(ErrorCode::bad_input, "the conditions are no list",
                "give [{\"curve\": \"A1\", \"s\": [1.1, 1.4]}, …]", "conditions");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string where = "conditions[" + std::to_string(i) + "]";
    if (!list[i].is_object())
      return fail(ErrorCode::bad_input, "a condition is no object",
                  "give {\"curve\": \"A1\", \"s\": [1.1, 1.4]}", where);
    CurveCondition c;
    for (const auto& [name, value] : list[i].items())
      if (auto read = read_member(name, value, where + "." + name, c); !read)
        return std::unexpected(read.error());
    conditions.push_back(std::move(c));
  }
  return conditions;
}

Result<json> condition_from_text(const std::string& text) {
  json condition = json::object();
  const auto colon = text.find(':');
  if (colon != std::string::npos) condition["curve"] = text.substr(0, colon);
  std::size_t at = colon == std::string::npos ? 0 : colon + 1;
  while (at <= text.size()) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string part = text.substr(at, end - at);
    const auto equals = part.find('=');
    if (equals == std::string::npos ||
        !put_text(part.substr(0, equals), part.substr(equals + 1), condition))
      return fail(
          ErrorCode::bad_input, "\"" + part + "\" of \"" + text + "\" is no condition",
          "write for example A1:s=1.1..1.4,alpha=0..0.3,end=0.1,branch=falling,tangent=kept",
          "--condition");
    at = end + 1;
  }
  return condition;
}

}  // namespace keyline::operations
