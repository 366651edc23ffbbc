/// Binary glTF files: their description (JSON) and their buffer.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace hemitex::tests {

struct Glb {
  nlohmann::json description;
  std::string buffer;
};

inline std::uint32_t uint32At(const std::string& bytes, std::size_t place) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

/// Reads a file of two chunks, as glTF 2.0, section 4.4, defines them. Throws std::runtime_error for anything else.
inline Glb parseGlb(const std::string& bytes) {
  const auto require = [](bool isTrue) {
    if (!isTrue) throw std::runtime_error("not binary glTF");
  };
  require(bytes.size() >= 20 && bytes.starts_with("glTF") && uint32At(bytes, 4) == 2 &&
          uint32At(bytes, 8) == bytes.size());
  const std::size_t length = uint32At(bytes, 12), second = 20 + length;
  require(length % 4 == 0 && bytes.substr(16, 4) == "JSON" && second + 8 <= bytes.size());
  require(bytes.substr(second + 4, 4) == std::string("BIN\0", 4));
  require(second + 8 + uint32At(bytes, second) == bytes.size());
  return {nlohmann::json::parse(bytes.substr(20, length)), bytes.substr(second + 8)};
}

/// The bytes of a file with this content.
inline std::string glbBytes(const Glb& glb) {
  const auto chunk = [](std::string content, const std::string& type, char padding) {
    content.resize((content.size() + 3) / 4 * 4, padding);
    const auto length = static_cast<std::uint32_t>(content.size());
    return std::string(reinterpret_cast<const char*>(&length), 4) + type + content;
  };
  const std::string chunks = chunk(glb.description.dump(), "JSON", ' ') + chunk(glb.buffer, std::string("BIN\0", 4), 0);
  const auto length = static_cast<std::uint32_t>(12 + chunks.size());
  return std::string("glTF\2\0\0\0", 8) + std::string(reinterpret_cast<const char*>(&length), 4) + chunks;
}

/// The bytes of a buffer view.
inline std::string viewBytes(const Glb& glb, std::size_t view) {
  const nlohmann::json& description = glb.description["bufferViews"].at(view);
  return glb.buffer.substr(description.value("byteOffset", std::size_t{0}), description["byteLength"]);
}

/// The values of an accessor that fills its buffer view.
template <typename Value>
std::vector<Value> accessorValues(const Glb& glb, std::size_t accessor) {
  const std::string bytes = viewBytes(glb, glb.description["accessors"].at(accessor)["bufferView"]);
  std::vector<Value> values(bytes.size() / sizeof(Value));
  std::memcpy(static_cast<void*>(values.data()), bytes.data(), values.size() * sizeof(Value));
  return values;
}

}  // namespace hemitex::tests
