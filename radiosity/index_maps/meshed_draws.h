/// Regular meshing, the method that textures replace (Nielsen and Christensen 2002, section 2): surfaces are cut along
/// the lines of their texel grids, and every element is drawn as polygons of its own with one item ID, without an index
/// map. Elements, areas and patches stay what the discretization says, and so do item IDs: an element's is that of its
/// own texel. So a mesh differs from textures by who draws the borders of elements, and by what that costs.
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
  /// Pieces of triangles in the order of the scene's triangles, and by texel within one; pieces of one element that
  /// follow each other are one draw. A quad whose two triangles lie in one plane, under one affine chart, is cut as a
  /// whole: its pieces are those of its first triangle, and the second has none.
  ///
  /// Corners that meet are one position, whichever surfaces they are of: they are rounded to a power of two between
  /// 2^-31 and 2^-30 extents of the scene, far above what binary64 rounds off, before they are rounded to binary32.
  /// Where surfaces with different grids share an edge, corners of one lie on sides of the other.
  raster::DrawList list;
  /// One a triangle of the scene, and the end: its pieces are the triangles [firstPiece[t], firstPiece[t + 1]) of the
  /// list.
  std::vector<std::uint32_t> firstPiece;
};

MeshedDraws makeMeshedDraws(const Scene& scene, const Discretization& discretization, const IdLayout& layout);

/// The renderer of a mesh: a caller that leaves out a triangle of the scene leaves out all its pieces.
class MeshedRenderer final : public raster::ItemBufferRenderer {
 public:
  /// `pieces` draws the list of MeshedDraws, and `firstPiece` is theirs.
  MeshedRenderer(std::unique_ptr<raster::ItemBufferRenderer> pieces, std::vector<std::uint32_t> firstPiece);

  /// `skipped` are triangles of the scene.
  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override;

 private:
  std::vector<std::uint32_t> piecesOf(std::span<const std::uint32_t> triangles) const;

  std::unique_ptr<raster::ItemBufferRenderer> pieces_;
  std::vector<std::uint32_t> firstPiece_;
};

}  // namespace hemitex::radiosity
