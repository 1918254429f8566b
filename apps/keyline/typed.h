#pragma once

#include <nlohmann/json.hpp>

#include "keyline/operations/json_form.h"

/// Described structs from and to JSON.
namespace keyline::app {

template <class T>
core::Result<T> from_json(const nlohmann::json& object, std::string_view subject) {
  T made;
  const operations::Part part{&core::type_of<T>(), &made};
  if (auto read = operations::read_json(object, {&part, 1}, {}, subject); !read)
    return std::unexpected(read.error());
  return made;
}

/// Precondition: all numbers are finite.
template <class T>
nlohmann::json to_json(const T& value) {
  return operations::write_json(core::type_of<T>(), &value).value();
}

}  // namespace keyline::app
