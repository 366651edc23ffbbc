/// The module hemitex_gltf: edits the JSON of a glTF file. The values come from tinygltf's model of the same file.
#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "radiosity/gltf/gltf_light_maps.h"
#include "radiosity/gltf/tinygltf/accessors.h"
#include "radiosity/gltf/tinygltf/model_parts.h"

namespace hemitex::radiosity {
namespace {

using json = nlohmann::ordered_json;

/// The description of a text or binary file.
json descriptionOf(const std::string& bytes) {
  if (!bytes.starts_with("glTF")) return json::parse(bytes);
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, sizeof length);
  return json::parse(bytes.substr(20, length));
}

std::string chunk(std::string content, const char* type, char padding) {
  content.resize((content.size() + 3) / 4 * 4, padding);
  const auto length = static_cast<std::uint32_t>(content.size());
  return std::string(reinterpret_cast<const char*>(&length), 4) + std::string(type, 4) + content;
}

/// A triangle with the coordinates of its corners, as the primitive has them.
struct EditedTriangle {
  std::array<std::uint32_t, 3> corners;
  std::array<glm::vec2, 3> coordinates;
  bool isBack = false;
};

/// The affine function of the coordinates of a lit triangle at a place in its plane.
glm::vec2 coordinateAt(const GltfLitTriangle& lit, const glm::dvec3& place) {
  const auto& [a, b, c] = lit.lightMapCoords;
  return glm::clamp(affineAt(lit.positions, {a, b, c}, place), 0.0, 1.0);
}

class Editor {
 public:
  Editor(json description, const tinygltf::Model& model, const std::vector<GltfLitTriangle>& lit,
         const std::vector<NamedLightMap>& maps)
      : file_(std::move(description)), model_(model), maps_(maps), materials_(file_.value("materials", json::array())) {
    joinBuffers();
    for (const GltfLitTriangle& triangle : lit) litOf_[triangle.polygon].push_back(&triangle);
  }

  void edit(const GltfImport& import, const std::vector<PartPlace>& places) {
    std::map<int, int> users;  // of a mesh
    for (const json& node : file_["nodes"])
      if (node.contains("mesh")) ++users[node["mesh"].get<int>()];
    std::uint32_t polygon = 0;
    for (std::size_t p = 0; p < import.parts.size();) {
      const int nodeIndex = places[p].node;
      json& node = file_["nodes"].at(static_cast<std::size_t>(nodeIndex));
      json mesh = file_["meshes"].at(node["mesh"].get<std::size_t>());
      std::map<int, json> edited;  // the new primitives of a primitive
      for (; p < import.parts.size() && places[p].node == nodeIndex; ++p) {
        edited[places[p].primitive] = editedPrimitive(
            mesh["primitives"].at(static_cast<std::size_t>(places[p].primitive)), import.parts[p], places[p], polygon);
        polygon += static_cast<std::uint32_t>(import.parts[p].corners.size() / 3);
      }
      json primitives = json::array();
      for (int i = 0; i < static_cast<int>(mesh["primitives"].size()); ++i)
        for (const json& primitive :
             edited.contains(i) ? edited[i] : json::array({mesh["primitives"][static_cast<std::size_t>(i)]}))
          primitives.push_back(primitive);
      mesh["primitives"] = std::move(primitives);
      if (users[node["mesh"].get<int>()] > 1) {
        node["mesh"] = file_["meshes"].size();
        file_["meshes"].push_back(std::move(mesh));
      } else {
        file_["meshes"].at(node["mesh"].get<std::size_t>()) = std::move(mesh);
      }
    }
  }

  /// Throws Fault for a file above the 4 GiB of the format.
  std::string bytes() && {
    file_["buffers"] = json::array({{{"byteLength", buffer_.size()}}});
    const std::string text = file_.dump(-1, ' ', false, json::error_handler_t::replace);
    if (text.size() + buffer_.size() > std::numeric_limits<std::uint32_t>::max() - 64)
      throw Fault{"it would have more than 4 GiB", "divide the scene"};
    const std::string chunks = chunk(text, "JSON", ' ') + chunk(std::move(buffer_), "BIN", 0);
    const auto length = static_cast<std::uint32_t>(12 + chunks.size());
    return std::string("glTF\2\0\0\0", 8) + std::string(reinterpret_cast<const char*>(&length), 4) + chunks;
  }

