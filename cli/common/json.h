/// JSON output. Keys keep their order, and numbers read back to the same bits. Bytes of names that are not valid UTF-8
/// are replaced.
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

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

inline std::string toText(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace hemitex::cli
