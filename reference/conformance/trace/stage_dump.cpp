#include "reference/conformance/trace/stage_dump.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "raster/base/file_io.h"
#include "raster/base/parallel.h"
#include "raster/plain/plain_renderer.h"
#include "reference/conformance/trace/fragments.h"
#include "reference/conformance/vectors/array_file.h"

namespace hemitex::reference {
namespace {

using Json = nlohmann::ordered_json;
using raster::ViewVertex;

// --- vertices and pieces ---

template <typename Vertices>
bool isCut(const raster::DrawList& list, const raster::Face& face, const Vertices& vertices) {
  const auto planes = raster::clipPlanes(list.clipDepth);
  return std::any_of(planes.begin(), planes.end(),
                     [&](raster::ClipPlane plane) { return raster::cuts(plane, vertices, face.nearDistance); });
}

glm::ivec2 onGrid(const raster::Face& face, const ViewVertex& vertex) {
  const raster::SnappedPoint snapped = raster::snap(face, vertex);
  return {snapped.x, snapped.y};
}

void addVertices(const raster::DrawList& list, const raster::Face& face, Stages& stages) {
  for (std::size_t v = 0; v < list.positions.size(); ++v) {
    const ViewVertex vertex = raster::viewedVertex(face, list, v);
    const bool isInside = raster::isFinite(vertex) && !isCut(list, face, std::array{vertex});
    stages.view.push_back({vertex.x, vertex.y, vertex.w});
    stages.snapped.push_back(isInside ? onGrid(face, vertex) : glm::ivec2(notSnapped));
  }
}

void addPieces(const raster::DrawList& list, const raster::Face& face, Stages& stages) {
  for (std::uint32_t t = 0; t < list.indices.size() / 3; ++t) {
    const std::array<ViewVertex, 3> corners = raster::view(face, list, t);
    if (!raster::areFinite(corners) || !isCut(list, face, corners)) continue;
    const raster::ClippedPolygon polygon = raster::clip(corners, face.nearDistance, list.clipDepth);
    for (std::size_t k = 2; k < polygon.count; ++k) {
      const auto& [a, b, c] = stages.pieceCorners.emplace_back(fanTriangle(polygon, k));
      stages.pieceTriangles.push_back(static_cast<std::int32_t>(t));
      stages.pieceSnapped.push_back({onGrid(face, a), onGrid(face, b), onGrid(face, c)});
    }
  }
}

// --- pixels ---

void addPixels(const raster::DrawList& list, const raster::Face& face, Stages& stages) {
  const std::vector<raster::SnappedTriangle> triangles = raster::snappedTriangles(list, face);
  const std::vector<raster::CoveredSample> visible = raster::visibleSamples(list, triangles, face.scissor);
  stages.triangles.resize(visible.size(), -1);
  stages.inverseDepths.resize(visible.size());
  stages.coordinates.resize(visible.size(), glm::dvec2(0.0));
  stages.texels.resize(visible.size(), glm::ivec2(-1));
  raster::parallelFor(visible.size(), [&](std::size_t pixel) {
    if (!visible[pixel].triangle) return;
    const Fragment fragment = fragmentOf(list, visible[pixel]);
    stages.triangles[pixel] = static_cast<std::int32_t>(fragment.triangle);
    stages.inverseDepths[pixel] = fragment.inverseDepth;
    stages.coordinates[pixel] = {fragment.u, fragment.v};
    if (fragment.texel) stages.texels[pixel] = {fragment.texel->column, fragment.texel->row};
  });
}

}  // namespace

Stages stagesOf(const raster::DrawList& list, const raster::Face& face) {
  Stages stages;
  addVertices(list, face, stages);
  addPieces(list, face, stages);
  addPixels(list, face, stages);
  return stages;
}

void writeStages(const std::filesystem::path& folder, const TestVector& vector) {
  Json faces = Json::array();
  for (std::size_t f = 0; f < vector.faces.size(); ++f) {
    const Stages stages = stagesOf(vector.list, vector.faces[f].face);
    Json json{{"name", vector.faces[f].name}};
    std::vector<std::array<double, 5>> corners;
    for (const std::array<ViewVertex, 3>& piece : stages.pieceCorners)
      for (const ViewVertex& corner : piece) corners.push_back({corner.x, corner.y, corner.w, corner.u, corner.v});
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
    write("piece_corners", "f64", corners);
    write("piece_snapped", "i32", stages.pieceSnapped);
    faces.push_back(std::move(json));
  }
  raster::writeFile(folder / "stages.json",
                    Json{{"faces", faces}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace hemitex::reference
