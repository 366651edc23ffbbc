#include "reference/conformance/records/conformance_record.h"

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/hashes/sha256.h"
#include "reference/base/json_text.h"

namespace hemitex::reference {
namespace {

using Json = nlohmann::ordered_json;
using raster::InputError;
namespace fs = std::filesystem;

constexpr const char* formatName = "hemitex conformance record";
constexpr int formatVersion = 1;

/// Names of folders may not be UTF-8; a record holds what replaces their bytes.
std::string textOf(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string hashOf(const Json& entry) { return sha256(textOf(entry)); }

Json withHash(Json entry) {
  const std::string hash = hashOf(entry);
  entry["sha256"] = hash;
  return entry;
}

bool isIntact(Json entry) {
  const auto hash = entry.find("sha256");
  if (hash == entry.end() || !hash->is_string()) return false;
  const std::string recorded = *hash;
  entry.erase("sha256");
  return hashOf(entry) == recorded;
}

std::string hashOfSuite(const std::vector<RecordedVector>& vectors) {
  std::string hashes;
  for (const RecordedVector& vector : vectors) hashes += vector.files + ' ' + vector.name + '\n';
  return sha256(hashes);
}

Json headerOf(const ConformanceRecord& record) {
  return {
      {"device", record.device},           {"driver", record.driver},          {"rules", record.rules},
      {"profile", toJson(record.profile)}, {"vectors", record.vectors.size()}, {"suite", hashOfSuite(record.vectors)}};
}

Json entryOf(const RecordedVector& vector) {
  Json entry{{"vector", vector.name},
             {"files", vector.files},
             {"outcome", nameOf(outcomeNames, vector.outcome)},
             {"expected", nullptr},
             {"faces", Json::array()}};
  if (vector.expected)
    entry["expected"] = {{"result", nameOf(expectationNames, vector.expected->expectation)},
                         {"reason", vector.expected->reason}};
  for (const RecordedFace& face : vector.faces) {
    Json pixels{{"name", face.name}, {"ids", face.ids}};
    for (const auto& [verdict, name] : pixelVerdictNames) pixels[name] = face.pixels[static_cast<std::size_t>(verdict)];
    entry["faces"].push_back(pixels);
  }
  return entry;
}

RecordedVector vectorOf(const Json& entry) {
  const auto text = [](const Json& object, const char* key) { return valueAt<std::string>(object, key); };
  RecordedVector vector{
      text(entry, "vector"), text(entry, "files"), valueOf(outcomeNames, text(entry, "outcome"), "outcome"), {}, {}};
  if (const Json expected = entry.value("expected", Json()); !expected.is_null())
    vector.expected = {vector.name, valueOf(expectationNames, text(expected, "result"), "result"),
                       text(expected, "reason")};
  for (const Json& pixels : partAt(entry, "faces")) {
    RecordedFace face{text(pixels, "name"), text(pixels, "ids"), {}};
    for (const auto& [verdict, name] : pixelVerdictNames)
      face.pixels[static_cast<std::size_t>(verdict)] = valueAt<std::uint64_t>(pixels, name);
    vector.faces.push_back(face);
  }
  return vector;
}

ConformanceRecord recordOf(const Json& entries) {
  const Json& header = entries[0];
  ConformanceRecord record{valueAt<int>(header, "rules"),
                           valueAt<std::string>(header, "device"),
                           valueAt<std::string>(header, "driver"),
                           parseProfile(partAt(header, "profile").dump()),
                           {}};
  for (std::size_t k = 1; k < entries.size(); ++k) record.vectors.push_back(vectorOf(entries[k]));
  return record;
}

std::vector<std::string> damageOf(const Json& entries, const ConformanceRecord& record) {
  std::vector<std::string> damage;
  for (std::size_t k = 0; k < entries.size(); ++k)
    if (!isIntact(entries[k]))
      damage.push_back(k == 0 ? "the header differs from its hash"
                              : "the entry of " + record.vectors[k - 1].name + " differs from its hash");
  const Json& header = entries[0];
  const auto vectors = valueAt<std::uint64_t>(header, "vectors");
  if (vectors != record.vectors.size())
    damage.push_back("it has entries of " + std::to_string(record.vectors.size()) + " vectors instead of " +
                     std::to_string(vectors));
  else if (valueAt<std::string>(header, "suite") != hashOfSuite(record.vectors))
    damage.push_back("the vectors are not those of the header");
  return damage;
}

Json parseRecord(const std::string& text) {
  const Json json = parseJson<Json>(text);
  if (!json.is_object() || json.value("format", Json()) != formatName) throw InputError("is not a conformance record");
  if (const Json version = json.value("version", Json()); version != formatVersion)
    throw InputError("has version " + shortText(version), "this program reads version 1");
  const Json& entries = partAt(json, "entries");
  if (!entries.is_array() || entries.empty()) throw InputError("has no entries");
  return entries;
}

/// As in an item ID file.
std::string_view bytesOf(const raster::ItemBuffer& buffer) {
  static_assert(std::endian::native == std::endian::little);
  return {reinterpret_cast<const char*>(buffer.ids.data()), buffer.ids.size() * sizeof(raster::ItemId)};
}

}  // namespace

std::string hashOfVector(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && !entry.path().filename().string().starts_with('.')) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::string hashes;
  for (const fs::path& file : files) hashes += sha256(raster::readFile(file)) + ' ' + file.filename().string() + '\n';
  return sha256(hashes);
}

RecordedVector recordOf(const Report& report, const fs::path& folder) {
  RecordedVector vector{folder.filename(), hashOfVector(folder), outcomeOf(report), report.expected, {}};
  for (const FaceVerdict& face : report.verdict.faces)
    vector.faces.push_back({face.name, sha256(bytesOf(face.found)), countVerdicts(face)});
  return vector;
}

std::string toJson(const ConformanceRecord& record) {
  Json json{{"format", formatName}, {"version", formatVersion}, {"entries", {withHash(headerOf(record))}}};
  for (const RecordedVector& vector : record.vectors) json["entries"].push_back(withHash(entryOf(vector)));
  return textOf(json, 2) + '\n';
}

RecordFile readRecord(const fs::path& file) {
  const std::string text = raster::readFile(file);
  try {
    const Json entries = parseRecord(text);
    const ConformanceRecord record = recordOf(entries);
    return {record, entries.size(), damageOf(entries, record)};
  } catch (const InputError& error) {
    throw InputError(file.string(), 0, error.what());
  }
}

std::vector<std::string> differences(const RecordedVector& recorded, const RecordedVector& found) {
  std::vector<std::string> lines;
  if (recorded.files != found.files) lines.push_back(recorded.name + ": other files than those of the record");
  if (found.faces.empty()) return lines;
  if (recorded.faces.size() != found.faces.size()) {
    lines.push_back(recorded.name + ": other faces than those of the record");
    return lines;
  }
  for (std::size_t f = 0; f < found.faces.size(); ++f) {
    const std::string place = recorded.name + ", " + found.faces[f].name;
    if (recorded.faces[f].ids != found.faces[f].ids)
      lines.push_back(place + ": other item IDs than those of the record");
    else if (recorded.faces[f] != found.faces[f])
      lines.push_back(place + ": another verdict than that of the record");
  }
  return lines;
}

}  // namespace hemitex::reference
