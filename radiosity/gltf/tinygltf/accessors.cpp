#include "radiosity/gltf/tinygltf/accessors.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace hemitex::radiosity {
namespace {

static_assert(std::endian::native == std::endian::little, "the buffers of glTF are little-endian");

/// The largest value of a normalized integer stands for 1.
template <typename Component>
double valueAt(const unsigned char* bytes, bool isNormalized) {
  Component value;
  std::memcpy(&value, bytes, sizeof value);
  if (!isNormalized) return static_cast<double>(value);
  constexpr bool isScaled = std::is_integral_v<Component> && sizeof value < 4;
  return std::max(
      static_cast<double>(value) / (isScaled ? static_cast<double>(std::numeric_limits<Component>::max()) : 1), -1.0);
}

double componentAt(const unsigned char* bytes, int type, bool isNormalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return valueAt<std::int8_t>(bytes, isNormalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return valueAt<std::uint8_t>(bytes, isNormalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return valueAt<std::int16_t>(bytes, isNormalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return valueAt<std::uint16_t>(bytes, isNormalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return valueAt<std::uint32_t>(bytes, isNormalized);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return valueAt<float>(bytes, isNormalized);
    default:
      throw Fault{"the component type " + std::to_string(type) + " is unknown", exportAgain};
  }
}

}  // namespace

Bytes bytesOf(const tinygltf::Model& gltf, int viewIndex) {
  const tinygltf::BufferView& view = itemAt(gltf.bufferViews, viewIndex, "buffer view");
  const std::vector<unsigned char>& data = itemAt(gltf.buffers, view.buffer, "buffer").data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    throw Fault{"buffer view " + std::to_string(viewIndex) + " reaches beyond its buffer", exportAgain};
  return {data.data() + view.byteOffset, view.byteLength};
}

std::vector<double> valuesOf(const tinygltf::Model& gltf, int index, int type, int components) {
  const tinygltf::Accessor& accessor = itemAt(gltf.accessors, index, "accessor");
  const std::string name = "accessor " + std::to_string(index);
  if (accessor.sparse.isSparse) throw Fault{name + " is sparse, which is not read", "export without sparse accessors"};
  if (accessor.type != type) throw Fault{name + " has values of a wrong type", exportAgain};
  const std::int32_t componentSize =
      tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
  componentAt(std::array<unsigned char, 8>{}.data(), accessor.componentType, false);  // throws for an unknown type
  const auto componentBytes = static_cast<std::size_t>(componentSize);
  const std::size_t size = componentBytes * static_cast<std::size_t>(components);
  if (accessor.count == 0) return {};
  const Bytes bytes = bytesOf(gltf, accessor.bufferView);
  const std::size_t given = gltf.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
  const std::size_t stride = given == 0 ? size : given;
  if (stride < size) throw Fault{name + " has a stride below the size of its values", exportAgain};
  // Divided, because products of numbers in the file may overflow.
  if (accessor.byteOffset > bytes.size || size > bytes.size - accessor.byteOffset ||
      accessor.count - 1 > (bytes.size - accessor.byteOffset - size) / stride)
    throw Fault{name + " reaches beyond its buffer view", exportAgain};
  std::vector<double> values;
  values.reserve(accessor.count * static_cast<std::size_t>(components));
  for (std::size_t i = 0; i < accessor.count; ++i)
    for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c) {
      const unsigned char* const first = bytes.first + accessor.byteOffset + i * stride + c * componentBytes;
      values.push_back(componentAt(first, accessor.componentType, accessor.normalized));
    }
  return values;
}

}  // namespace hemitex::radiosity
