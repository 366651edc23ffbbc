#include "radiosity/gltf/gltf_light_maps.h"

#include "radiosity/base/module_symbol.h"
#include "raster/base/file_io.h"

namespace hemitex::radiosity {

std::string writeWithLightMaps(const std::filesystem::path& file, const std::filesystem::path& source,
                               const std::vector<GltfLitTriangle>& triangles, const std::vector<NamedLightMap>& maps) {
  static const void* const editor = moduleSymbol("hemitex_gltf.so", "hemitexGltfEditor");
  const std::string folder = source.has_parent_path() ? source.parent_path().string() : ".";
  std::string edited;
  const ImportProblem problem =
      static_cast<const GltfEditor*>(editor)->edit(raster::readFile(source), folder, triangles, maps, edited);
  if (problem.problem.empty()) raster::writeFile(file, edited);
  return problem.problem;
}

}  // namespace hemitex::radiosity
