/// The nodes of a glTF file with their meshes and cameras.
#pragma once

#include <tiny_gltf.h>

#include "radiosity/gltf/gltf_module.h"

namespace hemitex::radiosity {

/// Adds the nodes of the scene that the file shows, their meshes and the first perspective camera to the import. Throws
/// Fault (accessors.h) for wrong numbers, and what the budget throws for too much memory.
void readNodes(const tinygltf::Model& gltf, const ImportBudget& budget, GltfImport& import);

}  // namespace hemitex::radiosity
