/// A simulated device in stages. It draws a test vector by the raster rules (raster/plain/rules.h), in double precision
/// from depths on. Each stage is a function that a known fault (fault.h) may replace.
///
///     assemble -> upload -> camera -> view and clip, snap -> facing -> cover -> depth -> interpolate -> fetch -> blend
///     -> store
///     -> resolve -> read back
///
/// Lengths on the picture are sub-pixels, 1/256 pixel.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "raster/plain/rules.h"
#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {

/// From a triangle to triangles on the sub-pixel grid.
struct StagedGeometry {
  /// View and clip: what remains of triangle t.
  std::function<raster::ClippedPolygon(const raster::Face&, const raster::DrawList&, std::uint32_t)> polygon =
      [](const raster::Face& face, const raster::DrawList& list, std::uint32_t t) { return clip(face, list, t); };

  /// The grid position of a position in sub-pixels.
  std::function<double(double)> snap = [](double position) { return std::nearbyint(position); };

  /// Grid positions per sub-pixel. Where it is more than 1, snapped positions have this finer unit.
  std::int64_t fineness = 1;
};

/// Snaps to a grid of 2^bits positions per pixel: to the nearest one, or down.
StagedGeometry snappedTo(int bits, bool isNearest);

enum class Facing { Front, Back, Culled };

/// The facing for the opposite winding.
inline Facing otherSide(Facing facing) { return facing == Facing::Front ? Facing::Back : Facing::Front; }

/// The sum of (u, v, 1) at the vertices of a triangle, times edge functions and weight(w). By default it is with
/// perspective, as in the rules.
glm::dvec3 weightedSum(
    const raster::SnappedTriangle& triangle, const raster::Weights& edges,
    double (*weight)(double) = [](double w) { return 1 / w; });

/// A lookup in an index map.
struct Lookup {
  const raster::SnappedTriangle& triangle;
  raster::SnappedPoint position;
  glm::dvec2 at;  ///< (u, v)
};

inline glm::dvec2 sizeOf(const raster::IndexMap& map) { return {map.width, map.height}; }

/// The item ID of the texel of the rules at `position`, which is (u, v) times the size of the map.
raster::ItemId texelAt(const raster::IndexMap& map, const glm::dvec2& position);

/// The same at (u, v).
raster::ItemId nearestTexel(const raster::IndexMap& map, const glm::dvec2& at);

/// Changes the item IDs of a face on their way to its file.
using ReadBack = std::function<void(const raster::Face&, raster::ItemBuffer&)>;

/// `assemble`, `upload`, `camera`, `geometry` and `readBack` may be empty, and then change nothing.
struct StagedDevice {
  /// From the list of the vector's file to an assembled one.
  std::function<raster::DrawList(const raster::DrawList&)> assemble;

  /// Changes the uploaded draws, indices, texture coordinates and index maps; positions stay.
  std::function<void(raster::DrawList&)> upload;

  /// The view of face `f`; its resolution and scissor rectangle stay those of the face.
  std::function<raster::Face(std::span<const raster::Face>, std::size_t)> camera;

  std::optional<StagedGeometry> geometry;

  /// The facing that the device assumes for a triangle, given its true facing and the view.
  std::function<Facing(Facing, const raster::Face&)> facing = [](Facing side, const raster::Face&) { return side; };

  /// Whether samples on an edge are covered, from its direction.
  std::function<bool(const raster::SnappedPoint&)> ownsSamples = raster::ownsSamples;

  /// Whether a triangle is drawn at all.
  std::function<bool(const raster::SnappedTriangle&)> keeps = [](const raster::SnappedTriangle&) { return true; };

  /// How far edges are moved outwards along each axis, in sub-pixels: conservative rasterization has half a pixel.
  std::int64_t widening = 0;

  /// Whether triangles are drawn as lines of one pixel along their edges.
  bool drawsLines = false;

  /// Positions in a pixel: the samples of coverage and depth, and the sample of texture coordinates.
  std::vector<raster::SnappedPoint> samples{{128, 128}};
  raster::SnappedPoint shadingSample{128, 128};
  bool shadesSamples = false;  ///< whether each sample has its own texture coordinates
  int shadingBlock = 1;        ///< pixels on the side of a block that has one sample of texture coordinates

