/// The module hemitex_gltf, which is the only code that links tinygltf. Programs open it when they first need it.
#pragma once

#include <iosfwd>
#include <string>

#include "radiosity/gltf/gltf_import.h"
#include "radiosity/gltf/gltf_model.h"

namespace hemitex::radiosity {

/// What the module exports under the name `hemitexGltfWriter`.
struct GltfWriter {
  /// Writes a model as binary glTF (.glb). Equal models give equal bytes. The caller checks the stream.
  void (*write)(GltfModel model, std::ostream& stream);
};

/// What the module exports under the name `hemitexGltfReader`.
struct GltfReader {
  /// Reads the bytes of a .gltf or .glb file. Files that it names are read from `folder` and below, never from
  /// elsewhere. Throws nothing but std::bad_alloc.
  ImportProblem (*read)(const std::string& bytes, const std::string& folder, GltfImport& import);
};

/// Open the module at the first call. Throw std::runtime_error where it is not found.
const GltfWriter& gltfWriter();
const GltfReader& gltfReader();

}  // namespace hemitex::radiosity