 private:
  /// Makes one buffer of all, and of the images in files.
  void joinBuffers() {
    std::vector<std::size_t> begins;
    for (const tinygltf::Buffer& buffer : model_.buffers) begins.push_back(append(std::span(buffer.data)));
    if (file_.contains("bufferViews"))
      for (json& view : file_["bufferViews"]) {
        view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + begins.at(view["buffer"].get<std::size_t>());
        view["buffer"] = 0;
      }
    std::map<std::string, std::size_t> views;  // of the files of images
    for (std::size_t i = 0; i < model_.images.size(); ++i) {
      json& image = file_["images"].at(i);
      if (!image.contains("uri")) continue;
      const std::vector<unsigned char>& data = model_.images[i].image;
      const std::string uri = image["uri"];
      if (!data.empty()) views.insert_or_assign(uri, appendView(std::span(data)));
      if (!views.contains(uri)) continue;  // a missing file
      image.erase("uri");
      image["bufferView"] = views.at(uri);
      if (!image.contains("mimeType")) image["mimeType"] = mimeTypeOf(views.at(uri));
    }
  }

  std::string mimeTypeOf(std::size_t view) const {
    const auto first = static_cast<unsigned char>(buffer_.at(file_["bufferViews"][view]["byteOffset"]));
    return first == 0x89 ? "image/png" : first == 0xff ? "image/jpeg" : "image/webp";
  }

  /// Returns where the values begin, at a multiple of 4 bytes.
  template <typename Value>
  std::size_t append(std::span<const Value> values) {
    const std::size_t begin = buffer_.size();
    buffer_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    return begin;
  }

  template <typename Value>
  std::size_t appendView(std::span<const Value> values) {
    const std::size_t begin = append(values);
    file_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", values.size_bytes()}});
    return file_["bufferViews"].size() - 1;
  }

  template <typename Value>
  std::size_t appendAccessor(const std::vector<Value>& values, int componentType, const char* type) {
    file_["accessors"].push_back({{"bufferView", appendView(std::span<const Value>(values))},
                                  {"componentType", componentType},
                                  {"count", values.size()},
                                  {"type", type}});
    return file_["accessors"].size() - 1;
  }

