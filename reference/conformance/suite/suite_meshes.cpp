/// Unclipped meshes whose triangles share edges: each sample inside belongs to exactly one triangle.
///
/// Each triangle has its own item ID and its own depth, so that both faults are visible. A hole shows the background. A
/// sample that two triangles cover shows the nearer one. Later triangles are nearer in one vector and earlier ones in
/// the other, so the wrong triangle is the nearer one in one of them.
#include <algorithm>
#include <random>

#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/draw_list_builder.h"

namespace hemitex::reference {
namespace {

using Corners = std::array<glm::dvec2, 3>;

/// A picture of triangles, in pixels.
using Mesh = std::vector<Corners>;

/// One of the six orders of a triangle's corners: three rotations in each winding.
Corners inOrder(Corners corners, std::size_t order) {
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(order % 3), corners.end());
  if (order / 3 % 2 == 1) std::swap(corners[0], corners[1]);
  return corners;
}

/// Adds the mesh with later triangles nearer, and with earlier ones nearer. Draw t has triangle t alone and the item ID
/// t.
void addBothOrders(std::vector<TestVector>& vectors, const std::string& name, const std::string& catches,
                   int resolution, const Mesh& mesh) {
  for (const bool laterIsNearer : {true, false}) {
    Picture picture(resolution);
    for (std::size_t t = 0; t < mesh.size(); ++t) {
      const std::size_t rank = laterIsNearer ? mesh.size() - 1 - t : t;
      const double w = 1 + static_cast<double>(rank) / 4096;
      addDraw(picture, static_cast<raster::ItemId>(t));
      addTriangle(picture, {picture.point(mesh[t][0], w), picture.point(mesh[t][1], w), picture.point(mesh[t][2], w)});
    }
    vectors.push_back(makeVector(name + (laterIsNearer ? "-later-nearer" : "-earlier-nearer"), catches, picture));
  }
}

/// The triangles from a hub to the sides of a polygon around it.
void addFan(Mesh& mesh, const glm::dvec2& hub, const std::vector<glm::dvec2>& rim, std::size_t order) {
  for (std::size_t k = 0; k < rim.size(); ++k)
    mesh.push_back(inOrder({hub, hub + rim[k], hub + rim[(k + 1) % rim.size()]}, order));
}

glm::dvec2 turned(const glm::dvec2& v) { return {-v.y, v.x}; }

/// Around the sample of each of 16 x 16 pixels a fan of eight triangles smaller than the pixel. Every fourth fan has
/// its spokes along the axes and diagonals.
Mesh centreFans() {
  std::mt19937 random(8);
  Mesh mesh;
  for (std::size_t pixel = 0; pixel < 256; ++pixel) {
    const glm::dvec2 hub(static_cast<double>(pixel % 16) + 0.5, static_cast<double>(pixel / 16) + 0.5);
    const bool isRegular = pixel % 4 == 0;
    const int x = isRegular ? 96 : 64 + static_cast<int>(random() % 40);
    const int y = isRegular ? 0 : static_cast<int>(random() % 40);
    glm::dvec2 spoke(x * subPixel, y * subPixel), between((x - y) / 2 * subPixel, (x + y) / 2 * subPixel);
    std::vector<glm::dvec2> rim;
    for (int quarter = 0; quarter < 4; ++quarter) {
      rim.insert(rim.end(), {spoke, between});
      spoke = turned(spoke);
      between = turned(between);
    }
    addFan(mesh, hub, rim, pixel);
  }
  return mesh;
}

/// Fans of sixteen triangles, 14 pixels across, in every order of corners. Spokes have slopes 0, 1/2, 1, 2 and
/// infinity, so that they pass through samples, but for the last row of fans, which lies between them.
Mesh fans() {
  Mesh mesh;
  std::vector<glm::dvec2> rim;
  for (const glm::dvec2& corner : {glm::dvec2(7, -7), glm::dvec2(7, 7), glm::dvec2(-7, 7), glm::dvec2(-7, -7)})
    for (int k = 0; k < 4; ++k) rim.push_back(corner + 0.25 * k * (turned(corner) - corner));
  for (std::size_t fan = 0; fan < 9; ++fan) {
    const glm::dvec2 hub(8.5 + 15.0 * static_cast<double>(fan % 3), 8.5 + 15.0 * static_cast<double>(fan / 3));
    addFan(mesh, fan < 6 ? hub : hub + glm::dvec2(37 * subPixel, -91 * subPixel), rim, fan);
  }
  return mesh;
}

/// cells x cells cells with sides `right` and `down`, two triangles each, cut along either diagonal in turn.
void addGrid(Mesh& mesh, const glm::dvec2& corner, const glm::dvec2& right, const glm::dvec2& down, int cells,
             std::size_t order) {
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const glm::dvec2 a = corner + double(i) * right + double(j) * down, b = a + right, c = b + down, d = a + down;
      const bool isCutFromA = (i + j) % 2 == 0;
      mesh.push_back(inOrder(isCutFromA ? Corners{a, b, c} : Corners{b, c, d}, order));
      mesh.push_back(inOrder(isCutFromA ? Corners{a, c, d} : Corners{b, d, a}, order));
    }
}

