/// Numbers and bytes of a glTF file: checks every index and range that tinygltf returns.
#pragma once

#include <tiny_gltf.h>

#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "radiosity/gltf/gltf_module.h"

namespace hemitex::radiosity {

using Fault = ImportProblem;

inline constexpr const char* exportAgain = "export the scene again";

inline std::string numbered(const std::string& what, std::size_t index) { return what + " " + std::to_string(index); }

template <typename Item>
const Item& itemAt(const std::vector<Item>& items, int index, const std::string& what) {
  if (index < 0 || static_cast<std::size_t>(index) >= items.size())
    throw Fault{what + " " + std::to_string(index) + " does not exist: there are " + std::to_string(items.size()),
                exportAgain};
  return items[static_cast<std::size_t>(index)];
}

inline bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Bytes of a buffer.
struct Bytes {
  const unsigned char* first = nullptr;
  std::size_t size = 0;
};

/// The bytes of a buffer view. Throws Fault if it reaches beyond its buffer.
Bytes bytesOf(const tinygltf::Model& gltf, int viewIndex);
/// `size` bytes of a buffer from `offset`. Throws Fault, with the name, if they reach beyond it.
Bytes bytesOf(const tinygltf::Model& gltf, int buffer, std::size_t offset, std::size_t size, const std::string& name);

/// The values of an accessor, `components` per element, with those that a sparse one replaces. Throws Fault for another
/// type, and for one that reaches beyond its buffer view.
std::vector<double> valuesOf(const tinygltf::Model& gltf, int index, int type, int components);
/// As above. Throws Fault, before memory is taken, unless it has `count` elements.
std::vector<double> valuesOf(const tinygltf::Model& gltf, int index, int type, int components, std::size_t count);

/// A member of an extension: its number or numbers; empty if there are none.
std::vector<double> numbersIn(const tinygltf::Value& object, const std::string& key);
/// The same as one integer, the nearest int of the sign where it is larger; `missing` if there is none.
int integerIn(const tinygltf::Value& object, const std::string& key, int missing);
/// The extension of a name; null if there is none.
const tinygltf::Value* extensionOf(const tinygltf::ExtensionMap& extensions, const std::string& name);

}  // namespace hemitex::radiosity
