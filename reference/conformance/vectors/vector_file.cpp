#include "reference/conformance/vectors/vector_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"
#include "raster/base/short_number.h"
#include "raster/interface/assembly.h"
#include "raster/plain/plain_renderer.h"
#include "raster/software/software_renderer.h"
#include "reference/base/json_text.h"
#include "reference/conformance/vectors/array_file.h"
#include "reference/conformance/vectors/enum_names.h"

namespace hemitex::reference {
namespace {

using Json = nlohmann::ordered_json;
using raster::InputError;
namespace filesystem = std::filesystem;

constexpr int newestRules = 2;

// --- JSON to values; every error names the key ---

const Json& at(const Json& object, const std::string& key) {
  if (!object.is_object() || !object.contains(key)) throw InputError("\"" + key + "\" is missing");
  return object.at(key);
}

/// Binary64 to binary32; a number written from a binary32 reads back to the same bits.
float toFloat(const Json& value, const std::string& key) {
  if (!value.is_number()) throw InputError("\"" + key + "\" is not a number");
  const auto number = static_cast<float>(value.get<double>());
  if (!std::isfinite(number)) throw InputError("\"" + key + "\" is beyond the range of binary32");
  return number;
}

std::int64_t toInteger(const Json& value, const std::string& key, std::int64_t low, std::int64_t high) {
  if (!value.is_number_integer()) throw InputError("\"" + key + "\" is not an integer");
  const bool isHuge = value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX;
  if (isHuge || value.get<std::int64_t>() < low || value.get<std::int64_t>() > high)
    throw InputError("\"" + key + "\" is not from " + std::to_string(low) + " to " + std::to_string(high));
  return value.get<std::int64_t>();
}

std::string toText(const Json& value, const std::string& key) {
  if (!value.is_string()) throw InputError("\"" + key + "\" is not a string");
  return value.get<std::string>();
}

bool toBool(const Json& value, const std::string& key) {
  if (!value.is_boolean()) throw InputError("\"" + key + "\" is neither true nor false");
  return value.get<bool>();
}

/// A file name without directories, so that a vector cannot read files outside of its folder.
std::string toFileName(const Json& value, const std::string& key) {
  const std::string name = toText(value, key);
  if (name.empty() || name == "." || name == ".." || name.find_first_of("/\\") != std::string::npos)
    throw InputError("\"" + key + "\" is not the name of a file in the vector's folder");
  return name;
}

const Json& toList(const Json& value, const std::string& key, std::optional<std::size_t> size = {}) {
  if (!value.is_array()) throw InputError("\"" + key + "\" is not a list");
  if (size && value.size() != *size)
    throw InputError("\"" + key + "\" does not have " + std::to_string(*size) + " entries");
  return value;
}

glm::vec3 toVector(const Json& value, const std::string& key) {
  const Json& list = toList(value, key, 3);
  return {toFloat(list[0], key), toFloat(list[1], key), toFloat(list[2], key)};
}

/// The value of a key that may be null or absent.
template <typename Read>
auto toOptional(const Json& object, const std::string& key, const Read& read)
    -> std::optional<decltype(read(object, key))> {
  if (!object.contains(key) || object.at(key).is_null()) return {};
  return read(object.at(key), key);
}

constexpr std::array<Named<raster::Blend>, 3> blendNames{{{raster::Blend::ClampedAdd, "clamped-add"},
                                                          {raster::Blend::IntegerAdd, "integer-add"},
                                                          {raster::Blend::Replace, "replace"}}};

constexpr std::array<Named<raster::Cull>, 3> cullNames{
    {{raster::Cull::None, "none"}, {raster::Cull::Front, "front"}, {raster::Cull::Back, "back"}}};

constexpr std::array<Named<raster::PixelValue>, 5> valueNames{
    {{raster::PixelValue::ItemIds, "item-ids"},
     {raster::PixelValue::TriangleNumbers, "triangle-numbers"},
     {raster::PixelValue::VertexValues, "vertex-values"},
     {raster::PixelValue::Pairs, "pairs"},
     {raster::PixelValue::PassedSamples, "passed-samples"}}};

constexpr std::array<Named<raster::Topology>, 3> topologyNames{
    {{raster::Topology::Triangles, "triangles"}, {raster::Topology::Strip, "strip"}, {raster::Topology::Fan, "fan"}}};

constexpr std::array<Named<raster::Provoking>, 2> provokingNames{
    {{raster::Provoking::First, "first"}, {raster::Provoking::Last, "last"}}};

constexpr std::array<Named<raster::DepthTest>, 4> depthTestNames{
    {{raster::DepthTest::Nearer, "nearer"},
     {raster::DepthTest::NearerOrEqual, "nearer-or-equal"},
     {raster::DepthTest::Farther, "farther"},
     {raster::DepthTest::FartherOrEqual, "farther-or-equal"}}};

constexpr std::array<Named<raster::SamplePlace>, 2> sampleNames{
    {{raster::SamplePlace::Middle, "middle"}, {raster::SamplePlace::Corner, "corner"}}};

constexpr std::array<Named<raster::ClipDepth>, 3> clipDepthNames{
    {{raster::ClipDepth::None, "none"},
     {raster::ClipDepth::ZeroToOne, "zero-to-one"},
     {raster::ClipDepth::MinusOneToOne, "minus-one-to-one"}}};

constexpr std::array<Named<raster::DepthPrecision>, 4> depthPrecisionNames{
    {{raster::DepthPrecision::Exact, "exact"},
     {raster::DepthPrecision::Unorm16, "unorm16"},
     {raster::DepthPrecision::Unorm24, "unorm24"},
     {raster::DepthPrecision::Float32, "float32"}}};

constexpr std::array<Named<raster::Winding>, 2> windingNames{
    {{raster::Winding::CounterClockwise, "counter-clockwise"}, {raster::Winding::Clockwise, "clockwise"}}};

/// Whether only PlainRenderer draws a vector.
bool isPlainOnly(const TestVector& vector) {
  return !isUsual(sourceOf(vector)) || std::any_of(vector.faces.begin(), vector.faces.end(),
                                                   [](const VectorFace& face) { return !isUsual(face.face); });
}

/// The first version of the rules that has all that a vector uses.
int rulesOf(const TestVector& vector) {
  const raster::DrawList& list = vector.list;
  const auto culls = [](const raster::Draw& draw) { return draw.cull != raster::Cull::None; };
  const bool isNew = vector.source || isPlainOnly(vector) || list.value != raster::PixelValue::ItemIds ||
                     std::any_of(list.indexMaps.begin(), list.indexMaps.end(), raster::hasHoles) ||
                     std::any_of(list.draws.begin(), list.draws.end(), culls);
  return isNew ? 2 : 1;
}

// --- reading ---

/// The vectors of a file, one per vertex.
template <typename Value>
std::vector<Value> readVertices(const filesystem::path& folder, const std::string& file) {
  constexpr std::size_t perValue = sizeof(Value) / sizeof(float);
  const std::vector<float> numbers = readArray<float>(folder / file);
  if (numbers.size() % perValue != 0)
    throw InputError(file + " holds " + std::to_string(numbers.size()) + " numbers",
                     "use " + std::to_string(perValue) + " per vertex");
  std::vector<Value> values(numbers.size() / perValue);
  std::copy(numbers.begin(), numbers.end(), reinterpret_cast<float*>(values.data()));
  return values;
}

/// Positions of a scene, or, with z as one of four numbers, in clip space.
void readPositions(const filesystem::path& folder, const std::string& file, raster::DrawList& list) {
  if (list.clipDepth == raster::ClipDepth::None) {
    list.positions = readVertices<glm::vec3>(folder, file);
    return;
  }
  for (const glm::vec4& position : readVertices<glm::vec4>(folder, file)) {
    list.positions.emplace_back(position.x, position.y, position.w);
    list.clipZ.push_back(position.z);
  }
}

/// In clip space a view has one degree of freedom: the direction of rows.
void requireClipView(const raster::Face& face) {
  const glm::vec3 zero(0.0F), x(1, 0, 0), y(0, 1, 0), w(0, 0, 1);
  if (face.eye != zero || face.x != x || (face.y != y && face.y != -y) || face.w != w)
    throw InputError("a face in clip space has an eye or rows of its own",
                     "use the eye 0,0,0 and the rows 1,0,0 and 0,0,1, with 0,1,0 or 0,-1,0 as y");
}

/// 16-bit numbers are read as 32-bit ones.
std::vector<std::uint32_t> readIndices(const filesystem::path& file, int bits) {
  if (bits == 32) return readArray<std::uint32_t>(file);
  const std::vector<std::uint16_t> indices = readArray<std::uint16_t>(file);
  return {indices.begin(), indices.end()};
}

raster::Instance readInstance(const Json& json) {
  const auto numbers = [&](const std::string& key, float otherwise) {
    glm::vec4 result(otherwise);
    if (!json.contains(key)) return result;
    const Json& list = toList(json.at(key), key, 4);
    for (int k = 0; k < 4; ++k) result[k] = toFloat(list[static_cast<std::size_t>(k)], key);
    return result;
  };
  return {numbers("scale", 1), numbers("offset", 0),
          static_cast<raster::ItemId>(toInteger(at(json, "id"), "id", 0, UINT32_MAX))};
}

/// The index maps of a vector, each file of one shape read once.
struct MapFiles {
  filesystem::path folder;
  std::map<std::tuple<std::string, int, int>, int> known;
};

int findMap(MapFiles& files, std::vector<raster::IndexMap>& maps, const std::string& file, int width, int height) {
  const auto [entry, isNew] = files.known.try_emplace({file, width, height}, static_cast<int>(maps.size()));
  if (isNew) maps.push_back({width, height, readArray<raster::ItemId>(files.folder / file)});
  return entry->second;
}

raster::Draw readDraw(const Json& json, MapFiles& files, std::vector<raster::IndexMap>& maps) {
  const auto id = [](const Json& value, const std::string& key) {
    return static_cast<raster::ItemId>(toInteger(value, key, 0, UINT32_MAX));
  };
  raster::Draw draw;
  draw.first = id(at(json, "first"), "first");
  draw.count = id(at(json, "count"), "count");
  draw.offset = id(at(json, "offset"), "offset");
  draw.back = toOptional(json, "back", id);
  draw.cull = valueOf(cullNames, toOptional(json, "cull", toText).value_or("none"), "cull");
  draw.topology = valueOf(topologyNames, toOptional(json, "topology", toText).value_or("triangles"), "topology");
  draw.restarts = toOptional(json, "restart", toBool).value_or(false);
  draw.baseVertex = toOptional(json, "base_vertex", id).value_or(0);
  draw.firstInstance = toOptional(json, "first_instance", id).value_or(0);
  draw.instances = toOptional(json, "instance_count", id).value_or(0);
  if (const auto file = toOptional(json, "index_map", toFileName)) {
    const auto side = [&](const std::string& key) { return static_cast<int>(toInteger(at(json, key), key, 1, 65536)); };
    draw.indexMap = findMap(files, maps, *file, side("width"), side("height"));
  }
  return draw;
}

raster::Scissor readScissor(const Json& json) {
  const Json& list = toList(json, "scissor", 4);
  const auto entry = [&](std::size_t k) { return static_cast<int>(toInteger(list[k], "scissor", 0, raster::maxSide)); };
  return {entry(0), entry(1), entry(2), entry(3)};
}

/// A number of pixels along both sides, or, in version 2, the numbers of columns and rows.
void readResolution(const Json& json, raster::Face& face) {
  const auto pixels = [](const Json& value, int low, int high) {
    return static_cast<int>(toInteger(value, "resolution", low, high));
  };
  if (!json.is_array()) {
    face.resolution = pixels(json, 2, 4096);
  } else {
    const Json& sides = toList(json, "resolution", 2);
    face.viewport = raster::Viewport{pixels(sides[0], 1, raster::maxSide), pixels(sides[1], 1, raster::maxSide)};
  }
}

VectorFace readFace(const Json& vector, const Json& json) {
  VectorFace face;
  face.name = toText(at(json, "name"), "name");
  face.ids = toFileName(at(json, "words"), "words");
  face.hash = toOptional(json, "hash", toText).value_or("");
  const std::optional<glm::vec3> ownEye = toOptional(json, "eye", toVector);
  face.face.eye = ownEye ? *ownEye : toVector(at(vector, "eye"), "eye");
  face.face.x = toVector(at(json, "x"), "x");
  face.face.y = toVector(at(json, "y"), "y");
  face.face.w = toVector(at(json, "w"), "w");
  face.face.nearDistance = toFloat(at(vector, "near"), "near");
  readResolution(at(vector, "resolution"), face.face);
  face.face.sample = valueOf(sampleNames, toOptional(vector, "sample", toText).value_or("middle"), "sample");
  face.face.scissor = readScissor(at(json, "scissor"));
  return face;
}

/// Sets the list, and keeps it if assembly changes it.
void setList(TestVector& vector, raster::DrawList list) {
  vector.list = assembled(list);
  if (!isAssembled(list)) vector.source = std::move(list);
}

TestVector readJson(const filesystem::path& folder, const Json& json) {
  const std::int64_t rules = toInteger(at(json, "rules"), "rules", 1, newestRules);
  TestVector vector;
  vector.name = toText(at(json, "name"), "name");
  vector.catches = toOptional(json, "catches", toText).value_or("");
  vector.origin = vectorAt(json, "origin");
  raster::DrawList list;
  list.format.channelBits.clear();
  for (const Json& bits : toList(at(json, "channels"), "channels"))
    list.format.channelBits.push_back(static_cast<int>(toInteger(bits, "channels", 1, 32)));
  list.blend = valueOf(blendNames, toText(at(json, "blend"), "blend"), "blend");
  const auto named = [&](const auto& names, const std::string& key) {
    return valueOf(names, toOptional(json, key, toText).value_or(names.front().name), key);
  };
  list.depthTest = named(depthTestNames, "depth_test");
  list.value = named(valueNames, "values");
  list.clipDepth = named(clipDepthNames, "clip_depth");
  list.depthPrecision = named(depthPrecisionNames, "depth_precision");
  list.front = named(windingNames, "front");
  list.provoking = named(provokingNames, "provoking");

  const auto file = [&](const std::string& key) { return toFileName(at(json, key), key); };
  readPositions(folder, file("positions"), list);
  list.texcoords = readVertices<glm::vec2>(folder, file("texcoords"));
  list.indexBits = file("indices").ends_with(".u16") ? 16 : 32;
  list.indices = readIndices(folder / file("indices"), list.indexBits);
  if (list.value == raster::PixelValue::VertexValues)
    list.vertexValues = readArray<raster::ItemId>(folder / file("vertex_values"));
  if (json.contains("instances"))
    for (const Json& instance : toList(json.at("instances"), "instances"))
      list.instances.push_back(readInstance(instance));
  MapFiles mapFiles{folder, {}};
  for (const Json& draw : toList(at(json, "draws"), "draws"))
    list.draws.push_back(readDraw(draw, mapFiles, list.indexMaps));
  raster::validate(list);
  setList(vector, list);
  const std::int64_t background = raster::backgroundId(list.format);
  toInteger(at(json, "background"), "background", background, background);

  for (const Json& face : toList(at(json, "faces"), "faces")) {
    vector.faces.push_back(readFace(json, face));
    raster::validate(vector.faces.back().face);
    if (list.clipDepth != raster::ClipDepth::None) requireClipView(vector.faces.back().face);
  }
  if (vector.faces.empty()) throw InputError("\"faces\" is empty");
  if (rulesOf(vector) > rules)
    throw InputError("the vector uses keys, values or holes (texels of 4294967295) that \"rules\": 1 does not have",
                     "write \"rules\": 2");
  std::set<std::string> names{"vector.json", file("positions"), file("texcoords"), file("indices")};
  if (!list.vertexValues.empty()) names.insert(file("vertex_values"));
  for (const auto& [map, index] : mapFiles.known) names.insert(std::get<std::string>(map));
  for (const VectorFace& face : vector.faces)
    if (!names.insert(face.ids).second)
      throw InputError("the item IDs of face \"" + face.name + "\" would overwrite \"" + face.ids + "\"");
  return vector;
}

bool hasPairs(const TestVector& vector) { return sourceOf(vector).value == raster::PixelValue::Pairs; }

/// The values of a face in a file: item IDs, or pairs of 64 bits.
template <typename Value>
std::vector<Value> readPixels(const filesystem::path& file, const raster::Scissor& scissor) {
  const raster::InputFile opened = raster::tryOpenFile(file);
  if (!opened)
    throw InputError(file.string(), 0, "is missing or not a file", "a candidate holds one item ID file per face");
  const std::uintmax_t size = filesystem::file_size(file);
  const std::uint64_t bytes = raster::saturatedProduct(sizeof(Value), scissor.width, scissor.height);
  if (size != bytes)
    throw InputError(file.string(), 0, "holds " + std::to_string(size) + " bytes",
                     std::to_string(scissor.width) + " x " + std::to_string(scissor.height) + " item IDs are " +
                         std::to_string(bytes) + " bytes");
  std::vector<Value> pixels(static_cast<std::size_t>(bytes / sizeof(Value)));
  if (std::fread(pixels.data(), 1, bytes, opened.get()) != bytes)
    throw InputError(file.string(), 0, "cannot be read to its end");
  return pixels;
}

raster::ItemBuffer readIds(const TestVector& vector, const filesystem::path& file, const raster::Scissor& scissor) {
  if (!hasPairs(vector)) return {scissor.width, scissor.height, readPixels<raster::ItemId>(file, scissor)};
  const raster::PairNumbers numbers(*vector.source);
  raster::ItemBuffer buffer;
  buffer.resize(scissor);
  const std::vector<std::uint64_t> pairs = readPixels<std::uint64_t>(file, scissor);
  std::transform(pairs.begin(), pairs.end(), buffer.ids.begin(),
                 [&](std::uint64_t pair) { return numbers.numberOf(pair); });
  return buffer;
}

/// The words of a face's file: item IDs, or the lower and the upper half of each pair.
std::vector<std::uint32_t> wordsOf(const TestVector& vector, const raster::ItemBuffer& buffer) {
  if (!hasPairs(vector)) return buffer.ids;
  const raster::PairNumbers numbers(*vector.source);
  std::vector<std::uint32_t> words;
  for (const raster::ItemId number : buffer.ids) {
    const std::uint64_t pair = numbers.pairOf(number);
    words.insert(words.end(), {static_cast<std::uint32_t>(pair), static_cast<std::uint32_t>(pair >> 32)});
  }
  return words;
}

// --- writing ---

/// A binary32 as the shortest binary64 decimal that reads back to it.
Json number(float value) {
  return raster::parseNumber(raster::withDigits(static_cast<double>(value), 9)).value_or(value);
}

Json toJson(const glm::vec3& v) { return {number(v.x), number(v.y), number(v.z)}; }

Json resolutionOf(const raster::Face& face) {
  return face.viewport ? Json{face.viewport->columns, face.viewport->rows} : Json(face.resolution);
}

std::string mapFileName(const raster::IndexMap& map, std::size_t index) {
  return "map-" + std::to_string(index) + "-" + std::to_string(map.width) + "x" + std::to_string(map.height) + ".u32";
}

void writePositions(const filesystem::path& file, const raster::DrawList& list) {
  if (list.clipDepth == raster::ClipDepth::None) return writeArray(file, list.positions);
  std::vector<glm::vec4> positions;
  for (std::size_t v = 0; v < list.positions.size(); ++v)
    positions.emplace_back(glm::vec2(list.positions[v]), list.clipZ[v], list.positions[v].z);
  writeArray(file, positions);
}

Json toJson(const raster::DrawList& list, const raster::Draw& draw) {
  Json json{{"first", draw.first}, {"count", draw.count}, {"offset", draw.offset}};
  json["back"] = draw.back ? Json(*draw.back) : Json();
  if (draw.cull != raster::Cull::None) json["cull"] = nameOf(cullNames, draw.cull);
  if (draw.topology != raster::Topology::Triangles) json["topology"] = nameOf(topologyNames, draw.topology);
  if (draw.restarts) json["restart"] = true;
  if (draw.baseVertex != 0) json["base_vertex"] = draw.baseVertex;
  if (draw.firstInstance != 0) json["first_instance"] = draw.firstInstance;
  if (draw.instances != 0) json["instance_count"] = draw.instances;
  json["index_map"] = nullptr;
  if (draw.indexMap) {
    const auto index = static_cast<std::size_t>(*draw.indexMap);
    const raster::IndexMap& map = list.indexMaps[index];
    json["index_map"] = mapFileName(map, index);
    json["width"] = map.width;
    json["height"] = map.height;
  }
  return json;
}

Json toJson(const raster::Instance& instance) {
  const auto numbers = [](const glm::vec4& v) { return Json{number(v.x), number(v.y), number(v.z), number(v.w)}; };
  return {{"scale", numbers(instance.scale)}, {"offset", numbers(instance.offset)}, {"id", instance.id}};
}

Json toJson(const VectorFace& face, const glm::vec3& sharedEye, const std::string& hash) {
  const raster::Scissor& scissor = face.face.scissor;
  Json json{{"name", face.name},
            {"x", toJson(face.face.x)},
            {"y", toJson(face.face.y)},
            {"w", toJson(face.face.w)},
            {"scissor", {scissor.column, scissor.row, scissor.width, scissor.height}},
            {"words", face.ids},
            {"hash", hash}};
  if (face.face.eye != sharedEye) json["eye"] = toJson(face.face.eye);
  return json;
}

}  // namespace

std::vector<raster::Face> facesOf(const TestVector& vector) {
  std::vector<raster::Face> faces;
  for (const VectorFace& face : vector.faces) faces.push_back(face.face);
  return faces;
}

std::vector<filesystem::path> vectorFolders(const filesystem::path& suite) {
  const auto isVector = [](const filesystem::path& folder) { return filesystem::exists(folder / "vector.json"); };
  if (isVector(suite) || !filesystem::is_directory(suite)) return {suite};
  std::vector<filesystem::path> folders;
  for (const filesystem::directory_entry& entry : filesystem::directory_iterator(suite))
    if (isVector(entry.path())) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  return folders.empty() ? std::vector{suite} : folders;
}

TestVector readVector(const filesystem::path& folder) {
  const filesystem::path file = folder / "vector.json";
  if (!filesystem::is_regular_file(file))
    throw InputError(file.string(), 0, "is missing or not a file", "a test vector is a folder with a vector.json");
  try {
    return readJson(folder, parseJson<Json>(raster::readFile(file), file.string()));
  } catch (const InputError& error) {
    if (!error.file().empty()) throw;
    throw InputError(file.string(), 0, error.what());
  }
}

void writeVector(const filesystem::path& folder, const TestVector& vector,
                 std::span<const raster::ItemBuffer> buffers) {
  const raster::DrawList& list = sourceOf(vector);
  const raster::Face& first = vector.faces.front().face;
  Json json{{"rules", rulesOf(vector)},
            {"name", vector.name},
            {"origin", {vector.origin.x, vector.origin.y, vector.origin.z}},
            {"resolution", resolutionOf(first)},
            {"near", number(first.nearDistance)},
            {"eye", toJson(first.eye)},
            {"channels", list.format.channelBits},
            {"blend", nameOf(blendNames, list.blend)},
            {"background", raster::backgroundId(list.format)},
            {"positions", "positions.f32"},
            {"texcoords", "texcoords.f32"},
            {"indices", list.indexBits == 16 ? "indices.u16" : "indices.u32"}};
  if (first.sample != raster::SamplePlace::Middle) json["sample"] = nameOf(sampleNames, first.sample);
  const auto addName = [&](const char* key, const auto& names, auto value) {
    if (value != names.front().value) json[key] = nameOf(names, value);
  };
  addName("values", valueNames, list.value);
  addName("depth_test", depthTestNames, list.depthTest);
  addName("clip_depth", clipDepthNames, list.clipDepth);
  addName("depth_precision", depthPrecisionNames, list.depthPrecision);
  addName("front", windingNames, list.front);
  addName("provoking", provokingNames, list.provoking);
  if (!list.vertexValues.empty()) json["vertex_values"] = "vertex-values.u32";
  for (const raster::Instance& instance : list.instances) json["instances"].push_back(toJson(instance));
  if (!vector.catches.empty()) json["catches"] = vector.catches;
  json["draws"] = Json::array();
  for (const raster::Draw& draw : list.draws) json["draws"].push_back(toJson(list, draw));
  json["faces"] = Json::array();
  for (std::size_t f = 0; f < vector.faces.size(); ++f) {
    const std::string hash = buffers.empty() ? "" : faceHash(vector, buffers[f]);
    json["faces"].push_back(toJson(vector.faces[f], first.eye, hash));
  }
  writeCandidate(folder, vector, buffers);
  writePositions(folder / "positions.f32", list);
  writeArray(folder / "texcoords.f32", list.texcoords);
  if (list.indexBits == 16)
    writeArray(folder / "indices.u16", std::vector<std::uint16_t>(list.indices.begin(), list.indices.end()));
  else
    writeArray(folder / "indices.u32", list.indices);
  if (!list.vertexValues.empty()) writeArray(folder / "vertex-values.u32", list.vertexValues);
  for (std::size_t m = 0; m < list.indexMaps.size(); ++m)
    writeArray(folder / mapFileName(list.indexMaps[m], m), list.indexMaps[m].ids);
  // Bytes of names that are not UTF-8 are replaced.
  raster::writeFile(folder / "vector.json", json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::vector<raster::ItemBuffer> readCandidate(const filesystem::path& folder, const TestVector& vector) {
  std::vector<raster::ItemBuffer> buffers;
  for (const VectorFace& face : vector.faces) buffers.push_back(readIds(vector, folder / face.ids, face.face.scissor));
  return buffers;
}

void writeCandidate(const filesystem::path& folder, const TestVector& vector,
                    std::span<const raster::ItemBuffer> buffers) {
  for (std::size_t f = 0; f < buffers.size(); ++f)
    writeArray(folder / vector.faces[f].ids, wordsOf(vector, buffers[f]));
}

std::string faceHash(const TestVector& vector, const raster::ItemBuffer& buffer) {
  return idsHash(wordsOf(vector, buffer));
}

std::string idsHash(std::span<const raster::ItemId> ids) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const raster::ItemId id : ids)
    for (int byte = 0; byte < 4; ++byte) hash = (hash ^ ((id >> (8 * byte)) & 0xff)) * 0x100000001b3u;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

TestVector makeVector(std::string name, std::string catches, raster::DrawList list, std::vector<raster::Face> faces,
                      const std::vector<std::string>& names) {
  TestVector vector;
  vector.name = std::move(name);
  vector.catches = std::move(catches);
  setList(vector, std::move(list));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::string numbered = faces.size() == 1 ? "front" : "face-" + std::to_string(f);
    const std::string& faceName = names.empty() ? numbered : names[f];
    vector.faces.push_back({faceName, faces[f], faceName + ".u32", {}});
  }
  return vector;
}

glm::ivec2 pixelAt(const raster::Scissor& scissor, std::size_t index) {
  const auto width = static_cast<std::size_t>(scissor.width);
  return {scissor.column + static_cast<int>(index % width), scissor.row + static_cast<int>(index / width)};
}

std::vector<raster::ItemBuffer> render(const TestVector& vector) {
  if (isPlainOnly(vector)) return render(raster::PlainRenderer(vector.list), facesOf(vector));
  return render(raster::SoftwareRenderer(vector.list), facesOf(vector));
}

std::string idsHash(std::span<const raster::ItemBuffer> buffers) {
  std::vector<raster::ItemId> ids;
  for (const raster::ItemBuffer& buffer : buffers) ids.insert(ids.end(), buffer.ids.begin(), buffer.ids.end());
  return idsHash(ids);
}

}  // namespace hemitex::reference
