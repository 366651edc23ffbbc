/// Arrays that go in and out. Arguments are checked before C++ reads them; results give their memory to NumPy without a
/// copy. This unit and calls.h are what another binding library would replace.
#pragma once

#include <pybind11/numpy.h>

#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hemitex::python {

namespace py = pybind11;

using Shape = std::vector<py::ssize_t>;

/// An argument: row-major, aligned values. It shares the memory of the caller's array if that has this type and order.
template <typename Value>
struct Array {
  py::array_t<Value> kept;
  Shape shape;
  std::span<const Value> values;

  std::size_t length() const { return static_cast<std::size_t>(shape.front()); }
};

/// The argument called `name`, anything that NumPy takes for an array of real numbers. Entries of `shape` that are -1
/// stand for any length. Throws InputError for another type or shape, and for values that are not finite.
Array<double> numbers(const py::handle& argument, const std::string& name, const Shape& shape);

/// As above for integers in [low, high].
Array<std::int64_t> integers(const py::handle& argument, const std::string& name, const Shape& shape, std::int64_t low,
                             std::int64_t high);

/// Three numbers, or one that stands for three.
glm::dvec3 vectorOf(const py::handle& argument, const std::string& name);

/// The rows of an n x 3 argument.
std::vector<glm::dvec3> vectorsOf(const Array<double>& array);

/// A NumPy array of this shape, which owns the values.
template <typename Value>
py::array_t<Value> toArray(std::vector<Value> values, Shape shape) {
  auto kept = std::make_unique<std::vector<Value>>(std::move(values));
  Value* const first = kept->data();
  const py::capsule owner(kept.release(), [](void* memory) { delete static_cast<std::vector<Value>*>(memory); });
  return py::array_t<Value>(std::move(shape), first, owner);
}

template <typename Value>
py::array_t<Value> toArray(std::vector<Value> values) {
  const auto length = static_cast<py::ssize_t>(values.size());
  return toArray(std::move(values), {length});
}

/// Vectors as an array of n x 3 numbers.
py::array_t<double> toArray(std::vector<glm::dvec3> values);

/// A read-only array of n x 3 numbers that shares the memory of vectors.
py::array_t<double> sharedArray(const std::shared_ptr<const std::vector<glm::dvec3>>& values);

py::tuple toTuple(const glm::dvec3& value);

}  // namespace hemitex::python
