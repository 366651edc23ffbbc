/// The texels of display textures as places that light meets, and the direct light of each.
///
/// Direct light is the sum over sources of a closed form times a visible share (direct_light.h). Few rays tell whether
/// a texel sees a part of a source. There, and beside texels that see another part of it, the share is measured by many
/// rays. Sources that add little to the others have fewer: an eighth, and none inside blocks of 8 x 8 texels whose
/// corners and middle see all of the source, or nothing. Sources that add next to nothing have the mean of these.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <optional>
#include <vector>

#include "radiosity/base/bands.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/gather/direct_light.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The texels of the display texture of a surface, row by row from v = 0.
struct LitTexels {
  int columns = 1, rows = 1;
  std::vector<std::optional<LitPlace>> places;  ///< none where the surface has no exposed area
  BandTable direct, seen;                       ///< irradiance of each in W/m^2, from sources and from elements
  /// Whether the texel to the right or the next row show another part of the scene; empty: all are parts of one
  /// surface.
  std::vector<bool> isBeforeEdge = {};

  Bands allLight(std::size_t texel) const {
    Bands sum(seen[texel].begin(), seen[texel].end());
    addTo(sum, direct[texel]);
    return sum;
  }
  double light(std::size_t texel) const { return bandSum(direct[texel]) + bandSum(seen[texel]); }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

/// The number of texels of a texture along the side of a texel of the grid, by surface.
using Magnifications = std::vector<int>;

/// The texels of all surfaces, without light.
std::vector<LitTexels> texelsOf(const Scene& scene, const Discretization& discretization,
                                const Magnifications& magnifications);

/// What light of texels is for: a picture of them, or light that reaches others, in which errors of texels cancel.
enum class TexelUse { Shown, Reflecting };

/// Adds the direct light of all sources, with fewer rays at texels that only reflect it. The same bits for any number
/// of threads. The light is incomplete if `isCancelled`, which may be null, becomes true.
void addDirectLight(const DirectLight& direct, LitTexels& texels, TexelUse use, const std::atomic<bool>* isCancelled);

/// The unit normals at the corners of the triangles of each curved surface; others have none. A vertex has one normal
/// in all charts of its part, so that light agrees where charts meet: the mean of its triangles by the cross product of
/// their edges over the squares of their lengths, exact on a sphere (Max 1999).
using CornerNormals = std::vector<std::vector<std::array<glm::dvec3, 3>>>;
CornerNormals smoothNormals(const Scene& scene);
/// The texels of one surface, without light; `normals` are smoothNormals of the scene.
LitTexels texelsOf(const Scene& scene, const Discretization& discretization, const CornerNormals& normals,
                   std::uint32_t surface, int magnification);

}  // namespace hemitex::radiosity
