#include "reference/conformance/vectors/vector_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"
#include "raster/base/short_number.h"
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

glm::dvec3 toWideVector(const Json& value, const std::string& key) {
  const Json& list = toList(value, key, 3);
  glm::dvec3 result;
  for (int k = 0; k < 3; ++k) {
    const Json& number = list[static_cast<std::size_t>(k)];
    if (!number.is_number() || !std::isfinite(number.get<double>())) throw InputError("\"" + key + "\" is not finite");
    result[k] = number.get<double>();
  }
  return result;
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

constexpr std::array<Named<raster::PixelValue>, 2> valueNames{
    {{raster::PixelValue::ItemIds, "item-ids"}, {raster::PixelValue::TriangleNumbers, "triangle-numbers"}}};

constexpr std::array<Named<raster::DepthTest>, 4> depthTestNames{
    {{raster::DepthTest::Nearer, "nearer"},
     {raster::DepthTest::NearerOrEqual, "nearer-or-equal"},
     {raster::DepthTest::Farther, "farther"},
     {raster::DepthTest::FartherOrEqual, "farther-or-equal"}}};

constexpr std::array<Named<raster::SamplePlace>, 2> sampleNames{
    {{raster::SamplePlace::Middle, "middle"}, {raster::SamplePlace::Corner, "corner"}}};

/// Whether only PlainRenderer draws a vector.
bool isPlainOnly(const TestVector& vector) {
  return vector.list.depthTest != raster::DepthTest::Nearer ||
         std::any_of(vector.faces.begin(), vector.faces.end(),
                     [](const VectorFace& face) { return !isUsual(face.face); });
}

/// The first version of the rules that has all that a vector uses.
int rulesOf(const TestVector& vector) {
  const raster::DrawList& list = vector.list;
  const auto culls = [](const raster::Draw& draw) { return draw.cull != raster::Cull::None; };
  const bool isNew = isPlainOnly(vector) || list.value != raster::PixelValue::ItemIds ||
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

TestVector readJson(const filesystem::path& folder, const Json& json) {
  const std::int64_t rules = toInteger(at(json, "rules"), "rules", 1, newestRules);
  TestVector vector;
  vector.name = toText(at(json, "name"), "name");
  vector.catches = toOptional(json, "catches", toText).value_or("");
  vector.origin = toWideVector(at(json, "origin"), "origin");
  raster::DrawList& list = vector.list;
  list.format.channelBits.clear();
  for (const Json& bits : toList(at(json, "channels"), "channels"))
    list.format.channelBits.push_back(static_cast<int>(toInteger(bits, "channels", 1, 32)));
  list.blend = valueOf(blendNames, toText(at(json, "blend"), "blend"), "blend");
  list.value = valueOf(valueNames, toOptional(json, "values", toText).value_or("item-ids"), "values");
  list.depthTest = valueOf(depthTestNames, toOptional(json, "depth_test", toText).value_or("nearer"), "depth_test");

  const auto file = [&](const std::string& key) { return toFileName(at(json, key), key); };
  list.positions = readVertices<glm::vec3>(folder, file("positions"));
  list.texcoords = readVertices<glm::vec2>(folder, file("texcoords"));
  list.indices = readArray<std::uint32_t>(folder / file("indices"));
  MapFiles mapFiles{folder, {}};
  for (const Json& draw : toList(at(json, "draws"), "draws"))
    list.draws.push_back(readDraw(draw, mapFiles, list.indexMaps));
  raster::validate(list);
  const std::int64_t background = raster::backgroundId(list.format);
  toInteger(at(json, "background"), "background", background, background);

  for (const Json& face : toList(at(json, "faces"), "faces")) {
    vector.faces.push_back(readFace(json, face));
    raster::validate(vector.faces.back().face);
  }
  if (vector.faces.empty()) throw InputError("\"faces\" is empty");
  if (rulesOf(vector) > rules)
    throw InputError("the vector uses keys, values or holes (texels of 4294967295) that \"rules\": 1 does not have",
                     "write \"rules\": 2");
  std::set<std::string> names{"vector.json", file("positions"), file("texcoords"), file("indices")};
  for (const auto& [map, index] : mapFiles.known) names.insert(std::get<std::string>(map));
  for (const VectorFace& face : vector.faces)
    if (!names.insert(face.ids).second)
      throw InputError("the item IDs of face \"" + face.name + "\" would overwrite \"" + face.ids + "\"");
  return vector;
}

raster::ItemBuffer readIds(const filesystem::path& file, const raster::Scissor& scissor) {
  const raster::InputFile opened = raster::tryOpenFile(file);
  if (!opened)
    throw InputError(file.string(), 0, "is missing or not a file", "a candidate holds one item ID file per face");
  const std::uintmax_t size = filesystem::file_size(file);
  const std::uint64_t bytes = raster::saturatedProduct(sizeof(raster::ItemId), scissor.width, scissor.height);
  if (size != bytes)
    throw InputError(file.string(), 0, "holds " + std::to_string(size) + " bytes",
                     std::to_string(scissor.width) + " x " + std::to_string(scissor.height) + " item IDs are " +
                         std::to_string(bytes) + " bytes");
  raster::ItemBuffer buffer;
  buffer.resize(scissor);
  if (std::fread(buffer.ids.data(), 1, bytes, opened.get()) != bytes)
    throw InputError(file.string(), 0, "cannot be read to its end");
  return buffer;
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

Json toJson(const raster::DrawList& list, const raster::Draw& draw) {
  Json json{{"first", draw.first}, {"count", draw.count}, {"offset", draw.offset}};
  json["back"] = draw.back ? Json(*draw.back) : Json();
  if (draw.cull != raster::Cull::None) json["cull"] = nameOf(cullNames, draw.cull);
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
  const raster::DrawList& list = vector.list;
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
            {"indices", "indices.u32"}};
  if (first.sample != raster::SamplePlace::Middle) json["sample"] = nameOf(sampleNames, first.sample);
  if (list.value != raster::PixelValue::ItemIds) json["values"] = nameOf(valueNames, list.value);
  if (list.depthTest != raster::DepthTest::Nearer) json["depth_test"] = nameOf(depthTestNames, list.depthTest);
  if (!vector.catches.empty()) json["catches"] = vector.catches;
  json["draws"] = Json::array();
  for (const raster::Draw& draw : list.draws) json["draws"].push_back(toJson(list, draw));
  json["faces"] = Json::array();
  for (std::size_t f = 0; f < vector.faces.size(); ++f) {
    const std::string hash = buffers.empty() ? "" : idsHash(buffers[f].ids);
    json["faces"].push_back(toJson(vector.faces[f], first.eye, hash));
  }
  writeCandidate(folder, vector, buffers);
  writeArray(folder / "positions.f32", list.positions);
  writeArray(folder / "texcoords.f32", list.texcoords);
  writeArray(folder / "indices.u32", list.indices);
  for (std::size_t m = 0; m < list.indexMaps.size(); ++m)
    writeArray(folder / mapFileName(list.indexMaps[m], m), list.indexMaps[m].ids);
  // Bytes of names that are not UTF-8 are replaced.
  raster::writeFile(folder / "vector.json", json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::vector<raster::ItemBuffer> readCandidate(const filesystem::path& folder, const TestVector& vector) {
  std::vector<raster::ItemBuffer> buffers;
  for (const VectorFace& face : vector.faces) buffers.push_back(readIds(folder / face.ids, face.face.scissor));
  return buffers;
}

void writeCandidate(const filesystem::path& folder, const TestVector& vector,
                    std::span<const raster::ItemBuffer> buffers) {
  for (std::size_t f = 0; f < buffers.size(); ++f) writeArray(folder / vector.faces[f].ids, buffers[f].ids);
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
  vector.list = std::move(list);
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
