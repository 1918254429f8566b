#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "keyline/core/describe.h"

/// What input a field of a request has a use for, declared beside the field. An operation that met
/// another input answers which of the fields it was given had none ("unused"); doors tell them.
namespace keyline::operations {

/// A field that has a use for some kinds of input alone: bits of an enumeration of such kinds.
/// Of a flattened member: all its fields.
struct Use {
  std::string_view field;
  unsigned kinds = 0;
};

template <auto Member>
constexpr Use use(unsigned kinds) {
  return {core::field<Member>("").name, kinds};
}

/// Names of the fields that were given (differ from their default) and have no use for that kind,
/// in their order. Fields without a Use have one for every kind.
std::vector<std::string> unused_fields(const core::Type& type, const void* record,
                                       std::span<const Use> uses, unsigned kind);

/// The same of a record that declares them: static constexpr auto uses(), a list of Use.
template <class Record>
std::vector<std::string> unused_fields(const Record& record, unsigned kind) {
  constexpr auto kUses = Record::uses();
  return unused_fields(core::type_of<Record>(), &record, kUses, kind);
}

/// What results tell of them.
inline constexpr std::string_view kUnusedText = "fields given that have no use for this input";

}  // namespace keyline::operations
