// The kernels for small triangles give the same results with each instruction set, bit for bit, and the same samples as
// screen triangles.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <tuple>

#include "raster/kernels/interpolation_bounds.h"
#include "raster/kernels/kernels.h"
#include "raster/setup/exact_interpolation.h"
#include "raster/software/cluster_setup.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::raster;

namespace {

/// In the last, triangles are about as large as small ones can be.
std::vector<Face> faces() {
  std::vector<Face> all{tests::frontFace(64), tests::frontFace(64), tests::frontFace(32), tests::frontFace(128),
                        tests::frontFace(512)};
  all[1].x = -all[1].x;
  all[1].scissor = {17, 9, 31, 40};
  all[4].scissor = {100, 100, 140, 90};
  return all;
}

/// A part of the mesh in the view of a face.
struct Seen {
  PlacedVertices placed;
  TriangleSets sets;

  Seen(const ClusterMesh& mesh, const ClusterPart& part, const Face& face)
      : sets(allKernels().back().place(mesh, part, face, placed)) {}
};

/// Results of setup, with floating-point numbers as bits. Triangles that are not drawn have no planes.
std::vector<std::uint64_t> valuesOf(const SmallSetup& setup) {
  std::vector<std::uint64_t> values{setup.count, setup.uniform, setup.negative, setup.thin};
  const auto add = [&values](double value) { values.push_back(std::bit_cast<std::uint64_t>(value)); };
  for (std::uint32_t k = 0; k < setup.count; ++k) {
    for (const int value :
         {setup.triangles[k], setup.firstColumn[k], setup.columns[k], setup.firstRow[k], setup.rows[k], setup.texel[k]})
      values.push_back(static_cast<std::uint64_t>(value));
    add(setup.clear[k]);
    if (setup.rows[k] == 0) continue;
    for (const SmallPlanes* planes :
         {&setup.edges[0], &setup.edges[1], &setup.edges[2], &setup.inverseDepth, &setup.column, &setup.row})
      for (const double value : {planes->at[k], planes->right[k], planes->down[k]}) add(value);
  }
  return values;
}

/// An index map, and whether its texels equal their numbers.
struct Map {
  int columns, rows;
  bool isCounting;
};

/// Item IDs: those of untextured entries tell their number.
SmallIds idsOf(const SmallSetup& setup, const Map& map, const std::vector<ItemId>& texels) {
  SmallIds ids;
  ids.textured = ~setup.uniform;
  ids.columns = map.columns;
  ids.rows = map.rows;
  if (!map.isCounting) ids.map = texels.data();
  for (std::uint32_t k = 0; k < setup.count; ++k) ids.ids[k] = 1000 * k;
  return ids;
}

/// All triangles of a mesh, drawn into one face.
struct DrawnSmall {
  std::vector<std::vector<std::uint64_t>> setups;
  DepthBuffer buffer;
  std::vector<std::tuple<std::uint32_t, int, int>> unresolved;
};

DrawnSmall drawAll(const Kernels& kernels, const ClusterMesh& mesh, const Face& face, const Map& map) {
  std::vector<ItemId> texels;
  for (int i = 0; i < map.columns * map.rows; ++i) texels.push_back(static_cast<ItemId>(7 * i + 3));
  DrawnSmall drawn;
  drawn.buffer.clear(face.scissor);
  for (const ClusterPart& part : mesh.parts) {
    const Seen seen(mesh, part, face);
    SmallSetup setup;
    kernels.setUpSmall({mesh, part, seen.placed, seen.sets.small, seen.sets.tiny, map.columns, map.rows}, face.scissor,
                       setup);
    drawn.setups.push_back(valuesOf(setup));
    UnresolvedSamples unresolved;
    kernels.drawSmall(setup, idsOf(setup, map, texels), firstSmall + part.firstTriangle, drawn.buffer, unresolved);
    for (const auto& [k, pixel] : unresolved.samples) {
      drawn.unresolved.emplace_back(part.firstTriangle + k, pixel.row, pixel.column);
      drawn.buffer.id[drawn.buffer.pixelAt(pixel.column, pixel.row)] = 0;  // it is unspecified
    }
  }
  std::sort(drawn.unresolved.begin(), drawn.unresolved.end());
  return drawn;
}

/// The pixels of a buffer that show a triangle: row, column, bits of 1/w, triangle, item ID.
std::vector<std::tuple<int, int, std::uint64_t, std::uint32_t, ItemId>> shownBy(const DepthBuffer& buffer) {
  std::vector<std::tuple<int, int, std::uint64_t, std::uint32_t, ItemId>> shown;
  const Scissor& part = buffer.scissor;
  for (int row = part.row; row < part.row + part.height; ++row)
    for (int column = part.column; column < part.column + part.width; ++column) {
      const std::size_t p = buffer.pixelAt(column, row);
      if (buffer.triangle[p] != noTriangle)
        shown.emplace_back(row, column, std::bit_cast<std::uint64_t>(buffer.inverseDepth[p]), buffer.triangle[p],
                           buffer.id[p]);
    }
  return shown;
}

/// The covered samples of a screen triangle: rows and columns.
std::vector<std::pair<int, int>> coveredBy(const ScreenTriangle& triangle) {
  std::vector<std::pair<int, int>> covered;
  for (int row = triangle.firstRow; row < triangle.endRow; ++row)
    for (int column = triangle.firstColumn; column < triangle.endColumn; ++column) {
      const EdgeValues edge = edgeValues(triangle, column, row), least = minCovered(triangle);
      if (edge[0] >= least[0] && edge[1] >= least[1] && edge[2] >= least[2]) covered.emplace_back(row, column);
    }
  return covered;
}

/// In squared sub-pixels.
std::int64_t areaOfBounds(const ScreenTriangle& triangle) {
  std::int64_t width = 0, height = 0;
  for (const Edge& edge : triangle.edges) {
    width = std::max(width, std::abs(edge.b) / 256);
    height = std::max(height, std::abs(edge.a) / 256);
  }
  return width * height;
}

/// One draw of triangles at w = 1 in a front face of 64 x 64, with corners in pixels.
DrawList triangles(const std::vector<std::array<glm::vec2, 3>>& corners) {
  DrawList list;
  list.format = {{8, 8, 8}};
  tests::addDraw(list, 1, std::nullopt, std::nullopt);
  const auto point = [](const glm::vec2& at) { return glm::vec3(at / 32.0F - 1.0F, 1); };
  for (const auto& [a, b, c] : corners) tests::addTriangle(list, {point(a), point(b), point(c)});
  return list;
}

SmallSetup setUpAll(const DrawList& list) {
  const ClusterMesh mesh = meshOf(list, clustersOf(list));
  REQUIRE(mesh.parts.size() == 1);
  const Face face = tests::frontFace(64);
  const Seen seen(mesh, mesh.parts[0], face);
  REQUIRE(std::popcount(seen.sets.small) == static_cast<int>(list.indices.size() / 3));
  SmallSetup setup;
  allKernels().back().setUpSmall({mesh, mesh.parts[0], seen.placed, seen.sets.small, seen.sets.tiny}, face.scissor,
                                 setup);
  return setup;
}

}  // namespace

