/// Sections: the polygons of an OBJ file cut into triangles, by group and material. From a section come one surface or,
/// where it needs several charts, more.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "radiosity/scene/obj_file.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

struct Section {
  std::string family;    ///< unique: the group's name, `/material` behind it where the group has several sections
  std::string material;  ///< as `usemtl` says it; empty where no material is said
  /// In file order, all with area. Texture coordinates are the file's, or zero; the chart is still to come, but where
  /// the polygon is a quad it maps the quad's corners to those of the unit square.
  std::vector<Triangle> triangles;
};

/// Cuts polygons into triangles. Polygons without area are dropped and counted in a warning, and polygons that cross
/// themselves are counted in another; sections that end up empty are left out.
std::vector<Section> cutIntoSections(const ObjFile& obj, std::vector<std::string>& warnings);

/// `wanted`, or the first of `wanted~2`, `wanted~3`, ... that is not taken; takes it.
std::string uniqueName(std::set<std::string>& taken, const std::string& wanted);

}  // namespace hemitex::radiosity
