/// Finds the surfaces whose backs absorb light. An item buffer of the solution has one item ID for all backs. So the
/// scene is drawn again from the patches that lose light to backs, with one item ID for the back of each surface.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

struct BackAbsorption {
  std::vector<glm::dvec3> ofSurfaces;  ///< one per surface: the flux in W that its back absorbs
  std::size_t patches = 0;             ///< number of patches that were drawn from
};

/// Distributes the flux that backs absorb over the surfaces of these backs. `absorbedByBacks` is that of the Solution,
/// one per patch. Draws from at most `maxPatches` patches, those with the largest flux first; the flux of the other
/// patches is left out. `layout` and `settings` are those of the solution, so that the views are the same.
BackAbsorption backAbsorption(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                              const DrawingSettings& settings, const std::vector<glm::dvec3>& absorbedByBacks,
                              std::size_t maxPatches);

}  // namespace hemitex::radiosity
