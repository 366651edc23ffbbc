#include "reference/conformance/trace/stage_dump.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "raster/base/file_io.h"
#include "raster/base/parallel.h"
#include "raster/setup/triangle_setup.h"
#include "raster/software/software_renderer.h"
#include "reference/conformance/trace/fragments.h"
#include "reference/conformance/vectors/array_file.h"

namespace hemitex::reference {
namespace {

using Json = nlohmann::ordered_json;
using raster::ViewVertex;

// Corners are written as they are in memory: x, y, w, u, v.
static_assert(sizeof(ViewVertex) == 5 * sizeof(double));

// --- vertices ---

bool isInside(const ViewVertex& vertex, double nearDistance) {
  return raster::isFinite(vertex) &&
         std::all_of(raster::halfSpaces.begin(), raster::halfSpaces.end(), [&](raster::HalfSpace halfSpace) {
           return raster::distance(halfSpace, vertex, nearDistance) >= 0;
         });
}

glm::ivec2 snap(const ViewVertex& vertex, int resolution) {
  return {raster::snap(vertex.x / vertex.w, resolution), raster::snap(vertex.y / vertex.w, resolution)};
}

void addVertices(const std::vector<ViewVertex>& vertices, const raster::Face& face, Stages& stages) {
  for (const ViewVertex& vertex : vertices) {
    stages.view.push_back({vertex.x, vertex.y, vertex.w});
    stages.snapped.push_back(isInside(vertex, face.nearDistance) ? snap(vertex, face.resolution)
                                                                 : glm::ivec2(notSnapped));
  }
}

// --- pieces ---

void addPieces(const raster::DrawList& list, const std::vector<ViewVertex>& vertices, const raster::Face& face,
               Stages& stages) {
  for (std::size_t t = 0; t < list.indices.size() / 3; ++t) {
    std::array<ViewVertex, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = vertices[list.indices[3 * t + k]];
    const bool isWhole = std::all_of(corners.begin(), corners.end(),
                                     [&](const ViewVertex& vertex) { return isInside(vertex, face.nearDistance); });
    if (isWhole || !std::all_of(corners.begin(), corners.end(), raster::isFinite)) continue;
    const raster::ClippedPolygon polygon = raster::clip(corners, face.nearDistance);
    for (std::size_t k = 2; k < static_cast<std::size_t>(polygon.count); ++k) {
      const std::array<ViewVertex, 3> piece{polygon.vertices[0], polygon.vertices[k - 1], polygon.vertices[k]};
      stages.pieceTriangles.push_back(static_cast<std::int32_t>(t));
      stages.pieceCorners.push_back(piece);
      stages.pieceSnapped.push_back(
          {snap(piece[0], face.resolution), snap(piece[1], face.resolution), snap(piece[2], face.resolution)});
    }
  }
}

// --- pixels ---

/// The index in `drawn` of the triangle that each pixel shows: the renderer draws each triangle with its index as item
/// ID.
raster::ItemBuffer drawNumbers(const raster::DrawList& list, const std::vector<DrawnTriangle>& drawn,
                               const raster::Face& face) {
  raster::DrawList numbered{list.positions, list.texcoords, list.indices, {}, {}, {{32}}};
  for (const DrawnTriangle& triangle : drawn)
    numbered.draws.push_back({3 * triangle.triangle, 3, static_cast<raster::ItemId>(numbered.draws.size()), {}, {}});
  return render(raster::SoftwareRenderer(std::move(numbered)), {&face, 1}, {}).front();
}

void addPixels(const raster::DrawList& list, const raster::Face& face, Stages& stages) {
  const std::vector<DrawnTriangle> drawn = drawnTriangles(list);
  const raster::ItemBuffer numbers = drawNumbers(list, drawn, face);
  stages.triangles.resize(numbers.ids.size(), -1);
  stages.inverseDepths.resize(numbers.ids.size());
  stages.coordinates.resize(numbers.ids.size(), glm::dvec2(0.0));
  stages.texels.resize(numbers.ids.size(), glm::ivec2(-1));
  raster::parallelFor(numbers.ids.size(), [&](std::size_t pixel) {
    if (numbers.ids[pixel] >= drawn.size()) return;
    const glm::ivec2 at = pixelAt(face.scissor, pixel);
    // Rounding may let parts of a clipped triangle overlap: then the nearest counts.
    const auto parts = screenTriangles(list, face, {&drawn[numbers.ids[pixel]], 1});
    const Fragment fragment = fragmentsAt(list, parts, at.x, at.y).at(0);
    stages.triangles[pixel] = static_cast<std::int32_t>(fragment.triangle);
    stages.inverseDepths[pixel] = fragment.inverseDepth;
    stages.coordinates[pixel] = {fragment.u, fragment.v};
    if (fragment.texel) stages.texels[pixel] = {fragment.texel->column, fragment.texel->row};
  });
}

}  // namespace

Stages stagesOf(const raster::DrawList& list, const raster::Face& face) {
  std::vector<ViewVertex> vertices;
  for (std::size_t v = 0; v < list.positions.size(); ++v)
    vertices.push_back(raster::transform(face, list.positions[v], list.texcoords[v]));
  Stages stages;
  addVertices(vertices, face, stages);
  addPieces(list, vertices, face, stages);
  addPixels(list, face, stages);
  return stages;
}

void writeStages(const std::filesystem::path& folder, const TestVector& vector) {
  Json faces = Json::array();
  for (std::size_t f = 0; f < vector.faces.size(); ++f) {
    const Stages stages = stagesOf(vector.list, vector.faces[f].face);
    Json json{{"name", vector.faces[f].name}};
    const auto write = [&](const std::string& key, const std::string& type, const auto& values) {
      const std::string file = "stage-" + std::to_string(f) + "-" + key + "." + type;
      writeArray(folder / file, values);
      json[key] = file;
    };
    write("triangles", "i32", stages.triangles);
    write("inverse_depths", "f64", stages.inverseDepths);
    write("coordinates", "f64", stages.coordinates);
    write("texels", "i32", stages.texels);
    write("view", "f32", stages.view);
    write("snapped", "i32", stages.snapped);
    write("piece_triangles", "i32", stages.pieceTriangles);
    write("piece_corners", "f64", stages.pieceCorners);
    write("piece_snapped", "i32", stages.pieceSnapped);
    faces.push_back(std::move(json));
  }
  raster::writeFile(folder / "stages.json",
                    Json{{"faces", faces}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace hemitex::reference
