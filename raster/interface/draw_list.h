/// The draw list: all triangles that are drawn into item buffers, independent of the view (docs/item-buffers.md,
/// "input"). It is the input of every ItemBufferRenderer and the geometry of a test vector.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "raster/interface/item_id.h"

namespace hemitex::raster {

/// A texel of an index map without an item ID. Fragments there, fronts and backs, are discarded before the depth test
/// (version 2 of the rules).
inline constexpr ItemId holeTexel = 0xFFFFFFFF;

/// A texture of item IDs: row-major, row 0 at v = 0, column 0 at u = 0.
struct IndexMap {
  int width = 0;
  int height = 0;
  std::vector<ItemId> ids;  ///< width * height item IDs or holes, at most 2^31
};

bool hasHoles(const IndexMap& map);

/// Which triangles of a draw do not exist: none, those that face the eye, or those that face away (version 2).
enum class Cull : std::uint8_t { None, Front, Back };

/// What the fragments of a front hold: an item ID, blended of offset and texel, or the number of their triangle
/// (version 2). Triangles of a draw count from its offset, in the order of their indices; index maps then only have
/// holes.
enum class PixelValue : std::uint8_t { ItemIds, TriangleNumbers };

/// Which fragments pass the depth test (version 2). The first one at a pixel always does.
enum class DepthTest : std::uint8_t { Nearer, NearerOrEqual, Farther, FartherOrEqual };

/// A run of triangles that share an offset and an index map.
struct Draw {
  std::uint32_t first = 0;  ///< in DrawList::indices; a multiple of 3
  std::uint32_t count = 0;  ///< number of indices, three per triangle
  ItemId offset = 0;
  std::optional<ItemId> back;  ///< item ID of back-facing triangles, without texel; none: drawn as front-facing ones
  std::optional<int> indexMap = {};  ///< in DrawList::indexMaps; none: the offset alone
  Cull cull = Cull::None;
};

/// Triangle t has the indices 3t, 3t + 1, 3t + 2. The draw order is the order of `draws`, then of indices within a
/// draw.
struct DrawList {
  std::vector<glm::vec3> positions;  ///< relative to the scene's origin
  std::vector<glm::vec2> texcoords;  ///< one per position
  std::vector<std::uint32_t> indices;
  std::vector<IndexMap> indexMaps;
  std::vector<Draw> draws;
  IdFormat format;
  Blend blend = Blend::ClampedAdd;
  PixelValue value = PixelValue::ItemIds;
  DepthTest depthTest = DepthTest::Nearer;
};

/// The value of triangle `t` of a draw whose pixels hold triangle numbers.
inline ItemId triangleNumber(const Draw& draw, std::uint32_t t) { return draw.offset + (t - draw.first / 3); }

/// Throws InputError if the list breaks a rule: an index or a run out of range, an index map of the wrong size, an item
/// ID wider than the format, or a draw that can produce the background. Holes are no item IDs.
void validate(const DrawList& list);

/// Throws InputError if pixels show another triangle than the nearest one. Only PlainRenderer draws such lists.
void requireNearest(const DrawList& list);

}  // namespace hemitex::raster
