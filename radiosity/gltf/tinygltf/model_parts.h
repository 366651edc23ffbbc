/// What the parts of the reader read from the model of tinygltf: compressed meshes, materials, and nodes.
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

/// Adds the images, those of one source once, and the materials to the import. Throws Fault (accessors.h) for wrong
/// numbers.
void readMaterials(const tinygltf::Model& gltf, GltfImport& import);

/// Adds the nodes of the scene that the file shows, their meshes and the first perspective camera to the import. Throws
/// Fault (accessors.h) for wrong numbers, and what the budget throws for too much memory.
void readNodes(const tinygltf::Model& gltf, const ImportBudget& budget, GltfImport& import);

}  // namespace hemitex::radiosity
