/// The materials and images of a glTF file.
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/base/unique_names.h"
#include "radiosity/gltf/tinygltf/accessors.h"
#include "radiosity/gltf/tinygltf/model_parts.h"

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

/// The number of an extension; `missing` where the file has none.
double numberOf(const tinygltf::ExtensionMap& extensions, const std::string& name, const std::string& key,
                double missing) {
  const tinygltf::Value* const extension = extensionOf(extensions, name);
  const std::vector<double> numbers = extension ? numbersIn(*extension, key) : std::vector<double>();
  return numbers.empty() ? missing : numbers.front();
}

/// The use of a texture by a material.
struct TextureUse {
  std::optional<int> image = {};  ///< in the import
  Sampler sampler = {};
  int texcoords = 0;
};

Wrap wrapOf(int mode) {
  return mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? Wrap::Clamp
         : mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::Mirror
                                                         : Wrap::Repeat;
}

/// The place of KHR_texture_transform in an image, between coordinates with v = 0 at the bottom. The extension turns
/// around the top left corner; its example shows in which direction.
std::array<double, 6> placeOf(const tinygltf::Value& transform) {
  const auto pair = [&](const char* key, const glm::dvec2& missing) {
    const std::vector<double> numbers = numbersIn(transform, key);
    return numbers.size() == 2 ? glm::dvec2(numbers[0], numbers[1]) : missing;
  };
  const glm::dvec2 offset = pair("offset", glm::dvec2(0)), scale = pair("scale", glm::dvec2(1));
  const std::vector<double> rotation = numbersIn(transform, "rotation");
  const double angle = rotation.empty() ? 0 : rotation.front(), c = std::cos(angle), s = std::sin(angle);
  const glm::dvec2 u(c * scale.x, -s * scale.x), v(s * scale.y, c * scale.y), fromTop = v + offset;
  return {u.x, -u.y, -v.x, v.y, fromTop.x, 1 - fromTop.y};
}

/// How a material uses a texture. The image of an extension counts where the texture has no other.
TextureUse useOf(const tinygltf::Model& gltf, const std::vector<int>& images, const tinygltf::TextureInfo& info) {
  TextureUse use{.texcoords = info.texCoord};
  if (info.index < 0) return use;
  const tinygltf::Texture& texture = itemAt(gltf.textures, info.index, "texture");
  const tinygltf::Value* const webp = extensionOf(texture.extensions, "EXT_texture_webp");
  use.image = itemAt(images, texture.source < 0 && webp ? integerIn(*webp, "source", -1) : texture.source, "image");
  if (texture.sampler >= 0) {
    const tinygltf::Sampler& sampler = itemAt(gltf.samplers, texture.sampler, "sampler");
    use.sampler.wrap = {wrapOf(sampler.wrapS), wrapOf(sampler.wrapT)};
  }
  if (const tinygltf::Value* const transform = extensionOf(info.extensions, "KHR_texture_transform")) {
    use.sampler.place = placeOf(*transform);
    use.texcoords = integerIn(*transform, "texCoord", use.texcoords);
  }
  return use;
}

/// The diffuse part of KHR_materials_pbrSpecularGlossiness, as a base colour.
tinygltf::PbrMetallicRoughness diffuseOf(const tinygltf::Value& extension) {
  tinygltf::PbrMetallicRoughness pbr;
  pbr.baseColorFactor = numbersIn(extension, "diffuseFactor");
  if (!extension.Has("diffuseTexture")) return pbr;
  const tinygltf::Value& texture = extension.Get("diffuseTexture");
  pbr.baseColorTexture.index = integerIn(texture, "index", -1);
  pbr.baseColorTexture.texCoord = integerIn(texture, "texCoord", 0);
  if (texture.Has("extensions") && texture.Get("extensions").Has("KHR_texture_transform"))
    pbr.baseColorTexture.extensions["KHR_texture_transform"] = texture.Get("extensions").Get("KHR_texture_transform");
  return pbr;
}

/// What lets light through a material: transmission, or alpha where the mode uses it. A factor of 0 transmits nothing.
std::string transparencyOf(const tinygltf::Material& material) {
  if (numberOf(material.extensions, "KHR_materials_transmission", "transmissionFactor", 0) > 0)
    return "KHR_materials_transmission";
  return material.alphaMode == "BLEND" ? "alphaMode BLEND" : "";
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
    const tinygltf::Value* const glossy = extensionOf(given.extensions, "KHR_materials_pbrSpecularGlossiness");
    const tinygltf::PbrMetallicRoughness pbr = glossy ? diffuseOf(*glossy) : given.pbrMetallicRoughness;
    const TextureUse colour = useOf(gltf, images, pbr.baseColorTexture),
                     light = useOf(gltf, images, given.emissiveTexture);
    if (glossy ? !pbr.baseColorFactor.empty() : given.values.count("baseColorFactor") > 0)
      material.baseColor = factorOf(pbr.baseColorFactor, glm::dvec3(1.0), owner);
    if (pbr.baseColorFactor.size() > 3) material.alpha = pbr.baseColorFactor[3];
    if (given.alphaMode == "MASK") material.cutoff = given.alphaCutoff;
    material.isDoubleSided = given.doubleSided;
    material.baseColorImage = colour.image;
    material.baseColorSampler = colour.sampler;
    material.emissionImage = light.image;
    material.emissionSampler = light.sampler;
    material.texcoords = colour.image ? colour.texcoords : light.image ? light.texcoords : 0;
    if (colour.image && light.image && colour.texcoords != light.texcoords)
      import.warnings.push_back(owner +
                                ": its emissive texture uses other coordinates than its base colour; those of " +
                                "the base colour stand for them");
    const double strength = numberOf(given.extensions, "KHR_materials_emissive_strength", "emissiveStrength", 1);
    material.emission = factorOf(given.emissiveFactor, glm::dvec3(0.0), owner);
    material.emission =
        factorOf({material.emission.x * strength, material.emission.y * strength, material.emission.z * strength},
                 glm::dvec3(0.0), owner);
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
