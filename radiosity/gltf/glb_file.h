/// Writes binary glTF files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "radiosity/gltf/gltf_module.h"

namespace hemitex::radiosity {

/// Writes a model as binary glTF (.glb); equal models give equal files. The format counts bytes in 32 bits. A model
/// that may need more than `maxBytes` is not written; then returns a warning for the user. Uses memory for two copies
/// of the file. Throws InputError if the file cannot be written.
std::optional<std::string> writeGlb(const std::filesystem::path& file, GltfModel model,
                                    std::uint64_t maxBytes = std::numeric_limits<std::uint32_t>::max());

}  // namespace hemitex::radiosity
