#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "keyline/core/error.h"

/// What a described struct tells of its members (see core/describe.h), and the types they have.
namespace keyline::core {

/// Which numbers a field may have.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false;
  bool high_excluded = false;
  friend bool operator==(const Bounds&, const Bounds&) = default;
};
constexpr Bounds from_to(double low, double high) { return {low, high, false, false}; }
constexpr Bounds between(double low, double high) { return {low, high, true, true}; }
constexpr Bounds at_least(double low) { return {.low = low}; }
constexpr Bounds above(double low) { return {.low = low, .low_excluded = true}; }
inline constexpr Bounds kPositive = above(0);
constexpr bool contains(const Bounds& b, double x) {
  return (b.low_excluded ? x > b.low : x >= b.low) && (b.high_excluded ? x < b.high : x <= b.high);
}

struct Type;

/// One described member of a record. Made by field<&T::member>("what it is") and refined:
/// field<&T::degree>("of the curve").within(from_to(3, 30)).
struct Field {
  std::string_view name;
  std::string_view text;  ///< what it is: half a sentence, for schema, help and reference
  std::string_view unit;  ///< "length", "radian", "1/length", …; empty: none
  Bounds bounds;          ///< of the number, or of each number of a list
  std::size_t least = 0;  ///< items of a list
  std::size_t most = std::numeric_limits<std::size_t>::max();
  bool required = false;
  bool or_null = false;       ///< an empty optional is written as null instead of left out
  bool or_one = false;        ///< a bare item counts as a list of one
  bool flat = false;          ///< the member's own fields stand in its place
  std::string_view narrowed;  ///< a flattened field with other bounds here
  const Type& (*type)() = nullptr;
  void* (*at)(void* owner) = nullptr;

  constexpr Field needed() const { return with(&Field::required, true); }
  constexpr Field in(std::string_view u) const { return with(&Field::unit, u); }
  constexpr Field within(Bounds b) const { return with(&Field::bounds, b); }
  constexpr Field null_if_empty() const { return with(&Field::or_null, true); }
  constexpr Field or_bare_item() const { return with(&Field::or_one, true); }
  constexpr Field named(std::string_view n) const { return with(&Field::name, n); }
  /// Items of a list.
  constexpr Field count(std::size_t at_least,
                        std::size_t at_most = std::numeric_limits<std::size_t>::max()) const {
    return with(&Field::least, at_least).with(&Field::most, at_most);
  }
  /// Of a flattened member: its field of that name has these bounds here.
  constexpr Field narrow(std::string_view field, Bounds b) const {
    return with(&Field::narrowed, field).within(b);
  }

 private:
  template <class V>
  constexpr Field with(V Field::* member, V value) const {
    Field copy = *this;
    copy.*member = value;
    return copy;
  }
};

/// A type as readers and writers see it; which members have a meaning depends on the kind.
struct Type {
  enum class Kind {
    boolean,
    integer,
    number,
    text,
    choice,    ///< an enumeration: one of some words
    point,     ///< Point2
    point3,    ///< Point3
    interval,  ///< Interval, written [low, high]
    optional,
    list,    ///< std::vector, or std::array of `fixed` items
    record,  ///< a described struct
    one_of,  ///< std::variant
    value    ///< something with a form of its own: a curve, a surface
  };
  Kind kind = Kind::boolean;
  std::string_view name = {};  ///< of records, choices and values

  std::int64_t (*integer)(const void*) = nullptr;
  bool (*set_integer)(void*, std::int64_t) = nullptr;  ///< false where it does not fit
  const std::string_view* words = nullptr;
  std::size_t word_count = 0;
  std::size_t (*chosen)(const void*) = nullptr;
  void (*choose)(void*, std::size_t) = nullptr;

  const Type& (*item)() = nullptr;             ///< of an optional or a list
  const void* (*held)(const void*) = nullptr;  ///< null where the optional is empty
  void* (*emplace)(void*) = nullptr;           ///< makes the optional hold a default item
  std::size_t fixed = 0;                       ///< 0: a list of any length
  std::size_t (*size)(const void*) = nullptr;
  void* (*at)(void*, std::size_t) = nullptr;
  void* (*append)(void*) = nullptr;
  void (*clear)(void*) = nullptr;

