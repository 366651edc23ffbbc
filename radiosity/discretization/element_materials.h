/// The reflectances and emitted radiosities of all elements in the bands of their scene, with maps averaged over each
/// element.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "radiosity/base/bands.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// Keeps references to its arguments, but not to their materials and maps.
class ElementMaterials {
 public:
  ElementMaterials(const Scene& scene, const Discretization& discretization);

  std::size_t bands() const { return none_.size(); }
  /// Of an element of a surface; the emission in W/m^2.
  std::span<const double> reflectance(std::uint32_t surface, std::uint32_t element) const {
    return hasReflectanceMaps() ? reflectanceOfElements_[element] : reflectance_[materialOf(surface)];
  }
  std::span<const double> emission(std::uint32_t surface, std::uint32_t element) const {
    if (discretization_.grids[surface].isDark) return none_;
    return emissionOfElements_.empty() ? emission_[materialOf(surface)] : emissionOfElements_[element];
  }
  /// Whether elements of one surface may have different reflectances.
  bool hasReflectanceMaps() const { return !reflectanceOfElements_.empty(); }
  /// True only if no element of a surface emits.
  bool isUnlit(std::uint32_t surface) const;

 private:
  std::size_t materialOf(std::uint32_t surface) const {
    return static_cast<std::size_t>(scene_.surfaces[surface].material);
  }

  const Scene& scene_;
  const Discretization& discretization_;
  Bands none_;                                            ///< no light
  BandTable reflectance_, emission_;                      ///< one per material
  BandTable reflectanceOfElements_, emissionOfElements_;  ///< if a surface has a map of that kind
};

/// The flux that all elements emit, in W per band.
Bands emittedFlux(const Discretization& discretization, const ElementMaterials& materials);
Bands emittedFlux(const Scene& scene, const Discretization& discretization);

}  // namespace hemitex::radiosity
