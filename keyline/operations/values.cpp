#include "keyline/operations/values.h"

#include <nlohmann/json.hpp>

#include "keyline/exchange/json/json_curve.h"
#include "keyline/exchange/json/json_members.h"
#include "keyline/exchange/json/json_space.h"
#include "keyline/exchange/json/json_surface.h"
#include "keyline/operations/json_form.h"

namespace keyline::operations {
namespace {

using core::Result;
using core::Type;
using nlohmann::json;

template <class T>
Result<void> keep(Result<T> read, void* value) {
  if (!read) return std::unexpected(std::move(read.error()));
  *static_cast<T*>(value) = std::move(*read);
  return {};
}

/// What the reader makes of a value none of whose members would be lost.
template <auto Read, class T>
Result<void> take(const json& j, const std::string& where, void* value) {
  if (auto known = exchange::check_members(j, where); !known) return known;
  return keep<T>(Read(j, where), value);
}

/// Whether the member says all that the path does.
bool is_alone(const document::Path& path) {
  return path.curves.size() == 1 &&
         (!path.closed || std::holds_alternative<lac::Chain>(path.curves[0].value));
}

json path_json(const document::PlanarCurve& c) { return exchange::to_json(c); }
json path_json(const document::Path& path) { return exchange::to_json(path); }

json path_json(const SpacePath& path) {
  json members = json::array();
  for (const document::SpaceCurve& c : path.curves) members.push_back(exchange::to_json(c));
  return {{"type", "path"}, {"curves", std::move(members)}, {"closed", path.closed}};
}

json path_json(const document::SpaceCurve& c) { return exchange::to_json(c); }

json curve_json(const AnyCurve& curve) {
  return std::visit([](const auto& c) { return path_json(c); }, curve);
}

Result<SpacePath> space_path_from_json(const json& j, const std::string& where) {
  auto members = exchange::space_path_from_json(j, where);
  if (!members) return std::unexpected(members.error());
  SpacePath path{std::move(*members)};
  path.closed = j.value("closed", false);
  return path;
}

Result<AnyCurve> any_curve_from_json(const json& j, const std::string& where) {
  const auto any = [](auto read) -> Result<AnyCurve> {
    if (!read) return std::unexpected(std::move(read.error()));
    return AnyCurve{std::move(*read)};
  };
  if (exchange::is_space_path(j)) return any(space_path_from_json(j, where));
  if (j.is_object() && exchange::is_space_curve(j))
    return any(exchange::space_curve_from_json(j, where));
  if (j.is_object() && j.value("type", json()) == "path")
    return any(exchange::path_from_json(j, where));
  auto read = exchange::path_from_json(j, where);
  if (!read) return std::unexpected(std::move(read.error()));
  return simplest(std::move(*read));
}

constexpr ValueForm kPathForm{take<exchange::path_from_json, document::Path>,
                              [](const void* value) {
                                const auto& path = *static_cast<const document::Path*>(value);
                                return is_alone(path) ? path_json(path.curves.front())
                                                      : path_json(path);
                              },
                              R"({"$ref":"#/$defs/Curve"})"};

constexpr ValueForm kAnyCurveForm{
    take<any_curve_from_json, AnyCurve>,
    [](const void* value) { return curve_json(*static_cast<const AnyCurve*>(value)); },
    R"({"$ref":"#/$defs/Curve"})"};

constexpr ValueForm kBoundedForm{
    [](const json& j, const std::string& where, void* value) -> Result<void> {
      auto& bounded = *static_cast<BoundedCurve*>(value);
      if (auto done = take<any_curve_from_json, AnyCurve>(j, where, &bounded.curve); !done)
        return done;
      const auto deviation = j.find("deviation");
      if (deviation == j.end()) return {};
      return keep(exchange::number_from_json(*deviation, where + ".deviation"), &bounded.deviation);
    },
    [](const void* value) {
      const auto& bounded = *static_cast<const BoundedCurve*>(value);
      json j = curve_json(bounded.curve);
      j["deviation"] = bounded.deviation;
      return j;
    },
    R"({"allOf":[{"$ref":"#/$defs/Curve"}],
        "properties":{"deviation":{"type":"number","minimum":0}},"required":["deviation"]})"};

constexpr ValueForm kSurfaceForm{
    take<exchange::surface_from_json, surface::Surface>,
    [](const void* value) {
      return exchange::to_json(*static_cast<const surface::Surface*>(value));
    },
    R"({"$ref":"#/$defs/Surface"})"};

constexpr Type value_type(std::string_view name, const ValueForm& form) {
  Type type;
  type.kind = Type::Kind::value;
  type.name = name;
  type.form = &form;
  return type;
}
constexpr Type kPath = value_type("Curve", kPathForm);
constexpr Type kAnyCurve = value_type("Curve", kAnyCurveForm);
constexpr Type kBounded = value_type("BoundedCurve", kBoundedForm);
constexpr Type kSurface = value_type("Surface", kSurfaceForm);

}  // namespace

document::Path path_of(document::PlanarCurve curve) {
  document::Path path;
  if (const auto* chain = std::get_if<lac::Chain>(&curve.value)) path.closed = chain->closed;
  path.curves.push_back(std::move(curve));
  return path;
}

std::optional<document::Path> planar_path(const AnyCurve& curve) {
  if (const auto* path = std::get_if<document::Path>(&curve)) return *path;
  if (const auto* alone = std::get_if<document::PlanarCurve>(&curve)) return path_of(*alone);
  return {};
}

AnyCurve simplest(document::Path path) {
  if (is_alone(path)) return std::move(path.curves.front());
  return path;
}

}  // namespace keyline::operations

namespace keyline::core {

const Type& ValueType<document::Path>::type() { return operations::kPath; }
const Type& ValueType<operations::AnyCurve>::type() { return operations::kAnyCurve; }
const Type& ValueType<operations::BoundedCurve>::type() { return operations::kBounded; }
const Type& ValueType<surface::Surface>::type() { return operations::kSurface; }

}  // namespace keyline::core
