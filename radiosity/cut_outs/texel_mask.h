/// The cut-out of a surface on its chart: a grid of texels that are holes or not. Index maps, areas and pictures use
/// it. Rays ask the image itself, of which it is a copy where the chart has the pixels of the image as texels.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "radiosity/geometry/grid_clipping.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

struct TexelMask {
  int columns = 1, rows = 1;
  std::vector<bool> isHole;  ///< columns * rows, row-major; row 0 is at v = 0
};

/// Texels of a mask along a side at most, unless the grid of the surface has more.
inline constexpr int largestMask = 1024;

/// Makes the masks of surfaces; surfaces with the same charts and materials share theirs. Keeps a reference to the
/// scene.
class TexelMasks {
 public:
  explicit TexelMasks(const Scene& scene) : scene_(scene) {}

  /// The mask of a surface whose grid has columns x rows texels; null without a cut-out. Each texel of the grid has n x
  /// m texels of the mask. They are at most as large as the pixels of the cut-out, up to `largestMask` along a side. A
  /// texel is a hole if the pixel at its middle is one.
  std::shared_ptr<const TexelMask> of(const Surface& surface, int columns, int rows);

  /// The pixels of the image of a cut-out as texels.
  std::shared_ptr<const TexelMask> ofPixels(const CutOut& cutOut);

 private:
  using Key = std::tuple<const CutOut*, int, int, std::vector<double>>;
  const Scene& scene_;
  std::map<Key, std::shared_ptr<const TexelMask>> known_;
};

/// Whether there is a hole in the rectangle [low, high] of the chart, in units in which the chart has this size.
bool hasHole(const TexelMask& mask, const glm::dvec2& size, const glm::dvec2& low, const glm::dvec2& high);

/// Visits the parts of a piece that are not in holes: one per rectangle of texels. The chart has `size` in the units of
/// the piece.
void forEachOpaquePart(const TexelMask& mask, const glm::dvec2& size, const Piece& piece,
                       const std::function<void(const Piece&)>& visit);

}  // namespace hemitex::radiosity
