/// The materials and images of a glTF file.
#pragma once

#include <tiny_gltf.h>

#include "radiosity/gltf/gltf_module.h"

namespace hemitex::radiosity {

/// Adds the images, those of one source once, and the materials to the import. Throws Fault (accessors.h) for wrong
/// numbers.
void readMaterials(const tinygltf::Model& gltf, GltfImport& import);

}  // namespace hemitex::radiosity
