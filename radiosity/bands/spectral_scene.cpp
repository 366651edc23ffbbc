#include "radiosity/bands/spectral_scene.h"

#include <algorithm>
#include <cassert>
#include <filesystem>

#include "radiosity/scene/mtl_file.h"
#include "radiosity/spectra/colour.h"
#include "raster/base/file_io.h"

namespace hemitex::radiosity {
namespace {

/// The channel of a colour that stands for a wavelength in nm.
int channelOf(double wavelength) { return wavelength >= 590 ? 0 : wavelength >= 490 ? 1 : 2; }

/// The sum over the bands of each place.
template <typename ValueOf>
glm::dvec3 sumIn(const BandGroup& group, const ValueOf& valueOf) {
  glm::dvec3 sums(0);
  for (int place = 0; place < 3; ++place)
    for (const std::size_t band : group[static_cast<std::size_t>(place)]) sums[place] += valueOf(band);
  return sums;
}

/// As above, but the mean. It has the bits of a single value.
template <typename ValueOf>
glm::dvec3 meanIn(const BandGroup& group, const ValueOf& valueOf) {
  glm::dvec3 means = sumIn(group, valueOf);
  for (int place = 0; place < 3; ++place)
    means[place] /= static_cast<double>(std::max<std::size_t>(1, group[static_cast<std::size_t>(place)].size()));
  return means;
}

/// Exchanges the channels of a map for those that stand for the bands of each place.
void exchangeChannels(Image& image, const BandGroup& group, std::span<const double> wavelengths) {
  glm::ivec3 channels(0, 1, 2);
  for (int place = 0; place < 3; ++place)
    if (const auto& bands = group[static_cast<std::size_t>(place)]; !bands.empty())
      channels[place] = channelOf(wavelengths[bands.front()]);
  if (channels == glm::ivec3(0, 1, 2)) return;
  for (glm::dvec3& pixel : image.pixels) pixel = {pixel[channels.x], pixel[channels.y], pixel[channels.z]};
}

const MaterialSpectra* spectraOf(const Material& material, const SpectralBands& bands) {
  const auto found = bands.materials.find(material.name);
  return found == bands.materials.end() ? nullptr : &found->second;
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

std::vector<BandGroup> groupsOfBands(std::size_t bands) {
  std::vector<BandGroup> groups((bands + 2) / 3);
  for (std::size_t band = 0; band < bands; ++band) {
    const BandPlace at = placeOf(band, bands);
    groups[at.group][static_cast<std::size_t>(at.place)] = {band};
  }
  return groups;
}

BandPlace placeOf(std::size_t band, std::size_t bands) {
  assert(band < bands);
  const std::size_t fromLongest = bands - 1 - band;
  return {fromLongest / 3, static_cast<int>(fromLongest % 3)};
}

BandGroup wholeSpectrum(std::span<const double> wavelengths) {
  BandGroup group;
  for (std::size_t band = 0; band < wavelengths.size(); ++band)
    group[static_cast<std::size_t>(channelOf(wavelengths[band]))].push_back(band);
  return group;
}

glm::dmat3 lightIn(const BandGroup& group, std::span<const double> wavelengths) {
  const glm::dvec3 equalEnergy = linearSrgb({{555}, {1}});
  glm::dmat3 matrix(0);
  for (int place = 0; place < 3; ++place)
    for (const std::size_t band : group[static_cast<std::size_t>(place)]) {
      const int channel = channelOf(wavelengths[band]);
      matrix[channel][place] += 1 / equalEnergy[channel];
    }
  return matrix;
}

glm::dvec3 reflectanceIn(const BandGroup& group, std::span<const double> wavelengths, const glm::dvec3& colour) {
  return meanIn(group, [&](std::size_t band) { return colour[channelOf(wavelengths[band])]; });
}

Scene inGroup(Scene scene, const SpectralBands& bands, const BandGroup& group) {
  const auto at = [&](const Spectrum& spectrum) {
    return [&](std::size_t band) { return valueAt(spectrum, bands.wavelengths[band]); };
  };
  const glm::dmat3 light = lightIn(group, bands.wavelengths);
  for (Material& material : scene.materials) {
    const MaterialSpectra* spectra = spectraOf(material, bands);
    material.reflectance = spectra != nullptr && spectra->reflectance
                               ? meanIn(group, at(*spectra->reflectance))
                               : reflectanceIn(group, bands.wavelengths, material.reflectance);
    material.emission =
        spectra != nullptr && spectra->emission ? sumIn(group, at(*spectra->emission)) : light * material.emission;
  }
  for (Image& image : scene.images) exchangeChannels(image, group, bands.wavelengths);
  scene.outside.sky = light * scene.outside.sky;
  for (Sun& sun : scene.outside.suns) sun.irradiance = light * sun.irradiance;
  return scene;
}

Scene inColour(Scene scene, const SpectralBands& bands, double maxReflectance) {
  for (Material& material : scene.materials) {
    const MaterialSpectra* spectra = spectraOf(material, bands);
    if (spectra != nullptr && spectra->reflectance)
      material.reflectance = glm::clamp(reflectanceColour(*spectra->reflectance), 0.0, maxReflectance);
    if (spectra != nullptr && spectra->emission)
      material.emission = glm::max(linearSrgb(*spectra->emission), glm::dvec3(0));
  }
  return scene;
}

}  // namespace hemitex::radiosity
