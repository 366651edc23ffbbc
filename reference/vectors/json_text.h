/// Reads JSON of users more strictly than the parser does: an object has each key once, and values are not nested
/// deeper than any format here needs. A parser keeps the last of equal keys without a word, and deep nesting can
/// exhaust the stack of code that walks the values.
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "raster/base/input_error.h"

namespace hemitex::reference {

inline constexpr int maxJsonDepth = 64;

/// Throws InputError, with `file` if it is not empty, for text that is not JSON, for a key that an object has twice,
/// and for values nested deeper than maxJsonDepth.
void checkJson(const std::string& text, const std::string& file = {});

/// The value of a text that passes checkJson.
template <typename Json>
Json parseJson(const std::string& text, const std::string& file = {}) {
  checkJson(text, file);
  return Json::parse(text);
}

/// The beginning of a text for messages, of at most about a hundred characters.
std::string beginningOf(const std::string& text);

/// A value as text for messages.
template <typename Json>
std::string shortText(const Json& value) {
  return beginningOf(value.dump(-1, ' ', true, Json::error_handler_t::replace));
}

/// The three numbers that an object has at a key. Throws InputError for anything else.
template <typename Json>
glm::dvec3 vectorAt(const Json& object, const std::string& key) {
  const Json values = object.value(key, Json());
  bool are = values.is_array() && values.size() == 3;
  for (const Json& value : values) are = are && value.is_number();
  if (!are)
    throw raster::InputError("`" + key + "` has the value " + shortText(values), "write a list of three numbers");
  return {values[0].template get<double>(), values[1].template get<double>(), values[2].template get<double>()};
}

}  // namespace hemitex::reference
