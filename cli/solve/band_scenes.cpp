#include "cli/solve/band_scenes.h"

#include <algorithm>
#include <utility>

#include "cli/solve/bands_file.h"
#include "radiosity/scene/load_scene.h"

namespace hemitex::cli {
namespace {

/// The options with their colours in the bands of a group.
MaterialOptions inGroup(MaterialOptions options, const radiosity::BandGroup& group,
                        const std::vector<double>& wavelengths) {
  const glm::dmat3 ofColour = radiosity::lightIn(group, wavelengths);
  const auto light = [&](glm::dvec3& colour) { colour = ofColour * colour; };
  for (NamedColor& emission : options.emissions) light(emission.color);
  for (NamedColor& paint : options.reflectances)
    paint.color = radiosity::reflectanceIn(group, wavelengths, paint.color);
  if (options.sky) light(*options.sky);
  for (radiosity::Sun& sun : options.suns) light(sun.irradiance);
  return options;
}

/// A warning that names the materials of surfaces that have only colours.
void warnOfColours(radiosity::Scene& scene, const radiosity::SpectralBands& bands) {
  constexpr std::size_t maxNames = 8;
  std::vector<std::string> names;
  for (const radiosity::Surface& surface : scene.surfaces) {
    const std::string& name = scene.materials[static_cast<std::size_t>(surface.material)].name;
    if (!bands.materials.contains(name) && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  }
  if (names.empty()) return;
  std::string text = "materials without a spectrum, whose colours stand for thirds of the bands: ";
  for (std::size_t i = 0; i < std::min(names.size(), maxNames); ++i) text += (i == 0 ? "" : ", ") + names[i];
  scene.warnings.push_back(text + (names.size() > maxNames ? ", ..." : ""));
}

}  // namespace

BandScenes bandScenes(const SceneOptions& options, const std::filesystem::path& bandsFile) {
  SceneOptions unchanged = options;
  unchanged.materials = {};
  const radiosity::Scene scene = loadedScene(unchanged);
  const BandsFile file = readBands(bandsFile, scene, options.settings);
  const radiosity::SpectralBands& bands = file.bands;
  BandScenes result{bands.wavelengths,
                    withMaterials(radiosity::inColour(scene, bands, options.settings.maxReflectance), options.materials,
                                  options.settings),
                    {}};
  result.inColour.files.insert(result.inColour.files.end(), file.files.begin(), file.files.end());
  warnOfColours(result.inColour, bands);
  bool isLit = false;
  const auto lightOf = [&](const radiosity::BandGroup& group) {
    radiosity::Scene changed = withMaterials(radiosity::inGroup(scene, bands, group),
                                             inGroup(options.materials, group, bands.wavelengths), options.settings);
    isLit = isLit || radiosity::emitsLight(changed);
    return BandLight{std::move(changed.materials), std::move(changed.images),
                     radiosity::lightIn(group, bands.wavelengths)};
  };
  for (const radiosity::BandGroup& group : radiosity::groupsOfBands(bands.wavelengths.size()))
    result.groups.push_back(lightOf(group));
  if (!isLit) requireLight(result.inColour, options.file);
  if (result.groups.size() > 1) result.whole = lightOf(radiosity::wholeSpectrum(bands.wavelengths));
  return result;
}

void setLight(radiosity::Scene& scene, const BandLight& light) {
  scene.materials = light.materials;
  scene.images = light.images;
}

}  // namespace hemitex::cli