  /// Appends the values of some vertices as floats, or as they are in the file. Normals of backs are turned over.
  std::size_t appendVertices(int accessor, const std::vector<std::uint32_t>& vertices,
                             const std::vector<bool>& turned) {
    const tinygltf::Accessor& given = itemAt(model_.accessors, accessor, "accessor");
    const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(given.type));
    const auto width = static_cast<std::size_t>(components);
    if (given.sparse.isSparse || !turned.empty() || given.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) {
      const std::vector<double> values = valuesOf(model_, accessor, given.type, components);
      std::vector<float> chosen, low(width, std::numeric_limits<float>::max()), high(width, -low[0]);
      for (std::size_t v = 0; v < vertices.size(); ++v)
        for (std::size_t c = 0; c < width; ++c) {
          const auto value = static_cast<float>(values.at(vertices[v] * width + c));
          chosen.push_back(!turned.empty() && turned[v] && c < 3 ? -value : value);
          low[c] = std::min(low[c], value);
          high[c] = std::max(high[c], value);
        }
      const std::string type = file_["accessors"].at(static_cast<std::size_t>(accessor))["type"];
      const std::size_t index = appendAccessor(chosen, TINYGLTF_COMPONENT_TYPE_FLOAT, type.c_str());
      json& written = file_["accessors"][index];
      written["count"] = vertices.size();
      if (!given.minValues.empty()) written["min"] = low;
      if (!given.maxValues.empty()) written["max"] = high;
      return index;
    }
    const Bytes bytes = bytesOf(model_, given.bufferView);
    const auto stride =
        static_cast<std::size_t>(given.ByteStride(model_.bufferViews[static_cast<std::size_t>(given.bufferView)]));
    const std::size_t size =
        width *
        static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(given.componentType)));
    const std::size_t padded = (size + 3) / 4 * 4;
    std::vector<unsigned char> chosen(padded * vertices.size());
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const std::size_t from = given.byteOffset + vertices[v] * stride;
      if (from + size > bytes.size) throw Fault{"an attribute reaches beyond its buffer view", exportAgain};
      std::memcpy(&chosen[v * padded], bytes.first + from, size);
    }
    json written = file_["accessors"].at(static_cast<std::size_t>(accessor));
    written["bufferView"] = appendView(std::span<const unsigned char>(chosen));
    file_["bufferViews"].back()["byteStride"] = padded;
    written.erase("byteOffset");
    written["count"] = vertices.size();
    file_["accessors"].push_back(std::move(written));
    return file_["accessors"].size() - 1;
  }

  /// The triangles of a part by light maps. Triangles that are not lit are with the first one.
  std::map<int, std::vector<EditedTriangle>> trianglesOf(const ImportedPart& part, const PartPlace& place,
                                                         std::uint32_t polygon) const {
    std::map<int, std::vector<EditedTriangle>> byMap;
    std::vector<EditedTriangle> unlit;
    for (std::size_t c = 0; c < part.corners.size(); c += 3, ++polygon) {
      std::array<std::uint32_t, 3> corners{part.corners[c], part.corners[c + 1], part.corners[c + 2]};
      const auto normalOf = [](const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
        return glm::cross(q - p, r - p);
      };
      const glm::dvec3 normal =
          normalOf(part.positions[corners[0]], part.positions[corners[1]], part.positions[corners[2]]);
      bool isLit[2] = {false, false};
      const auto found = litOf_.find(polygon);
      if (found != litOf_.end())
        for (const GltfLitTriangle* lit : found->second) {
          EditedTriangle triangle{
              corners, {}, glm::dot(normal, normalOf(lit->positions[0], lit->positions[1], lit->positions[2])) < 0};
          if (std::exchange(isLit[triangle.isBack], true)) continue;  // another part of it
          for (std::size_t k = 0; k < 3; ++k) triangle.coordinates[k] = coordinateAt(*lit, part.positions[corners[k]]);
          byMap[lit->lightMap].push_back(triangle);
        }
      if (!isLit[0] && !isLit[1]) unlit.push_back({corners, {}});
    }
    if (!byMap.empty()) byMap.begin()->second.insert(byMap.begin()->second.end(), unlit.begin(), unlit.end());
    for (auto& [map, triangles] : byMap)
      for (EditedTriangle& triangle : triangles)
        if (triangle.isBack != place.isMirrored) {
          std::swap(triangle.corners[1], triangle.corners[2]);
          std::swap(triangle.coordinates[1], triangle.coordinates[2]);
        }
    return byMap;
  }

  /// The primitives, one per light map, that stand for one; a list.
  json editedPrimitive(const json& primitive, const ImportedPart& part, const PartPlace& place, std::uint32_t polygon) {
    const auto byMap = trianglesOf(part, place, polygon);
    if (byMap.empty()) return json::array({primitive});
    const bool hasBacks = std::any_of(byMap.begin(), byMap.end(), [](const auto& ofMap) {
      return std::any_of(ofMap.second.begin(), ofMap.second.end(), std::mem_fn(&EditedTriangle::isBack));
    });
    json primitives = json::array();
    for (const auto& [map, triangles] : byMap)
      primitives.push_back(
          withLightMap(primitive, map, triangles, byMap.size() == 1 ? part.positions.size() : 0, hasBacks));
    return primitives;
  }

  /// A primitive with coordinates of a light map, its own second ones or new ones. If each of all `vertices` has one,
  /// only they are added; else vertices are written anew. `hasBacks`: whether this or another one is a back.
  json withLightMap(json primitive, int map, const std::vector<EditedTriangle>& triangles, std::size_t vertices,
                    bool hasBacks) {
    const bool hasSet = maps_.at(static_cast<std::size_t>(map)).usesSecondCoordinates;
    int set = hasSet ? 1 : 0;
    while (!hasSet && primitive["attributes"].contains("TEXCOORD_" + std::to_string(set))) ++set;
    std::map<std::tuple<std::uint32_t, float, float, bool>, std::uint32_t> numbers;
    std::map<std::uint32_t, std::uint32_t> copies;  // of a vertex
    std::vector<std::uint32_t> sources, corners;
    std::vector<glm::vec2> coordinates;
    std::vector<bool> isBack;
    bool hasCopies = vertices == 0;
    for (const EditedTriangle& triangle : triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec2 coordinate = hasSet ? glm::vec2(0) : triangle.coordinates[k];  // each vertex has one already
        const auto [known, isNew] =
            numbers.try_emplace({triangle.corners[k], coordinate.x, coordinate.y, triangle.isBack},
                                static_cast<std::uint32_t>(sources.size()));
        corners.push_back(known->second);
        if (!isNew) continue;
        hasCopies = hasCopies || ++copies[triangle.corners[k]] > 1;
        sources.push_back(triangle.corners[k]);
        coordinates.push_back(coordinate);
        isBack.push_back(triangle.isBack);
      }
    if (hasCopies || hasBacks) {
      const auto moveTo = [&](json& attributes) {
        for (auto& [name, accessor] : attributes.items())
          accessor =
              appendVertices(accessor.get<int>(), sources, hasBacks && name == "NORMAL" ? isBack : std::vector<bool>());
      };
      moveTo(primitive["attributes"]);
      if (primitive.contains("targets"))
        for (json& target : primitive["targets"]) moveTo(target);
      primitive["indices"] = appendAccessor(corners, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, "SCALAR");
      primitive["mode"] = TINYGLTF_MODE_TRIANGLES;
    } else if (!hasSet) {
      std::vector<glm::vec2> ofVertices(vertices, glm::vec2(0));
      for (std::size_t v = 0; v < sources.size(); ++v) ofVertices[sources[v]] = coordinates[v];
      coordinates = std::move(ofVertices);
    }
    if (!hasSet)
      primitive["attributes"]["TEXCOORD_" + std::to_string(set)] =
          appendAccessor(coordinates, TINYGLTF_COMPONENT_TYPE_FLOAT, "VEC2");
    primitive["material"] = materialWith(primitive.value("material", -1), map, set, hasBacks);
    return primitive;
  }

  /// The number of a material with a light map: the material itself for the first, copies for others.
  std::size_t materialWith(int material, int map, int set, bool hasBacks) {
    const auto [known, isNew] = newMaterials_.try_emplace({material, map, set, hasBacks}, 0);
    if (!isNew) return known->second;
    const bool isFirst = material >= 0 && edited_.insert(material).second;
    const NamedLightMap& named = maps_.at(static_cast<std::size_t>(map));
    json written = material < 0 ? json{{"name", "default"}} : materials_.at(static_cast<std::size_t>(material));
    if (!isFirst && material >= 0) written["name"] = written.value("name", "material") + "/" + named.name;
    if (hasBacks) written.erase("doubleSided");  // both sides are there
    if (!written.contains("extras") || !written["extras"].is_object()) {
      const json former = written.value("extras", json());
      written["extras"] = json::object();
      if (!former.is_null()) written["extras"]["extras"] = former;
    }
    written["extras"].update({{"lightMap", named.map.png},
                              {"lightMapLinear", named.map.exr},
                              {"lightMapTexCoord", set},
                              {"lightMapScale", named.map.scale},
                              {"exposure", named.map.exposure}});
    json& list = file_["materials"];
    known->second = isFirst ? static_cast<std::size_t>(material) : list.size();
    if (isFirst)
      list.at(known->second) = std::move(written);
    else
      list.push_back(std::move(written));
    return known->second;
  }

  json file_;
  const tinygltf::Model& model_;
  const std::vector<NamedLightMap>& maps_;
  const json materials_;                                                 // of the given file
  std::map<std::uint32_t, std::vector<const GltfLitTriangle*>> litOf_;   // a polygon
  std::map<std::tuple<int, int, int, bool>, std::size_t> newMaterials_;  // numbers, with light maps
  std::set<int> edited_;                                                 // materials
  std::string buffer_;
};

