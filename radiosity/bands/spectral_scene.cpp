#include "radiosity/bands/spectral_scene.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "radiosity/scene/mtl_file.h"
#include "radiosity/spectra/colour.h"
#include "raster/base/file_io.h"

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
    if (file.extension() == ".mtl")
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
