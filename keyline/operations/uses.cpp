#include "keyline/operations/uses.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "keyline/operations/json_form.h"

namespace keyline::operations {
namespace {

using core::Field;
using core::Type;

void add_given(const Field& field, const void* member, const void* by_default,
               std::vector<std::string>& names) {
  const Type& type = field.type();
  const bool given = type.kind == Type::Kind::optional
                         ? type.held(member) != nullptr
                         : write_json(type, member).value() != write_json(type, by_default).value();
  if (given) names.emplace_back(field.name);
}

}  // namespace

std::vector<std::string> unused_fields(const Type& type, const void* record,
                                       std::span<const Use> uses, unsigned kind) {
  const auto made = type.make();
  std::vector<std::string> names;
  for (const Field& field : type.fields()) {
    const auto of = std::ranges::find(uses, field.name, &Use::field);
    if (of == uses.end() || (of->kinds & kind) != 0) continue;
    void* const member = field.at(const_cast<void*>(record));
    void* const by_default = field.at(made.get());
    if (!field.flat) {
      add_given(field, member, by_default, names);
      continue;
    }
    std::vector<const void*> defaults;
    core::visit_fields(field.type(), by_default,
                       [&](const Field&, void* at) { defaults.push_back(at); });
    std::size_t i = 0;
    core::visit_fields(field.type(), member, [&](const Field& inner, void* at) {
      add_given(inner, at, defaults[i++], names);
    });
  }
  return names;
}

}  // namespace keyline::operations
