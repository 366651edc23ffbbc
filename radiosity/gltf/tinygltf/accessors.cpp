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

/// Where numbers of a buffer are.
struct Range {
  int view = 0;
  std::size_t offset = 0;
  int componentType = 0;
  bool isNormalized = false;
};

/// `count` elements of `components` numbers. Throws Fault, with the accessor's name, if they reach beyond their view.
std::vector<double> numbersAt(const tinygltf::Model& gltf, const Range& range, std::size_t count,
                              std::size_t components, const std::string& name) {
  componentAt(std::array<unsigned char, 8>{}.data(), range.componentType, false);  // throws for an unknown type
  const auto componentBytes =
      static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(range.componentType)));
  const std::size_t size = componentBytes * components;
  if (count == 0) return {};
  const Bytes bytes = bytesOf(gltf, range.view);
  const std::size_t given = gltf.bufferViews[static_cast<std::size_t>(range.view)].byteStride;
  const std::size_t stride = given == 0 ? size : given;
  if (stride < size) throw Fault{name + " has a stride below the size of its values", exportAgain};
  // Divided, because products of numbers in the file may overflow.
  if (range.offset > bytes.size || size > bytes.size - range.offset ||
      count - 1 > (bytes.size - range.offset - size) / stride)
    throw Fault{name + " reaches beyond its buffer view", exportAgain};
  std::vector<double> values;
  values.reserve(count * components);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < components; ++c)
      values.push_back(componentAt(bytes.first + range.offset + i * stride + c * componentBytes, range.componentType,
                                   range.isNormalized));
  return values;
}

}  // namespace

Bytes bytesOf(const tinygltf::Model& gltf, int viewIndex) {
  const tinygltf::BufferView& view = itemAt(gltf.bufferViews, viewIndex, "buffer view");
  return bytesOf(gltf, view.buffer, view.byteOffset, view.byteLength, "buffer view " + std::to_string(viewIndex));
}

Bytes bytesOf(const tinygltf::Model& gltf, int buffer, std::size_t offset, std::size_t size, const std::string& name) {
  const std::vector<unsigned char>& data = itemAt(gltf.buffers, buffer, "buffer").data;
  if (offset > data.size() || size > data.size() - offset)
    throw Fault{name + " reaches beyond its buffer", exportAgain};
  return {data.data() + offset, size};
}

std::vector<double> valuesOf(const tinygltf::Model& gltf, int index, int type, int components) {
  const tinygltf::Accessor& accessor = itemAt(gltf.accessors, index, "accessor");
  const std::string name = "accessor " + std::to_string(index);
  if (accessor.type != type) throw Fault{name + " has values of a wrong type", exportAgain};
  const auto width = static_cast<std::size_t>(components);
  std::vector<double> values;
  if (accessor.bufferView < 0 && accessor.sparse.isSparse)
    values.resize(accessor.count * width);
  else
    values = numbersAt(gltf, {accessor.bufferView, accessor.byteOffset, accessor.componentType, accessor.normalized},
                       accessor.count, width, name);
  if (!accessor.sparse.isSparse) return values;
  const auto& [count, isSparse, indices, replaced] = accessor.sparse;
  const auto offset = [](int bytes) { return static_cast<std::size_t>(std::max(bytes, 0)); };
  const auto number = static_cast<std::size_t>(std::max(count, 0));
  const std::vector<double> places =
      numbersAt(gltf, {indices.bufferView, offset(indices.byteOffset), indices.componentType, false}, number, 1, name);
  const std::vector<double> others =
      numbersAt(gltf, {replaced.bufferView, offset(replaced.byteOffset), accessor.componentType, accessor.normalized},
                number, width, name);
  for (std::size_t i = 0; i < number; ++i) {
    if (!(places[i] >= 0 && places[i] < static_cast<double>(accessor.count)))
      throw Fault{name + " is sparse, and replaces a value that it lacks", exportAgain};
    std::copy_n(others.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                values.begin() + static_cast<std::ptrdiff_t>(places[i]) * static_cast<std::ptrdiff_t>(width));
  }
  return values;
}

std::vector<double> valuesOf(const tinygltf::Model& gltf, int index, int type, int components, std::size_t count) {
  if (itemAt(gltf.accessors, index, "accessor").count != count)
    throw Fault{"accessor " + std::to_string(index) + " has not one value for each of " + std::to_string(count),
                exportAgain};
  return valuesOf(gltf, index, type, components);
}

std::vector<double> numbersIn(const tinygltf::Value& object, const std::string& key) {
  std::vector<double> numbers;
  if (!object.IsObject() || !object.Has(key)) return numbers;
  const tinygltf::Value& value = object.Get(key);
  if (value.IsNumber()) numbers.push_back(value.GetNumberAsDouble());
  for (std::size_t i = 0; value.IsArray() && i < value.ArrayLen(); ++i)
    if (const tinygltf::Value& item = value.Get(static_cast<int>(i)); item.IsNumber())
      numbers.push_back(item.GetNumberAsDouble());
  return numbers;
}

int integerIn(const tinygltf::Value& object, const std::string& key, int missing) {
  const std::vector<double> numbers = numbersIn(object, key);
  constexpr std::numeric_limits<int> limits;
  return numbers.empty() ? missing : static_cast<int>(std::clamp<double>(numbers.front(), limits.min(), limits.max()));
}

const tinygltf::Value* extensionOf(const tinygltf::ExtensionMap& extensions, const std::string& name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

}  // namespace hemitex::radiosity
