// The random families contain the cases that they are named for, in sufficient numbers.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "raster/setup/exact_interpolation.h"
#include "raster/setup/triangle_setup.h"
#include "reference/conformance/vectors/random_vectors.h"

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

void countSamples(const std::vector<ScreenTriangle>& triangles, const raster::IndexMap& map, int resolution,
                  Counts& counts) {
  for (int row = 0; row < resolution; ++row)
    for (int column = 0; column < resolution; ++column) {
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

/// For families of one face and one triangle per draw.
void count(const raster::DrawList& list, const raster::Face& face, Counts& counts) {
  std::vector<ScreenTriangle> triangles;
  for (std::uint32_t d = 0; d < list.draws.size(); ++d) {
    const std::uint32_t t = list.draws[d].first / 3;
    const raster::TriangleRun run{d, t, t + 1};
    raster::appendScreenTriangles(list, face, {&run, 1}, {}, triangles);
    std::array<ViewVertex, 3> corners;
    std::array<glm::dvec3, 3> positions;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t index = list.indices[3 * t + k];
      positions[k] = list.positions[index];
      corners[k] = raster::view(face, list.positions[index], list.texcoords[index]);
    }
    countCorners(corners, face, counts);
    counts["slimmer than 2e-7"] += slimness(positions) < 2e-7;
    counts["a million from zero"] += glm::length(positions[0]) > 1e6;
  }
  countSamples(triangles, list.indexMaps[0], face.resolution, counts);
}

}  // namespace

TEST_CASE("randomFamilies contain the cases that they are named for", "[rational]") {
  struct Meeting {
    std::string family, what;
    int min;
  };
  const std::vector<Meeting> meetings{
      {"generic", "samples in triangles", 10000},
      {"slivers", "slimmer than 2e-7", 100},
      {"sample-ties", "samples on edges", 100},
      {"sample-ties", "samples on corners", 100},
      {"sample-ties", "coordinates on half sub-pixels", 100},
      {"texel-borders", "samples on texel borders", 1000},
      {"near-plane", "cut by the near plane", 100},
      {"near-plane", "corners on the near plane", 10},
      {"guard-band", "cut by the guard band", 100},
      {"guard-band", "corners on the guard band", 10},
      {"depth-ratios", "depth ratios of a million", 100},
      {"depth-ties", "samples at equal depths", 1000},
      {"far-from-zero", "a million from zero", 100},
  };
  for (const reference::RandomFamily& family : reference::randomFamilies()) {
    Counts counts;
    for (std::uint64_t seed = 0; seed < 560; ++seed) {
      const reference::TestVector vector = reference::randomVector(seed, family.name);
      count(vector.list, vector.faces[0].face, counts);
    }
    std::string all;
    for (const auto& [what, number] : counts) all += what + ": " + std::to_string(number) + "\n";
    INFO(family.name << "\n" << all);
    for (const Meeting& meeting : meetings)
      if (meeting.family == family.name) CHECK(counts[meeting.what] >= meeting.min);
  }
}

TEST_CASE("randomFamilies have unique names, at most ten triangles per drawing, and small faces", "[random]") {
  std::set<std::string> names;
  std::vector<reference::RandomFamily> families = reference::randomFamilies();
  families.insert(families.end(), reference::newRandomFamilies().begin(), reference::newRandomFamilies().end());
  for (const reference::RandomFamily& family : families) {
    INFO(family.name);
    CHECK(names.insert(family.name).second);
    CHECK_FALSE(std::string(family.catches).empty());
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
      reference::Random random(seed);
      const reference::Drawing drawing = family.make(random);
      validate(drawing.list);
      CHECK(drawing.list.indices.size() <= 30);
      CHECK(drawing.faces.size() <= 3);
      for (const raster::Face& face : drawing.faces) {
        validate(face);
        CHECK(face.resolution == 16);
      }
    }
  }
}

TEST_CASE("newRandomFamilies show what they are named for in most vectors", "[random]") {
  constexpr int count = 300;
  const auto differing = [](const std::string& family, const std::function<void(reference::TestVector&)>& change) {
    int changed = 0;
    for (std::uint64_t seed = 0; seed < count; ++seed) {
      reference::TestVector vector = reference::randomVector(seed, family);
      const std::string hash = reference::idsHash(reference::render(vector));
      change(vector);
      changed += reference::idsHash(reference::render(vector)) != hash;
    }
    return changed;
  };
  const auto fill = [](reference::TestVector& vector) {
    for (raster::IndexMap& map : vector.list.indexMaps)
      std::replace(map.ids.begin(), map.ids.end(), raster::holeTexel, 0U);
  };
  const auto drawAll = [](reference::TestVector& vector) {
    for (raster::Draw& draw : vector.list.draws) draw.cull = raster::Cull::None;
  };
  CHECK(differing("holes", fill) > count / 2);
  CHECK(differing("holes", drawAll) == 0);
  CHECK(differing("culled-sides", drawAll) > count / 2);
  CHECK(differing("culled-sides", fill) == 0);
  CHECK(differing("two-sided", fill) > count / 2);
  CHECK(differing("two-sided", drawAll) > count / 2);
  CHECK(differing("triangle-numbers",
                  [](reference::TestVector& vector) { vector.list.value = raster::PixelValue::ItemIds; }) > count / 2);
  CHECK(differing("depth-tests", [](reference::TestVector& vector) {
          vector.list.depthTest = raster::DepthTest::Nearer;
        }) > count / 2);
  CHECK(differing("viewports", [](reference::TestVector& vector) {
          for (reference::VectorFace& face : vector.faces)
            face.face.sample = face.face.sample == raster::SamplePlace::Middle ? raster::SamplePlace::Corner
                                                                               : raster::SamplePlace::Middle;
        }) > count / 2);
}

TEST_CASE("Random gives the pinned numbers within their intervals", "[random]") {
  reference::Random random(5489);
  // The standard defines the 10,000th number of this seed: 9981545732273789042.
  for (int k = 1; k < 10000; ++k) random.bits();
  CHECK(random.bits() == 9981545732273789042u >> 32);
  for (int k = 0; k < 10000; ++k) {
    const float x = random.uniform(-1, 3);
    CHECK((x >= -1 && x < 3));
    const int n = random.between(-2, 5);
    CHECK((n >= -2 && n <= 5));
    CHECK(random.below(7) < 7);
  }
}
