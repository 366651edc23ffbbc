#include "radiosity/bands/spectral_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "radiosity/base/name_suggestions.h"
#include "radiosity/scene/mtl_file.h"
#include "radiosity/spectra/colour.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/base/lower_case.h"

namespace hemitex::radiosity {
namespace {

/// A warning that names the materials of surfaces that have only colours.
void warnOfColours(Scene& scene, const SpectralBands& bands) {
  constexpr std::size_t maxNames = 8;
  std::vector<std::string> names;
  for (const Surface& surface : scene.surfaces) {
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

std::map<std::string, MaterialSpectra> spectraOfFiles(const Scene& scene, const SceneSettings& settings) {
  std::map<std::string, std::pair<MaterialStatement, std::filesystem::path>> statements;  // the first of a name
  for (const std::filesystem::path& file : scene.files)
    if (raster::endingOf(file) == ".mtl")
      for (MaterialStatement& statement : parseMaterials(raster::readFile(file), file, settings.emission))
        statements.try_emplace(statement.name, statement, file);
  std::map<std::string, MaterialSpectra> found;
  for (const Material& material : scene.materials) {
    const auto known = statements.find(material.name);
    if (known == statements.end()) continue;
    const auto& [statement, file] = known->second;
    if (statement.reflectanceSpectrum) {
      Spectrum& spectrum = found[material.name].reflectance.emplace(readSpectrum(*statement.reflectanceSpectrum, file));
      for (double& value : spectrum.values) value = value < 1 ? value : settings.maxReflectance;
    }
    if (statement.emissionSpectrum) {
      Spectrum& spectrum = found[material.name].emission.emplace(readSpectrum(*statement.emissionSpectrum, file));
      for (double& value : spectrum.values) value *= radiosityPerUnit(settings.emission);
    }
  }
  return found;
}

void requireValid(const SpectralBands& bands, const Scene& scene) {
  for (std::size_t i = 0; i < bands.wavelengths.size(); ++i)
    if (!(bands.wavelengths[i] > (i == 0 ? 0 : bands.wavelengths[i - 1])))
      throw raster::InputError("the wavelengths do not ascend from above 0", "give them in nm");
  if (bands.wavelengths.empty()) throw raster::InputError("there is no wavelength");
  std::set<std::string> names;
  for (const Material& material : scene.materials) names.insert(material.name);
  const auto areIn = [](const std::optional<Spectrum>& spectrum, double largest) {
    return !spectrum || std::all_of(spectrum->values.begin(), spectrum->values.end(),
                                    [&](double v) { return v >= 0 && v <= largest; });
  };
  for (const auto& [name, spectra] : bands.materials) {
    const std::string owner = "of `" + raster::excerpt(name) + "`";
    if (!names.contains(name))
      throw raster::InputError("the scene has no material `" + raster::excerpt(name) + "`",
                               "similar names: " + nearestNames(names, name));
    if (!areIn(spectra.reflectance, std::nextafter(1.0, 0.0)))
      throw raster::InputError("a reflectance " + owner + " is below 0, or 1 or more");
    if (!areIn(spectra.emission, largestEmission))
      throw raster::InputError("an emission " + owner + " is below 0 or above 1e30");
  }
}

Scene inBands(Scene scene, const SpectralBands& bands, double maxReflectance) {
  scene.wavelengths.assign(bands.wavelengths.rbegin(), bands.wavelengths.rend());
  for (Material& material : scene.materials) {
    const auto found = bands.materials.find(material.name);
    if (found == bands.materials.end()) continue;
    material.reflectanceSpectrum = found->second.reflectance;
    material.emissionSpectrum = found->second.emission;
    if (material.reflectanceSpectrum)
      material.reflectance = glm::clamp(reflectanceColour(*material.reflectanceSpectrum), 0.0, maxReflectance);
    if (material.emissionSpectrum) material.emission = glm::max(linearSrgb(*material.emissionSpectrum), glm::dvec3(0));
  }
  warnOfColours(scene, bands);
  return scene;
}

}  // namespace hemitex::radiosity
