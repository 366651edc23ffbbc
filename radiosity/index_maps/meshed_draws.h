/// Regular meshing, the method that textures replace (Nielsen and Christensen 2002, section 2): surfaces are cut along
/// the lines of their texel grids, and every element is drawn as polygons of its own with one word, without an index
/// map. Elements, areas and patches stay what the discretization says, and so do words: an element's is that of its own
/// texel. So a mesh differs from textures by who draws the borders of elements, and by what that costs.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "raster/interface/draw_list.h"

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

MeshedDraws makeMeshedDraws(const Scene& scene, const Discretization& discretization, const WordLayout& layout);

}  // namespace hemitex::radiosity
