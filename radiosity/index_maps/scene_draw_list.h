/// The draw list of a scene: offsets and index maps from the item ID layout, charts as texture coordinates.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>

#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "raster/interface/draw_list.h"

namespace hemitex::radiosity {

/// Makes one draw per surface and instance, with the reserved back item ID. An image has its own positions in the list,
/// because draws have no transforms (docs/item-buffers.md), and the item IDs of its surface. The surface's chart is
/// moved to its place in its page, and its index map is the shared one of the page's size or its own. Triangle t of the
/// list is triangle t in space. A cut-out has the index map of its mask, with holes, over its chart.
///
/// A chart that does not fill its page lies strictly inside its place, by at least one binary32 step. So no sample
/// selects a texel of another surface. This is sufficient for three reasons. The side of a page is a power of two, so
/// that the borders of the place are binary32 numbers. The coordinates of a sample are exact means of those of the
/// corners (docs/item-buffers.md, "texel"). New corners from clipping are rounded to 53 bits, which is less than that
/// step. Inside, binary32 page coordinates move the borders of texels by at most 2^-24 of the page's side. (The page's
/// own border has no neighbour.)
raster::DrawList makeDrawList(const Scene& scene, const Discretization& discretization, const IdLayout& layout);

/// As makeDrawList, but images have the largest item ID that is not reserved, on both sides, so that they only block
/// the view. `layout` leaves it free.
raster::DrawList drawListWithBlockers(const Scene& scene, const Discretization& discretization, const IdLayout& layout);

/// Appends triangles at an instance, with positions relative to `origin` and texture coordinates of 0, as one draw with
/// offset 0 and without the item ID of backs and index map. Returns the draw.
raster::Draw& appendDraw(raster::DrawList& list, std::span<const Triangle> triangles, const Instance& instance,
                         const glm::dvec3& origin);

/// Cuts the holes of surfaces into draws whose item IDs are only offsets: each gets an index map of zeros and holes.
class HoleMaps {
 public:
  explicit HoleMaps(const Scene& scene) : scene_(scene), masks_(scene) {}

  /// Cuts a draw of the list, which has these triangles of a surface. Its texture coordinates become places in the
  /// image of the cut-out, where they lie in one period of it. Else they are those of the chart. Without a cut-out the
  /// draw has no index map.
  void cut(raster::DrawList& list, std::size_t draw, const Surface& surface, std::span<const Triangle> triangles,
           const Instance& instance);

 private:
  const Scene& scene_;
  TexelMasks masks_;
  std::map<std::shared_ptr<const TexelMask>, int> numbers_;  ///< of index maps
};

}  // namespace hemitex::radiosity