  /// The stored depth, from 1/w (in clip space -z/w) and the near distance; empty: that of the rules. The depth test
  /// has a tolerance, so that rounding does not decide between equal depths.
  std::function<double(double, double)> depth;
  std::function<bool(double, double)> passes = [](double incoming, double stored) {
    return incoming < stored - 0x1p-40 * std::abs(stored);
  };

  /// Whether all pixels of a quad with a covered one count as passed.
  bool countsQuads = false;

  /// Times the largest change of the depth 1/w per pixel, it is added to the depth.
  double depthBias = 0;

  /// The depth of a cleared sample; without one the first fragment of a sample passes.
  std::optional<double> clearedDepth;

  /// Whether a face starts with the depths that earlier faces left in its pixels.
  bool keepsDepth = false;

  /// (u, v) at a position, which may lie outside of the triangle.
  std::function<glm::dvec2(const raster::SnappedTriangle&, const raster::SnappedPoint&)> interpolate =
      [](const raster::SnappedTriangle& triangle, const raster::SnappedPoint& position) {
        const glm::dvec3 sum = weightedSum(triangle, weightsAt(triangle, position));
        return glm::dvec2(sum) / sum.z;
      };

  /// The texel of index map `map` at a lookup.
  std::function<raster::ItemId(const raster::DrawList&, std::size_t, const Lookup&)> fetch =
      [](const raster::DrawList& list, std::size_t map, const Lookup& lookup) {
        return nearestTexel(list.indexMaps[map], lookup.at);
      };

  /// The item ID of a textured fragment.
  std::function<raster::ItemId(const raster::DrawList&, raster::ItemId, raster::ItemId)> blend =
      [](const raster::DrawList& list, raster::ItemId offset, raster::ItemId texel) {
        return raster::blend(list.format, list.blend, offset, texel);
      };

  /// The item ID of a fragment after a change by its distance w from the eye; may be empty.
  std::function<raster::ItemId(raster::ItemId, double)> fade;

  /// The item ID in the target, from the stored one and the fragment's.
  std::function<raster::ItemId(raster::ItemId, raster::ItemId)> store = [](raster::ItemId, raster::ItemId fragment) {
    return fragment;
  };

  /// The item ID of a pixel, from those of its samples.
  std::function<raster::ItemId(std::span<const raster::ItemId>)> resolve = [](std::span<const raster::ItemId> ids) {
    return ids.front();
  };

  ReadBack readBack;
  bool isDrawnByRules = false;  ///< whether all stages but `readBack` are those of the rules
};

/// A device with one changed stage.
template <typename Stage, typename Change>
StagedDevice withStage(Stage StagedDevice::*stage, const Change& change) {
  StagedDevice device;
  device.*stage = change;
  return device;
}

/// A device that draws by the rules and changes the item IDs afterwards.
StagedDevice withReadBack(const ReadBack& readBack);

/// A vector as the staged device without faults draws it. Devices share its results of all stages before the first one
/// that they replace. It refers to the vector.
struct PlacedVector {
  const raster::DrawList& list;
  std::vector<raster::Face> faces;
  std::vector<std::vector<raster::SnappedTriangle>> triangles;  ///< of each face, by the rules
  std::vector<raster::ItemBuffer> buffers;                      ///< of each face
  const raster::DrawList& source;                               ///< before assembly
};

PlacedVector placeVector(const TestVector& vector);

/// The list that a device draws, after `assemble` and `upload`; nothing where it is that of the vector.
std::optional<raster::DrawList> uploadedOn(const StagedDevice& device, const PlacedVector& placed);

/// Draws the vector on a device. `wantsMore` gets the rows of each face from its first to its last, in the order of
/// faces, some rows at a time; drawing ends where it returns false. A device without faults gives the item IDs of the
/// rules, except at samples within rounding of a texel border or of another depth.
void drawOn(const StagedDevice& device, const PlacedVector& placed,
            const std::function<bool(const raster::ItemBuffer&)>& wantsMore);

/// The same with the list that the device draws, which may be that of the vector.
void drawOn(const StagedDevice& device, const PlacedVector& placed, const raster::DrawList& list,
            const std::function<bool(const raster::ItemBuffer&)>& wantsMore);

}  // namespace hemitex::reference
