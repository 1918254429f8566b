#pragma once

#include <pybind11/pybind11.h>

#include <nlohmann/json.hpp>

#include "keyline/core/error.h"

/// Python's own objects to request values and back: numbers keep every bit.
namespace keyline::python {

/// Dictionaries, sequences, numbers, text, None, paths, arrays of numbers, Curve and Surface.
/// Throws pybind11::type_error naming the place of anything else.
nlohmann::json to_json(const pybind11::handle& object, const std::string& where);

pybind11::object to_python(const nlohmann::json& value);

/// Throws the Python exception of a failure (keyline.Error and those below it).
[[noreturn]] void raise(const core::Failure& failure);

}  // namespace keyline::python
