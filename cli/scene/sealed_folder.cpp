#include "cli/scene/sealed_folder.h"

#include <optional>

#include "cli/common/staging.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/hashes/sha256.h"
#include "reference/base/json_text.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

const char* const sealName = "solution.json";

bool hasTimes(const fs::path& name) { return name.filename() == sealName || name.filename() == "report.html"; }

bool staysInside(const fs::path& name) {
  return !name.empty() && name.is_relative() && *name.lexically_normal().begin() != "..";
}

/// Leaves out all members of the outermost object but `files`: a million surfaces would take gigabytes.
bool isOfFiles(int depth, ordered_json::parse_event_t event, ordered_json& parsed) {
  return depth != 1 || event != ordered_json::parse_event_t::key || parsed == "files";
}

/// The object `files` of the solution.json of a folder; empty if there is none.
ordered_json namedFiles(const fs::path& folder) {
  const std::optional<std::string> text = raster::tryReadFile(folder / sealName);
  if (!text) return ordered_json::object();
  try {
    const auto solution = reference::parseJson<ordered_json>(*text, {}, isOfFiles);
    const ordered_json files = solution.is_object() ? solution.value("files", ordered_json()) : ordered_json();
    return files.is_object() ? files : ordered_json::object();
  } catch (const raster::InputError&) {  // no file of ours
    return ordered_json::object();
  }
}

}  // namespace

ordered_json fileHashes(const fs::path& folder) {
  ordered_json hashes = ordered_json::object();
  for (const fs::path& name : filesBelow(folder))
    hashes[name.string()] = hasTimes(name) ? ordered_json() : ordered_json(reference::sha256OfFile(folder / name));
  return hashes;
}

std::set<std::string> filesOfSolution(const fs::path& folder) {
  std::set<std::string> names;
  const ordered_json files = namedFiles(folder);
  for (const auto& [name, hash] : files.items())
    if (staysInside(name)) names.insert(name);
  if (!names.empty()) names.insert(sealName);
  return names;
}

void requireIntact(const fs::path& folder) {
  const ordered_json files = namedFiles(folder);
  for (const auto& [name, hash] : files.items()) {
    const fs::path file = folder / name;
    const std::string advice = "solve the scene again, or remove solution.json";
    if (!staysInside(name) || !fs::is_regular_file(file))
      throw raster::InputError(file.string(), 0, "is missing, but solution.json beside it names it", advice);
    if (hash.is_string() && reference::sha256OfFile(file) != hash)
      throw raster::InputError(file.string(), 0, "is not the file that solution.json beside it names", advice);
  }
}

void requireLitScene(const fs::path& folder) {
  if (fs::exists(folder / "scene.obj") || namedFiles(folder).empty()) return;
  throw raster::InputError(folder.empty() ? "." : folder.string(), 0,
                           "holds no lit scene: it was solved with --no-textures",
                           "solve the scene again without --no-textures");
}

}  // namespace hemitex::cli
