#include "radiosity/textures/chart_borders.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "radiosity/geometry/mesh_edges.h"

namespace hemitex::radiosity {
namespace {

/// The distance from a border edge over which its correction fades out, in texels of the grid.
constexpr double fadeLength = 2;

/// The charts of each curved part that has several.
std::vector<std::vector<std::uint32_t>> chartsOfParts(const Scene& scene, const Discretization& discretization) {
  std::map<std::pair<std::string_view, std::uint32_t>, std::vector<std::uint32_t>> charts;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    if (const Surface& surface = scene.surfaces[s]; surface.curvedPart && isDiscretized(discretization.grids[s]))
      charts[{surface.family, *surface.curvedPart}].push_back(s);
  std::vector<std::vector<std::uint32_t>> parts;
  for (auto& [part, surfaces] : charts)
    if (surfaces.size() > 1) parts.push_back(std::move(surfaces));
  return parts;
}

/// A vertex of the mesh in a chart.
struct ChartVertex {
  std::uint32_t vertex = 0, surface = 0;
  glm::dvec2 place{0.0};  ///< in texels

  auto key() const { return std::tuple(vertex, surface, place.x, place.y); }
  bool operator<(const ChartVertex& other) const { return key() < other.key(); }
  bool operator==(const ChartVertex& other) const { return key() == other.key(); }
};

/// The mesh of a curved part, with the surface and the chart of each triangle.
struct PartMesh {
  std::vector<const Triangle*> triangles;
  std::vector<std::uint32_t> surfaces;
  MeshEdges edges;

  PartMesh(const Scene& scene, const std::vector<std::uint32_t>& charts) {
    std::vector<TrianglePositions> positions;
    for (const std::uint32_t s : charts) {
      for (const Triangle& triangle : scene.surfaces[s].triangles) {
        triangles.push_back(&triangle);
        surfaces.push_back(s);
        positions.push_back(triangle.position);
      }
    }
    edges = findEdges(positions);
  }

  ChartVertex vertexAt(std::uint32_t corner, const Discretization& discretization) const {
    const std::uint32_t surface = surfaces[corner / 3];
    const Grid& grid = discretization.grids[surface];
    return {edges.vertex[corner], surface,
            triangles[corner / 3]->chart[corner % 3] * glm::dvec2(grid.columns, grid.rows)};
  }
};

/// Both ends of each edge between two charts of a part, once in each chart. The ends are in the order of the vertices.
std::vector<std::array<ChartVertex, 2>> commonEdges(const PartMesh& mesh, const Discretization& discretization) {
  std::vector<std::array<ChartVertex, 2>> common;
  for (std::uint32_t e = 0; e < mesh.edges.count(); ++e) {
    const std::span<const std::uint32_t> around = mesh.edges.around(e);
    if (around.size() != 2 || mesh.surfaces[around[0] / 3] == mesh.surfaces[around[1] / 3]) continue;
    for (const std::uint32_t h : around)
      common.push_back({mesh.vertexAt(h, discretization), mesh.vertexAt(nextCorner(h), discretization)});
  }
  return common;
}

/// The corrections at common vertices, which are sorted and different.
std::vector<glm::dvec3> corrections(const std::vector<ChartVertex>& vertices, const Discretization& discretization,
                                    const std::vector<glm::dvec3>& radiosity, TextureFilter filter) {
  std::vector<glm::dvec3> result;
  for (const ChartVertex& vertex : vertices)
    result.push_back(filteredValue(discretization.grids[vertex.surface], radiosity, filter, vertex.place));
  for (std::size_t begin = 0, end = 0; begin < vertices.size(); begin = end) {
    glm::dvec3 sum(0);
    for (; end < vertices.size() && vertices[end].vertex == vertices[begin].vertex; ++end) sum += result[end];
    const glm::dvec3 mean = sum / static_cast<double>(end - begin);
    for (std::size_t i = begin; i < end; ++i) result[i] = mean - result[i];
  }
  return result;
}

/// The correction at the nearest point of border edges, and the square of its distance in texels.
struct Nearest {
  double square = fadeLength * fadeLength;
  glm::dvec3 correction{0.0};
};

void approach(const BorderEdge& edge, const glm::dvec2& place, Nearest& nearest) {
  const glm::dvec2 along = edge.ends[1] - edge.ends[0], from = place - edge.ends[0];
  const double length = glm::dot(along, along);
  const double share = length > 0 ? std::clamp(glm::dot(from, along) / length, 0.0, 1.0) : 0;
  const glm::dvec2 away = from - share * along;
  if (glm::dot(away, away) >= nearest.square) return;
  nearest = {glm::dot(away, away), (1 - share) * edge.correction[0] + share * edge.correction[1]};
}

}  // namespace

std::vector<std::vector<BorderEdge>> borderEdges(const Scene& scene, const Discretization& discretization,
                                                 const std::vector<glm::dvec3>& radiosity, TextureFilter filter) {
  std::vector<std::vector<BorderEdge>> result(scene.surfaces.size());
  if (!hasKernel(filter)) return result;
  for (const std::vector<std::uint32_t>& charts : chartsOfParts(scene, discretization)) {
    const auto common = commonEdges(PartMesh(scene, charts), discretization);
    std::vector<ChartVertex> vertices;
    for (const std::array<ChartVertex, 2>& ends : common) vertices.insert(vertices.end(), ends.begin(), ends.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const std::vector<glm::dvec3> atVertices = corrections(vertices, discretization, radiosity, filter);
    const auto correctionAt = [&](const ChartVertex& vertex) {
      return atVertices[static_cast<std::size_t>(std::lower_bound(vertices.begin(), vertices.end(), vertex) -
                                                 vertices.begin())];
    };
    for (const auto& [a, b] : common)
      result[a.surface].push_back({{a.place, b.place}, {correctionAt(a), correctionAt(b)}});
  }
  return result;
}

void correctBorders(const Grid& grid, const std::vector<glm::dvec3>& radiosity, TextureFilter filter, int magnification,
                    const std::vector<BorderEdge>& edges, std::vector<glm::dvec3>& texels) {
  if (edges.empty()) return;
  const int width = grid.columns * magnification, height = grid.rows * magnification;
  const auto placeOf = [&](int i, int j) { return (glm::dvec2(i, j) + 0.5) / static_cast<double>(magnification); };
  const auto indexOf = [&](double place, int size) {
    return static_cast<int>(std::clamp(place * magnification, 0.0, size - 1.0));
  };
  std::vector<Nearest> nearest(texels.size());
  for (const BorderEdge& edge : edges) {
    const glm::dvec2 low = glm::min(edge.ends[0], edge.ends[1]) - fadeLength,
                     high = glm::max(edge.ends[0], edge.ends[1]) + fadeLength;
    for (int j = indexOf(low.y, height); j <= indexOf(high.y, height); ++j)
      for (int i = indexOf(low.x, width); i <= indexOf(high.x, width); ++i)
        approach(edge, placeOf(i, j), nearest[static_cast<std::size_t>(j * width + i)]);
  }
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      const auto texel = static_cast<std::size_t>(j * width + i);
      const double fade = 1 - std::sqrt(nearest[texel].square) / fadeLength;
      if (!(fade > 0)) continue;
      const glm::dvec3 filtered = filteredValue(grid, radiosity, filter, placeOf(i, j));
      texels[texel] = glm::max(glm::dvec3(0), filtered + fade * fade * nearest[texel].correction);
    }
  }
}

}  // namespace hemitex::radiosity
