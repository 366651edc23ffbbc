/// The files of a solved folder and their hashes, which solution.json holds. It is written last and removed first, so
/// that it fits its folder, or the folder shows that it is a mixture.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/common/staging.h"

namespace hemitex::cli {

/// The SHA-256 of each file below a folder, by its name relative to the folder; null for files with times in them
/// (report.html, and solution.json of frames).
nlohmann::ordered_json fileHashes(const std::filesystem::path& folder);
/// The same for the files of a result that is not moved yet.
nlohmann::ordered_json fileHashes(Staging& staging);

/// Throws InputError if a file that the solution.json of a folder names is missing or has another hash.
void requireIntact(const std::filesystem::path& folder);

/// Throws InputError for a solved folder without scene.obj (solve --no-textures).
void requireLitScene(const std::filesystem::path& folder);

}  // namespace hemitex::cli
