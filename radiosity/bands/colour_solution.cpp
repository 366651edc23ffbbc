#include "radiosity/bands/colour_solution.h"

#include <algorithm>

#include "radiosity/spectra/colour.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// The irradiance whose reflection, with the emission, is this radiosity; 0 where nothing is reflected.
glm::dvec3 irradianceFor(const glm::dvec3& radiosity, const glm::dvec3& emission, const glm::dvec3& reflectance) {
  glm::dvec3 irradiance(0);
  for (int channel = 0; channel < 3; ++channel)
    if (reflectance[channel] > 0) irradiance[channel] = (radiosity[channel] - emission[channel]) / reflectance[channel];
  return irradiance;
}

}  // namespace

double radiosityIn(const BandSolution& solution, std::size_t band, std::size_t element) {
  const BandPlace at = placeOf(band, solution.wavelengths.size());
  return solution.groups[at.group].radiosity[element][at.place];
}

double fluxIn(const BandSolution& solution, std::size_t band, glm::dvec3 Energy::*flux) {
  const BandPlace at = placeOf(band, solution.wavelengths.size());
  return (solution.groups[at.group].energy.*flux)[at.place];
}

Solution inColour(const Scene& scene, const Discretization& discretization, const BandSolution& bandSolution,
                  bool keepsIrradiance) {
  const std::vector<glm::dvec3> colours = linearSrgbOfBands(bandSolution.wavelengths);
  const std::vector<Solution>& groups = bandSolution.groups;
  const std::size_t bands = colours.size();
  // A value in all bands as a colour; `valueIn` returns that of a group.
  const auto colourOf = [&](const auto& valueIn) {
    glm::dvec3 colour(0);
    for (std::size_t band = 0; band < bands; ++band) {
      const BandPlace at = placeOf(band, bands);
      colour += colours[band] * valueIn(groups[at.group])[at.place];
    }
    return colour;
  };
  Solution solution;
  solution.radiosity.resize(discretization.elements.size());
  raster::parallelFor(discretization.grids.size(), [&](std::size_t surface) {
    for (const std::uint32_t element : elementsOf(discretization.grids[surface]))
      solution.radiosity[element] = colourOf([element](const Solution& group) { return group.radiosity[element]; });
  });
  if (hasMaps(scene) || keepsIrradiance)
    for (std::uint32_t element = 0; element < solution.radiosity.size(); ++element)
      solution.irradiance.push_back(irradianceFor(solution.radiosity[element], emission(scene, discretization, element),
                                                  reflectance(scene, discretization, element)));
  solution.ambient = colourOf([](const Solution& group) { return group.ambient; });
  for (glm::dvec3 Energy::*const flux :
       {&Energy::emitted, &Energy::absorbed, &Energy::unshot, &Energy::lost, &Energy::lostToBacks, &Energy::skyOnBacks})
    solution.energy.*flux = colourOf([flux](const Solution& group) { return group.energy.*flux; });
  for (const Solution& group : groups) {
    solution.residual = std::max(solution.residual, group.residual);
    solution.shots += group.shots;
    solution.isInterrupted = solution.isInterrupted || group.isInterrupted;
  }
  const auto emitsLess = [](const Solution& a, const Solution& b) {
    return bandSum(a.energy.emitted) < bandSum(b.energy.emitted);
  };
  solution.warnings = std::max_element(groups.begin(), groups.end(), emitsLess)->warnings;
  return solution;
}

}  // namespace hemitex::radiosity
