#include "keyline/operations/sound_result.h"

#include <cmath>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "keyline/core/coordinate.h"
#include "keyline/operations/common.h"
#include "keyline/operations/values.h"

namespace keyline::operations {
namespace {

using core::Result;
using core::Type;
using Kind = core::Type::Kind;

Result<void> check(const document::Path& path) {
  return path.curves.empty() ? Result<void>{} : validate(path);
}

Result<void> check(const SpacePath& path) {
  for (const document::SpaceCurve& c : path.curves)
    if (auto sound = validate(c); !sound) return sound;
  return {};
}

Result<void> check(const document::PlanarCurve& c) { return validate(c); }
Result<void> check(const document::SpaceCurve& c) { return validate(c); }

Result<void> check(const AnyCurve& curve) {
  return std::visit([](const auto& c) { return check(c); }, curve);
}

Result<void> check_value(const Type& type, const void* value) {
  if (&type == &core::ValueType<document::Path>::type())
    return check(*static_cast<const document::Path*>(value));
  if (&type == &core::ValueType<AnyCurve>::type())
    return check(*static_cast<const AnyCurve*>(value));
  if (&type == &core::ValueType<BoundedCurve>::type())
    return check(static_cast<const BoundedCurve*>(value)->curve);
  if (&type == &core::ValueType<surface::Surface>::type())
    return validate(*static_cast<const surface::Surface*>(value));
  return {};
}

/// The failure of a value as that of the whole: what the client sees is no fault of its own.
std::unexpected<core::Failure> unsound(const core::Failure& why) {
  return core::fail(core::ErrorCode::internal, "the result is not valid: " + why.message,
                    "please report this request");
}

/// A failure's path seen from one step further out.
std::unexpected<core::Failure> within(core::Failure failure, const std::string& step) {
  const bool dotted = !step.empty() && !failure.path.empty() && failure.path[0] != '[';
  failure.path = step + (dotted ? "." : "") + failure.path;
  return std::unexpected(std::move(failure));
}

bool is_extreme(double number) {
  const double size = std::abs(number);
  return size > core::kLargestCoordinate || (size > 0 && size < core::kSmallestSize);
}

/// Where the first such number stands.
std::optional<std::string> extreme_in(const nlohmann::json& j, const std::string& place) {
  if (j.is_number_float() && is_extreme(j.get<double>())) return place;
  if (!j.is_structured()) return std::nullopt;
  for (const auto& [key, item] : j.items()) {
    const std::string step = j.is_array() ? "[" + key + "]" : place.empty() ? key : "." + key;
    if (auto found = extreme_in(item, place + step)) return found;
  }
  return std::nullopt;
}

}  // namespace

core::Failure explained(core::Failure unsound, const nlohmann::json& request) {
  nlohmann::json own = request;
  for (const std::string_view key : detail::kEnvelope) own.erase(std::string(key));
  const auto place = extreme_in(own, "");
  if (!place) return unsound;
  return core::fail(core::ErrorCode::bad_input,
                    "with this number the result leaves the range of doubles",
                    "give one between 1e-100 and 1e100 in size, or 0", *place)
      .error();
}

Result<void> check_values(const Type& type, const void* value) {
  switch (type.kind) {
    case Kind::value:
      if (auto sound = check_value(type, value); !sound) return unsound(sound.error());
      return {};
    case Kind::optional:
      return type.held(value) ? check_values(type.item(), type.held(value)) : Result<void>{};
    case Kind::one_of:
      return check_values(type.alternatives[type.index(value)](), type.current(value));
    case Kind::list:
      for (std::size_t i = 0; i < type.size(value); ++i)
        if (auto sound = check_values(type.item(), type.at(const_cast<void*>(value), i)); !sound)
          return within(sound.error(), "[" + std::to_string(i) + "]");
      return {};
    case Kind::record:
      for (const core::Field& field : type.fields())
        if (auto sound = check_values(field.type(), field.at(const_cast<void*>(value))); !sound)
          return within(sound.error(), field.flat ? "" : std::string(field.name));
      return {};
    default:
      return {};
  }
}

}  // namespace keyline::operations
