/// Sections: the polygons of a scene file, triangulated and divided by group and material. A section becomes one
/// surface, or several if it needs several charts.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "radiosity/scene/polygon_mesh.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

struct Section {
  std::string family;    ///< unique: the group's name, with `/material` if the group has several sections
  std::string material;  ///< empty for none
  /// In file order, all with area. Texture coordinates are those of the file, or zero. Charts are not set yet, except
  /// for quads, whose corners map to those of the unit square.
  std::vector<Triangle> triangles;
};

/// Triangulates polygons. Polygons without area are dropped and counted in a warning; self-intersecting polygons are
/// counted in another. Empty sections are left out.
std::vector<Section> cutIntoSections(const PolygonMesh& mesh, std::vector<std::string>& warnings);

/// Returns `wanted`, or the first of `wanted~2`, `wanted~3`, ... that is not in `taken`, and inserts it there.
std::string uniqueName(std::set<std::string>& taken, const std::string& wanted);

}  // namespace hemitex::radiosity
