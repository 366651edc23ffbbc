/// One table of names per enum: JSON and messages write the names and read them back.
#pragma once

#include <array>
#include <string>

#include "raster/base/input_error.h"

namespace hemitex::reference {

template <typename Value>
struct Named {
  Value value;
  const char* name;
};

/// The name of a value; empty for a value that the table lacks.
template <typename Value, std::size_t count>
std::string nameOf(const std::array<Named<Value>, count>& names, Value value) {
  for (const Named<Value>& each : names)
    if (each.value == value) return each.name;
  return {};
}

/// The value of the name that the JSON key `key` holds. Throws InputError with all names for any other text.
template <typename Value, std::size_t count>
Value valueOf(const std::array<Named<Value>, count>& names, const std::string& name, const std::string& key) {
  std::string known;
  for (const Named<Value>& each : names) {
    if (each.name == name) return each.value;
    known += (known.empty() ? "" : ", ") + std::string(each.name);
  }
  throw raster::InputError("\"" + key + "\" is \"" + name + "\"", "use one of " + known);
}

}  // namespace hemitex::reference
