#include "python/bindings/settings.h"

#include <cmath>

namespace hemitex::python {
namespace {

using raster::InputError;

[[noreturn]] void fail(const std::string& name, const py::handle& value, const std::string& advice) {
  throw InputError("`" + name + "` is " + raster::excerpt(py::repr(value).cast<std::string>(), 80), advice);
}

}  // namespace

std::int64_t integerOf(const py::handle& value, const std::string& name, std::int64_t low, std::int64_t high) {
  const std::string advice = "give an integer from " + std::to_string(low) + " to " + std::to_string(high);
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!index || PyBool_Check(value.ptr())) {
    PyErr_Clear();
    fail(name, value, advice);
  }
  int overflow = 0;
  const std::int64_t number = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
  if (overflow != 0 || number < low || number > high) fail(name, value, advice);
  return number;
}

std::string textOf(const py::handle& value, const std::string& name) {
  if (!py::isinstance<py::str>(value)) fail(name, value, "give a text");
  Py_ssize_t length = 0;
  const char* const bytes = PyUnicode_AsUTF8AndSize(value.ptr(), &length);
  if (bytes == nullptr) {  // lone surrogates
    PyErr_Clear();
    fail(name, value, "give a text of valid characters");
  }
  return {bytes, static_cast<std::size_t>(length)};
}

std::optional<py::object> Settings::value(const char* name) const {
  if (!values_.contains(name)) return std::nullopt;
  const py::object found = values_[name];
  return found.is_none() ? std::nullopt : std::optional(found);
}

std::optional<int> Settings::integer(const char* name, int low, int high) const {
  const auto found = value(name);
  if (!found) return std::nullopt;
  return static_cast<int>(integerOf(*found, name, low, high));
}

std::optional<double> Settings::number(const char* name, double low, double high) const {
  const auto found = value(name);
  if (!found) return std::nullopt;
  const double number = PyFloat_AsDouble(found->ptr());
  const bool isNumber = PyErr_Occurred() == nullptr && !py::isinstance<py::str>(*found);
  PyErr_Clear();
  if (!isNumber || !(number >= low && number <= high))
    fail(name, *found,
         "give a number from " + py::str(py::float_(low)).cast<std::string>() + " to " +
             py::str(py::float_(high)).cast<std::string>());
  return number;
}

std::optional<std::string> Settings::text(const char* name) const {
  const auto found = value(name);
  if (!found) return std::nullopt;
  return textOf(*found, name);
}

std::optional<bool> Settings::flag(const char* name) const {
  const auto found = value(name);
  if (!found) return std::nullopt;
  const std::string type = Py_TYPE(found->ptr())->tp_name;
  if (type != "bool" && type != "numpy.bool_") fail(name, *found, "give True or False");
  return PyObject_IsTrue(found->ptr()) == 1;
}

}  // namespace hemitex::python
