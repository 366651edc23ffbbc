#include "cli/scene/facet_file.h"

#include "radiosity/meshes/vtu_file.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/input_error.h"
#include "raster/base/lower_case.h"

namespace hemitex::cli {
namespace {

const std::filesystem::path& checked(const std::filesystem::path& file) {
  if (raster::endingOf(file) != ".vtu") throw raster::InputError(file.string(), 0, "does not end in .vtu", "rename it");
  return file;
}

}  // namespace

FacetFile::FacetFile(const std::filesystem::path& file, const std::string& writer,
                     const std::set<std::filesystem::path>& inputs)
    : staging_({Output::Kind::File, checked(file), writer, inputs}) {
  staging_.requirePlaces({file.filename()});
}

void FacetFile::write(const std::filesystem::path& mesh, radiosity::Sides sides,
                      std::span<const radiosity::FaceArray> arrays) {
  radiosity::writeVtu(staging_.file(), radiosity::readFaces(mesh, sides), arrays);
  staging_.commit();
}

}  // namespace hemitex::cli
