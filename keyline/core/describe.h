#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "keyline/core/field.h"
#include "keyline/core/interval.h"
#include "keyline/core/point.h"

/// Plain structs that tell what they hold: every member described once, beside it.
///
///     struct BlendOptions {
///       Order order = Order::g2;
///       double alpha = -1;
///       static constexpr auto describe() {
///         return core::fields(core::field<&BlendOptions::order>("continuity at both ends"),
///                             core::field<&BlendOptions::alpha>("slope of the pieces"));
///       }
///     };
///
/// The name is the member's, the default its own initialiser. Readers, writers, schemas, command
/// lines and references are made from type_of<BlendOptions>(); no room needs to know them. An
/// enumeration tells its words by `choices`, found beside it:
///
///     constexpr auto choices(const Order*) {
///       return core::words<Order>({{Order::g1, "G1"}, {Order::g2, "G2"}});
///     }
namespace keyline::core {

namespace detail {

template <class T>
concept Described = requires { T::describe(); };
template <class T>
concept Enumerated = std::is_enum_v<T>;
template <class T>
concept HasText = requires(std::string_view text) {
  { T::from_text(text) } -> std::same_as<Result<T>>;
};
template <class T>
concept Checked = requires(const T& t) {
  { T::check(t) } -> std::same_as<Result<void>>;
};

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsArray : std::false_type {};
template <class T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};
template <class T>
struct IsVariant : std::false_type {};
template <class... T>
struct IsVariant<std::variant<T...>> : std::true_type {};

template <class T>
constexpr Type integer_type() {
  Type t{.kind = Type::Kind::integer};
  t.integer = [](const void* p) { return static_cast<std::int64_t>(*static_cast<const T*>(p)); };
  t.set_integer = [](void* p, std::int64_t v) {
    if (!std::in_range<T>(v)) return false;
    *static_cast<T*>(p) = static_cast<T>(v);
    return true;
  };
  return t;
}

template <class E>
inline constexpr auto kWords = [] {
  constexpr auto list = choices(static_cast<const E*>(nullptr));
  std::array<std::string_view, list.size()> texts{};
  for (std::size_t i = 0; i < list.size(); ++i) texts[i] = list[i].word;
  return texts;
}();

template <class E>
constexpr Type choice_type() {
  Type t{.kind = Type::Kind::choice, .name = type_name<E>()};
  t.words = kWords<E>.data();
  t.word_count = kWords<E>.size();
  t.chosen = [](const void* p) {
    constexpr auto list = choices(static_cast<const E*>(nullptr));
    std::size_t i = 0;
    while (i < list.size() && list[i].value != *static_cast<const E*>(p)) ++i;
    return i;
  };
  t.choose = [](void* p, std::size_t i) {
    constexpr auto list = choices(static_cast<const E*>(nullptr));
    *static_cast<E*>(p) = list[i].value;
  };
  return t;
}

template <class T>
constexpr Type optional_type() {
  Type t{.kind = Type::Kind::optional};
  t.item = &type_of<typename T::value_type>;
  t.held = [](const void* p) -> const void* {
    const auto& o = *static_cast<const T*>(p);
    return o ? &*o : nullptr;
  };
  t.emplace = [](void* p) -> void* { return &static_cast<T*>(p)->emplace(); };
  return t;
}

template <class T>
constexpr Type list_type() {
  Type t{.kind = Type::Kind::list};
  t.item = &type_of<typename T::value_type>;
  t.size = [](const void* p) { return static_cast<const T*>(p)->size(); };
  t.at = [](void* p, std::size_t i) -> void* { return &(*static_cast<T*>(p))[i]; };
  if constexpr (IsArray<T>::value)
    t.fixed = std::tuple_size_v<T>;
  else {
    t.append = [](void* p) -> void* { return &static_cast<T*>(p)->emplace_back(); };
    t.clear = [](void* p) { static_cast<T*>(p)->clear(); };
  }
  return t;
}

template <class T>
inline constexpr auto kFields = T::describe();

template <class T>
constexpr Type record_type() {
  Type t{.kind = Type::Kind::record, .name = type_name<T>()};
  t.fields = [] { return std::span<const Field>(kFields<T>); };
  t.make = []() -> std::shared_ptr<void> { return std::make_shared<T>(); };
  if constexpr (HasText<T>) {
    t.text_form = T::kTextForm;
    t.from_text = [](std::string_view text, void* p) -> Result<void> {
      auto made = T::from_text(text);
      if (!made) return std::unexpected(made.error());
      *static_cast<T*>(p) = std::move(*made);
      return {};
    };
  }
  if constexpr (Checked<T>)
    t.check = [](const void* p) { return T::check(*static_cast<const T*>(p)); };
  return t;
}

template <class T>
struct Alternatives;
template <class... T>
struct Alternatives<std::variant<T...>> {
  static constexpr const Type& (*list[])() = {&type_of<T>...};
  static void* become(void* p, std::size_t i) {
    auto& v = *static_cast<std::variant<T...>*>(p);
    void* at = nullptr;
    std::size_t k = 0;
    ((k++ == i ? static_cast<void>(at = &v.template emplace<T>()) : void()), ...);
    return at;
  }
};

template <class T>
constexpr Type variant_type() {
  Type t{.kind = Type::Kind::one_of};
  t.alternatives = Alternatives<T>::list;
  t.alternative_count = std::variant_size_v<T>;
  t.index = [](const void* p) { return static_cast<const T*>(p)->index(); };
  t.current = [](const void* p) -> const void* {
    return std::visit([](const auto& v) -> const void* { return &v; }, *static_cast<const T*>(p));
  };
  t.become = &Alternatives<T>::become;
  return t;
}

template <class T>
constexpr Type make_type() {
  using Kind = Type::Kind;
  if constexpr (std::is_same_v<T, bool>)
    return {.kind = Kind::boolean};
  else if constexpr (std::is_same_v<T, double>)
    return {.kind = Kind::number};
  else if constexpr (std::is_integral_v<T>)
    return integer_type<T>();
  else if constexpr (std::is_same_v<T, std::string>)
    return {.kind = Kind::text};
  else if constexpr (std::is_same_v<T, Point2>)
    return {.kind = Kind::point};
  else if constexpr (std::is_same_v<T, Point3>)
    return {.kind = Kind::point3};
  else if constexpr (std::is_same_v<T, Interval>)
    return {.kind = Kind::interval};
  else if constexpr (std::is_enum_v<T>)
    return choice_type<T>();
  else if constexpr (IsOptional<T>::value)
    return optional_type<T>();
  else if constexpr (IsVector<T>::value || IsArray<T>::value)
    return list_type<T>();
  else if constexpr (IsVariant<T>::value)
    return variant_type<T>();
  else {
    static_assert(Described<T>, "the type has no describe()");
    return record_type<T>();
  }
}

template <class T>
inline constexpr Type kType = make_type<T>();

template <class T>
concept HasValueType = requires { ValueType<T>::type(); };

}  // namespace detail

template <class T>
const Type& type_of() {
  if constexpr (detail::HasValueType<T>)
    return ValueType<T>::type();
  else
    return detail::kType<T>;
}

}  // namespace keyline::core
