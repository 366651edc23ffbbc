/// What the parts of the reader read from the model of tinygltf: compressed meshes, materials, and nodes.
#pragma once

#include <tiny_gltf.h>

#include <optional>
#include <string>
#include <vector>

#include "radiosity/gltf/gltf_module.h"

namespace hemitex::radiosity {

/// The model of a file's bytes, with the bytes of images. Files that it names are read from `folder` and added to
/// `files`. Throws Fault (accessors.h) for a file that is no glTF.
tinygltf::Model parsed(const std::string& bytes, const std::string& folder, const ImportBudget& budget,
                       std::vector<std::string>& files);

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

/// Where a part of the import is in the file.
struct PartPlace {
  int node = 0, primitive = 0;  ///< the node, and the primitive in its mesh
  bool isMirrored = false;      ///< whether the corners of triangles are in reverse order in the file
};

/// Adds the nodes of the scene that the file shows, their meshes and the first perspective camera to the import.
/// Returns the places of its parts. Throws Fault (accessors.h) for wrong numbers, and what the budget throws for too
/// much memory.
std::vector<PartPlace> readNodes(const tinygltf::Model& gltf, const ImportBudget& budget, GltfImport& import);

}  // namespace hemitex::radiosity
