/// JSON output. Keys keep their order, and numbers read back to the same bits. Bytes of names that are not valid UTF-8
/// are replaced, and characters that control a terminal are escaped (raster/base/printable_text.h).
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "raster/base/printable_text.h"

namespace hemitex::cli {

inline nlohmann::ordered_json toJson(const glm::dvec3& value) { return {value.x, value.y, value.z}; }

/// The value, or null if there is none.
template <typename Value>
nlohmann::ordered_json orNull(const std::optional<Value>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

/// The JSON list of `make(item)` for each item.
template <typename List, typename Make>
nlohmann::ordered_json listOf(const List& list, const Make& make) {
  nlohmann::ordered_json result = nlohmann::ordered_json::array();
  for (const auto& item : list) result.push_back(make(item));
  return result;
}

/// A value in one line, without its end, or in indented lines.
inline std::string toLine(const nlohmann::ordered_json& json, int indent = -1) {
  return raster::printableJson(json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

inline std::string toText(const nlohmann::ordered_json& json) { return toLine(json, 2) + '\n'; }

}  // namespace hemitex::cli
