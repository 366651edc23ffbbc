/// Regular meshing, the method that index maps replace (Nielsen and Christensen 2002, section 2). Surfaces are cut
/// along the lines of their texel grids, and each element is drawn as polygons with one item ID, without an index map.
/// Elements, areas, patches and item IDs are those of the discretization. So a mesh differs from textures only in how
/// the borders of elements are drawn, and in the time that takes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::radiosity {

struct MeshedDraws {
  /// Pieces of triangles in the order of the triangles in space, then by texel. Consecutive pieces of one element are
  /// one draw. A quad whose two triangles lie in one plane with one affine chart is cut as a whole: its pieces belong
  /// to its first triangle, and the second has none.
  ///
  /// Corners at the same place have one position, also across surfaces. They are rounded to a power of two between
  /// 2^-31 and 2^-30 extents of the scene, and then to binary32. The first step is far above the rounding of doubles.
  /// Where surfaces with different grids share an edge, corners of one lie on edges of the other (T-junctions).
  raster::DrawList list;
  /// One per triangle in space and one at the end: its pieces are the triangles [firstPiece[t], firstPiece[t + 1])
  /// of the list.
  std::vector<std::uint32_t> firstPiece;
};

/// Meshes a scene with the item IDs of a layout of its discretization.
MeshedDraws makeMeshedDraws(const Scene& scene, const Discretization& discretization, const IdLayout& layout);

/// Renders a mesh. Skipping a triangle skips all its pieces.
class MeshedRenderer final : public raster::ItemBufferRenderer {
 public:
  /// `pieces` draws the list of MeshedDraws, and `firstPiece` is theirs.
  MeshedRenderer(std::unique_ptr<raster::ItemBufferRenderer> pieces, std::vector<std::uint32_t> firstPiece);

  /// `skipped` are triangles in space.
  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override;

 private:
  std::unique_ptr<raster::ItemBufferRenderer> pieces_;
  std::vector<std::uint32_t> firstPiece_;
};

}  // namespace hemitex::radiosity
