/// Reads JSON of users more strictly than the parser does: an object has each key once, and values are not nested
/// deeper than any format here needs. A parser keeps the last of equal keys without a word, and deep nesting can
/// exhaust the stack of code that walks the values.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "raster/base/input_error.h"

namespace hemitex::reference {

inline constexpr int maxJsonDepth = 64;

/// A value as text for messages, of at most about a hundred characters.
template <typename Json>
std::string shortText(const Json& value) {
  return raster::excerpt(value.dump(-1, ' ', true, Json::error_handler_t::replace), 100);
}

/// Finds where a text stops being JSON, for messages in our words. Accepts all values on the way.
template <typename Json>
struct JsonFault : nlohmann::detail::json_sax_acceptor<Json> {
  std::size_t end = 0;  ///< behind the fault, in bytes
  std::string at;       ///< the text there

  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception&) {
    end = position;
    at = token;
    return false;
  }
};

/// Throws InputError for a text that the parser refuses, with line and column.
template <typename Json>
[[noreturn]] void failToParse(const std::string& text, const std::string& file) {
  JsonFault<Json> fault;
  Json::sax_parse(text, &fault);
  const std::string_view before = std::string_view(text).substr(0, std::max<std::size_t>(fault.end, 1) - 1);
  const auto line = static_cast<int>(1 + std::count(before.begin(), before.end(), '\n'));
  const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
  const std::string place =
      "column " + std::to_string(column) +
      (fault.end > text.size() ? ", where the text ends" : ", in `" + raster::excerpt(fault.at, 40) + "`");
  throw raster::InputError(file, line,
                           "is not JSON: " + (file.empty() ? "line " + std::to_string(line) + ", " : "") + place);
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
  } catch (const typename Json::exception&) {
    failToParse<Json>(text, file);
  }
}

/// A string, number, or integer in the range of its type that an object has at a key. Throws InputError, which names
/// the key, for anything else.
template <typename Value, typename Json>
Value valueAt(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  if (found == object.end()) throw raster::InputError("`" + key + "` is missing");
  const auto require = [&](bool is, const char* what) {
    if (!is) throw raster::InputError("`" + key + "` has the value " + shortText(*found), std::string("write ") + what);
  };
  if constexpr (std::is_same_v<Value, std::string>)
    require(found->is_string(), "a string");
  else if constexpr (std::is_integral_v<Value>)
    require(found->is_number_integer() &&
                (found->is_number_unsigned() ? std::in_range<Value>(found->template get<std::uint64_t>())
                                             : std::in_range<Value>(found->template get<std::int64_t>())),
            "an integer of its range");
  else
    require(found->is_number(), "a number");
  return found->template get<Value>();
}

/// The object or list that an object has at a key. Throws InputError, which names the key, if there is none.
template <typename Json>
const Json& partAt(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_structured()) throw raster::InputError("`" + key + "` is missing");
  return *found;
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
