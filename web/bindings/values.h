/// Values between JavaScript and C++: settings and results as JSON, arrays as typed arrays, errors as exceptions.
#pragma once

#include <emscripten/val.h>

#include <cstddef>
#include <glm/glm.hpp>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "raster/base/input_error.h"
#include "raster/interface/face.h"

namespace hemitex::web {

using Json = nlohmann::ordered_json;
using Value = emscripten::val;

/// An object of JavaScript as JSON; `undefined` and `null` become an empty object.
Json jsonOf(const Value& value);

/// JSON as an object of JavaScript.
Value toValue(const Json& json);

/// The item of a list. Throws InputError for a number out of range; `what` names an item.
template <typename List>
const auto& itemOf(const List& list, std::size_t number, const std::string& what) {
  if (number >= list.size())
    throw raster::InputError("there is no " + what + ' ' + std::to_string(number),
                             "their number is " + std::to_string(list.size()));
  return list[number];
}

/// The value with a name. Throws InputError for other names; `what` says what has the name.
template <typename Named>
Named valueNamed(const std::string& name, const std::string& what,
                 std::initializer_list<std::pair<const char*, Named>> known) {
  for (const auto& [knownName, value] : known)
    if (name == knownName) return value;
  throw raster::InputError("there is no " + what + " `" + raster::excerpt(name) + "`");
}

Json toJson(const glm::dvec3& vector);
/// Throws InputError for anything but three numbers.
glm::dvec3 vectorOf(const Json& json);

/// A typed array of JavaScript, such as "Float64Array", with a copy of the numbers.
template <typename Number>
Value toArray(const char* type, const std::vector<Number>& numbers) {
  return Value::global(type).new_(Value(emscripten::typed_memory_view(numbers.size(), numbers.data())));
}

/// Item buffers as a list of Uint32Array, and back. The latter throws InputError unless there is one of the right size
/// for each face.
Value toArrays(const std::vector<raster::ItemBuffer>& buffers);
std::vector<raster::ItemBuffer> buffersOf(const Value& arrays, const std::vector<raster::Face>& faces);

/// Throws an error of JavaScript with the text of an exception, which is being handled.
[[noreturn]] void rethrowAsError();

/// Calls a function; its exceptions become errors of JavaScript. Returns what it returns.
template <typename Function>
auto guarded(const Function& function) {
  try {
    return function();
  } catch (...) {
    rethrowAsError();
  }
}

}  // namespace hemitex::web