/// What stores vertices in ways that are read, but not edited.
constexpr std::array<const char*, 3> uneditedExtensions{"EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression",
                                                        "EXT_meshopt_compression"};

ImportProblem edit(const std::string& bytes, const std::string& folder, const std::vector<GltfLitTriangle>& triangles,
                   const std::vector<NamedLightMap>& maps, std::string& edited) {
  const ImportBudget unlimited{[](std::uint64_t, const std::string&) {}, [](std::uint64_t, std::uint64_t) {}};
  try {
    GltfImport import;
    const tinygltf::Model model = parsed(bytes, folder, unlimited, import.files);
    for (const char* const name : uneditedExtensions)
      if (std::find(model.extensionsUsed.begin(), model.extensionsUsed.end(), name) != model.extensionsUsed.end())
        throw Fault{std::string("it uses ") + name, exportAgain};
    readMaterials(model, import);
    const std::vector<PartPlace> places = readNodes(model, unlimited, import);
    Editor editor(descriptionOf(bytes), model, triangles, maps);
    editor.edit(import, places);
    edited = std::move(editor).bytes();
  } catch (const Fault& fault) {
    return fault;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // of the JSON parser
    return {"it is no valid glTF", exportAgain};
  }
  return {};
}

}  // namespace
}  // namespace hemitex::radiosity

extern "C" __attribute__((visibility("default")))
const hemitex::radiosity::GltfEditor hemitexGltfEditor = {hemitex::radiosity::edit};
