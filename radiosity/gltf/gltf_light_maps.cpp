#include "radiosity/gltf/gltf_light_maps.h"

#include "radiosity/base/module_symbol.h"
#include "raster/base/file_io.h"

namespace hemitex::radiosity {

namespace {

std::string folderOf(const std::filesystem::path& source) {
  return source.has_parent_path() ? source.parent_path().string() : ".";
}

}  // namespace

ImportProblem readParts(const std::filesystem::path& source, GltfImport& import) {
  const ImportBudget unlimited{[](std::uint64_t, const std::string&) {}, [](std::uint64_t, std::uint64_t) {}};
  return gltfReader().read(raster::readFile(source), folderOf(source), unlimited, import);
}

std::string writeWithLightMaps(const std::filesystem::path& file, const std::filesystem::path& source,
                               const std::vector<GltfLitTriangle>& triangles, const std::vector<NamedLightMap>& maps) {
  static const void* const editor = moduleSymbol("hemitex_gltf.so", "hemitexGltfEditor");
  std::string edited;
  const ImportProblem problem =
      static_cast<const GltfEditor*>(editor)->edit(raster::readFile(source), folderOf(source), triangles, maps, edited);
  if (problem.problem.empty()) raster::writeFile(file, edited);
  return problem.problem;
}

}  // namespace hemitex::radiosity
