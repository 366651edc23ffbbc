#include "cli/render/solved_folder.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/scene/lit_surfaces.h"
#include "cli/scene/material_options.h"
#include "cli/scene/sealed_folder.h"
#include "radiosity/images/image.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/json_text.h"

namespace hemitex::cli {
namespace {

using json = nlohmann::ordered_json;

/// Reads a number of texels. Throws InputError for a number that no texture has.
int texelsAt(const json& object, const char* key, int least) {
  const int value = reference::valueAt<int>(object, key);
  if (value < least || value > 1 << 24) throw raster::InputError(std::string(key) + " is " + std::to_string(value));
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

}  // namespace

std::optional<SolvedFolder> SolvedFolder::around(const std::filesystem::path& sceneFile, radiosity::Scene& scene) {
  SolvedFolder solved;
  solved.folder_ = sceneFile.parent_path();
  const std::filesystem::path file = solved.folder_ / "solution.json";
  const std::optional<std::string> text = raster::tryReadFile(file);
  if (!text) return std::nullopt;
  requireIntact(solved.folder_);
  const auto solution = reference::parseJson<json>(*text, file.string());
  try {
    const json& settings = solution.at("settings");
    if (!settings.at("texels").is_null()) solved.settings_.texels = texelsAt(settings, "texels", 1);
    solved.settings_.patch = texelsAt(settings, "patch", 1);
    if (const json& size = settings.at("texel_size"); !size.is_null()) solved.settings_.texelSize = size.get<double>();
    solved.exposure_ = settings.at("exposure").get<double>();
    restoreLights(solved.lights_, settings);
    const double metres = settings.value("metres_per_unit", 1.0);
    solved.lights_.squareMetres = metres * metres;
    if (settings.contains("symmetry")) solved.lacks_ = "images by symmetry";
    if (solution.contains("bands")) solved.lacks_ = "spectra";
    const json& surfaces = solution.at("surfaces");
    for (const std::uint32_t number : restoreSurfaces(scene, surfaces)) {
      const json& surface = surfaces[number];
      const json& texture = surface.at("texture");
      solved.places_.push_back({texture.at("name").get<std::string>(), texelsAt(texture, "width", 1),
                                texelsAt(texture, "height", 1), texelsAt(texture, "column", 0),
                                texelsAt(texture, "row", 0), texelsAt(surface, "columns", 1),
                                texelsAt(surface, "rows", 1), reference::vectorAt(surface, "reflectance"),
                                reference::vectorAt(surface, "emission"), surface.contains("curved")});
      if (surface.contains("maps")) solved.lacks_ = "maps of materials";
    }
  } catch (const std::exception&) {
    throw raster::InputError(file.string(), 0, "does not belong to the scene beside it", "solve the scene again");
  }
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const Place& place = solved.places_[s];
    for (radiosity::Triangle& triangle : scene.surfaces[s].triangles)
      for (glm::dvec2& corner : triangle.chart)
        corner = {chartCoordinate(corner.x, place.width, place.column, place.columns),
                  chartCoordinate(corner.y, place.height, place.row, place.rows)};
  }
  return solved;
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

radiosity::Scene SolvedFolder::unlit(radiosity::Scene scene) const {
  if (!lacks_.empty())
    throw raster::InputError(folder_.string(), 0, "does not hold the " + lacks_ + " that its light needs",
                             "render the scene that was solved with --gather, instead of this folder");
  scene.materials.clear();
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    scene.surfaces[s].material = static_cast<int>(s);
    scene.surfaces[s].hasColours = false;
    if (places_[s].isCurved) scene.surfaces[s].curvedPart = static_cast<std::uint32_t>(s);
    scene.materials.push_back({scene.surfaces[s].name, places_[s].reflectance, places_[s].emission});
  }
  scene.outside = lights_.outside;
  scene.lamps = lights_.lamps;
  scene.squareMetres = lights_.squareMetres;
  return scene;
}

/// Textures of a gather have several texels along the side of an element, which has their mean.
std::vector<glm::dvec3> SolvedFolder::radiosity(const radiosity::Discretization& discretization) const {
  std::map<std::string, radiosity::Image> textures;
  std::vector<glm::dvec3> values;
  for (const radiosity::Element& element : discretization.elements) {
    const Place& place = places_[element.surface];
    const auto [texture, isNew] = textures.try_emplace(place.texture);
    if (isNew) texture->second = radiosity::readImage(folder_ / (place.texture + ".exr"));
    const radiosity::Image& image = texture->second;
    const auto columns = static_cast<std::uint32_t>(place.columns);
    const int side = std::max(image.width / place.width, 1);
    const int left = side * (place.column + static_cast<int>(element.texel % columns));
    const int top = image.height - side * (place.row + static_cast<int>(element.texel / columns) + 1);
    if (left + side > image.width || top < 0)
      throw raster::InputError((folder_ / (place.texture + ".exr")).string(), 0,
                               "has fewer texels than solution.json gives", "solve the scene again");
    glm::dvec3 sum(0);
    for (int row = top; row < top + side; ++row)
      for (int column = left; column < left + side; ++column)
        sum += image.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                            static_cast<std::size_t>(column)];
    values.push_back(sum / static_cast<double>(side * side));
  }
  return values;
}

void SolvedFolder::expose(radiosity::Scene& scene, double exposure) const {
  std::map<int, std::string> textures;  // of images
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s)
    if (const auto map = scene.materials[static_cast<std::size_t>(scene.surfaces[s].material)].reflectanceMap)
      textures.emplace(*map, places_[s].texture);
  for (const auto& [image, texture] : textures)
    scene.images[static_cast<std::size_t>(image)] =
        scaled(radiosity::readImage(folder_ / (texture + ".exr")), exposure);
}

}  // namespace hemitex::cli
