/// Shading: how the pixels of a triangle get their item IDs, from one constant or from texels.
#pragma once

#include <memory>
#include <optional>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_id.h"
#include "raster/kernels/depth_buffer.h"
#include "raster/kernels/texel_planes.h"
#include "raster/setup/triangle_setup.h"
#include "raster/software/prepared_draw_list.h"

namespace hemitex::raster {

struct Shading {
  ItemId id;  ///< of all pixels, or the addend, or the offset
  struct Texels {
    const IndexMap* map;
    bool isSum;   ///< the draw has an addend
    bool counts;  ///< and the texels equal their numbers
    TexelPlanes planes;
    std::unique_ptr<const ExactTexels>
        exact;  ///< made once a texel is unresolved; a pointer, because that is rare and shadings should stay compact
  };
  std::optional<Texels> texels;
};

/// The number that gives item IDs when added to the texels of the draw's index map: 0 where texels replace the offset;
/// the offset, if its bits are none of the texels'. Nothing if a channel may clamp or carry.
std::optional<ItemId> addendOf(const PreparedDrawList& draws, const Draw& draw);

/// The shading of a screen triangle.
Shading shadingOf(const PreparedDrawList& draws, const ScreenTriangle& triangle);

/// The item ID of a pixel that shows triangle `t` of a draw; `texel` is the number of the texel if the draw has an
/// index map.
ItemId idOf(const PreparedDrawList& draws, const Draw& draw, std::uint32_t t, bool facesAway, ItemId texel);

/// Whether pixels get their item IDs from texels.
inline bool isTextured(const DrawList& list, const Draw& draw, bool facesAway) {
  return draw.indexMap && !(facesAway && draw.back) && list.value == PixelValue::ItemIds;
}

/// The number of the texel at a sample, computed exactly.
ItemId texelExactly(const ScreenTriangle& triangle, const IndexMap& map, const Pixel& pixel);

}  // namespace hemitex::raster
