/// Shading: how the pixels of a triangle get their item IDs, all the same one or by texels.
#pragma once

#include <memory>
#include <optional>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_id.h"
#include "raster/kernels/depth_buffer.h"
#include "raster/kernels/texel_kernels.h"
#include "raster/setup/triangle_setup.h"
#include "raster/software/prepared_draw_list.h"

namespace hemitex::raster {

struct Shading {
  ItemId id;  ///< of all pixels, or the offset
  struct Texels {
    const IndexMap* map;
    bool isSum;   ///< the item IDs are sums of offset and texel in which nothing is carried and nothing clamped
    bool counts;  ///< and the texels are their own numbers
    TexelPlanes planes;
    std::unique_ptr<const ExactTexels> exact;  ///< once a texel was undecided, where there are any:
                                               ///< so seldom that shadings are not to be large for it
  };
  std::optional<Texels> texels;
};

/// Of a triangle on the screen.
Shading shadingOf(const PreparedDrawList& draws, const ScreenTriangle& triangle);

/// The item ID of a pixel that shows a draw, and of its index map, if any, a texel by number.
ItemId idOf(const PreparedDrawList& draws, const Draw& draw, bool facesAway, ItemId texel);

/// The number of the texel that a sample falls on.
ItemId texelExactly(const ScreenTriangle& triangle, const IndexMap& map, const Pixel& pixel);

}  // namespace hemitex::raster
