/// Compressed meshes of glTF: those of KHR_draco_mesh_compression by Draco, and the buffer views of
/// EXT_meshopt_compression by meshoptimizer.
#include <draco/compression/decode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "radiosity/gltf/tinygltf/accessors.h"
#include "radiosity/gltf/tinygltf/model_parts.h"

namespace hemitex::radiosity {
namespace {

constexpr const char *dracoMeshes = "KHR_draco_mesh_compression", *meshoptViews = "EXT_meshopt_compression";

/// Appends a buffer. Returns its index.
int appendBuffer(tinygltf::Model& gltf, std::vector<unsigned char> bytes) {
  gltf.buffers.emplace_back();
  gltf.buffers.back().data = std::move(bytes);
  return static_cast<int>(gltf.buffers.size()) - 1;
}

// ---- meshoptimizer -------------------------------------------------------------------------------------------------

/// `count` values of `stride` bytes. `mode` and `filter` are those of the extension. Returns whether the data are
/// right.
bool decode(const Bytes& source, const std::string& mode, const std::string& filter, std::size_t count,
            std::size_t stride, std::vector<unsigned char>& bytes) {
  const bool isVertices = mode == "ATTRIBUTES";
  if (isVertices ? stride == 0 || stride > 256 || stride % 4 != 0 : stride != 2 && stride != 4) return false;
  // A byte of an encoded file stands for at most 64 bytes: 16 equal ones per two bits of the vertex codec.
  if (count > 64 * source.size / stride) return false;
  bytes.resize(count * stride);
  if (!isVertices && mode != "INDICES")
    return mode == "TRIANGLES" && count % 3 == 0 &&
           meshopt_decodeIndexBuffer(bytes.data(), count, stride, source.first, source.size) == 0;
  if (!isVertices) return meshopt_decodeIndexSequence(bytes.data(), count, stride, source.first, source.size) == 0;
  if (meshopt_decodeVertexBuffer(bytes.data(), count, stride, source.first, source.size) != 0) return false;
  if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))
    meshopt_decodeFilterOct(bytes.data(), count, stride);
  else if (filter == "QUATERNION" && stride == 8)
    meshopt_decodeFilterQuat(bytes.data(), count, stride);
  else if (filter == "EXPONENTIAL")
    meshopt_decodeFilterExp(bytes.data(), count, stride);
  else
    return filter == "NONE";
  return true;
}

/// Makes a view that the extension compresses one of a new buffer.
void decodeView(tinygltf::Model& gltf, std::size_t index, const ImportBudget& budget) {
  const tinygltf::BufferView& view = gltf.bufferViews[index];
  const tinygltf::Value* const extension = extensionOf(view.extensions, meshoptViews);
  if (extension == nullptr) return;
  const std::string name = numbered("buffer view", index);
  const auto size = [&](const char* key) {
    return static_cast<std::size_t>(std::max(integerIn(*extension, key, 0), 0));
  };
  const auto word = [&](const char* key) {
    return extension->Has(key) && extension->Get(key).IsString() ? extension->Get(key).Get<std::string>() : "NONE";
  };
  const Bytes source = bytesOf(gltf, integerIn(*extension, "buffer", -1), size("byteOffset"), size("byteLength"), name);
  budget.forFile(size("count") * size("byteStride"), name);
  std::vector<unsigned char> bytes;
  if (!decode(source, word("mode"), word("filter"), size("count"), size("byteStride"), bytes))
    throw Fault{name + " is compressed with meshopt, and its data are broken", exportAgain};
  const std::size_t length = bytes.size();
  const int buffer = appendBuffer(gltf, std::move(bytes));
  tinygltf::BufferView& decoded = gltf.bufferViews[index];
  decoded.buffer = buffer;
  decoded.byteOffset = 0;
  decoded.byteLength = length;
}

// ---- Draco ---------------------------------------------------------------------------------------------------------

/// Asks for the memory of a mesh by the numbers that its data begin with (version 2.2, which the extension asks for),
/// because Draco believes them. Returns whether they are there.
bool requireMemoryFor(draco::DecoderBuffer data, const ImportBudget& budget) {
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&data, &header).ok()) return false;
  data.set_bitstream_version(DRACO_BITSTREAM_VERSION(2, 2));
  draco::GeometryMetadata ignored;
  if ((header.flags & METADATA_FLAG_MASK) != 0 && !draco::MetadataDecoder().DecodeGeometryMetadata(&data, &ignored))
    return false;
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) data.Advance(1);
  std::uint32_t faces = 0, vertices = 0;
  if (!draco::DecodeVarint(&faces, &data) || !draco::DecodeVarint(&vertices, &data)) return false;
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) std::swap(faces, vertices);
  budget.forMeshes(faces, vertices);
  return header.version_major == 2 && header.version_minor == 2;
}

/// Appends an accessor of values in a buffer of their own. Returns its index.
template <typename Value>
int appendAccessor(tinygltf::Model& gltf, tinygltf::Accessor accessor, const std::vector<Value>& values) {
  const auto* const first = reinterpret_cast<const unsigned char*>(values.data());
  tinygltf::BufferView view;
  view.byteLength = values.size() * sizeof(Value);
  view.buffer = appendBuffer(gltf, {first, first + view.byteLength});
  gltf.bufferViews.push_back(std::move(view));
  accessor.bufferView = static_cast<int>(gltf.bufferViews.size()) - 1;
  accessor.byteOffset = 0;
  accessor.sparse.isSparse = false;
  gltf.accessors.push_back(std::move(accessor));
  return static_cast<int>(gltf.accessors.size()) - 1;
}

