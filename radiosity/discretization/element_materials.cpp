#include "radiosity/discretization/element_materials.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "radiosity/base/kahan_sum.h"
#include "radiosity/discretization/material_averages.h"

namespace hemitex::radiosity {
namespace {

BandTable tableOf(const std::vector<Bands>& list, std::size_t bands) {
  BandTable table(list.size(), bands);
  for (std::size_t i = 0; i < list.size(); ++i) set(table[i], list[i]);
  return table;
}

template <typename ValueOf>
BandTable ofMaterials(const Scene& scene, const ValueOf& valueOf) {
  std::vector<Bands> list;
  for (const Material& material : scene.materials) list.push_back(valueOf(scene, material));
  return tableOf(list, bandCount(scene));
}

BandTable tableOf(const std::vector<glm::dvec3>& colours) {
  BandTable table(colours.size(), 3);
  for (std::size_t i = 0; i < colours.size(); ++i)
    for (int channel = 0; channel < 3; ++channel) table[i][static_cast<std::size_t>(channel)] = colours[i][channel];
  return table;
}

/// The values of materials times the means of maps, up to `largest`; one per element.
BandTable ofElements(const Scene& scene, const Discretization& discretization, const BandTable& ofMaterials,
                     std::optional<int> Material::*map, double largest) {
  BandTable table(discretization.elements.size(), ofMaterials.bands);
  const std::vector<std::vector<glm::dvec3>> means = meansOfMap(scene, discretization.grids, map);
  for (std::size_t s = 0; s < means.size(); ++s) {
    const auto material = static_cast<std::size_t>(scene.surfaces[s].material);
    const Grid& grid = discretization.grids[s];
    for (std::uint32_t i = 0; i < grid.elementCount; ++i)
      for (std::size_t band = 0; band < table.bands; ++band)
        table[grid.firstElement + i][band] =
            std::min(means[s][i][channelOf(scene, band)] * ofMaterials[material][band], largest);
  }
  return table;
}

}  // namespace

ElementMaterials::ElementMaterials(const Scene& scene, const Discretization& discretization)
    : scene_(scene),
      discretization_(discretization),
      none_(bandCount(scene)),
      reflectance_(ofMaterials(scene, reflectanceInBands)),
      emission_(ofMaterials(scene, emissionInBands)) {
  const bool isInColour = scene.wavelengths.empty();
  if (!discretization.mappedReflectance.empty())
    reflectanceOfElements_ =
        isInColour ? tableOf(discretization.mappedReflectance)
                   : ofElements(scene, discretization, reflectance_, &Material::reflectanceMap, maxMappedReflectance);
  if (!discretization.mappedEmission.empty())
    emissionOfElements_ = isInColour ? tableOf(discretization.mappedEmission)
                                     : ofElements(scene, discretization, emission_, &Material::emissionMap,
                                                  std::numeric_limits<double>::max());
}

bool ElementMaterials::isUnlit(std::uint32_t surface) const {
  return discretization_.grids[surface].isDark ||
         (emissionOfElements_.empty() && areZero(emission_[materialOf(surface)]));
}

Bands emittedFlux(const Discretization& discretization, const ElementMaterials& materials) {
  KahanSum sum(materials.bands());
  for (std::uint32_t s = 0; s < discretization.grids.size(); ++s) {
    if (materials.isUnlit(s)) continue;
    for (const std::uint32_t element : elementsOf(discretization.grids[s]))
      sum.add(materials.emission(s, element), discretization.elements[element].area);
  }
  return sum.sum;
}

Bands emittedFlux(const Scene& scene, const Discretization& discretization) {
  return emittedFlux(discretization, ElementMaterials(scene, discretization));
}

}  // namespace hemitex::radiosity
