#include "cli/scene/facet_file.h"

#include "radiosity/meshes/vtu_file.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

const std::filesystem::path& checked(const std::filesystem::path& file) {
  if (file.extension() != ".vtu") throw raster::InputError(file.string(), 0, "does not end in .vtu", "rename it");
  return file;
}

}  // namespace

radiosity::PolygonMesh facetsOfFile(const std::filesystem::path& mesh, radiosity::Sides sides) {
  radiosity::PolygonMesh faces = radiosity::readFaces(mesh);
  if (sides != radiosity::Sides::Two) return faces;
  const std::size_t fronts = faces.polygons.size();
  for (std::size_t p = 0; p < fronts; ++p) {
    radiosity::MeshPolygon back = faces.polygons[p];
    const auto first = faces.corners.begin() + back.firstCorner;
    const std::vector<radiosity::MeshCorner> corners(first, first + back.cornerCount);
    back.firstCorner = static_cast<std::uint32_t>(faces.corners.size());
    faces.corners.insert(faces.corners.end(), corners.rbegin(), corners.rend());
    faces.polygons.push_back(back);
  }
  return faces;
}

FacetFile::FacetFile(const std::filesystem::path& file, const std::string& writer,
                     const std::set<std::filesystem::path>& inputs)
    : staging_({Output::Kind::File, checked(file), writer, inputs}) {
  staging_.requirePlaces({file.filename()});
}

void FacetFile::write(const std::filesystem::path& mesh, radiosity::Sides sides,
                      std::span<const radiosity::FaceArray> arrays) {
  radiosity::writeVtu(staging_.file(), facetsOfFile(mesh, sides), arrays);
  staging_.commit();
}

}  // namespace hemitex::cli