/// The types of components of glTF have the order of those of Draco, from 8 to 32 bits.
int componentTypeOf(draco::DataType type) {
  if (type == draco::DT_FLOAT32) return TINYGLTF_COMPONENT_TYPE_FLOAT;
  return type >= draco::DT_INT8 && type <= draco::DT_UINT32 ? TINYGLTF_COMPONENT_TYPE_BYTE + type - draco::DT_INT8 : -1;
}

/// The accessor of an attribute with the values of the decoded one. Returns its index, or -1 for broken data.
int decodeAttribute(tinygltf::Model& gltf, tinygltf::Accessor accessor, const draco::Mesh& mesh,
                    const draco::PointAttribute* attribute) {
  if (attribute == nullptr ||
      attribute->num_components() != tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)))
    return -1;
  const std::size_t stride = static_cast<std::size_t>(attribute->byte_stride());
  accessor.componentType = componentTypeOf(attribute->data_type());
  accessor.count = mesh.num_points();
  std::vector<unsigned char> values(accessor.count * stride);
  for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
    const unsigned char* const first = attribute->GetAddressOfMappedIndex(p);
    if (!attribute->IsAddressValid(first + stride - 1)) return -1;
    std::memcpy(values.data() + p.value() * stride, first, stride);
  }
  return appendAccessor(gltf, std::move(accessor), values);
}

/// Gives a primitive that the extension compresses accessors of new buffers.
void decodePrimitive(tinygltf::Model& gltf, tinygltf::Primitive& primitive, const std::string& name,
                     const ImportBudget& budget) {
  const tinygltf::Value* const extension = extensionOf(primitive.extensions, dracoMeshes);
  if (extension == nullptr) return;
  const Fault broken{name + " is compressed with Draco, and its data are broken", exportAgain};
  const Bytes bytes = bytesOf(gltf, integerIn(*extension, "bufferView", -1));
  draco::DecoderBuffer data;
  data.Init(reinterpret_cast<const char*>(bytes.first), bytes.size);
  if (!requireMemoryFor(data, budget)) throw broken;
  const auto decoded = draco::Decoder().DecodeMeshFromBuffer(&data);
  if (!decoded.ok() || !extension->Has("attributes")) throw broken;
  const draco::Mesh& mesh = *decoded.value();

  for (auto& [attribute, index] : primitive.attributes) {
    if (!extension->Get("attributes").Has(attribute)) continue;
    const int id = integerIn(extension->Get("attributes"), attribute, -1);
    index = decodeAttribute(gltf, itemAt(gltf.accessors, index, "accessor"), mesh,
                            mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id)));
    if (index < 0) throw broken;
  }
  std::vector<std::uint32_t> corners;
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
    for (const draco::PointIndex& corner : mesh.face(f)) corners.push_back(corner.value());
  tinygltf::Accessor indices;
  indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  indices.type = TINYGLTF_TYPE_SCALAR;
  indices.count = corners.size();
  primitive.indices = appendAccessor(gltf, std::move(indices), corners);
  primitive.mode = TINYGLTF_MODE_TRIANGLES;  // also for strips, which Draco turns into triangles
}

using nlohmann::json;

/// The extension of an object; null if there is none.
json extensionOf(const json& object, const char* name) {
  return object.value("extensions", json::object()).value(name, json());
}

void addPlaceholders(json& file) {
  for (json& buffer : file["buffers"])
    if (const json extension = extensionOf(buffer, meshoptViews);
        extension.is_object() && extension.value("fallback", false))
      buffer = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
  for (const json& mesh : file["meshes"])
    for (const json& primitive : mesh.value("primitives", json::array()))
      if (const json extension = extensionOf(primitive, dracoMeshes);
          primitive.contains("indices") && extension.is_object())
        file["accessors"].at(primitive["indices"].get<std::size_t>()).emplace("bufferView", extension.at("bufferView"));
}

/// Sets four bytes of a binary file.
void setSize(std::string& bytes, std::size_t place, std::size_t size) {
  const auto value = static_cast<std::uint32_t>(size);
  std::memcpy(bytes.data() + place, &value, sizeof value);
}

}  // namespace

std::optional<std::string> withPlaceholders(const std::string& bytes) {
  if (bytes.find(meshoptViews) == bytes.npos && bytes.find(dracoMeshes) == bytes.npos) return {};
  const bool isBinary = bytes.starts_with("glTF");
  constexpr std::size_t headers = 20;  // of a binary file and its first chunk, whose length is at 12
  std::uint32_t length = 0;
  if (isBinary && bytes.size() >= headers) std::memcpy(&length, bytes.data() + 12, sizeof length);
  const std::size_t begin = isBinary ? headers : 0, end = isBinary ? begin + length : bytes.size();
  if (end > bytes.size()) return {};
  json file = json::parse(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                          bytes.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
  if (!file.is_object()) return {};
  addPlaceholders(file);
  std::string text = file.dump(-1, ' ', false, json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string edited = bytes.substr(0, begin) + text + bytes.substr(end);
  if (isBinary) setSize(edited, 12, text.size());
  if (isBinary) setSize(edited, 8, edited.size());
  return edited;
}

void decompress(tinygltf::Model& gltf, const ImportBudget& budget) {
  for (std::size_t v = 0; v < gltf.bufferViews.size(); ++v) decodeView(gltf, v, budget);
  for (std::size_t m = 0; m < gltf.meshes.size(); ++m)
    for (tinygltf::Primitive& primitive : gltf.meshes[m].primitives)
      decodePrimitive(gltf, primitive, numbered("mesh", m), budget);
}

}  // namespace hemitex::radiosity
