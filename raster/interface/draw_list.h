/// The draw list: everything that is drawn into an item buffer, whatever the view (raster rules, 1). It is the input
/// of every ItemBufferRenderer and, written out, the geometry of a test vector.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "raster/interface/item_id.h"

namespace hemitex::raster {

/// A texture of item IDs: row-major, row 0 at v = 0, column 0 at u = 0.
struct IndexMap {
  int width = 0;
  int height = 0;
  std::vector<ItemId> ids;  ///< width * height of them, at most 2^31
};

/// A run of triangles that share an offset and an index map.
struct Draw {
  std::uint32_t first = 0;  ///< in DrawList::indices; a multiple of 3
  std::uint32_t count = 0;  ///< indices, three a triangle
  ItemId offset = 0;
  std::optional<ItemId> back;  ///< the item ID, untextured, of triangles that face away; none: drawn like the front
  std::optional<int> indexMap = {};  ///< in DrawList::indexMaps; none: the offset alone
};

/// Triangle t is made of indices 3t, 3t + 1, 3t + 2; draw order is the order of `draws` and, within one, of indices.
struct DrawList {
  std::vector<glm::vec3> positions;  ///< relative to the scene's origin
  std::vector<glm::vec2> texcoords;  ///< one a position
  std::vector<std::uint32_t> indices;
  std::vector<IndexMap> indexMaps;
  std::vector<Draw> draws;
  IdFormat format;
  Blend blend = Blend::ClampedAdd;
};

/// Throws InputError where the list breaks the rules: an index or a run out of range, an index map of the wrong size, a
/// item ID wider than the format, or a draw that can produce the background item ID.
void validate(const DrawList& list);

}  // namespace hemitex::raster
