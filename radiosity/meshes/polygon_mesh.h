/// The polygons of a scene file, whatever its format. Each polygon belongs to a section, which is a group (or object)
/// with a material name.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "radiosity/base/text_lines.h"
#include "radiosity/meshes/scene_object.h"

namespace hemitex::radiosity {

/// All faces of a file that share a group and a material, wherever they are.
struct MeshSection {
  std::uint32_t object = 0;  ///< in PolygonMesh::objects
  std::string material;      ///< empty for none
};

struct MeshPolygon {
  std::uint32_t firstCorner = 0;  ///< in PolygonMesh::corners
  std::uint32_t cornerCount = 0;  ///< at least 3
  std::uint32_t section = 0;      ///< in PolygonMesh::sections
  int line = 0;                   ///< of a text file; 0 in others
  bool textured = false;          ///< every corner has texture coordinates
};

struct MeshCorner {
  std::uint32_t position = 0;                  ///< in PolygonMesh::positions
  std::optional<std::uint32_t> texcoord = {};  ///< in PolygonMesh::texcoords
  std::optional<std::uint32_t> normal = {};    ///< in PolygonMesh::normals
};

/// Values of faces, such as the cell data of VTK.
struct FaceArray {
  std::string name;
  int components = 1;               ///< 1 or 3
  std::vector<double> values = {};  ///< `components` per polygon
};

struct PolygonMesh {
  std::vector<glm::dvec3> positions = {};  ///< finite; absolute coordinates at most 1e18
  std::vector<glm::vec3> colours = {};     ///< linear, one per position where the file has any; else empty
  std::vector<glm::dvec2> texcoords = {};  ///< finite; absolute coordinates at most 1e18
  std::vector<glm::dvec3> normals = {};    ///< of any length, perhaps 0
  std::vector<MeshCorner> corners = {};
  std::vector<MeshPolygon> polygons = {};  ///< in file order
  std::vector<MeshSection> sections = {};  ///< in the order of their first faces
  /// In the order of their first faces. OBJ: groups; `default` before any group, and a blank between several names of
  /// one `g`. glTF: all nodes.
  std::vector<SceneObject> objects = {};
  std::vector<std::string> materialLibraries =
      {};  ///< OBJ: the argument of each `mtllib`, a file or several with blanks between them
  std::vector<FaceArray> arrays = {};      ///< those that were asked for; View3D: `reflectance`
  std::vector<std::string> warnings = {};  ///< about faults in unused data, for the user
};

/// The square of a larger coordinate would leave the range of binary32, which drawing uses. A larger texture coordinate
/// could not be located between texels.
inline constexpr double largestCoordinate = 1e18;

/// Appends a position without a colour. Throws InputError at `place` if a coordinate is not finite or too large.
void addPosition(PolygonMesh& mesh, const glm::dvec3& position, const Place& place);

/// Appends a polygon of positions, of the last section. Throws InputError if it has fewer than 3 corners, or a position
/// that the mesh lacks.
void addPolygon(PolygonMesh& mesh, std::span<const std::uint32_t> positions, const Place& place);

/// Appends a strip of triangles of the last section: three positions in a row are one, every second one turned over.
/// Triangles that name a position twice are left out. Throws InputError as addPolygon.
void addStrip(PolygonMesh& mesh, std::span<const std::uint32_t> positions, const Place& place);

/// Sets the colour of the last position; earlier ones without a colour are white. A colour is clamped to [0, 1].
void setColour(PolygonMesh& mesh, const glm::dvec3& linear);

/// Makes each polygon a section of its own with its material. The group is the number of the polygon, counted from 0.
/// In meshes of several groups it is `group#number`.
void divideIntoFacets(PolygonMesh& mesh);

/// Where a polygon is, for messages: `line 7` of a text file, else `face 7`, counted from 1.
std::string placeOf(const PolygonMesh& mesh, std::uint32_t polygon);

}  // namespace hemitex::radiosity
