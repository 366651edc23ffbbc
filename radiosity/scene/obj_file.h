/// Parses an OBJ file: positions, texture coordinates and polygons. Each polygon belongs to a section, which is a group
/// (or object) with a material name.
///
/// Numbers (`v`, `vt`, `vn` and the indices of `f`) are parsed here as doubles and checked. The packaged tinyobjloader
/// rounds them, reads `x` and `nan` as 0 and accepts indices out of range. It parses only the structure (`g`, `o`,
/// `usemtl`).
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hemitex::radiosity {

/// All faces of a file that share a group and a material, wherever they are.
struct ObjSection {
  std::string group;     ///< `default` before any group; several names of one `g` are joined by a blank
  std::string material;  ///< as in `usemtl`; empty before any
};

struct ObjPolygon {
  std::uint32_t firstCorner = 0;  ///< in ObjFile::corners
  std::uint32_t cornerCount = 0;  ///< at least 3
  std::uint32_t section = 0;      ///< in ObjFile::sections
  int line = 0;
  bool textured = false;  ///< every corner has texture coordinates
};

struct ObjCorner {
  std::uint32_t position = 0;                  ///< in ObjFile::positions
  std::optional<std::uint32_t> texcoord = {};  ///< in ObjFile::texcoords
};

struct ObjFile {
  std::vector<glm::dvec3> positions;              ///< finite; absolute coordinates at most 1e18
  std::vector<std::optional<glm::dvec3>> colors;  ///< one per position: the r g b of `v x y z r g b`
  std::vector<glm::dvec2> texcoords;              ///< finite; absolute coordinates at most 1e18
  std::vector<ObjCorner> corners;
  std::vector<ObjPolygon> polygons;  ///< in file order
  std::vector<ObjSection> sections;  ///< in the order of their first faces
  std::vector<std::string>
      materialLibraries;              ///< the argument of each `mtllib`: a file, or several separated by blanks
  std::vector<std::string> warnings;  ///< about faults in unused data, for the user
};

/// Reads a file. Throws InputError if it cannot be read, and as parseObj.
ObjFile readObj(const std::filesystem::path& file);

/// Parses the text of `file`. Throws InputError with the line for a malformed or non-finite number, an absolute
/// coordinate above 1e18, and a vertex with too few numbers. Also throws it for an index that is malformed or out of
/// range, and a face with fewer than three corners. A normal out of range is a warning, because normals are not used.
ObjFile parseObj(std::string_view text, const std::filesystem::path& file);

}  // namespace hemitex::radiosity
