/// What lies between the vertices and the item IDs of a face, for whoever looks for the stage at which a device leaves
/// the raster rules: where every vertex goes, what clipping leaves of the triangles that it cuts, and for every pixel
/// which triangle it shows, at what depth and texture coordinates, and which texel.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <vector>

#include "raster/setup/vertex_stage.h"
#include "reference/vectors/vector_file.h"

namespace hemitex::reference {

/// In place of both coordinates of a vertex that is clipped away or not finite.
constexpr int notSnapped = std::numeric_limits<std::int32_t>::min();

/// Arrays with an entry a pixel of the scissor rectangle (row-major, row 0 first), a vertex of the list, or a piece: a
/// triangle of the fans into which clipping cuts triangles, in the order of triangles and, within one, of the fan.
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
  std::vector<std::int32_t> pieceTriangles;                     ///< what was cut
  std::vector<std::array<raster::ViewVertex, 3>> pieceCorners;  ///< x, y, w, u, v
  std::vector<std::array<glm::ivec2, 3>> pieceSnapped;          ///< of the corners
};

/// The stages of a face. The list and the face are valid. The cost is that of drawing, and of a triangle a pixel.
Stages stagesOf(const raster::DrawList& list, const raster::Face& face);

/// Writes the stages of all faces of a vector beside its vector.json: `stages.json`, which names the arrays of each
/// face (docs/item-buffers.md), and their files `stage-FACE-...`, faces numbered from 0. Throws InputError where a file
/// cannot be written.
void writeStages(const std::filesystem::path& folder, const TestVector& vector);

}  // namespace hemitex::reference
