/// An OBJ file as it is written: positions, texture coordinates and polygons, each polygon in a section, which is a
/// group (or object) with a material name.
///
/// The work is shared. Numbers (`v`, `vt`, `vn` and the indices of `f`) are read here, as binary64 and checked, because
/// the packaged tinyobjloader rounds them, reads `x` and `nan` as 0 and lets indices leave their range. The structure
/// (`g`, `o`, `usemtl`) is read by tinyobjloader.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hemitex::radiosity {

/// The part of a file that shares a group and a material, wherever its faces stand.
struct ObjSection {
  std::string group;     ///< `default` before any group; several names of one `g` are joined by a blank
  std::string material;  ///< as `usemtl` says it; empty before any
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
  std::vector<glm::dvec3> positions;              ///< finite, each coordinate at most 1e18 in size
  std::vector<std::optional<glm::dvec3>> colors;  ///< one a position: the r g b of `v x y z r g b`
  std::vector<glm::dvec2> texcoords;              ///< the same
  std::vector<ObjCorner> corners;
  std::vector<ObjPolygon> polygons;            ///< in file order
  std::vector<ObjSection> sections;            ///< in the order of their first faces
  std::vector<std::string> materialLibraries;  ///< what each `mtllib` says: a file, or several between blanks
};

/// Reads a file. Throws InputError where it cannot be read, and as parseObj.
ObjFile readObj(const std::filesystem::path& file);

/// Reads the text of `file`. Throws InputError with the line on a malformed or non-finite number, a coordinate of a
/// vertex or of a texture above 1e18 in size, a vertex that has too few numbers, an index that is malformed or out of
/// range, and a face with fewer than three corners.
ObjFile parseObj(std::string_view text, const std::filesystem::path& file);

}  // namespace hemitex::radiosity
