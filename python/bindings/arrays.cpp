#include "python/bindings/arrays.h"

#include <cmath>
#include <limits>

#include "raster/base/input_error.h"

namespace hemitex::python {
namespace {

using raster::InputError;

std::string shapeText(const Shape& shape) {
  std::string text = "(";
  for (std::size_t axis = 0; axis < shape.size(); ++axis)
    text += (axis == 0 ? "" : ", ") + (shape[axis] < 0 ? std::string("n") : std::to_string(shape[axis]));
  return text + (shape.size() == 1 ? ",)" : ")");
}

bool fits(const Shape& found, const Shape& asked) {
  if (found.size() != asked.size()) return false;
  for (std::size_t axis = 0; axis < asked.size(); ++axis)
    if (asked[axis] >= 0 && found[axis] != asked[axis]) return false;
  return true;
}

/// The argument as a NumPy array whose type has one of these kinds, with this shape.
py::array checkedArray(const py::handle& argument, const std::string& name, const Shape& shape,
                       const std::string& kinds, const std::string& what) {
  py::array array = py::array::ensure(argument);
  if (!array || kinds.find(array.dtype().kind()) == std::string::npos)
    throw InputError("`" + name + "` is no array of " + what, "give " + what + " in the shape " + shapeText(shape));
  const Shape found(array.shape(), array.shape() + array.ndim());
  if (!fits(found, shape))
    throw InputError("`" + name + "` has the shape " + shapeText(found),
                     "give " + what + " in the shape " + shapeText(shape));
  return array;
}

template <typename Value>
Array<Value> converted(const py::array& array) {
  constexpr int flags = py::array::c_style | py::array::forcecast | py::detail::npy_api::NPY_ARRAY_ALIGNED_;
  const auto kept = py::array_t<Value, flags>::ensure(array);
  if (!kept) throw py::error_already_set();
  Array<Value> result{kept, Shape(kept.shape(), kept.shape() + kept.ndim()), {}};
  result.values = {kept.data(), static_cast<std::size_t>(kept.size())};
  return result;
}

}  // namespace

Array<double> numbers(const py::handle& argument, const std::string& name, const Shape& shape) {
  Array<double> array = converted<double>(checkedArray(argument, name, shape, "fiu", "numbers"));
  for (std::size_t i = 0; i < array.values.size(); ++i)
    if (!std::isfinite(array.values[i]))
      throw InputError("`" + name + "` has a number that is not finite, at position " + std::to_string(i));
  return array;
}

Array<std::int64_t> integers(const py::handle& argument, const std::string& name, const Shape& shape, std::int64_t low,
                             std::int64_t high) {
  // An empty list has no type of its own.
  const py::array array = checkedArray(argument, name, shape, "iuf", "integers");
  if (array.dtype().kind() == 'f' && array.size() > 0)
    throw InputError("`" + name + "` holds floating-point numbers", "give integers");
  Array<std::int64_t> result = converted<std::int64_t>(array);
  for (const std::int64_t value : result.values)
    if (value < low || value > high)
      throw InputError("`" + name + "` has the value " + std::to_string(value),
                       "give integers from " + std::to_string(low) + " to " + std::to_string(high));
  return result;
}

glm::dvec3 vectorOf(const py::handle& argument, const std::string& name) {
  const py::array array = py::array::ensure(argument);
  if (array && array.ndim() == 0) return glm::dvec3(numbers(argument, name, {}).values[0]);
  const Array<double> three = numbers(argument, name, {3});
  return {three.values[0], three.values[1], three.values[2]};
}

std::vector<glm::dvec3> vectorsOf(const Array<double>& array) {
  std::vector<glm::dvec3> vectors;
  vectors.reserve(array.values.size() / 3);
  for (std::size_t i = 0; i + 2 < array.values.size(); i += 3)
    vectors.push_back({array.values[i], array.values[i + 1], array.values[i + 2]});
  return vectors;
}

py::array_t<double> toArray(std::vector<glm::dvec3> values) {
  const auto kept = std::make_shared<const std::vector<glm::dvec3>>(std::move(values));
  py::array_t<double> array = sharedArray(kept);
  py::detail::array_proxy(array.ptr())->flags |= py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

py::array_t<double> sharedArray(const std::shared_ptr<const std::vector<glm::dvec3>>& values) {
  static_assert(sizeof(glm::dvec3) == 3 * sizeof(double));
  using Kept = std::shared_ptr<const std::vector<glm::dvec3>>;
  auto kept = std::make_unique<Kept>(values);
  const auto* const first = reinterpret_cast<const double*>((*kept)->data());
  const auto length = static_cast<py::ssize_t>((*kept)->size());
  const py::capsule owner(kept.release(), [](void* memory) { delete static_cast<Kept*>(memory); });
  py::array_t<double> array({length, py::ssize_t{3}}, first, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

py::tuple toTuple(const glm::dvec3& value) { return py::make_tuple(value.x, value.y, value.z); }

}  // namespace hemitex::python
