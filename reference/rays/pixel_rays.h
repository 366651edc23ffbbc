/// What a ray tracer makes of an item buffer: a ray through every pixel of the same faces, and the number of the
/// triangle that it meets first. What drawing is measured against, so it is done as fast as Embree can: packets of
/// sixteen neighbours, four by four, with its coherent traversal and without its robust flag. On a Xeon with AVX-512
/// that was faster than packets of eight and of four, than other shapes, and, on a million triangles, than streams of
/// any length; where triangles are few they all take the same.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"

namespace hemitex::reference {

/// What a ray meets that meets no triangle.
inline constexpr raster::ItemId noTriangle = 0xffffffff;

class PixelRays {
 public:
  /// Builds the tree over the triangles of a list. Throws std::runtime_error where Embree fails.
  explicit PixelRays(const raster::DrawList& list);
  ~PixelRays();
  PixelRays(const PixelRays&) = delete;
  PixelRays& operator=(const PixelRays&) = delete;

  /// For every pixel of the faces' scissor rectangles the triangle that its sample shows, numbered as in the list, or
  /// noTriangle; none nearer than the face's near distance. The memory of `buffers` serves again where it is as large.
  void cast(std::span<const raster::Face> faces, std::vector<raster::ItemBuffer>& buffers) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hemitex::reference
