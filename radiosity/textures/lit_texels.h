/// The texels of display textures as places that light meets, and the direct light of each.
///
/// Direct light is the sum over sources of a closed form times a visible share (direct_light.h). Few rays tell whether
/// a texel sees a part of a source. There, and beside texels that see another part of it, the share is measured by many
/// rays. Sources that add little to the others have fewer: an eighth, and none inside blocks of 8 x 8 texels whose
/// corners and middle see all of the source, or nothing.
#pragma once

#include <atomic>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/base/bands.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "radiosity/textures/direct_light.h"

namespace hemitex::radiosity {

/// The texels of the display texture of a surface, row by row from v = 0.
struct LitTexels {
  int columns = 1, rows = 1;
  std::vector<std::optional<LitPlace>> places;  ///< none where the surface has no exposed area
  BandTable direct, seen;                       ///< irradiance of each in W/m^2, from sources and from elements

  double light(std::size_t texel) const { return bandSum(direct[texel]) + bandSum(seen[texel]); }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

/// The texels of all surfaces with their direct light; `seen` is 0. The texture of a surface has a square of
/// `magnifications` texels along a side per texel of its grid. The same bits for any number of threads. The result is
/// incomplete if `isCancelled` becomes true.
std::vector<LitTexels> directlyLitTexels(const Scene& scene, const Discretization& discretization,
                                         std::span<const int> magnifications, const DirectLight& direct,
                                         const std::atomic<bool>* isCancelled = nullptr);

/// Whether a value is there and true.
inline bool isTrue(const std::atomic<bool>* value) { return value && *value; }

}  // namespace hemitex::radiosity
