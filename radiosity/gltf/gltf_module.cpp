#include "radiosity/gltf/gltf_module.h"

#include <fstream>
#include <stdexcept>
#include <utility>

#include "radiosity/base/module_symbol.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

const GltfWriter& writerFor(const std::filesystem::path& file) try {
  static const void* const writer = moduleSymbol("hemitex_gltf.so", "hemitexGltfWriter");
  return *static_cast<const GltfWriter*>(writer);
} catch (const std::runtime_error& error) {
  throw raster::InputError(file.string(), 0,
                           std::string("needs the module for glTF, which cannot be opened: ") + error.what(),
                           "install hemitex again, or build it with CMake");
}

/// An upper bound of the file's size. The description of an object, a primitive, a material or a texture takes less
/// than 2 KiB of JSON and its name, which stands there twice.
std::uint64_t maxSize(const GltfModel& model) {
  constexpr std::uint64_t description = 2048;
  std::uint64_t size = description;
  for (const GltfTexture& texture : model.textures) size += texture.png.size() + 2 * texture.name.size() + description;
  for (const GltfMaterial& material : model.materials) size += 2 * material.name.size() + description;
  for (const GltfObject& object : model.objects) {
    size += 2 * object.name.size() + description;
    for (const GltfPrimitive& primitive : object.primitives)
      size += primitive.positions.size() * sizeof(glm::vec3) + primitive.texcoords.size() * 2 * sizeof(glm::vec2) +
              primitive.corners.size() * sizeof(std::uint32_t) + description;
  }
  return size;
}

}  // namespace

const GltfReader& gltfReader() {
  static const void* const reader = moduleSymbol("hemitex_gltf.so", "hemitexGltfReader");
  return *static_cast<const GltfReader*>(reader);
}

std::optional<std::string> writeGlb(const std::filesystem::path& file, GltfModel model, std::uint64_t maxBytes) {
  if (maxSize(model) > maxBytes)
    return file.filename().string() +
           " is not written, because the scene needs more than the 4 GiB that the format can hold. Magnify display "
           "textures less, or use scene.obj.";
  const GltfWriter& writer = writerFor(file);
  std::ofstream stream(file, std::ios::binary);
  writer.write(std::move(model), stream);
  stream.close();
  if (!stream) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    throw raster::InputError(file.string(), 0, "cannot be written", "is there enough space, and may you write there?");
  }
  return std::nullopt;
}

}  // namespace hemitex::radiosity
