/// Cuts the triangles of a surface along their slices, and finds the regions that the cuttings form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/geometry/grid_clipping.h"
#include "radiosity/geometry/triangle_slices.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The part of a triangle in a texel, or one of the pieces that slices cut it into.
struct Cutting {
  std::uint32_t texel = 0, triangle = 0;
  std::shared_ptr<const Piece> piece = {};  ///< where there are several in the texel
  glm::dvec2 centre{0.0};                   ///< barycentric weights, of the triangle's corners 1 and 2
  double area = 0;
};

/// A surface cut by its slices. Cuttings that share a part of their borders that no slice lies along are one region:
/// they are exposed or buried together.
struct CutSurface {
  std::vector<Cutting> cuttings;                    ///< by triangle
  std::vector<std::uint32_t> first;                 ///< of each triangle's cuttings, and behind the last
  std::vector<bool> isCut;                          ///< one a triangle: whether it has slices
  std::vector<std::vector<std::uint32_t>> regions;  ///< the cuttings of each, the largest first
};

/// `slices` has an entry a triangle of the surface; `tolerance` is a length, far above what rounding does to a slice.
CutSurface cutSurface(const Surface& surface, const Grid& grid, std::span<const std::vector<Slice>> slices,
                      double tolerance);

/// The cutting that a point of a triangle lies in; the triangle's first where rounding puts it in none.
std::uint32_t cuttingAt(const CutSurface& cut, const Surface& surface, const Grid& grid, std::uint32_t triangle,
                        const glm::dvec2& weights);

}  // namespace hemitex::radiosity
