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
#include <memory>
#include <optional>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/element_materials.h"
#include "radiosity/gather/direct_light.h"
#include "radiosity/gather/lit_texels.h"
#include "radiosity/gather/seen_elements.h"
#include "radiosity/images/image.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/spectra/colour.h"
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

/// Who follows a gather, and who ends it.
struct GatherProgress {
  std::function<void(double)> show = {};           ///< called with the done share in [0, 1], from one thread at a time
  const std::atomic<bool>* isCancelled = nullptr;  ///< the gather ends soon after this becomes true

  bool isStopping() const { return isCancelled && *isCancelled; }
};

Magnifications magnificationsOf(const TextureLayout& textures);

/// Gathers the light of a solution at places of its scene. The results do not depend on the number of threads.
class Gatherer {
 public:
  /// `layout` is that of the discretization. Where elements are divided finer, gathers at their texels first, at most
  /// at those of `textures`. The arguments must outlive this object.
  Gatherer(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
           const TextureLayout& textures, const Solution& solution, const GatherSettings& settings,
           const GatherProgress& progress);

  /// Adds the light of texels that have places, but no light yet (see addDirectLight).
  void light(std::vector<LitTexels>& all, TexelUse use);
  /// All light at a place, in W/m^2. Several threads may call it.
  Bands lightAt(const LitPlace& place);
  /// Light that arrives at an element of a surface, as colours.
  glm::dvec3 colourOf(std::uint32_t surface, std::uint32_t element, Bands light) const;
  /// The light of the texels of a surface in colours; those without area have that of the nearest one with area.
  std::vector<glm::dvec3> coloursOf(std::uint32_t surface, int magnification, const LitTexels& texels) const;

  /// See GatheredLight; the error of the last texels.
  std::size_t drawn() const { return drawn_; }
  double error() const { return error_; }

 private:
  Magnifications finerElements(const Magnifications& texels) const;
  Discretization dividedFiner(const Magnifications& finer) const;
  BandTable radiosityOfFiner(const std::vector<LitTexels>& all) const;

  const Scene& scene_;
  const Discretization& discretization_;
  const GatherSettings& settings_;
  const GatherProgress& progress_;
  ElementMaterials materials_;
  BandColours colours_;
  DirectLight direct_;
  Discretization finer_ = {};  ///< of surfaces with few elements
  IdLayout finerLayout_ = {};
  std::unique_ptr<SeenElements> seen_;
  std::size_t drawn_ = 0;
  double error_ = 0;
};

/// Gathers the light of a solution at the texels of the display textures of a layout. Returns nothing if it is
/// cancelled.
std::optional<GatheredLight> gather(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                                    const TextureLayout& textures, const Solution& solution,
                                    const GatherSettings& settings = {}, const GatherProgress& progress = {});

/// The texels of each display texture: the irradiance alone, or the radiosity with the maps of materials, in W/m^2.
std::vector<Image> irradianceTextures(const Discretization& discretization, const TextureLayout& textures,
                                      const GatheredLight& light);
std::vector<Image> radiosityTextures(const Scene& scene, const Discretization& discretization,
                                     const TextureLayout& textures, const GatheredLight& light);

}  // namespace hemitex::radiosity
