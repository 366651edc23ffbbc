#include "radiosity/gltf/tinygltf/materials.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/base/unique_names.h"
#include "radiosity/gltf/tinygltf/accessors.h"

namespace hemitex::radiosity {
namespace {

/// A factor of three numbers of at least 0; `missing` where the file has none.
glm::dvec3 factorOf(const std::vector<double>& numbers, const glm::dvec3& missing, const std::string& what) {
  if (numbers.size() < 3) return missing;
  const glm::dvec3 factor(numbers[0], numbers[1], numbers[2]);
  if (!isFinite(factor)) throw Fault{"a factor of " + what + " is not finite", exportAgain};
  if (factor.x < 0 || factor.y < 0 || factor.z < 0)
    throw Fault{"a factor of " + what + " is negative", "light cannot be less than 0"};
  return factor;
}

double emissiveStrength(const tinygltf::Material& material) {
  const auto extension = material.extensions.find("KHR_materials_emissive_strength");
  if (extension == material.extensions.end() || !extension->second.IsObject() ||
      !extension->second.Has("emissiveStrength"))
    return 1;
  const tinygltf::Value& strength = extension->second.Get("emissiveStrength");
  return strength.IsNumber() ? strength.GetNumberAsDouble() : 1;
}

/// The image of a texture in the import, if there is one.
std::optional<int> imageOf(const tinygltf::Model& gltf, const std::vector<int>& images, int texture, int texcoord,
                           const std::string& material, GltfImport& import) {
  if (texture < 0) return {};
  const int image = itemAt(images, itemAt(gltf.textures, texture, "texture").source, "image");
  if (texcoord != 0)
    import.warnings.push_back("material '" + material + "': its texture uses other coordinates than the first ones");
  return image;
}

/// What lets light through a material: transmission, or alpha where the mode uses it. A factor of 0 transmits nothing.
std::string transparencyOf(const tinygltf::Material& material) {
  const auto transmission = material.extensions.find("KHR_materials_transmission");
  if (transmission != material.extensions.end() && transmission->second.IsObject() &&
      transmission->second.Has("transmissionFactor")) {
    const tinygltf::Value& factor = transmission->second.Get("transmissionFactor");
    if (factor.IsNumber() && factor.GetNumberAsDouble() > 0) return "KHR_materials_transmission";
  }
  return material.alphaMode == "BLEND" || material.alphaMode == "MASK" ? "alphaMode " + material.alphaMode : "";
}

/// `images` has the number in the import of each image of the file.
std::vector<ImportedMaterial> materialsOf(const tinygltf::Model& gltf, const std::vector<int>& images,
                                          GltfImport& import) {
  std::vector<ImportedMaterial> materials;
  UniqueNames names;
  for (std::size_t m = 0; m < gltf.materials.size(); ++m) {
    const tinygltf::Material& given = gltf.materials[m];
    ImportedMaterial material;
    material.name = names.add(given.name.empty() ? "material-" + std::to_string(m) : given.name);
    const std::string owner = "material '" + material.name + "'";
    const tinygltf::PbrMetallicRoughness& pbr = given.pbrMetallicRoughness;
    material.baseColor = factorOf(pbr.baseColorFactor, glm::dvec3(1.0), owner);
    material.baseColorImage =
        imageOf(gltf, images, pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord, material.name, import);
    const double strength = emissiveStrength(given);
    material.emission = factorOf(given.emissiveFactor, glm::dvec3(0.0), owner);
    material.emission =
        factorOf({material.emission.x * strength, material.emission.y * strength, material.emission.z * strength},
                 glm::dvec3(0.0), owner);
    material.emissionImage =
        imageOf(gltf, images, given.emissiveTexture.index, given.emissiveTexture.texCoord, material.name, import);
    material.transparency = transparencyOf(given);
    materials.push_back(std::move(material));
  }
  return materials;
}

/// The number of a key, `next` if it is new; and whether it is.
template <typename Key>
std::pair<int, bool> numberOf(std::map<Key, int>& numbers, const Key& key, int next) {
  const auto [known, isNew] = numbers.try_emplace(key, next);
  return {known->second, isNew};
}

/// Adds the images to the import, those of one source once. Returns the number in the import of each.
std::vector<int> readImages(const tinygltf::Model& gltf, GltfImport& import) {
  std::vector<int> numbers;
  std::map<std::string, int> ofFile;
  std::map<std::pair<const unsigned char*, std::size_t>, int> ofRange;
  for (std::size_t i = 0; i < gltf.images.size(); ++i) {
    const tinygltf::Image& given = gltf.images[i];
    Bytes bytes{given.image.data(), given.image.size()};
    if (given.bufferView >= 0) bytes = bytesOf(gltf, given.bufferView);
    const auto next = static_cast<int>(import.images.size());
    const bool isFile = given.bufferView < 0 && !given.uri.empty();
    const auto [number, isNew] =
        isFile ? numberOf(ofFile, given.uri, next) : numberOf(ofRange, std::pair(bytes.first, bytes.size), next);
    numbers.push_back(number);
    if (isNew)
      import.images.push_back({given.uri.empty() ? "image " + std::to_string(i) : given.uri,
                               { bytes.first,
                                 bytes.first + bytes.size }});
  }
  return numbers;
}

}  // namespace

void readMaterials(const tinygltf::Model& gltf, GltfImport& import) {
  import.materials = materialsOf(gltf, readImages(gltf, import), import);
}

}  // namespace hemitex::radiosity
