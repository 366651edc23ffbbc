#include "cli/render/solved_folder.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cli/scene/sealed_folder.h"
#include "cli/scene/surface_names.h"
#include "radiosity/images/image.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/json_text.h"

namespace hemitex::cli {
namespace {

using nlohmann::json;

/// Reads a number of texels. Throws std::out_of_range if it is below `least`.
int texelsAt(const json& object, const char* key, int least) {
  const int value = object.at(key).get<int>();
  if (value < least) throw std::out_of_range(std::string(key) + " is below " + std::to_string(least));
  return value;
}

/// Maps a texture coordinate to the chart at texels [start, start + length] of `size`; rounded to binary32, as charts
/// are.
double chartCoordinate(double texture, int size, int start, int length) {
  const double chart = (texture * size - start) / length;
  return static_cast<float>(std::clamp(chart, 0.0, 1.0));
}

radiosity::Image scaled(radiosity::Image image, double factor) {
  for (glm::dvec3& pixel : image.pixels) pixel *= factor;
  return image;
}

/// Multiplies the linear value of an sRGB-encoded colour.
glm::dvec3 scaledColour(const glm::dvec3& encoded, double factor) {
  glm::dvec3 colour(0);
  for (int band = 0; band < 3; ++band)
    colour[band] = radiosity::encodeSrgb(radiosity::decodeSrgb(encoded[band]) * factor) / 255.0;
  return colour;
}

}  // namespace

std::optional<SolvedFolder> SolvedFolder::around(const std::filesystem::path& sceneFile,
                                                 const radiosity::Scene& scene) {
  SolvedFolder solved;
  solved.folder_ = sceneFile.parent_path();
  const std::filesystem::path file = solved.folder_ / "solution.json";
  const std::optional<std::string> text = raster::tryReadFile(file);
  if (!text) return std::nullopt;
  requireIntact(solved.folder_);
  try {
    const json solution = reference::parseJson<json>(*text);
    const json& settings = solution.at("settings");
    if (const json& texels = settings.at("texels"); !texels.is_null()) solved.settings_.texels = texels.get<int>();
    solved.settings_.patch = settings.at("patch").get<int>();
    if (const json& size = settings.at("texel_size"); !size.is_null()) solved.settings_.texelSize = size.get<double>();
    solved.exposure_ = settings.at("exposure").get<double>();
    if (settings.contains("sky")) solved.sky_ = reference::vectorAt(settings, "sky");
    // The lit scene has one group per surface, in order. A group without a chart may have several planar parts.
    const json& surfaces = solution.at("surfaces");
    for (const std::uint32_t family : familiesOf(scene).ofSurface) {
      const json& surface = surfaces.at(family);
      const json& texture = surface.at("texture");
      solved.places_.push_back({texture.at("name").get<std::string>(), texelsAt(texture, "width", 1),
                                texelsAt(texture, "height", 1), texelsAt(texture, "column", 0),
                                texelsAt(texture, "row", 0), texelsAt(surface, "columns", 1),
                                texelsAt(surface, "rows", 1)});
    }
  } catch (const std::exception& error) {
    throw raster::InputError(file.string(), 0, std::string("does not belong to the scene beside it: ") + error.what(),
                             "solve the scene again");
  }
  return solved;
}

void SolvedFolder::restoreCharts(radiosity::Scene& scene) const {
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const Place& place = places_[s];
    for (radiosity::Triangle& triangle : scene.surfaces[s].triangles)
      for (glm::dvec2& corner : triangle.chart)
        corner = {chartCoordinate(corner.x, place.width, place.column, place.columns),
                  chartCoordinate(corner.y, place.height, place.row, place.rows)};
  }
}

radiosity::DiscretizationSettings SolvedFolder::grids(const radiosity::Scene& scene) const {
  radiosity::DiscretizationSettings settings = settings_;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const Place& place = places_[s];
    if (!settings.texels || radiosity::GridSize(place.columns, place.rows) != radiosity::GridSize(*settings.texels))
      settings.surfaceTexels[scene.surfaces[s].family] = {place.columns, place.rows};
  }
  return settings;
}

std::vector<glm::dvec3> SolvedFolder::radiosity(const radiosity::Discretization& discretization) const {
  std::map<std::string, radiosity::Image> textures;
  std::vector<glm::dvec3> values;
  for (const radiosity::Element& element : discretization.elements) {
    const Place& place = places_[element.surface];
    const auto [texture, isNew] = textures.try_emplace(place.texture);
    if (isNew) texture->second = radiosity::readImage(folder_ / (place.texture + ".exr"));
    const radiosity::Image& image = texture->second;
    const auto columns = static_cast<std::uint32_t>(place.columns);
    const int column = place.column + static_cast<int>(element.texel % columns);
    const int row = image.height - 1 - place.row - static_cast<int>(element.texel / columns);
    if (column < 0 || column >= image.width || row < 0 || row >= image.height)
      throw raster::InputError((folder_ / (place.texture + ".exr")).string(), 0,
                               "has fewer texels than solution.json gives", "solve the scene again");
    values.push_back(image.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                                  static_cast<std::size_t>(column)]);
  }
  return values;
}

void SolvedFolder::expose(radiosity::Scene& scene, double exposure) const {
  for (const radiosity::Material& material : scene.materials)
    if (material.reflectanceMap)
      scene.images[static_cast<std::size_t>(*material.reflectanceMap)] =
          scaled(radiosity::readImage(folder_ / (material.name + ".exr")), exposure);
  for (radiosity::Surface& surface : scene.surfaces)
    for (radiosity::Triangle& triangle : surface.triangles)
      if (triangle.cornerColor)
        for (glm::dvec3& colour : *triangle.cornerColor) colour = scaledColour(colour, exposure / exposure_);
}

}  // namespace hemitex::cli
