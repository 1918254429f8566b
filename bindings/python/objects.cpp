#include "objects.h"

#include <pybind11/numpy.h>

#include "keyline/operations/held_curve.h"

namespace py = pybind11;

namespace keyline::python {

using nlohmann::json;

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

json array_json(const double* data, const py::ssize_t* shape, py::ssize_t dimensions,
                py::ssize_t stride) {
  json list = json::array();
  auto& items = list.get_ref<json::array_t&>();
  items.reserve(static_cast<std::size_t>(shape[0]));
  for (py::ssize_t i = 0; i < shape[0]; ++i) {
    if (dimensions == 1) {
      items.emplace_back(data[i]);
    } else {
      const py::ssize_t inner = stride / shape[0];
      items.push_back(array_json(data + i * inner, shape + 1, dimensions - 1, inner));
    }
  }
  return list;
}

/// Arrays of numbers in one go; whole numbers stay whole.
json from_array(const py::array& array, const std::string& where) {
  if (py::hasattr(array, "mask") && py::bool_(array.attr("mask").attr("any")()))
    raise({core::ErrorCode::bad_input, "some of the values are masked",
           "give compressed() or filled() ones", where});
  const char kind = array.dtype().kind();
  if (array.ndim() == 0 || kind != 'f') return to_json(array.attr("tolist")(), where);
  const Doubles doubles = Doubles::ensure(array);
  if (doubles.size() == 0) return json::array();
  return array_json(doubles.data(), doubles.shape(), doubles.ndim(), doubles.size());
}

json from_mapping(const py::dict& object, const std::string& where) {
  json j = json::object();
  for (const auto& [key, value] : object) {
    const auto name = py::cast<std::string>(py::str(key));
    j[name] = to_json(value, where.empty() ? name : where + "." + name);
  }
  return j;
}

json from_sequence(const py::handle& object, const std::string& where) {
  json list = json::array();
  std::size_t i = 0;
  for (const py::handle item : py::reinterpret_borrow<py::sequence>(object))
    list.push_back(to_json(item, where + "[" + std::to_string(i++) + "]"));
  return list;
}

/// Whole numbers beyond 64 bits are doubles, as in JSON.
json from_whole(const py::handle& number) {
  int beyond = 0;
  const long long value = PyLong_AsLongLongAndOverflow(number.ptr(), &beyond);
  if (beyond == 0) return value;
  return py::cast<double>(py::float_(py::reinterpret_borrow<py::object>(number)));
}

json from_text(const py::handle& text, const std::string& where) {
  Py_ssize_t size = 0;
  const char* utf8 = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
  if (utf8) return std::string(utf8, static_cast<std::size_t>(size));
  PyErr_Clear();
  raise({core::ErrorCode::bad_input, "the text cannot be written as UTF-8",
         "give a file another name, or what it holds", where});
}

/// One level of a request within another: Python's own limit stops a list that holds itself.
class Level {
 public:
  Level() {
    if (Py_EnterRecursiveCall(" in a request") != 0) throw py::error_already_set();
  }
  ~Level() { Py_LeaveRecursiveCall(); }
  Level(const Level&) = delete;
  Level& operator=(const Level&) = delete;
};

}  // namespace

json to_json(const py::handle& object, const std::string& where) {
  const Level level;
  if (object.is_none()) return nullptr;
  if (py::isinstance<py::bool_>(object)) return py::cast<bool>(object);
  if (py::isinstance<py::int_>(object)) return from_whole(object);
  if (py::isinstance<py::float_>(object)) return py::cast<double>(object);
  if (py::isinstance<py::str>(object)) return from_text(object, where);
  if (py::isinstance<operations::HeldCurve>(object))
    return py::cast<const operations::HeldCurve&>(object).to_json();
  if (py::isinstance<operations::HeldSurface>(object))
    return py::cast<const operations::HeldSurface&>(object).to_json();
  if (py::hasattr(object, "_handle")) return to_json(object.attr("_handle"), where);
  if (py::isinstance<py::dict>(object))
    return from_mapping(py::reinterpret_borrow<py::dict>(object), where);
  if (py::hasattr(object, "keys"))
    return from_mapping(py::dict(py::reinterpret_borrow<py::object>(object)), where);
  if (py::isinstance<py::array>(object))
    return from_array(py::reinterpret_borrow<py::array>(object), where);
  if (py::hasattr(object, "__fspath__"))
    return from_text(py::str(object.attr("__fspath__")()), where);
  if (py::hasattr(object, "item")) return to_json(object.attr("item")(), where);  // numpy scalars
  if (py::isinstance<py::sequence>(object)) return from_sequence(object, where);
  throw py::type_error("keyline: " + where + ": a " +
                       py::cast<std::string>(py::str(py::type::of(object).attr("__name__"))) +
                       " has no place in a request");
}

py::object to_python(const json& value) {
  switch (value.type()) {
    case json::value_t::object: {
      py::dict object;
      for (const auto& [name, member] : value.items()) object[py::str(name)] = to_python(member);
      return object;
    }
    case json::value_t::array: {
      py::list list(value.size());
      for (std::size_t i = 0; i < value.size(); ++i) list[i] = to_python(value[i]);
      return list;
    }
    case json::value_t::string:
      return py::str(value.get_ref<const std::string&>());
    case json::value_t::boolean:
      return py::bool_(value.get<bool>());
    case json::value_t::number_integer:
      return py::int_(value.get<std::int64_t>());
    case json::value_t::number_unsigned:
      return py::int_(value.get<std::uint64_t>());
    case json::value_t::number_float:
      return py::float_(value.get<double>());
    default:
      return py::none();
  }
}

void raise(const core::Failure& failure) {
  const py::object make = py::module_::import("keyline._errors").attr("error_of");
  const py::object error =
      make(core::code_name(failure.code), failure.message, failure.path, failure.hint);
  PyErr_SetObject(py::type::of(error).ptr(), error.ptr());
  throw py::error_already_set();
}

}  // namespace keyline::python
