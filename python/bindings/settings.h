/// The settings of a call: a dictionary of names and values, which are checked here. None stands for the default.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "raster/base/input_error.h"

namespace hemitex::python {

namespace py = pybind11;

class Settings {
 public:
  explicit Settings(py::dict values) : values_(std::move(values)) {}

  /// The value of a setting; nothing if it is missing or None.
  std::optional<py::object> value(const char* name) const;
  /// Throw InputError for a value of another type or out of [low, high].
  std::optional<int> integer(const char* name, int low, int high) const;
  std::optional<double> number(const char* name, double low, double high) const;
  std::optional<std::string> text(const char* name) const;
  std::optional<bool> flag(const char* name) const;

  /// One of several names. Throws InputError with all of them for any other value.
  template <typename Value>
  std::optional<Value> choice(const char* name, const std::vector<std::pair<std::string, Value>>& choices) const {
    const std::optional<std::string> found = text(name);
    if (!found) return std::nullopt;
    std::string known;
    for (const auto& [each, meaning] : choices) {
      if (each == *found) return meaning;
      known += (known.empty() ? "" : ", ") + each;
    }
    throw raster::InputError("`" + std::string(name) + "` is `" + raster::excerpt(*found) + "`", "use one of " + known);
  }

 private:
  py::dict values_;
};

/// An integer, of Python or NumPy, in [low, high]; throws InputError for anything else.
std::int64_t integerOf(const py::handle& value, const std::string& name, std::int64_t low, std::int64_t high);

/// A text; throws InputError for anything else.
std::string textOf(const py::handle& value, const std::string& name);

/// Assigns a value that is given.
template <typename Target, typename Value>
void assign(Target& target, const std::optional<Value>& value) {
  if (value) target = *value;
}

}  // namespace hemitex::python
