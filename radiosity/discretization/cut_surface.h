/// Cuts the triangles of a surface along their slices (triangle_slices.h) into pieces, and joins pieces to regions.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/triangle_slices.h"
#include "radiosity/geometry/grid_clipping.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The part of a triangle in a texel, or one of the pieces into which slices cut that part.
struct Cutting {
  std::uint32_t texel = 0, triangle = 0;
  std::shared_ptr<const Piece> piece = {};  ///< if the texel has several pieces of the triangle
  glm::dvec2 centre{0.0};                   ///< barycentric weights, of the triangle's corners 1 and 2
  double area = 0;
};

/// Which cuttings form a region.
enum class Regions {
  /// A cutting near a slice is a region of its own. The others are joined with those in the same and in adjacent
  /// texels, so that a large surface has few regions.
  FarFromSlices,
  /// Cuttings of one triangle or of neighbours are joined if they share a border that slices do not cover completely:
  /// the parts into which slices separate the surface. All have pieces. Finer grids only make this faster.
  Connected
};

/// A surface cut by its slices. A region is exposed or buried as a whole.
struct CutSurface {
  std::vector<Cutting> cuttings;                    ///< by triangle, then by texel
  std::vector<std::uint32_t> first;                 ///< first cutting of each triangle; one more at the end
  std::vector<bool> isCut;                          ///< one per triangle: whether it may have several
  std::vector<std::vector<std::uint32_t>> regions;  ///< the cuttings of each region, largest first
};

/// `slices` has one entry per triangle of the surface. `tolerance` is a length far above the rounding errors of slices.
CutSurface cutSurface(const Surface& surface, const GridSize& grid, std::span<const std::vector<Slice>> slices,
                      double tolerance, Regions regions = Regions::FarFromSlices);

/// The cutting that contains a point of a triangle; the triangle's first one if rounding puts the point in none.
std::uint32_t cuttingAt(const CutSurface& cut, const Surface& surface, const GridSize& grid, std::uint32_t triangle,
                        const glm::dvec2& weights);

}  // namespace hemitex::radiosity
