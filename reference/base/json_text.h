/// Reads JSON of users more strictly than the parser does: an object has each key once, and values are not nested
/// deeper than any format here needs. A parser keeps the last of equal keys without a word, and deep nesting can
/// exhaust the stack of code that walks the values.
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "raster/base/input_error.h"

namespace hemitex::reference {

inline constexpr int maxJsonDepth = 64;

/// A value as text for messages, of at most about a hundred characters.
template <typename Json>
std::string shortText(const Json& value) {
  return raster::excerpt(value.dump(-1, ' ', true, Json::error_handler_t::replace), 100);
}

/// The value of a text. Throws InputError, with `file` if it is not empty, for text that is not JSON, for a key that an
/// object has twice, and for values nested deeper than maxJsonDepth. `keeps` tells which parts of the
/// text the value has, as in Json::parse: the others take no memory.
template <typename Json>
Json parseJson(const std::string& text, const std::string& file = {},
               const typename Json::parser_callback_t& keeps = {}) {
  using Event = typename Json::parse_event_t;
  std::vector<std::set<std::string>> keys;  // of the open objects, by depth; empty for arrays
  const auto check = [&](int depth, Event event, Json& value) {
    const auto open = static_cast<std::size_t>(depth);
    if (depth == maxJsonDepth && (event == Event::object_start || event == Event::array_start))
      throw raster::InputError(file, 0, "values are nested too deeply");
    if (event == Event::object_start) {
      keys.resize(open + 1);
      keys.back().clear();
    }
    if (event == Event::key && !keys[open - 1].insert(value.template get<std::string>()).second)
      throw raster::InputError(file, 0, "an object has this key twice: " + shortText(value));
    return !keeps || keeps(depth, event, value);
  };
  try {
    return Json::parse(text, check);
  } catch (const typename Json::exception& error) {
    throw raster::InputError(file, 0, error.what());
  }
}

/// A value that is a list of three numbers; nothing for any other value.
template <typename Json>
std::optional<glm::dvec3> vectorOf(const Json& value) {
  bool are = value.is_array() && value.size() == 3;
  for (const Json& number : value) are = are && number.is_number();
  if (!are) return std::nullopt;
  return glm::dvec3(value[0].template get<double>(), value[1].template get<double>(), value[2].template get<double>());
}

/// The three numbers that an object has at a key. Throws InputError for anything else.
template <typename Json>
glm::dvec3 vectorAt(const Json& object, const std::string& key) {
  const Json value = object.value(key, Json());
  const std::optional<glm::dvec3> vector = vectorOf(value);
  if (!vector)
    throw raster::InputError("`" + key + "` has the value " + shortText(value), "write a list of three numbers");
  return *vector;
}

}  // namespace hemitex::reference
