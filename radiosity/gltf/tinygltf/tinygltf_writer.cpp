/// The module hemitex_gltf: writes glTF by tinygltf.
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "radiosity/gltf/gltf_module.h"

namespace hemitex::radiosity {
namespace {

/// A name with the replacement character for bytes that are no UTF-8, such as those of an OBJ file in Latin-1. JSON
/// text must be UTF-8.
std::string validUtf8(const std::string& name) {
  using nlohmann::json;
  return json::parse(json(name).dump(-1, ' ', false, json::error_handler_t::replace));
}

int last(const auto& list) { return static_cast<int>(list.size()) - 1; }

/// Appends values to the buffer, at a multiple of 4 bytes. Returns the index of their view.
template <typename Value>
int appendView(tinygltf::Model& gltf, std::span<const Value> values, int target) {
  std::vector<unsigned char>& bytes = gltf.buffers.front().data;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = bytes.size();
  view.byteLength = values.size_bytes();
  view.target = target;
  const auto* const first = reinterpret_cast<const unsigned char*>(values.data());
  bytes.insert(bytes.end(), first, first + values.size_bytes());
  bytes.resize((bytes.size() + 3) / 4 * 4);
  gltf.bufferViews.push_back(std::move(view));
  return last(gltf.bufferViews);
}

int appendAccessor(tinygltf::Model& gltf, int view, int componentType, int type, std::size_t count) {
  tinygltf::Accessor accessor;
  accessor.bufferView = view;
  accessor.componentType = componentType;
  accessor.type = type;
  accessor.count = count;
  gltf.accessors.push_back(std::move(accessor));
  return last(gltf.accessors);
}

/// An accessor of one vector of binary32 per vertex.
template <int Size>
int appendAttribute(tinygltf::Model& gltf, const std::vector<glm::vec<Size, float, glm::defaultp>>& values) {
  const int view = appendView(gltf, std::span(values), TINYGLTF_TARGET_ARRAY_BUFFER);
  return appendAccessor(gltf, view, TINYGLTF_COMPONENT_TYPE_FLOAT, Size, values.size());
}

/// As above with the bounds that glTF requires of positions.
int appendPositions(tinygltf::Model& gltf, const std::vector<glm::vec3>& positions) {
  const int index = appendAttribute(gltf, positions);
  glm::vec3 low = positions.front(), high = low;
  for (const glm::vec3& position : positions) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  gltf.accessors.back().minValues = {low.x, low.y, low.z};
  gltf.accessors.back().maxValues = {high.x, high.y, high.z};
  return index;
}

int appendCorners(tinygltf::Model& gltf, const std::vector<std::uint32_t>& corners) {
  const int view = appendView(gltf, std::span(corners), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  return appendAccessor(gltf, view, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, corners.size());
}

int modeOf(Wrap wrap) {
  return wrap == Wrap::Clamp    ? TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE
         : wrap == Wrap::Mirror ? TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT
                                : TINYGLTF_TEXTURE_WRAP_REPEAT;
}

/// The index of a sampler with these modes.
int appendSampler(tinygltf::Model& gltf, const std::array<Wrap, 2>& wrap) {
  tinygltf::Sampler sampler;
  sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
  sampler.wrapS = modeOf(wrap[0]);
  sampler.wrapT = modeOf(wrap[1]);
  const auto known = std::find(gltf.samplers.begin(), gltf.samplers.end(), sampler);
  const auto index = static_cast<int>(known - gltf.samplers.begin());
  if (known == gltf.samplers.end()) gltf.samplers.push_back(std::move(sampler));
  return index;
}

void appendTexture(tinygltf::Model& gltf, const GltfTexture& texture) {
  tinygltf::Image image;
  image.name = validUtf8(texture.name);
  image.mimeType = "image/png";
  image.bufferView = appendView(gltf, std::span(texture.png), 0);
  gltf.images.push_back(std::move(image));
  tinygltf::Texture sampled;
  sampled.source = last(gltf.images);
  sampled.sampler = appendSampler(gltf, texture.sampler.wrap);
  gltf.textures.push_back(std::move(sampled));
}

std::vector<double> numbersOf(const glm::dvec3& vector) { return {vector.x, vector.y, vector.z}; }

tinygltf::Value extrasOf(const GltfLightMap& map) {
  tinygltf::Value::Object extras;
  extras["lightMap"] = tinygltf::Value(map.png);
  extras["lightMapLinear"] = tinygltf::Value(map.exr);
  extras["lightMapTexCoord"] = tinygltf::Value(1);
  extras["lightMapScale"] = tinygltf::Value(map.scale);
  extras["exposure"] = tinygltf::Value(map.exposure);
  return tinygltf::Value(std::move(extras));
}

/// The use of a texture, if there is one, with KHR_texture_transform where its place is not that of the coordinates.
tinygltf::TextureInfo useOf(const std::optional<int>& texture, const std::vector<GltfTexture>& textures) {
  tinygltf::TextureInfo info;
  if (!texture) return info;
  info.index = *texture;
  const std::array<double, 6>& place = textures[static_cast<std::size_t>(*texture)].sampler.place;
  if (place == Sampler().place) return info;
  // With v from the top: u and v are the columns of a scale and a turn.
  const glm::dvec2 u(place[0], -place[1]), v(-place[2], place[3]);
  const double scale = glm::length(u), angle = std::atan2(-u.y, u.x);
  const auto pair = [](double x, double y) {
    return tinygltf::Value(tinygltf::Value::Array{tinygltf::Value(x), tinygltf::Value(y)});
  };
  tinygltf::Value::Object transform;
  transform["scale"] = pair(scale, std::sin(angle) * v.x + std::cos(angle) * v.y);
  transform["offset"] = pair(place[4] - v.x, 1 - place[5] - v.y);
  if (angle != 0) transform["rotation"] = tinygltf::Value(angle);
  info.extensions["KHR_texture_transform"] = tinygltf::Value(std::move(transform));
  return info;
}

/// Factors of emission are at most 1; a strength holds the rest.
void setEmission(const GltfMaterial& material, const std::vector<GltfTexture>& textures, tinygltf::Material& written) {
  const double strength = std::max({1.0, material.emission.x, material.emission.y, material.emission.z});
  written.emissiveFactor = numbersOf(material.emission / strength);
  written.emissiveTexture = useOf(material.emissionTexture, textures);
  if (strength == 1) return;
  tinygltf::Value::Object extension;
  extension["emissiveStrength"] = tinygltf::Value(strength);
  written.extensions["KHR_materials_emissive_strength"] = tinygltf::Value(std::move(extension));
}

tinygltf::Material materialOf(const GltfMaterial& material, const std::vector<GltfTexture>& textures) {
  tinygltf::Material written;
  written.name = validUtf8(material.name);
  written.pbrMetallicRoughness.metallicFactor = 0;  // also for viewers that do not know unlit materials
  written.pbrMetallicRoughness.baseColorTexture = useOf(material.texture, textures);
  if (material.isCutOut) written.alphaMode = "MASK";
  if (!material.lightMap) {
    written.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object());
    return written;
  }
  written.pbrMetallicRoughness.baseColorFactor = {material.colour.x, material.colour.y, material.colour.z, 1};
  setEmission(material, textures, written);
  written.extras = extrasOf(*material.lightMap);
  return written;
}

/// The extensions that materials use.
std::vector<std::string> extensionsOf(const std::vector<tinygltf::Material>& materials) {
  std::set<std::string> names;
  for (const tinygltf::Material& material : materials)
    for (const tinygltf::ExtensionMap& extensions :
         {material.extensions, material.pbrMetallicRoughness.baseColorTexture.extensions,
          material.emissiveTexture.extensions})
      for (const auto& [name, value] : extensions) names.insert(name);
  return {names.begin(), names.end()};
}

tinygltf::Primitive appendPrimitive(tinygltf::Model& gltf, const GltfPrimitive& given) {
  tinygltf::Primitive primitive;
  primitive.attributes["POSITION"] = appendPositions(gltf, given.positions);
  primitive.attributes["TEXCOORD_0"] = appendAttribute(gltf, given.texcoords);
  if (!given.colours.empty()) primitive.attributes["COLOR_0"] = appendAttribute(gltf, given.colours);
  if (!given.lightMapCoords.empty()) primitive.attributes["TEXCOORD_1"] = appendAttribute(gltf, given.lightMapCoords);
  primitive.indices = appendCorners(gltf, given.corners);
  primitive.material = given.material;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  return primitive;
}

/// Appends the node of an object, with its mesh.
void appendObject(tinygltf::Model& gltf, const GltfObject& object, const glm::dvec3& origin) {
  tinygltf::Node node;
  node.name = validUtf8(object.name);
  if (!object.parent) node.translation = {origin.x, origin.y, origin.z};
  if (!object.primitives.empty()) {
    tinygltf::Mesh mesh;
    mesh.name = validUtf8(object.name);
    for (const GltfPrimitive& primitive : object.primitives)
      mesh.primitives.push_back(appendPrimitive(gltf, primitive));
    gltf.meshes.push_back(std::move(mesh));
    node.mesh = last(gltf.meshes);
  }
  gltf.nodes.push_back(std::move(node));
}

/// Appends the objects as the first nodes, and links them.
void appendObjects(tinygltf::Model& gltf, GltfModel& model) {
  std::vector<std::optional<int>> parents;
  for (GltfObject& object : model.objects) {
    appendObject(gltf, object, model.origin);
    parents.push_back(object.parent);
    object = {};
  }
  for (std::size_t n = 0; n < parents.size(); ++n) {
    const auto node = static_cast<int>(n);
    if (parents[n])
      gltf.nodes[static_cast<std::size_t>(*parents[n])].children.push_back(node);
    else
      gltf.scenes.front().nodes.push_back(node);
  }
}

std::vector<double> numbersOf(const glm::dmat4& matrix) {
  const double* first = &matrix[0][0];
  return {first, first + 16};
}

void appendCamera(tinygltf::Model& gltf, const GltfCamera& camera) {
  tinygltf::Camera perspective;
  perspective.name = "camera";
  perspective.type = "perspective";
  perspective.perspective.yfov = camera.fov;
  perspective.perspective.aspectRatio = camera.aspect;
  perspective.perspective.znear = camera.near;
  perspective.perspective.zfar = camera.far;
  gltf.cameras.push_back(std::move(perspective));

  tinygltf::Node node;
  node.name = "camera";
  node.camera = last(gltf.cameras);
  node.matrix = numbersOf(camera.toWorld);
  gltf.nodes.push_back(std::move(node));
  gltf.scenes.front().nodes.push_back(last(gltf.nodes));
}

/// Puts all roots below a node with the matrix.
void appendRoot(tinygltf::Model& gltf, const glm::dmat4& matrix) {
  if (matrix == glm::dmat4(1.0)) return;
  tinygltf::Node root;
  root.name = "scene";
  root.matrix = numbersOf(matrix);
  root.children = std::move(gltf.scenes.front().nodes);
  gltf.nodes.push_back(std::move(root));
  gltf.scenes.front().nodes = {last(gltf.nodes)};
}

/// Frees the parts of the model as it goes, because tinygltf needs a second copy of the buffer.
void write(GltfModel model, std::ostream& stream) {
  tinygltf::Model gltf;
  gltf.asset.version = "2.0";
  gltf.asset.generator = "hemitex";
  gltf.buffers.emplace_back();
  gltf.scenes.emplace_back();
  gltf.defaultScene = 0;
  for (const GltfMaterial& material : model.materials) gltf.materials.push_back(materialOf(material, model.textures));
  for (GltfTexture& texture : model.textures) {
    appendTexture(gltf, texture);
    texture = {};
  }
  gltf.extensionsUsed = extensionsOf(gltf.materials);
  appendObjects(gltf, model);
  appendCamera(gltf, model.camera);
  appendRoot(gltf, model.toGltf);
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&gltf, stream, false, true);
}

}  // namespace
}  // namespace hemitex::radiosity

extern "C" __attribute__((visibility("default")))
const hemitex::radiosity::GltfWriter hemitexGltfWriter = {hemitex::radiosity::write};
