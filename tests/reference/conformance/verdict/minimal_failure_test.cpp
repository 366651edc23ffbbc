// A minimal failure keeps the kind of error at one pixel, and needs each of its triangles.
#include <catch2/catch.hpp>

#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/vectors/draw_list_builder.h"
#include "reference/conformance/verdict/reduction.h"
#include "tests/support/judged_wall.h"

using namespace hemitex;
using reference::ErrorKind;
using reference::MinimalFailure;
using reference::TestVector;

namespace {

reference::Verdict verdictOf(const MinimalFailure& minimal) { return judge(minimal.vector, {&minimal.found, 1}, {}); }

std::size_t trianglesOf(const TestVector& vector) { return vector.list.indices.size() / 3; }

/// The verdict on a device that shows `id` at one pixel and is right elsewhere.
reference::Verdict withOneId(const TestVector& vector, std::size_t face, std::size_t pixel, raster::ItemId id) {
  std::vector<raster::ItemBuffer> found = reference::render(vector);
  found[face].ids[pixel] = id;
  return judge(vector, found, {});
}

}  // namespace

TEST_CASE("minimize leaves one pixel and at most two triangles of a scene with one wrong pixel", "[verdict]") {
  for (const TestVector& vector : reference::sceneVectors(HEMITEX_DATA)) {
    INFO(vector.name);
    const raster::Scissor& scissor = vector.faces[0].face.scissor;
    // Next to the middle: no mesh has an inner edge there.
    const auto pixel = static_cast<std::size_t>((scissor.height / 2 + 1) * scissor.width + scissor.width / 2 + 5);
    const raster::ItemId right = reference::render(vector)[0].ids[pixel];
    const raster::ItemId background = raster::backgroundId(vector.list.format);
    REQUIRE(right != background);
    const raster::ItemId last = vector.list.draws.back().offset;
    for (const raster::ItemId id : {background, last, right ^ 1, background - 5}) {
      INFO(id);
      const reference::Verdict verdict = withOneId(vector, 0, pixel, id);
      REQUIRE(hasErrors(verdict));
      const MinimalFailure minimal = minimize(vector, verdict, {});
      CHECK(trianglesOf(minimal.vector) <= 2);
      CHECK(minimal.error.kind == firstErrors(vector, verdict, 1)[0].kind);
      CHECK(minimal.error.expected == right);
      CHECK(minimal.found.ids == std::vector<raster::ItemId>{id});
      CHECK(minimal.vector.faces[0].face.scissor.width * minimal.vector.faces[0].face.scissor.height == 1);
      CHECK(reference::render(minimal.vector)[0].ids == minimal.expected.ids);
      CHECK(hasErrors(verdictOf(minimal)));
    }
  }
}

TEST_CASE("minimize leaves the missing triangle, or the extra one", "[verdict]") {
  tests::JudgedWall wall;
  raster::DrawList& list = wall.vector.list;
  tests::addDraw(list, 0x200);
  tests::addTriangle(list, {{-1, -1, 9}, {-0.5, -1, 9}, {-1, -0.5, 9}});  // behind the wall, and in its picture
  for (glm::vec3& position : list.positions) position.x -= 0.5f;          // the wall covers columns 0 to 5
  const MinimalFailure missing = minimize(wall.vector, withOneId(wall.vector, 0, 8 + 1, 0xffffff), {});
  CHECK(missing.error.kind == ErrorKind::Missing);
  CHECK(trianglesOf(missing.vector) == 1);
  CHECK(missing.vector.list.draws.size() == 1);
  CHECK(missing.vector.list.draws[0].offset == 0x100);
  CHECK(missing.error.column == 1);
  CHECK(missing.error.row == 1);

  const MinimalFailure extra = minimize(wall.vector, withOneId(wall.vector, 0, 8 + 7, 0x200), {});
  CHECK(extra.error.kind == ErrorKind::Extra);
  CHECK(trianglesOf(extra.vector) == 1);
  CHECK(extra.vector.list.draws[0].offset == 0x200);
  CHECK(extra.vector.list.indexMaps.empty());

  const MinimalFailure behind = minimize(wall.vector, withOneId(wall.vector, 0, 8 + 1, 0x200), {});
  CHECK(behind.error.kind == ErrorKind::WrongSurface);
  CHECK(trianglesOf(behind.vector) == 2);
}

TEST_CASE("minimize keeps the most frequent kind of error", "[verdict]") {
  tests::JudgedWall wall;
  wall.found[0].ids[0] = 0xffffff;
  wall.found[1].ids[3] = 0x300;
  wall.found[1].ids[17] = 0x300;
  const MinimalFailure minimal = minimize(wall.vector, wall.verdict(), {});
  CHECK(minimal.error.kind == ErrorKind::WrongSide);
  CHECK(minimal.vector.faces[0].name == "side");
  CHECK(minimal.error.column == 3);
  CHECK(minimal.error.row == 4);
}

TEST_CASE("minimize keeps the triangles on both sides of a hole on an inner edge", "[verdict]") {
  // The wall's diagonal passes through the samples (k, k). Either triangle alone has its boundary there, where a device
  // may show the background.
  const tests::JudgedWall wall;
  const MinimalFailure minimal = minimize(wall.vector, withOneId(wall.vector, 0, 8 + 1, 0xffffff), {});
  CHECK(minimal.error.kind == ErrorKind::Missing);
  CHECK(trianglesOf(minimal.vector) == 2);
}

TEST_CASE("minimize keeps the numbers of triangles", "[verdict]") {
  reference::Picture picture(16);
  picture.value = raster::PixelValue::TriangleNumbers;
  tests::addDraw(picture, 0x100);
  for (int column = 0; column < 16; ++column)
    for (int row = 0; row < 16; ++row) picture.addPixel(column, row);
  const TestVector vector = makeVector("numbers", "", picture);
  // Triangle 16 * column + row covers one pixel.
  REQUIRE(reference::render(vector)[0].ids[16 * 2 + 5] == 0x100 + 16 * 5 + 2);
  const MinimalFailure minimal = minimize(vector, withOneId(vector, 0, 16 * 2 + 5, 0x100 + 16 * 5 + 3), {});
  CHECK(trianglesOf(minimal.vector) <= 2);
  CHECK(minimal.error.expected == 0x100 + 16 * 5 + 2);
  CHECK(minimal.error.kind == ErrorKind::WrongElement);
  CHECK(reference::render(minimal.vector)[0].ids == minimal.expected.ids);
}
