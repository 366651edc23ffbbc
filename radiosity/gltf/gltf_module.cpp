#include "radiosity/gltf/gltf_module.h"

#include "radiosity/base/module_symbol.h"

namespace hemitex::radiosity {

const GltfWriter& gltfWriter() {
  static const void* const writer = moduleSymbol("hemitex_gltf.so", "hemitexGltfWriter");
  return *static_cast<const GltfWriter*>(writer);
}

const GltfReader& gltfReader() {
  static const void* const reader = moduleSymbol("hemitex_gltf.so", "hemitexGltfReader");
  return *static_cast<const GltfReader*>(reader);
}

}  // namespace hemitex::radiosity
