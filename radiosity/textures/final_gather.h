/// Final gather: the light of each texel of display textures from all that the texel sees, at any number of texels.
///
/// A hemicube over a texel shows elements of the solution: undivided surfaces, one index map and one item buffer per
/// texel, as for the row of a patch. With F_j the share of element j and B_j its radiosity, the irradiance is
///
///     H = sum F_j B_j + direct light,
///
/// where emission that is among the sources of DirectLight is left out of B_j. The first sum changes slowly. So texels
/// are drawn on a coarse grid. A cell between four of them is interpolated if they are nearly equal, or if a fifth in
/// its middle has the light between them; else it is divided into four. Differences are shares of H. Direct light is
/// computed at each texel, with few rays where all neighbours see all of a source or nothing of it, and where a source
/// is weak.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/images/image.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/texture_layout.h"

namespace hemitex::radiosity {

/// The most texels of layouts whose number is not given: a gathered texel takes much more time than a filtered one.
inline constexpr std::int64_t maxGatheredTexels = std::int64_t{1} << 22;

struct GatherSettings {
  /// Surfaces with fewer elements along the longer side are divided finer, and get the light of their elements by a
  /// first gather. At most the texels of their display textures; 1: none is divided.
  int elements = 64;
  int resolution = 64;       ///< pixels along the side of a hemicube; even, 2 to 4096
  double even = 0.04;        ///< cells whose corners differ by no more than this share are interpolated
  double tolerance = 0.015;  ///< cells whose middle differs from their corners by more than this share are divided
};

struct GatheredLight {
  /// The irradiance of each texel of the display texture of each surface, W/m^2, row by row from v = 0; as
  /// Solution::irradiance, with the ambient estimate of surfaces that the texel sees.
  std::vector<std::vector<glm::dvec3>> irradiance;
  std::size_t texels = 0;  ///< with area
  std::size_t drawn = 0;   ///< those with a hemicube
  double error = 0;        ///< root of the mean squared relative error of interpolated texels, as measured at some
};

/// Gathers the light of a solution at the texels of the display textures of a layout. `layout` is that of the
/// discretization. Calls progress(share), with the done share of texels in [0, 1], from one thread at a time. Returns
/// nothing if `isCancelled` becomes true, soon after. The result does not depend on the number of threads.
std::optional<GatheredLight> gather(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                                    const TextureLayout& textures, const Solution& solution,
                                    const GatherSettings& settings = {},
                                    const std::function<void(double)>& progress = {},
                                    const std::atomic<bool>* isCancelled = nullptr);

/// The texels of each display texture: the irradiance alone, or the radiosity with the maps of materials, in W/m^2.
std::vector<Image> irradianceTextures(const Discretization& discretization, const TextureLayout& textures,
                                      const GatheredLight& light);
std::vector<Image> radiosityTextures(const Scene& scene, const Discretization& discretization,
                                     const TextureLayout& textures, const GatheredLight& light);

}  // namespace hemitex::radiosity