/// Grids turned by the angle of the triangle 3, 4, 5, so that their corners lie on sub-pixels, in every order of
/// corners; the first six have their corners on samples.
Mesh rotatedGrids() {
  Mesh mesh;
  for (std::size_t grid = 0; grid < 9; ++grid) {
    const glm::dvec2 place(21.0 * static_cast<double>(grid % 3), 21.0 * static_cast<double>(grid / 3));
    const glm::dvec2 nudge = grid < 6 ? glm::dvec2(0) : glm::dvec2(37 * subPixel, 91 * subPixel);
    addGrid(mesh, place + glm::dvec2(9.5, 0.5) + nudge, {4, 3}, {-3, 4}, 3, grid);
  }
  return mesh;
}

/// One grid over the whole view whose lines and diagonals pass through samples, and triangles in all orders.
Mesh sampleGrid() {
  Mesh mesh;
  for (int j = -1; j < 8; ++j)
    for (int i = -1; i < 8; ++i)
      addGrid(mesh, {2 * i + 0.5, 2 * j + 0.5}, {2, 0}, {0, 2}, 1, static_cast<std::size_t>(i + 2 * j + 3));
  return mesh;
}

/// Jittered cells of half a pixel: most triangles cover nothing, and together they cover every sample once.
Mesh microGrid() {
  constexpr int cells = 32;
  std::mt19937 random(32);
  Mesh mesh;
  const auto point = [&](int i, int j) {
    const auto jitter = [&] { return (static_cast<double>(random() % 49) - 24) * subPixel; };
    const double x = jitter(), y = jitter();
    return glm::dvec2(0.5 * i + (i % cells == 0 ? 0 : x), 0.5 * j + (j % cells == 0 ? 0 : y));
  };
  forEachCell(cells, point, [&](const std::array<glm::dvec2, 4>& p, int, int) {
    mesh.push_back(inOrder({p[0], p[1], p[3]}, mesh.size()));
    mesh.push_back(inOrder({p[2], p[3], p[1]}, mesh.size()));
  });
  return mesh;
}

/// Four strips over the view. Triangle t of a strip has the vertices t, t + 1 and t + 2 and its own draw. So three
/// draws share a vertex, and each vertex is the first, the second and the last of at most one triangle.
TestVector strips() {
  Picture picture(32);
  for (int strip = 0; strip < 4; ++strip) {
    const auto firstVertex = static_cast<std::uint32_t>(picture.positions.size());
    for (int t = 0; t <= 16; ++t) picture.positions.push_back(picture.point({2 * t, 8 * strip + (t % 2 == 0 ? 0 : 8)}));
    for (std::uint32_t t = 0; t < 15; ++t) {
      addDraw(picture, static_cast<raster::ItemId>(picture.draws.size() + 1) * 0x107);
      for (std::uint32_t k = 0; k < 3; ++k) picture.indices.push_back(firstVertex + t + k);
      picture.draws.back().count = 3;
    }
  }
  picture.texcoords.resize(picture.positions.size());
  return makeVector("shared-vertices", "colour from the wrong provoking vertex, vertices that belong to one draw alone",
                    picture);
}

/// A board of quads whose vertices are the last ones of more than 65,536; those of the last quad lie on either side of
/// 65,536. Cut to 16 bits or to 8, an index names one of the first vertices. They hold the board moved by one cell and
/// nearer, and no index names them. The vertices between are not used either.
TestVector manyVertices() {
  constexpr int resolution = 32, side = 8, cell = resolution / side;
  constexpr std::uint32_t quads = side * side, overflow = 65536;
  Picture picture(resolution);
  picture.positions.resize(overflow + 4 * quads - 2);
  picture.texcoords.resize(picture.positions.size());
  const auto corner = [&](std::uint32_t quad, std::uint32_t k, double w) {
    const auto place = static_cast<int>(quad % quads);
    const glm::dvec2 first(place % side * cell, place / side * cell);
    return picture.point(first + glm::dvec2(k == 1 || k == 2 ? cell : 0, k > 1 ? cell : 0), w);
  };
  for (std::uint32_t quad = 0; quad < quads; ++quad) {
    const std::uint32_t first = quad + 1 == quads ? overflow - 2 : overflow + 2 + 4 * quad;
    for (std::uint32_t k = 0; k < 4; ++k) {
      picture.positions[first + k] = corner(quad, k, 1);
      if (first + k >= overflow) picture.positions[first + k - overflow] = corner(quad + 1, k, 0.75);
    }
    addDraw(picture, quad);
    for (const std::uint32_t k : {0u, 2u, 1u, 0u, 3u, 2u}) picture.indices.push_back(first + k);
    picture.draws.back().count = 6;
  }
  return makeVector("many-vertices", "indices cut to 16 bits or to 8: there are more than 65,536 vertices", picture);
}

}  // namespace

std::vector<TestVector> meshVectors() {
  std::vector<TestVector> vectors;
  addBothOrders(vectors, "centre-fans",
                "a sample on the hub of eight sub-pixel triangles drawn twice or not at all: a wrong fill rule", 16,
                centreFans());
  addBothOrders(vectors, "fans", "a fill rule that depends on the winding or on which corner comes first", 48, fans());
  addBothOrders(vectors, "rotated-grids", "holes and double hits along slanted shared edges through samples", 64,
                rotatedGrids());
  addBothOrders(vectors, "sample-grid", "the wrong side of horizontal, vertical and diagonal edges through samples", 16,
                sampleGrid());
  addBothOrders(vectors, "micro-grid", "triangles smaller than a pixel lost, grown or drawn twice", 16, microGrid());
  vectors.push_back(strips());
  vectors.push_back(manyVertices());
  return vectors;
}

}  // namespace hemitex::reference
