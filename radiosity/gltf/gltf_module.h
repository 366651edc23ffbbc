/// The module hemitex_gltf, which is the only code that links tinygltf. Programs open it when they first need it.
#pragma once

#include <iosfwd>
#include <string>

#include "radiosity/gltf/gltf_model.h"

namespace hemitex::radiosity {

/// What the module exports under the name `hemitexGltfWriter`.
struct GltfWriter {
  /// Writes a model as binary glTF (.glb). Equal models give equal bytes. The caller checks the stream.
  void (*write)(GltfModel model, std::ostream& stream);
};

/// Opens the module at the first call. Throws std::runtime_error where it is not found.
const GltfWriter& gltfWriter();

}  // namespace hemitex::radiosity
