#include "tests/support/compressed_meshes.h"

#include <draco/compression/encode.h>
#include <meshoptimizer.h>

#include <cstring>
#include <stdexcept>
#include <vector>

namespace hemitex::tests {
namespace {

using nlohmann::json;

void require(bool isTrue) {
  if (!isTrue) throw std::runtime_error("a mesh cannot be encoded");
}

std::size_t componentsOf(const json& accessor) {
  const std::string type = accessor["type"];
  return type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
}

template <typename Value>
std::vector<Value> valuesOf(const json& description, const std::string& buffer, const json& accessor) {
  const json& view = description["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  std::vector<Value> values(accessor["count"].get<std::size_t>() * componentsOf(accessor));
  std::memcpy(values.data(), buffer.data() + view.value("byteOffset", std::size_t{0}), values.size() * sizeof(Value));
  return values;
}

/// Appends bytes to the buffer. Returns where they begin.
std::size_t append(std::string& buffer, const char* first, std::size_t size) {
  buffer.resize((buffer.size() + 3) / 4 * 4);
  buffer.append(first, size);
  return buffer.size() - size;
}

draco::GeometryAttribute::Type typeOf(const std::string& attribute) {
  return attribute == "POSITION"              ? draco::GeometryAttribute::POSITION
         : attribute == "NORMAL"              ? draco::GeometryAttribute::NORMAL
         : attribute.starts_with("TEXCOORD_") ? draco::GeometryAttribute::TEX_COORD
                                              : draco::GeometryAttribute::GENERIC;
}

void addAttribute(draco::Mesh& mesh, const std::string& name, const std::vector<float>& values, std::size_t width) {
  const std::size_t count = values.size() / width;
  mesh.set_num_points(static_cast<std::uint32_t>(count));
  draco::GeometryAttribute attribute;
  attribute.Init(typeOf(name), nullptr, static_cast<std::uint8_t>(width), draco::DT_FLOAT32, false,
                 static_cast<std::int64_t>(width * sizeof(float)), 0);
  const int id = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(count));
  for (std::uint32_t v = 0; v < count; ++v)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), &values[v * width]);
}

/// Encodes a primitive; `ids` gets the numbers of its attributes.
draco::EncoderBuffer encoded(const json& description, const std::string& buffer, const json& primitive, bool inSequence,
                             json& ids) {
  draco::Mesh mesh;
  for (const auto& [name, index] : primitive["attributes"].items()) {
    const json& accessor = description["accessors"][index.get<std::size_t>()];
    addAttribute(mesh, name, valuesOf<float>(description, buffer, accessor), componentsOf(accessor));
    ids[name] = mesh.attribute(mesh.num_attributes() - 1)->unique_id();
  }
  const auto corners =
      valuesOf<std::uint16_t>(description, buffer, description["accessors"][primitive["indices"].get<std::size_t>()]);
  for (std::size_t c = 0; c < corners.size(); c += 3)
    mesh.AddFace({draco::PointIndex(corners[c]), draco::PointIndex(corners[c + 1]), draco::PointIndex(corners[c + 2])});
  draco::Encoder encoder;
  encoder.SetEncodingMethod(inSequence ? draco::MESH_SEQUENTIAL_ENCODING : draco::MESH_EDGEBREAKER_ENCODING);
  for (const auto type : {draco::GeometryAttribute::POSITION, draco::GeometryAttribute::TEX_COORD})
    if (!inSequence) encoder.SetAttributeQuantization(type, 12);
  draco::EncoderBuffer bytes;
  require(encoder.EncodeMeshToBuffer(mesh, &bytes).ok());
  return bytes;
}

}  // namespace

void compressByDraco(json& description, std::string& buffer, bool inSequence) {
  for (json& mesh : description["meshes"])
    for (json& primitive : mesh["primitives"]) {
      json ids;
      const draco::EncoderBuffer bytes = encoded(description, buffer, primitive, inSequence, ids);
      const std::size_t offset = append(buffer, bytes.data(), bytes.size());
      description["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
      primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", description["bufferViews"].size() - 1},
                                                               {"attributes", ids}};
    }
  for (json& accessor : description["accessors"]) accessor.erase("bufferView");
  for (const char* list : {"extensionsUsed", "extensionsRequired"})
    description[list].push_back("KHR_draco_mesh_compression");
}

void compressByMeshopt(json& description, std::string& buffer, MeshoptMode mode) {
  std::size_t whole = 0;
  for (const json& accessor : description["accessors"]) {
    json& view = description["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::size_t count = accessor["count"], width = componentsOf(accessor);
    json extension{{"buffer", 0}, {"count", count}};
    std::vector<unsigned char> bytes;
    if (width == 1) {
      std::vector<unsigned> corners;
      for (const std::uint16_t corner : valuesOf<std::uint16_t>(description, buffer, accessor))
        corners.push_back(corner);
      const bool isRotated = mode == MeshoptMode::Rotated;
      bytes.resize(isRotated ? meshopt_encodeIndexBufferBound(count, 65536)
                             : meshopt_encodeIndexSequenceBound(count, 65536));
      bytes.resize(isRotated ? meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), corners.data(), count)
                             : meshopt_encodeIndexSequence(bytes.data(), bytes.size(), corners.data(), count));
      extension["mode"] = isRotated ? "TRIANGLES" : "INDICES";
      extension["byteStride"] = sizeof(std::uint16_t);
    } else {
      std::vector<float> values = valuesOf<float>(description, buffer, accessor);
      const std::size_t stride = width * sizeof(float);
      if (mode == MeshoptMode::Exponents) {
        const std::vector<float> given = values;
        meshopt_encodeFilterExp(values.data(), count, stride, 15, given.data());
        extension["filter"] = "EXPONENTIAL";
      }
      bytes.resize(meshopt_encodeVertexBufferBound(count, stride));
      bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values.data(), count, stride));
      extension["mode"] = "ATTRIBUTES";
      extension["byteStride"] = stride;
    }
    require(!bytes.empty());
    extension["byteOffset"] = append(buffer, reinterpret_cast<const char*>(bytes.data()), bytes.size());
    extension["byteLength"] = bytes.size();
    view["extensions"]["EXT_meshopt_compression"] = extension;
    view["buffer"] = 1;
    view["byteOffset"] = whole;
    whole += (view["byteLength"].get<std::size_t>() + 3) / 4 * 4;
  }
  description["buffers"][1] = {{"byteLength", whole},
                               {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}};
  for (const char* list : {"extensionsUsed", "extensionsRequired"})
    description[list].push_back("EXT_meshopt_compression");
}

}  // namespace hemitex::tests
