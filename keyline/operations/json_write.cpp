#include <cmath>

#include <nlohmann/json.hpp>

#include "keyline/operations/json_form.h"

namespace keyline::operations {
namespace {

using core::Field;
using core::Result;
using core::Type;
using nlohmann::json;
using Kind = Type::Kind;

/// Writes values; remembers where a number was not finite, from the inside out.
class Writer {
 public:
  json write(const Type& type, const void* value) {
    switch (type.kind) {
      case Kind::boolean:
        return *static_cast<const bool*>(value);
      case Kind::integer:
        return type.integer(value);
      case Kind::number:
        return number(*static_cast<const double*>(value));
      case Kind::text:
        return *static_cast<const std::string*>(value);
      case Kind::choice:
        return chosen(type, value);
      case Kind::point: {
        const auto& p = *static_cast<const core::Point2*>(value);
        return json::array({number(p.x), number(p.y)});
      }
      case Kind::point3: {
        const auto& p = *static_cast<const core::Point3*>(value);
        return json::array({number(p.x), number(p.y), number(p.z)});
      }
      case Kind::interval: {
        const auto& i = *static_cast<const core::Interval*>(value);
        return json::array({number(i.low), number(i.high)});
      }
      case Kind::optional:
        return type.held(value) ? write(type.item(), type.held(value)) : json();
      case Kind::list:
        return list(type, value);
      case Kind::record:
        return record(type, value);
      case Kind::one_of:
        return write(type.alternatives[type.index(value)](), type.current(value));
      case Kind::value:
        return static_cast<const ValueForm*>(type.form)->write(value);
    }
    return {};
  }

  bool sound = true;
  std::string where;

 private:
  static bool is_endless(const Field& field, const void* member) {
    return field.or_null && field.type().kind == Kind::number &&
           std::isinf(*static_cast<const double*>(member));
  }

  json number(double value) {
    if (!std::isfinite(value)) sound = false;
    return value;
  }

  json chosen(const Type& type, const void* value) {
    const std::size_t i = type.chosen(value);
    return i < type.word_count ? json(std::string(type.words[i])) : json();
  }

  json list(const Type& type, const void* value) {
    json all = json::array();
    const Type& item = type.item();
    for (std::size_t i = 0; i < type.size(value) && sound; ++i) {
      all.push_back(write(item, type.at(const_cast<void*>(value), i)));
      if (!sound) where = "[" + std::to_string(i) + "]" + where;
    }
    return all;
  }

  json record(const Type& type, const void* value) {
    json object = json::object();
    core::visit_fields(type, value, [&](const Field& field, const void* member) {
      const Type& its = field.type();
      if (!sound || (its.kind == Kind::optional && !its.held(member) && !field.or_null)) return;
      object[std::string(field.name)] = is_endless(field, member) ? json() : write(its, member);
      if (!sound)
        where = std::string(field.name) + (where.empty() || where[0] == '[' ? "" : ".") + where;
    });
    return object;
  }
};

}  // namespace

Result<json> write_json(const Type& type, const void* value) {
  Writer writer;
  json j = writer.write(type, value);
  if (writer.sound) return j;
  return core::fail(core::ErrorCode::internal, "the result is not a finite number",
                    "please report this request", writer.where);
}

}  // namespace keyline::operations
