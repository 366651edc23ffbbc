/// A projection of the half space over a point of a surface: faces, and the share of the point's light that leaves
/// through each pixel. The item buffers of the faces and these shares give a row of form factors. The hemicube is one
/// projection (projection_kinds.h); projections differ only in the members below.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "raster/interface/face.h"

namespace hemitex::radiosity {

/// Shares of the flux that leaves a patch are integers in units of 2^-60, so that the order of summation does not
/// change a sum.
inline constexpr int shareBits = 60;
inline constexpr std::uint64_t wholeShare = std::uint64_t{1} << shareBits;

/// The form factor of a share, in [0, 1]. Signed integers convert to double with one instruction, unsigned ones need
/// several.
inline double formFactor(std::uint64_t share) {
  return static_cast<double>(static_cast<std::int64_t>(share)) / static_cast<double>(wholeShare);
}

/// A face in the axes of the projection: x right and y up in the tangent plane, z along the normal. Otherwise as
/// raster::Face.
struct ProjectionFace {
  glm::dvec3 x, y, w;  ///< rows
  int resolution = 0;
  raster::Scissor scissor;  ///< the pixels that are drawn
  std::size_t shares = 0;   ///< in Projection::sharesBefore
};

struct Projection {
  std::vector<ProjectionFace> faces;
  /// Delta form factors in units of 2^-60: the integrals of cos(theta)/pi over the solid angle of each pixel of a
  /// scissor rectangle, row-major. Pixels without weight come first in each row. The table holds running sums: the sum
  /// before each pixel, and the total at the end. So the share of a run of pixels is one difference. Equal faces share
  /// a table.
  std::vector<std::vector<std::uint64_t>> sharesBefore;
  std::uint64_t captured = wholeShare;  ///< the sum over all pixels of all faces
  /// Squared maximum ratio of distance to depth: a point at distance d has a depth w of at least d / sqrt(squaredReach)
  /// on some face.
  double squaredReach = 0;
};

/// A part of a face.
struct Window {
  std::size_t face = 0;     ///< in Projection::faces
  raster::Scissor scissor;  ///< inside that of the face
};

/// One window per face, each the whole face.
std::vector<Window> wholeFaces(const Projection& projection);

/// The share of a pixel, by its place in the face's viewport; it must lie inside the scissor rectangle.
std::uint64_t shareOf(const Projection& projection, std::size_t face, int column, int row);

/// The delta form factors of the pixels of a face's scissor rectangle, row by row.
std::vector<double> deltaFormFactors(const Projection& projection, std::size_t face);

/// The faces over a point, in their order. `position` is relative to the scene's origin, `normal` is a unit vector, and
/// `nearDistance` is in units of the scene, above 0. If `up` is not zero, the projection is rotated about the normal so
/// that its up direction is as near to `up` as possible.
std::vector<raster::Face> facesOver(std::span<const ProjectionFace> faces, const glm::dvec3& position,
                                    const glm::dvec3& normal, const glm::dvec3& up, double nearDistance);

}  // namespace hemitex::radiosity
