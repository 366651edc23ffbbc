// Bugs of public programs, made again from their descriptions: at most 64 pixels find and name each of them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "reference/conformance/diagnosis/diagnosis.h"
#include "reference/conformance/vectors/draw_list_builder.h"

using namespace hemitex;
using raster::ItemId;
using reference::Picture;
using reference::TestVector;

namespace {

using Ids = std::vector<ItemId>;

/// The faults that the vector names for the item IDs of a face of 8 x 8 pixels.
std::set<std::string> faultsNamed(const TestVector& vector, const Ids& ids) {
  std::vector<raster::ItemBuffer> found(1);
  found[0].resize(vector.faces[0].face.scissor);
  REQUIRE(found[0].ids.size() == 64);
  found[0].ids = ids;
  const reference::Verdict verdict = judge(vector, found, {});
  CHECK(hasErrors(verdict));
  std::set<std::string> names;
  for (const reference::Finding& finding : diagnose(vector, verdict)) names.insert(finding.fault);
  return names;
}

/// Two triangles that share a diagonal, with the windings of an index list (0, 1, 2), (3, 2, 1).
TestVector square() {
  Picture picture(8);
  const std::array<glm::vec3, 4> corners{picture.point({0, 0}), picture.point({0, 8}), picture.point({8, 0}),
                                         picture.point({8, 8})};
  addDraw(picture, 0);
  addTriangle(picture, {corners[0], corners[1], corners[2]});
  addDraw(picture, 1);
  addTriangle(picture, {corners[3], corners[2], corners[1]});
  return makeVector("square", "", picture);
}

/// Each of 16 blocks of 2 x 2 pixels has the ID of its place, behind `first`.
TestVector blocks(ItemId first) {
  Picture picture(8);
  for (int k = 0; k < 16; ++k) {
    addDraw(picture, first + static_cast<ItemId>(k));
    picture.addBlock({k % 4 * 2, k / 4 * 2, k % 4 * 2 + 2, k / 4 * 2 + 2});
  }
  return makeVector("blocks", "", picture);
}

Ids idsOf(const TestVector& vector) { return reference::render(vector)[0].ids; }

}  // namespace

// github.com/facebookresearch/DRTK, issue 9: of two triangles with a common diagonal, neither has the pixels on it; the
// pixels are there when one triangle is turned over.
TEST_CASE("diagnose names the holes on a diagonal of a differentiable rasterizer", "[diagnosis]") {
  Ids found;
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 8; ++column) {
      const int side = column + row - 7;  // of the sample
      found.push_back(side < 0 ? 0 : side > 0 ? 1 : 0xffffffff);
    }
  CHECK(faultsNamed(square(), found) == std::set<std::string>{"wrong fill rule"});
}

// github.com/redhog/InfiniteGlass, issue 63: the picked window 0x1000007 is read as 0x1000008, after a shader computed
// its channels in floats. xBimTeam/XbimWebUI, issue 91, is the same kind.
TEST_CASE("diagnose names the picked numbers that a shader rounds to floats", "[diagnosis]") {
  const TestVector vector = blocks(0x1000001);
  Ids found = idsOf(vector);
  REQUIRE(std::count(found.begin(), found.end(), 0x1000007u) == 4);
  for (ItemId& id : found) id = static_cast<ItemId>(static_cast<float>(id));
  CHECK(std::count(found.begin(), found.end(), 0x1000008u) > 4);
  CHECK(faultsNamed(vector, found) == std::set<std::string>{"item IDs through binary32"});
}

// github.com/playcanvas/engine, pull request 7545: the decoder of picked numbers lost the sign bit.
TEST_CASE("diagnose names the picked numbers that lose their sign bit", "[diagnosis]") {
  const TestVector vector = blocks(0x7ffffff8);
  Ids found = idsOf(vector);
  for (ItemId& id : found) id &= 0x7fffffff;
  CHECK(faultsNamed(vector, found) == std::set<std::string>{"item IDs through signed integers"});
}

// github.com/dune3d/dune3d, issue 57, and openantz/antz, issue 49: antialiasing mixes the numbers at the edges of
// objects. Bytes are averaged over four samples, of which a triangle covers those inside.
TEST_CASE("diagnose names the picked numbers that antialiasing mixes", "[diagnosis]") {
  Picture picture(8);
  addDraw(picture, 0x00204060);
  picture.addBlock(picture.whole(), 2);
  addDraw(picture, 0x60402000);
  addTriangle(picture, {picture.point({0.25, 0.75}), picture.point({7.25, 2.75}), picture.point({2.25, 7.5})});
  const TestVector vector = makeVector("mixed", "", picture);
  const auto isInside = [](double x, double y) {
    const auto side = [=](double ax, double ay, double bx, double by) {
      return (bx - ax) * (y - ay) - (by - ay) * (x - ax);
    };
    return side(0.25, 0.75, 7.25, 2.75) > 0 && side(7.25, 2.75, 2.25, 7.5) > 0 && side(2.25, 7.5, 0.25, 0.75) > 0;
  };
  Ids found;
  for (int pixel = 0; pixel < 64; ++pixel) {
    int covered = 0;
    for (const auto& [x, y] : {std::pair{6, 2}, {14, 6}, {2, 10}, {10, 14}})
      covered += isInside(pixel % 8 + x / 16.0, pixel / 8 + y / 16.0);
    ItemId id = 0;
    for (const int shift : {0, 8, 16, 24}) {
      const auto byte = [=](ItemId of) { return static_cast<int>(of >> shift & 255); };
      id |= static_cast<ItemId>((covered * byte(0x60402000) + (4 - covered) * byte(0x00204060) + 2) / 4) << shift;
    }
    found.push_back(id);
  }
  CHECK(faultsNamed(vector, found) == std::set<std::string>{"multisampling"});
}
