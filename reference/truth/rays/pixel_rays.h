/// Item buffers of triangle numbers by ray tracing: casts a ray through each pixel of the same faces and returns the
/// first triangle. It is the baseline for drawing, so it uses Embree's fastest settings: packets of four by four
/// neighbours, coherent traversal, no robust flag. On a Xeon with AVX-512 that was faster than packets of eight and of
/// four and than other shapes. With a million triangles it was also faster than streams of any length; with few
/// triangles all settings take the same time.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"

namespace hemitex::reference {

struct EmbreeScene;

/// The result of a ray that meets no triangle.
inline constexpr raster::ItemId noTriangle = 0xffffffff;

class PixelRays {
 public:
  /// Builds the tree over the triangles of a list. Throws InputError for index maps with holes, and std::runtime_error
  /// if Embree fails.
  explicit PixelRays(const raster::DrawList& list);

  /// For each pixel of the faces' scissor rectangles, the triangle that its sample shows, numbered as in the list, or
  /// noTriangle. Ignores triangles nearer than the face's near distance. Reuses the allocations of `buffers`.
  void cast(std::span<const raster::Face> faces, std::vector<raster::ItemBuffer>& buffers) const;

 private:
  std::shared_ptr<const EmbreeScene> tree_;
};

}  // namespace hemitex::reference
