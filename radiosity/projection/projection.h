/// A projection of the half space over a point of a surface: faces that stand there, and the share of the point's light
/// that goes through each of their pixels. Item buffers on the faces say what is met there, and so make a row of form
/// factors. The hemicube is one (hemicube.h); all that differs between projections is what stands here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/projection/fixed_point.h"
#include "raster/interface/face.h"

namespace hemitex::radiosity {

/// A face in the projection's own axes: x to the right and y up, both across the surface's normal, and z along it. The
/// rest is as in raster::Face.
struct ProjectionFace {
  glm::dvec3 x, y, w;  ///< rows
  int resolution = 0;
  raster::Scissor scissor;  ///< the pixels that exist
  std::size_t shares = 0;   ///< in Projection::sharesBefore
};

struct Projection {
  std::vector<ProjectionFace> faces;
  /// The delta form factors, in units of 2^-60: the integrals of cos(theta)/pi over what each pixel of a scissor
  /// rectangle stands for, row-major. Pixels that stand for nothing come before all others of their row. They stand as
  /// running sums, so that a run of pixels takes a difference: what all before a pixel have, and behind the last pixel
  /// what all have. Faces that are alike have one table.
  std::vector<std::vector<std::uint64_t>> sharesBefore;
  std::uint64_t captured = wholeShare;  ///< the sum over all pixels of all faces
  /// How much farther away than deep what a face sees can be, squared: it sees a point at distance d at a depth w of
  /// d / sqrt(squaredReach) or more.
  double squaredReach = 0;
};

/// A part of a face.
struct Window {
  std::size_t face = 0;     ///< in Projection::faces
  raster::Scissor scissor;  ///< inside the face's own
};

/// The faces of a projection, each whole.
std::vector<Window> wholeFaces(const Projection& projection);

/// From the shares of pixels to Projection::sharesBefore.
std::vector<std::uint64_t> runningSums(const std::vector<std::uint64_t>& shares);

/// The share of a pixel, by its place in the face's viewport; inside the scissor rectangle.
std::uint64_t shareOf(const Projection& projection, std::size_t face, int column, int row);

/// The faces over a point, in their order. `position` is relative to the scene's origin, `normal` is unit; `up`, where
/// it is not zero, turns the projection about the normal so that its own up points along it as far as that is
/// possible.
std::vector<raster::Face> facesOver(std::span<const ProjectionFace> faces, const glm::dvec3& position,
                                    const glm::dvec3& normal, const glm::dvec3& up, double nearDistance);

/// A unit vector at right angles to the unit vector `normal`, along `up` as far as that is possible.
glm::dvec3 tangentAlong(const glm::dvec3& normal, const glm::dvec3& up);

}  // namespace hemitex::radiosity
