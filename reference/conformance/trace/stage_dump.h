/// The intermediate results of a face between its vertices and its item IDs. The author of a backend compares them with
/// those of a device to find the stage that breaks the raster rules. They are the transformed and snapped vertices, the
/// pieces of clipped triangles, and per pixel the visible triangle, its depth, texture coordinates and texel.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <vector>

#include "raster/plain/rules.h"
#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {

/// Both coordinates of a vertex that is clipped away or not finite.
constexpr int notSnapped = std::numeric_limits<std::int32_t>::min();

/// Arrays with an entry per pixel of the scissor rectangle (row-major, row 0 first), per vertex of the list, or per
/// piece. Clipping leaves a polygon of a triangle, cut into a fan of pieces. Pieces follow the order of triangles.
struct Stages {
  // pixels
  std::vector<std::int32_t> triangles;  ///< t of indices 3t to 3t + 2; -1 on the background
  std::vector<double> inverseDepths;    ///< 1/w, rounded as in a Fragment; 0 on the background
  std::vector<glm::dvec2> coordinates;  ///< u and v, likewise
  std::vector<glm::ivec2> texels;       ///< column and row; -1 on the background, without an index map, and on backs
  // vertices
  std::vector<glm::vec3> view;      ///< x, y, w of the vertex stage
  std::vector<glm::ivec2> snapped;  ///< in 1/256 pixel
  // pieces
  std::vector<std::int32_t> pieceTriangles;                     ///< the clipped triangle of each piece
  std::vector<std::array<raster::ViewVertex, 3>> pieceCorners;  ///< x, y, w, u, v
  std::vector<std::array<glm::ivec2, 3>> pieceSnapped;          ///< of the corners
};

/// The stages of a face. The list and the face are valid. It draws the face as PlainRenderer does.
Stages stagesOf(const raster::DrawList& list, const raster::Face& face);

/// Writes the stages of all faces of a vector beside its vector.json. `stages.json` names the arrays of each face
/// (docs/item-buffers.md); their files are `stage-FACE-...` with faces numbered from 0. Throws InputError for a file
/// that cannot be written.
void writeStages(const std::filesystem::path& folder, const TestVector& vector);

}  // namespace hemitex::reference
