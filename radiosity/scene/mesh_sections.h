/// Sections: the polygons of a scene file, triangulated and divided by group and material. A section becomes one
/// surface, or several if it needs several charts.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include "radiosity/meshes/polygon_mesh.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// Unit normals of a file are equal up to this distance, about a degree, since files round them.
inline constexpr double normalTolerance = 0.02;

struct Section {
  std::string family;        ///< unique: the group's name, with `/material` if the group has several sections
  std::string material;      ///< empty for none
  std::uint32_t object = 0;  ///< in PolygonMesh::objects
  /// In file order, all with area. Texture coordinates are those of the file, or zero. Charts are not set yet, except
  /// for quads, whose corners map to those of the unit square.
  std::vector<Triangle> triangles;
  /// The unit normals of the file at the corners of each triangle. Empty if a corner has none, or if all are the
  /// normals of their faces: programs write these for meshes without smooth shading, too.
  std::vector<std::array<glm::vec3, 3>> normals = {};
  std::set<std::uint32_t> crossing = {};  ///< polygons that cross themselves, whose triangles may overlap
};

/// Triangulates polygons. Polygons without area are dropped and counted in a warning; so are polygons that repeat an
/// earlier one of the same section, corner for corner, and of facets those that repeat any of the same material.
/// Self-intersecting polygons are counted in another. Empty sections are left out.
std::vector<Section> cutIntoSections(const PolygonMesh& mesh, bool areFacets, std::vector<std::string>& warnings);

/// The number of the first polygon with the same corners in the same order, from any corner on, and the same material;
/// its own number for a polygon that repeats none. One per polygon.
std::vector<std::uint32_t> firstOfEqual(const PolygonMesh& mesh);

}  // namespace hemitex::radiosity
