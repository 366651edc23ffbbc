/// JSON as the program writes it: keys in the order they were given, numbers that read back to the same bits, and names
/// that are not UTF-8 mended instead of refused.
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace hemitex::cli {

inline nlohmann::ordered_json toJson(const glm::dvec3& value) { return {value.x, value.y, value.z}; }

/// The list of what `make` makes of each item.
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
