/// Elements as polygons: the triangles, cut along the texels of an index map. Rays start on these pieces, and closed
/// forms use them.
///
/// Positions are in the frame of the scene (see ray_meeting.h). Triangles have their numbers in space.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::reference {

/// Converts a position of the file, and the corners of a triangle, to the frame of the scene.
glm::dvec3 inFrame(const radiosity::Scene& scene, const glm::dvec3& position);
std::array<glm::dvec3, 3> inFrame(const radiosity::Scene& scene, const radiosity::Triangle& triangle);

/// A triangle in space.
struct SceneTriangle {
  radiosity::TrianglePlace place;
  const radiosity::Triangle* triangle;  ///< of the surface
  const radiosity::Instance* instance;
  bool isBacked;                                          ///< rays pass through its back
  std::shared_ptr<const radiosity::HoledTriangle> holed;  ///< rays pass through its holes; null without
};
/// All triangles in space, in the order of their numbers. The scene must outlive them.
std::vector<SceneTriangle> sceneTriangles(const radiosity::Scene& scene);

/// The part of a triangle that belongs to an element: a convex polygon.
struct SurfacePiece {
  std::uint32_t element = 0;
  std::uint32_t triangle = 0;
  glm::dvec3 normal;                ///< unit
  std::vector<glm::dvec3> corner;   ///< counter-clockwise in front; three to eight corners
  std::vector<glm::dvec2> onChart;  ///< the corners on the chart of the surface, in texels
  std::uint32_t surface = 0;        ///< in Scene::surfaces
  glm::uvec2 texel{0, 0};           ///< column and row
};

struct SurfacePieces {
  std::vector<SurfacePiece> pieces;  ///< element by element, then in the order of the triangles
  std::vector<std::uint32_t> first;  ///< the first piece of each element; one more at the end

  std::span<const SurfacePiece> of(std::uint32_t element) const {
    return std::span(pieces).subspan(first[element], first[element + 1] - first[element]);
  }
};

/// Assigns the pieces of each texel to the element that the texel maps to, as the discretization does with areas.
/// Pieces without area are left out. The pieces are those of the first instance.
SurfacePieces surfacePieces(const radiosity::Scene& scene, const radiosity::Discretization& discretization);
/// Pieces of the first instance with their images, all of which belong to the element.
SurfacePieces withImages(const SurfacePieces& pieces, const radiosity::Scene& scene);

/// The element at a point of a triangle: that of the texel that an index map shows there. `weights` are barycentric, of
/// the triangle's corners 1 and 2; in the second form those of the triangle in space.
std::uint32_t elementAt(const radiosity::Triangle& triangle, const radiosity::Grid& grid, const glm::dvec2& weights);
std::uint32_t elementAt(const SceneTriangle& triangle, const radiosity::Discretization& discretization,
                        const glm::dvec2& weights);

}  // namespace hemitex::reference
