/// A solution in bands as a solution in colour, which textures and pictures show.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/bands/spectral_scene.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::radiosity {

/// A solution in bands.
struct BandSolution {
  std::vector<double> wavelengths;  ///< nm, ascending
  std::vector<Solution> groups;     ///< one per group of groupsOfBands
};

/// The radiosity of an element in a band, W/m^2.
double radiosityIn(const BandSolution& solution, std::size_t band, std::size_t element);
/// A flux of the account in a band, in W.
double fluxIn(const BandSolution& solution, std::size_t band, glm::dvec3 Energy::*flux);

/// The solution in linear sRGB (see colour.h), where a colour outside sRGB has negative channels. `scene` is that of
/// inColour with `discretization`. The irradiance of an element, if a surface has a map or it is kept, is that which,
/// reflected by its colour, gives its radiosity. The energy is that of all bands in linear sRGB. The shots are those of
/// all groups, the residual is the largest, and the warnings are those of the group that emits most.
Solution inColour(const Scene& scene, const Discretization& discretization, const BandSolution& bands,
                  bool keepsIrradiance = false);

}  // namespace hemitex::radiosity
