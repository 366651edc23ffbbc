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

/// What pixels hold. All but item IDs are of version 2, and index maps then only have holes.
enum class PixelValue : std::uint8_t {
  ItemIds,          ///< blended of offset and texel
  TriangleNumbers,  ///< the offset plus the number of the triangle in its draw or instance, from 0
  VertexValues,     ///< the offset plus the value of the triangle's provoking vertex
  Pairs,            ///< the offset and the number of the triangle, as 64 bits (assembly.h)
  PassedSamples,    ///< the number of fragments that passed the depth test at the pixel
};

/// How a draw makes triangles of its indices (version 2).
enum class Topology : std::uint8_t { Triangles, Strip, Fan };

/// Which vertex of a triangle gives its value (version 2).
enum class Provoking : std::uint8_t { First, Last };

/// A copy of a draw (version 2): each coordinate is multiplied by `scale`, then `offset` is added, in binary32.
struct Instance {
  glm::vec4 scale{1.0F};   ///< of x, y, z, and in clip space of w
  glm::vec4 offset{0.0F};  ///< likewise
  ItemId id = 0;           ///< added to the offset of the draw
};

/// Which fragments pass the depth test (version 2). The first one at a pixel always does.
enum class DepthTest : std::uint8_t { Nearer, NearerOrEqual, Farther, FartherOrEqual };

/// Whether positions are those of a scene or in clip space (version 2), and then which z are inside: those from 0 to w,
/// or from -w to w.
enum class ClipDepth : std::uint8_t { None, ZeroToOne, MinusOneToOne };

/// How depths are stored (version 2): as they are, in 16 or 24 bits as multiples of 1/(2^bits - 1), or in binary32.
/// Depths d are from 0 to 1: z/w or (z/w + 1)/2 in clip space, else 1 - n/w. They are rounded to nearest, ties to even.
enum class DepthPrecision : std::uint8_t { Exact, Unorm16, Unorm24, Float32 };

/// Which winding is the front, seen where rows grow along y and determinants of views are positive (version 2).
enum class Winding : std::uint8_t { CounterClockwise, Clockwise };

/// A run of triangles that share an offset and an index map.
struct Draw {
  std::uint32_t first = 0;  ///< in DrawList::indices; a multiple of 3 in an assembled list
  std::uint32_t count = 0;  ///< number of indices, three per triangle
  ItemId offset = 0;
  std::optional<ItemId> back;  ///< item ID of back-facing triangles, without texel; none: drawn as front-facing ones
  std::optional<int> indexMap = {};  ///< in DrawList::indexMaps; none: the offset alone
  Cull cull = Cull::None;
  // Version 2, for assembly (assembly.h).
  Topology topology = Topology::Triangles;
  bool restarts = false;            ///< whether restartIndex ends a strip, a fan or a triangle
  std::uint32_t baseVertex = 0;     ///< added to indices
  std::uint32_t firstInstance = 0;  ///< in DrawList::instances
  std::uint32_t instances = 0;      ///< 0: drawn once, as it is
};

/// Triangle t of an assembled list has the indices 3t, 3t + 1, 3t + 2. The draw order is the order of `draws`, then of
/// indices within a draw.
struct DrawList {
  std::vector<glm::vec3> positions;  ///< relative to the scene's origin; in clip space x, y and w
  std::vector<glm::vec2> texcoords;  ///< one per position
  std::vector<std::uint32_t> indices;
  std::vector<IndexMap> indexMaps;
  std::vector<Draw> draws;
  IdFormat format;
  Blend blend = Blend::ClampedAdd;
  PixelValue value = PixelValue::ItemIds;
  DepthTest depthTest = DepthTest::Nearer;
  ClipDepth clipDepth = ClipDepth::None;
  std::vector<float> clipZ = {};  ///< in clip space: z, one per position; else empty
  DepthPrecision depthPrecision = DepthPrecision::Exact;
  Winding front = Winding::CounterClockwise;
  std::vector<ItemId> vertexValues = {};  ///< one per position where pixels hold them
  Provoking provoking = Provoking::First;
  std::vector<Instance> instances = {};
  int indexBits = 32;  ///< 16 or 32
};

/// Appends vertex `index` of another list.
void addVertex(DrawList& list, const DrawList& from, std::size_t index);
void removeVertices(DrawList& list);

/// The value of triangle `t` of a draw whose pixels hold triangle numbers.
inline ItemId triangleNumber(const Draw& draw, std::uint32_t t) { return draw.offset + (t - draw.first / 3); }

/// The value of triangle `t` of a front in an assembled list whose pixels hold no item IDs.
inline ItemId flatValue(const DrawList& list, const Draw& draw, std::uint32_t t) {
  if (list.value != PixelValue::VertexValues) return triangleNumber(draw, t);
  const std::size_t corner = list.provoking == Provoking::First ? 0 : 2;
  return draw.offset + list.vertexValues[list.indices[3 * std::size_t{t} + corner]];
}

/// The value of a pixel that no triangle covers.
inline ItemId clearedValue(const DrawList& list) {
  return list.value == PixelValue::PassedSamples ? 0 : backgroundId(list.format);
}

/// Throws InputError if the list breaks a rule: an index or a run out of range, an index map of the wrong size, an item
/// ID wider than the format, or a draw that can produce the background. Holes are no item IDs.
void validate(const DrawList& list);

/// Whether all draws are triangles of three indices, and the value of a pixel has 32 bits.
bool isAssembled(const DrawList& list);

/// The same triangles in the same order with the same values, as an assembled list. Each instance is a draw of its own
/// with vertices of its own. Pairs become triangle numbers (see assembly.h). Throws InputError if indices, runs or
/// instances are out of range, or if an offset is wider than the format.
DrawList assembled(const DrawList& list);

/// Whether pixels show the nearest triangle, by 1/w, of a scene. SoftwareRenderer draws no other lists.
bool isUsual(const DrawList& list);
/// Throws InputError for any other list.
void requireUsual(const DrawList& list);

}  // namespace hemitex::raster
