/// The scene: what an OBJ file and its materials mean to radiosity, checked, triangulated and mapped into charts.
///
/// A surface is a set of triangles that share a material and a chart: coordinates in [0,1]^2 that no two triangles
/// claim twice. The chart is what an index map is laid over, so each texel is an element of the surface
/// (Nielsen and Christensen 2002, section 3.1). Positions stay binary64; `origin`, the centre of the bounds, is
/// subtracted from everything that is drawn, so that a scene far from zero loses no digits.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/images/image.h"

namespace hemitex::radiosity {

struct Material {
  std::string name;
  glm::dvec3 reflectance{0.5};             ///< Kd, diffuse, RGB in [0, 1)
  glm::dvec3 emission{0.0};                ///< Ke as emitted radiosity, W/m^2 per RGB band, >= 0
  std::optional<int> reflectanceMap = {};  ///< map_Kd in Scene::images, linear; scales the reflectance
  std::optional<int> emissionMap = {};     ///< map_Ke in Scene::images, linear; scales the emission
};

struct Triangle {
  std::array<glm::dvec3, 3> position;  ///< in the file's units, the origin not subtracted; counter-clockwise in front
  std::array<glm::dvec2, 3> chart;     ///< in [0,1]^2, multiples of 2^-24, so binary32 numbers: what is drawn
  std::array<glm::dvec2, 3> texcoord;  ///< the file's coordinates, for material maps; they wrap; the chart's without
  std::uint32_t polygon = 0;           ///< the face of the file that it was cut from, counted from 0 over the file
  /// The file's colours of its corners (`v x y z r g b`), where all three have one: the display colours, sRGB-encoded,
  /// of a Gouraud shaded surface of a solved scene.
  std::optional<std::array<glm::dvec3, 3>> cornerColor = {};
};

struct Surface {
  /// Unique: the group's name, `/material` behind it where a group has several, `#n` behind that for parts, `/back` for
  /// the other side in two-sided scenes; `~2`, `~3`, ... where a name would come again.
  std::string name;
  std::string family;  ///< the name without `#n`: what a surface is called on the command line
  int material = 0;    ///< in Scene::materials
  std::vector<Triangle>
      triangles;                 ///< in file order; never empty, none without area (see hasArea) here or in the chart
  std::optional<int> twin = {};  ///< two-sided scenes: the surface that is the other side of this one
};

struct Scene {
  glm::dvec3 origin{0.0};  ///< the centre of the bounds
  double extent = 0;       ///< the diagonal of the bounds
  std::vector<Material> materials;
  std::vector<Image> images;
  std::vector<Surface>
      surfaces;  ///< in the order of their first faces; in two-sided scenes all twins follow all fronts
  std::vector<std::string> warnings;  ///< one sentence each, for the user
};

/// Area of a triangle, and its unit normal on the side from which it winds counter-clockwise.
double area(const Triangle& triangle);
glm::dvec3 normal(const Triangle& triangle);

/// The number of triangles of all surfaces; triangles are numbered through the scene, surface by surface.
std::size_t triangleCount(const Scene& scene);

/// Sets the origin and the extent of a scene that has a surface.
void measureBounds(Scene& scene);

}  // namespace hemitex::radiosity
