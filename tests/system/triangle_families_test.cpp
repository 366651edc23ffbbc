// The triangle families contain the cases that they are named for, in sufficient numbers.
#include "tests/support/triangle_families.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "raster/setup/exact_interpolation.h"
#include "raster/setup/triangle_setup.h"
#include "raster/setup/vertex_stage.h"

using namespace hemitex;
using raster::ScreenTriangle;
using raster::ViewVertex;

namespace {

using Counts = std::map<std::string, int>;

/// Counts the properties of the three corners of a triangle before clipping.
void countCorners(const std::array<ViewVertex, 3>& corners, const raster::Face& face, Counts& counts) {
  const auto [nearest, farthest] = std::minmax({corners[0].w, corners[1].w, corners[2].w});
  const double nearDistance = face.nearDistance;
  counts["cut by the near plane"] += nearest < nearDistance && farthest > nearDistance;
  counts["corners on the near plane"] += nearest == nearDistance && farthest > nearDistance;
  if (nearest < nearDistance) return;
  counts["depth ratios of a million"] += farthest / nearest > 0.99e6;
  bool isCut = false, isOnBand = false;
  for (const ViewVertex& corner : corners) {
    isCut |= std::max(std::abs(corner.x), std::abs(corner.y)) > 8 * corner.w;
    isOnBand |= std::abs(corner.x) == 8 * corner.w;
    for (const double q : {corner.x / corner.w, corner.y / corner.w}) {
      const double position = (q + 1) * 128 * face.resolution;
      counts["coordinates on half sub-pixels"] += std::abs(q) < 8 && position - std::floor(position) == 0.5;
    }
  }
  counts["cut by the guard band"] += isCut;
  counts["corners on the guard band"] += isOnBand;
}

/// The height of a triangle over its longest side.
double slimness(const std::array<glm::dvec3, 3>& p) {
  const double area = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
  const double longest = std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
  return area / (longest * longest);
}

/// Whether the sample lies in the triangle or on its boundary, and on how many edges.
bool isInside(const ScreenTriangle& triangle, int column, int row, int& edges) {
  edges = 0;
  for (const raster::Edge& edge : triangle.edges) {
    if (edge.at(column, row) < 0) return false;
    edges += edge.at(column, row) == 0;
  }
  return true;
}

/// A coordinate of k / size at the sample, 0 < k < size: rounded down, it and its distance from 1 sum to the size.
bool isOnBorder(const ScreenTriangle& triangle, const std::array<double, 3>& coordinate, int size, int column,
                int row) {
  const std::array<double, 3> reversed{1 - coordinate[0], 1 - coordinate[1], 1 - coordinate[2]};
  return raster::texelExactly(triangle, coordinate, size, column, row) +
             raster::texelExactly(triangle, reversed, size, column, row) ==
         size;
}

void countSamples(const std::vector<ScreenTriangle>& triangles, const tests::DrawnCase& drawn, Counts& counts) {
  const raster::IndexMap& map = drawn.list.indexMaps[0];
  for (int row = 0; row < drawn.face.resolution; ++row)
    for (int column = 0; column < drawn.face.resolution; ++column) {
      const ScreenTriangle* last = nullptr;
      for (const ScreenTriangle& triangle : triangles) {
        int edges = 0;
        if (!isInside(triangle, column, row, edges)) continue;
        ++counts["samples in triangles"];
        counts["samples on edges"] += edges == 1;
        counts["samples on corners"] += edges == 2;
        counts["samples on texel borders"] += isOnBorder(triangle, triangle.u, map.width, column, row) ||
                                              isOnBorder(triangle, triangle.v, map.height, column, row);
        if (last)
          counts["samples at equal depths"] += !raster::isNearerExactly(triangle, *last, column, row) &&
                                               !raster::isNearerExactly(*last, triangle, column, row);
        last = &triangle;
      }
    }
}

void count(const tests::DrawnCase& drawn, Counts& counts) {
  std::vector<ScreenTriangle> triangles;
  for (std::uint32_t d = 0; d < drawn.list.draws.size(); ++d) {
    const std::uint32_t t = drawn.list.draws[d].first / 3;
    const raster::TriangleRun run{d, t, t + 1};
    raster::appendScreenTriangles(drawn.list, drawn.face, {&run, 1}, {}, triangles);
    std::array<ViewVertex, 3> corners;
    std::array<glm::dvec3, 3> positions;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t index = drawn.list.indices[3 * t + k];
      positions[k] = drawn.list.positions[index];
      corners[k] = raster::transform(drawn.face, drawn.list.positions[index], drawn.list.texcoords[index]);
    }
    countCorners(corners, drawn.face, counts);
    counts["slimmer than 2e-7"] += slimness(positions) < 2e-7;
    counts["a million from zero"] += glm::length(positions[0]) > 1e6;
  }
  countSamples(triangles, drawn, counts);
}

}  // namespace

TEST_CASE("triangleFamilies contain the cases that they are named for", "[rational]") {
  struct Meeting {
    std::string family, what;
    int least;
  };
  const std::vector<Meeting> meetings{
      {"generic", "samples in triangles", 10000},
      {"sliver", "slimmer than 2e-7", 100},
      {"corners and edges on samples", "samples on edges", 100},
      {"corners and edges on samples", "samples on corners", 100},
      {"corners and edges on samples", "coordinates on half sub-pixels", 100},
      {"texel borders on samples", "samples on texel borders", 1000},
      {"near plane", "cut by the near plane", 100},
      {"near plane", "corners on the near plane", 10},
      {"guard band", "cut by the guard band", 100},
      {"guard band", "corners on the guard band", 10},
      {"depth ratios of a million", "depth ratios of a million", 100},
      {"coplanar overlaps", "samples at equal depths", 1000},
      {"a million units from zero", "a million from zero", 100},
  };
  for (const tests::TriangleFamily& family : tests::triangleFamilies()) {
    std::mt19937 random(2002);
    Counts counts;
    for (int triangles = 0; triangles < 2240; triangles += family.trianglesPerCase) count(family.make(random), counts);
    std::string all;
    for (const auto& [what, number] : counts) all += what + ": " + std::to_string(number) + "\n";
    INFO(family.name << "\n" << all);
    for (const Meeting& meeting : meetings)
      if (meeting.family == family.name) CHECK(counts[meeting.what] >= meeting.least);
  }
}
