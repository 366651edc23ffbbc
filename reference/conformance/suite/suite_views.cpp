/// Faces: the five of a hemicube, mirrored ones, scissor rectangles, and the smallest and largest viewports.
#include <random>

#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/draw_list_builder.h"

namespace hemitex::reference {
namespace {

using raster::Face;
using raster::Scissor;

/// A room around the origin without symmetries: each wall has its own item ID, distance and size, an index map of 5 x 3
/// texels, and a gap to its neighbours that shows the background.
raster::DrawList asymmetricRoom() {
  raster::DrawList list = plainList();
  list.indexMaps.push_back(countingMap(5, 3));
  const auto addWall = [&](const std::array<glm::vec3, 4>& corners) {
    addDraw(list, static_cast<raster::ItemId>(list.draws.size() + 1) << 8, raster::backId(list.format), 0);
    addQuad(list, corners);
  };
  // Ceiling; walls at +x, +y, -x, -y; a board that hides a part of the ceiling, its back to the eye.
  addWall({glm::vec3(-2, -1.5f, 2.5f), glm::vec3(1.5f, -2, 2.5f), glm::vec3(1, 1.5f, 2.5f), glm::vec3(-2, 2, 2)});
  addWall({glm::vec3(3, 2.5f, 2), glm::vec3(3, -2.5f, 1.5f), glm::vec3(3, -2, -1), glm::vec3(3, 2, -1)});
  addWall({glm::vec3(-2, 2, 1.7f), glm::vec3(1, 2, 2.4f), glm::vec3(2, 2.2f, -1), glm::vec3(-2.2f, 2, -1)});
  addWall({glm::vec3(-4, -3, 3), glm::vec3(-4, 2.5f, 2.7f), glm::vec3(-4, 3, -1), glm::vec3(-4, -3, -1)});
  addWall({glm::vec3(2, -1.2f, 1), glm::vec3(-1, -1.2f, 1.4f), glm::vec3(-1.5f, -1.2f, -1), glm::vec3(2, -1.4f, -1)});
  addWall({glm::vec3(0.2f, 0.1f, 1), glm::vec3(0.2f, 0.6f, 1), glm::vec3(0.7f, 0.5f, 1), glm::vec3(0.6f, 0.1f, 1)});
  return list;
}

/// The five faces over an eye: the top, then the sides that look along its +x, +y, -x and -y; rows grow away from the
/// horizon, and only those above it exist.
TestVector hemicube(const std::string& name, const std::string& catches, const glm::vec3& eye, const glm::vec3& x,
                    const glm::vec3& y, const glm::vec3& normal) {
  const auto face = [&](const glm::vec3& right, const glm::vec3& rows, const glm::vec3& forward, int firstRow) -> Face {
    return {eye, right, rows, forward, 0.1f, 64, {0, firstRow, 64, 64 - firstRow}};
  };
  return makeVector(name, catches, asymmetricRoom(),
                    {face(x, y, normal, 0), face(y, normal, x, 32), face(-x, normal, y, 32), face(-y, normal, -x, 32),
                     face(x, normal, -y, 32)},
                    {"top", "side-right", "side-up", "side-left", "side-down"});
}

/// The room from faces with different eyes, mirrored, rotated, wider and narrower than ninety degrees.
TestVector oddFaces() {
  Face mirrored = frontFace(32, 0.1f), turned = mirrored, wide = mirrored, narrow = mirrored, skewed = mirrored;
  mirrored.x = -mirrored.x;
  turned.x = {0, 1, 0};
  turned.y = {-1, 0, 0};
  wide.x = {0.4f, 0, 0};
  wide.y = {0, 0.25f, 0};
  wide.eye = {0, 0, -2};
  narrow.x *= 1.5f;
  narrow.y *= -2.5f;
  narrow.eye = {0.25f, -0.125f, 0};
  skewed.x = {1, 0.25f, 0.5f};
  skewed.y = {-0.5f, 1, 0.125f};
  skewed.w = {0.25f, 0.125f, 1.5f};
  return makeVector("odd-faces", "views assumed to be orthonormal, of ninety degrees, unmirrored, or from one eye",
                    asymmetricRoom(), {mirrored, turned, wide, narrow, skewed});
}

/// One viewport through several scissor rectangles, of odd sizes and single pixels.
TestVector scissors() {
  std::vector<Face> faces;
  for (const Scissor& scissor : {Scissor{0, 0, 31, 17}, Scissor{22, 0, 18, 40}, Scissor{5, 17, 29, 23},
                                 Scissor{7, 13, 1, 1}, Scissor{0, 39, 40, 1}, Scissor{23, 0, 1, 40}}) {
    faces.push_back(frontFace(40, 0.1f));
    faces.back().scissor = scissor;
  }
  return makeVector("scissors", "a viewport moved or scaled to the scissor rectangle, padded rows, rows upside down",
                    asymmetricRoom(), faces);
}

/// Random triangles of all sizes at the corners of the largest viewport, with scissor rectangles of a few pixels.
TestVector largestViewport() {
  constexpr int resolution = 4096;
  std::mt19937 random(4096);
  Picture picture(resolution);
  picture.indexMaps.push_back(countingMap(256, 256));
  for (raster::ItemId id = 0; id < 64; ++id) {
    const bool isFirstCorner = id % 2 == 0;
    const float size = std::array<float, 4>{4, 20, 100, 20000}[id / 2 % 4];
    std::array<glm::vec3, 3> corners;
    std::array<glm::vec2, 3> texcoords;
    for (std::size_t k = 0; k < 3; ++k) {
      const float middle = isFirstCorner ? 8 : resolution - 8;
      const float column = middle + uniform(random, -size, size), row = middle + uniform(random, -size, size);
      const float w = uniform(random, 1, 2) + size / 100;
      corners[k] = picture.point({column, row}, w);
      const float u = uniform(random, 0, 1), v = uniform(random, 0, 1);
      texcoords[k] = {u, v};
    }
    addDraw(picture, id << 16, {}, 0);
    addTriangle(picture, {corners[0], corners[1], corners[2]}, {texcoords[0], texcoords[1], texcoords[2]});
  }
  Face first = frontFace(resolution, 0.5f), last = first;
  first.scissor = {0, 0, 16, 16};
  last.scissor = {resolution - 16, resolution - 16, 16, 16};
  return makeVector("corners-of-4096", "edge functions in 32 bits, or in binary32, that overflow or lose bits", picture,
                    {first, last});
}

/// A crumpled sheet with one item ID per triangle, in a view so narrow that the last bit of the vertex stage is about a
/// sub-pixel. A device that rounds differently moves corners, and with them a few pixels.
TestVector narrowView() {
  constexpr int cells = 48;
  constexpr float scale = 2048, third = 1.0f / 3;
  const glm::vec3 eye(0.1f, -0.2f, 0.3f);
  const glm::vec3 right(2 * third, 2 * third, -third), rows(-third, 2 * third, 2 * third),
      forward(2 * third, -third, 2 * third);
  std::mt19937 random(4096);
  raster::DrawList list = plainList();
  addTexelSheet(list, cells, [&](int column, int row) {
    const auto across = [&](int cell) {
      const float position = static_cast<float>(cell) + uniform(random, -0.3f, 0.3f);
      return (2 * position / cells - 1) / scale;
    };
    const float x = across(column), y = across(row), w = uniform(random, 1, 2);
    return eye + w * (forward + x * right + y * rows);
  });
  const Face face{eye, scale * right, scale * rows, forward, 0.5f, cells, {0, 0, cells, cells}};
  return makeVector("narrow-view", "a vertex stage that fuses multiply-add, sums in another order or in more bits",
                    std::move(list), {face});
}

/// A crumpled wall around the origin from a rotated view, whose eye is 4 units in front of it. The rows of the view as
/// columns, and the transposed 4x4 matrix with z = n, show a part of the wall, too.
TestVector rotatedView() {
  constexpr int cells = 12;
  const glm::vec3 right = glm::vec3(6, -3, 2) / 7.0f, rows = glm::vec3(2, 6, 3) / 7.0f,
                  forward = glm::vec3(-3, -2, 6) / 7.0f;
  std::mt19937 random(49);
  raster::DrawList list = plainList();
  const auto point = [&](int column, int row) {
    const auto across = [&](int cell) { return static_cast<float>(cell - cells / 2) + uniform(random, -0.3f, 0.3f); };
    const float x = across(column), y = across(row), z = uniform(random, -0.5f, 0.5f);
    return x * right + y * rows + z * forward;
  };
  forEachCell(cells, point, [&](const std::array<glm::vec3, 4>& corners, int, int) {
    addDraw(list, static_cast<raster::ItemId>(list.draws.size() + 1) << 24);
    addQuad(list, corners);
  });
  const Face face{-4.0f * forward, right, rows, forward, 0.5f, 32, {0, 0, 32, 32}};
  return makeVector("rotated-view", "matrices transposed, with the eye subtracted before or as a part of the matrix",
                    std::move(list), {face});
}

}  // namespace

std::vector<TestVector> viewVectors() {
  const float third = 1.0f / 3;
  return {hemicube("five-faces", "faces swapped, rotated, mirrored or upside down; the wrong half of a side", {0, 0, 0},
                   {1, 0, 0}, {0, 1, 0}, {0, 0, 1}),
          hemicube("five-faces-tilted", "matrices transposed or applied to the eye twice", {0.1f, -0.2f, 0.3f},
                   {2 * third, 2 * third, -third}, {-third, 2 * third, 2 * third}, {2 * third, -third, 2 * third}),
          oddFaces(),
          narrowView(),
          scissors(),
          makeVector("two-by-two", "a viewport that is too small for a tile or a quad of pixels", asymmetricRoom(),
                     {frontFace(2, 0.1f)}),
          largestViewport(),
          rotatedView()};
}

}  // namespace hemitex::reference
