#include "cli/scene/sealed_folder.h"

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/hashes/sha256.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The object `files` of the solution.json of a folder; empty if there is none.
ordered_json namedFiles(const fs::path& folder) {
  return filesOfSolution(raster::tryReadFile(folder / solutionName).value_or(""));
}

}  // namespace

ordered_json fileHashes(const fs::path& folder) {
  ordered_json hashes = ordered_json::object();
  for (const fs::path& name : filesBelow(folder))
    hashes[name.string()] = hasTimes(name) ? ordered_json() : ordered_json(reference::sha256OfFile(folder / name));
  return hashes;
}

ordered_json fileHashes(Staging& staging) {
  ordered_json hashes = ordered_json::object();
  for (const auto& [name, hash] : staging.hashes()) hashes[name] = hasTimes(name) ? ordered_json() : ordered_json(hash);
  return hashes;
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
