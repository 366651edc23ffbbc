/// Compressed meshes of glTF: those of KHR_draco_mesh_compression by Draco, and the buffer views of
/// EXT_meshopt_compression by meshoptimizer.
#pragma once

#include <tiny_gltf.h>

#include <optional>
#include <string>

#include "radiosity/gltf/gltf_module.h"

namespace hemitex::radiosity {

/// The bytes of a file with placeholders for what compressed files lack and tinygltf asks for: fallbacks of
/// EXT_meshopt_compression, buffers that may have no bytes, get one byte, and indices of Draco's meshes the buffer view
/// of their mesh. Nothing for other files, and for those that are no glTF.
std::optional<std::string> withPlaceholders(const std::string& bytes);

/// Appends the values of compressed meshes as buffers, and makes views, accessors and indices refer to them. Throws
/// Fault (accessors.h) for broken data, and what the budget throws for too much memory.
void decompress(tinygltf::Model& gltf, const ImportBudget& budget);

}  // namespace hemitex::radiosity