  std::span<const Field> (*fields)() = nullptr;
  std::shared_ptr<void> (*make)() = nullptr;  ///< a default record
  /// A record's form as text, "start:G1,end:G2", where it has one: static from_text(string_view).
  Result<void> (*from_text)(std::string_view, void*) = nullptr;
  std::string_view text_form = {};               ///< static kTextForm: how it is written
  Result<void> (*check)(const void*) = nullptr;  ///< static check(const T&): of the whole

  const Type& (*const* alternatives)() = nullptr;
  std::size_t alternative_count = 0;
  std::size_t (*index)(const void*) = nullptr;
  const void* (*current)(const void*) = nullptr;
  void* (*become)(void*, std::size_t) = nullptr;

  const void* form = nullptr;  ///< of a value: what reads and writes it, known to the readers
};

/// Specialised where a value's form is known: static const Type& type().
template <class T>
struct ValueType;

/// The described type, made in core/describe.h. Precondition: T is one of the kinds above.
template <class T>
const Type& type_of();

/// A word of an enumeration.
template <class E>
struct Word {
  E value;
  std::string_view word;
};
template <class E, std::size_t N>
constexpr std::array<Word<E>, N> words(const Word<E> (&list)[N]) {
  return std::to_array(list);
}

template <class E>
constexpr std::string_view word_of(E value) {
  for (const auto& w : choices(static_cast<const E*>(nullptr)))
    if (w.value == value) return w.word;
  return "";
}

template <class... Fields>
constexpr auto fields(Fields... f) {
  return std::array<Field, sizeof...(f)>{f...};
}

namespace detail {

template <class T>
struct MemberOf;
template <class Owner_, class Value_>
struct MemberOf<Value_ Owner_::*> {
  using Owner = Owner_;
  using Value = Value_;
};

template <auto Member>
constexpr std::string_view printed_name() {
  return __PRETTY_FUNCTION__;
}
template <class T>
constexpr std::string_view printed_name() {
  return __PRETTY_FUNCTION__;
}

/// The last identifier of what the compiler prints: "… = &a::S::radius; …" gives "radius".
constexpr std::string_view last_identifier(std::string_view text) {
  const std::size_t from = text.find("= ") + 2;
  std::size_t end = text.find_first_of(";]", from);
  const std::size_t colons = text.rfind("::", end);
  const std::size_t begin = colons == std::string_view::npos || colons < from ? from : colons + 2;
  return text.substr(begin, end - begin);
}

}  // namespace detail

/// The unqualified name of a type.
template <class T>
constexpr std::string_view type_name() {
  return detail::last_identifier(detail::printed_name<T>());
}

/// A member, or a member of a member: field<&Request::options, &Options::seed>.
template <auto Member, auto... Inner>
constexpr Field field(std::string_view text) {
  constexpr auto last = [](auto... members) {
    return std::get<sizeof...(members) - 1>(std::tuple{members...});
  }(Member, Inner...);
  using Owner = typename detail::MemberOf<decltype(Member)>::Owner;
  using Value = typename detail::MemberOf<std::remove_const_t<decltype(last)>>::Value;
  Field f;
  f.name = detail::last_identifier(detail::printed_name<last>());
  f.text = text;
  f.type = &type_of<Value>;
  f.at = [](void* owner) -> void* {
    auto walk = [](auto& self, auto& object, auto member, auto... rest) -> void* {
      if constexpr (sizeof...(rest) == 0)
        return &(object.*member);
      else
        return self(self, object.*member, rest...);
    };
    return walk(walk, *static_cast<Owner*>(owner), Member, Inner...);
  };
  return f;
}

/// The fields of a member, as if they were the record's own.
template <auto Member>
constexpr Field flattened() {
  Field f = field<Member>("");
  f.flat = true;
  return f;
}

/// The fields of a record, those of flattened members in their places, with the address of each in
/// `owner`: each(const Field&, void*).
template <class Each>
void visit_fields(const Type& record, void* owner, const Each& each,
                  const Field* narrowing = nullptr) {
  for (const Field& field : record.fields()) {
    void* const member = field.at(owner);
    if (field.flat)
      visit_fields(field.type(), member, each, field.narrowed.empty() ? nullptr : &field);
    else if (narrowing && narrowing->narrowed == field.name)
      each(field.within(narrowing->bounds), member);
    else
      each(field, member);
  }
}
/// The same of a record that is only looked at.
template <class Each>
void visit_fields(const Type& record, const void* owner, const Each& each) {
  visit_fields(record, const_cast<void*>(owner), [&each](const Field& field, void* member) {
    each(field, static_cast<const void*>(member));
  });
}

}  // namespace keyline::core