TEST_CASE("Kernels::setUpSmall and drawSmall give the same results with each instruction set", "[small_triangles]") {
  const DrawList list = tests::smallTriangles(600);
  const ClusterMesh mesh = meshOf(list, clustersOf(list));
  std::size_t samples = 0, unresolved = 0;
  for (const Face& face : faces())
    for (const Map& map : {Map{8, 5, true}, Map{8, 5, false}, Map{1, 1, true}}) {
      const DrawnSmall plain = drawAll(allKernels().back(), mesh, face, map);
      samples += shownBy(plain.buffer).size();
      unresolved += plain.unresolved.size();
      for (const Kernels& kernels : allKernels()) {
        INFO(kernels.instructionSet);
        const DrawnSmall drawn = drawAll(kernels, mesh, face, map);
        CHECK(drawn.setups == plain.setups);
        CHECK(shownBy(drawn.buffer) == shownBy(plain.buffer));
        CHECK(drawn.unresolved == plain.unresolved);
      }
    }
  CHECK(samples > 50000);
  CHECK(unresolved > 100);
}

TEST_CASE("Kernels::drawSmall shows the samples and texels of the screen triangle", "[small_triangles]") {
  const DrawList list = tests::smallTriangles(600);
  const std::vector<Cluster> clusters = clustersOf(list);
  const ClusterMesh mesh = meshOf(list, clusters);
  const Kernels& kernels = allKernels().back();
  int empty = 0, thin = 0, decided = 0, unresolved = 0, uniform = 0;
  DepthBuffer buffer;
  /// Draws a triangle alone and compares what it shows.
  const auto check = [&](const SmallTriangles& one, const Face& face, const ScreenTriangle& triangle, bool isEmpty) {
    SmallSetup setup;
    kernels.setUpSmall(one, face.scissor, setup);
    UnresolvedSamples open;
    if (setup.thin != 0) {
      // The three |e| below are at most 4 times the area of the bounds each, and one w at most 3 times another.
      if (!isEmpty) CHECK(triangle.area * 512 <= 3 * 3 * 4 * areaOfBounds(triangle));
      return void(++thin);
    }
    buffer.clear(face.scissor);
    kernels.drawSmall(setup, idsOf(setup, {one.columns, one.rows, true}, {}), firstSmall, buffer, open);
    const auto shown = shownBy(buffer);
    const auto expected = isEmpty ? std::vector<std::pair<int, int>>() : coveredBy(triangle);
    REQUIRE(shown.size() == expected.size());
    if (expected.empty()) return void(++empty);
    CHECK((setup.negative == 1) == (triangle.facesAway == (determinant(face) < 0)));
    unresolved += static_cast<int>(open.samples.size());
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const auto [row, column, bits, number, id] = shown[i];
      CHECK(std::pair(row, column) == expected[i]);
      const double inverseDepth = inverseDepthAt(triangle, edgeValues(triangle, column, row));
      CHECK(std::abs(std::bit_cast<double>(bits) - inverseDepth) <= 2 * depthError * inverseDepth);
      const auto isHere = [r = row, c = column](const SmallSample& s) {
        return s.pixel.row == r && s.pixel.column == c;
      };
      if (std::any_of(open.samples.begin(), open.samples.end(), isHere)) continue;
      const int texel = texelExactly(triangle, triangle.v, one.rows, column, row) * one.columns +
                        texelExactly(triangle, triangle.u, one.columns, column, row);
      CHECK((setup.uniform == 1 ? setup.texel[0] : static_cast<int>(id)) == texel);
      setup.uniform == 1 ? ++uniform : ++decided;
    }
  };
  for (const Face& face : faces())
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      const ClusterPart& part = mesh.parts[c];
      const Seen seen(mesh, part, face);
      for (std::uint32_t t = 0; t < part.triangles; ++t) {
        const std::uint32_t bit = 1U << t;
        if ((seen.sets.small & bit) == 0) continue;
        ScreenTriangle triangle;
        const bool isEmpty = !makeScreenTriangle(list, mesh, clusters[c], part, t, seen.placed, face.scissor,
                                                 determinant(face) < 0, triangle);
        for (const int columns : {7, 1})
          check({mesh, part, seen.placed, bit, seen.sets.tiny & bit, columns, 5}, face, triangle, isEmpty);
      }
    }
  CHECK(empty > 1000);
  CHECK(thin > 100);
  CHECK(decided > 5000);
  CHECK(unresolved > 100);
  CHECK(uniform > 1000);
}

TEST_CASE("Kernels::setUpSmall keeps one of the four smallest triangles around a sample", "[small_triangles]") {
  // Half a square of 1/256 pixel in each quadrant of the sample of column 10 and row 12.
  constexpr float step = 1 / 256.0F;
  const glm::vec2 sample(10.5F, 12.5F);
  const std::array<glm::vec2, 4> sides{{{step, 0}, {0, step}, {-step, 0}, {0, -step}}};
  std::vector<std::array<glm::vec2, 3>> corners;
  for (std::size_t k = 0; k < 4; ++k) corners.push_back({sample, sample + sides[k], sample + sides[(k + 1) % 4]});
  const SmallSetup setup = setUpAll(triangles(corners));
  REQUIRE(setup.count == 1);
  CHECK(setup.firstColumn[0] == 10);
  CHECK(setup.firstRow[0] == 12);
  CHECK(setup.columns[0] == 1);
  CHECK(setup.rows[0] == 1);
}

TEST_CASE("Kernels::setUpSmall leaves out triangles whose 1/w is not accurate enough", "[small_triangles]") {
  // With edges e and the area A, both in squared sub-pixels, the bound of the relative error of 1/w at w = 1 is 2^-49
  // times the sum of |e| / A. In a sliver along a diagonal of d pixels, two corners lie at most d pixels from the first
  // sample, so each |e| is below 4 * (256 d)^2. With d = 30 and A = 256, the sum may reach 2^22. The bound has to be
  // below 2^-40, so the sum below 2^9: a triangle of half the square of its bounds has a sum of about 10.
  const SmallSetup setup = setUpAll(triangles(
      {{{{2, 2}, {32, 32}, {32 + 1 / 256.0F, 32}}}, {{{2, 2}, {32, 32}, {32, 2}}}, {{{2, 2}, {12, 12}, {22, 22}}}}));
  REQUIRE(setup.count == 3);
  CHECK(setup.thin == 0b001);
  CHECK(setup.rows[0] == 0);
  CHECK(setup.rows[1] == 30);
  CHECK(setup.rows[2] == 0);  // it has no area
}
