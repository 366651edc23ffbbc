// The vector suite: its vectors are as described, the renderer follows the rules on them, and its hashes are pinned.
#include "reference/conformance/suite/vector_suite.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <set>
#include <sstream>

#include "raster/base/parallel.h"
#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/trace/rational_rasterizer.h"
#include "tests/support/raster_scenes.h"
#include "tests/support/suite_hashes.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using raster::ItemId;
using reference::TestVector;

namespace {

std::vector<TestVector> wholeSuite() { return reference::wholeSuite(HEMITEX_DATA); }

const TestVector& named(const std::vector<TestVector>& suite, const std::string& name) {
  const auto found = std::find_if(suite.begin(), suite.end(), [&](const TestVector& v) { return v.name == name; });
  REQUIRE(found != suite.end());
  return *found;
}

/// The item IDs of a vector's first face.
std::vector<ItemId> idsOf(const TestVector& vector) { return reference::render(vector).front().ids; }

/// How often the draws of a vector cover each pixel, drawn one by one.
std::vector<int> coverCounts(const TestVector& vector) {
  std::vector<int> counts;
  TestVector one = vector;
  for (const raster::Draw& draw : vector.list.draws) {
    one.list.draws = {draw};
    const std::vector<ItemId> ids = idsOf(one);
    counts.resize(ids.size());
    for (std::size_t p = 0; p < ids.size(); ++p) counts[p] += ids[p] != 0xffffffff;
  }
  return counts;
}

std::size_t countOf(const std::vector<int>& counts, int value) {
  return static_cast<std::size_t>(std::count(counts.begin(), counts.end(), value));
}

bool hasSameIds(const std::vector<raster::ItemBuffer>& a, const std::vector<raster::ItemBuffer>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.ids == y.ids; });
}

}  // namespace

TEST_CASE("vectorSuite has at least forty vectors with unique names and one line in catches each", "[suite]") {
  std::set<std::string> names;
  for (const TestVector& vector : wholeSuite()) {
    INFO(vector.name);
    CHECK(names.insert(vector.name).second);
    CHECK(vector.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos);
    CHECK(!vector.catches.empty());
    CHECK(vector.catches.find('\n') == std::string::npos);
    CHECK_NOTHROW(raster::validate(vector.list));
  }
  CHECK(names.size() >= 40);
}

TEST_CASE("readVector reads every vector of the suite back to the same bits and item IDs", "[suite]") {
  for (const TestVector& vector : wholeSuite()) {
    INFO(vector.name);
    const TemporaryFolder folder;
    const std::vector<raster::ItemBuffer> buffers = reference::render(vector);
    reference::writeVector(folder.path, vector, buffers);
    const TestVector read = reference::readVector(folder.path);
    CHECK(read.name == vector.name);
    CHECK(read.catches == vector.catches);
    CHECK(read.list.positions == vector.list.positions);
    CHECK(read.list.texcoords == vector.list.texcoords);
    CHECK(hasSameIds(reference::render(read), buffers));
    REQUIRE(read.faces.size() == vector.faces.size());
    for (std::size_t f = 0; f < read.faces.size(); ++f) {
      CHECK(read.faces[f].hash == reference::idsHash(buffers[f].ids));
      CHECK(read.faces[f].face.x == vector.faces[f].face.x);
      CHECK(read.faces[f].face.eye == vector.faces[f].face.eye);
      CHECK(read.faces[f].face.nearDistance == vector.faces[f].face.nearDistance);
    }
  }
}

TEST_CASE("evaluateRules equals the renderer on every pixel of the suite", "[suite]") {
  for (const TestVector& vector : wholeSuite()) {
    const std::vector<raster::ItemBuffer> found = reference::render(vector);
    for (std::size_t f = 0; f < found.size(); ++f) {
      INFO(vector.name << ", face " << vector.faces[f].name);
      CHECK(found[f].ids == reference::evaluateRules(vector.list, vector.faces[f].face).ids);
    }
  }
}

TEST_CASE("vectorSuite has the pinned hashes with 1, 2 and 7 threads", "[suite]") {
  // `hemitex_suite_hashes` prints this file anew where the suite grows.
  std::stringstream pinned;
  pinned << std::ifstream(HEMITEX_SUITE_HASHES).rdbuf();
  const std::vector<TestVector> suite = wholeSuite();
  for (const int threads : {1, 2, 7}) {
    const raster::ThreadLimit limit(threads);
    CHECK(tests::suiteHashes(suite) == pinned.str());
  }
}

TEST_CASE("vectorSuite: eight sub-pixel triangles around each sample cover it exactly once", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  for (const char* order : {"centre-fans-later-nearer", "centre-fans-earlier-nearer"})
    CHECK(countOf(coverCounts(named(suite, order)), 1) == 256);
}

TEST_CASE("vectorSuite: meshes cover exactly their interior, once, in every order of corners", "[suite]") {
  // The nine fans fill squares of 14 x 14 pixels, the nine grids squares with the sides (12, 9) and (-9, 12). Samples
  // on the left and top borders count, those on the others do not; such a half-open square between two vectors of
  // whole numbers holds as many samples as its area, wherever it lies: its copies tile the plane.
  const std::vector<TestVector> suite = reference::vectorSuite();
  struct Case {
    std::string name;
    std::size_t once, never;
  };
  for (const Case& mesh :
       {Case{"fans", 9 * 14 * 14, 48 * 48 - 9 * 14 * 14}, Case{"rotated-grids", 9 * 15 * 15, 64 * 64 - 9 * 15 * 15},
        Case{"sample-grid", 256, 0}, Case{"micro-grid", 256, 0}})
    for (const char* order : {"-later-nearer", "-earlier-nearer"}) {
      INFO(mesh.name << order);
      const std::vector<int> counts = coverCounts(named(suite, mesh.name + order));
      CHECK(countOf(counts, 1) == mesh.once);
      CHECK(countOf(counts, 0) == mesh.never);
    }
}

TEST_CASE("vectorSuite: strips share vertices, each the first and last of at most one triangle", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  const TestVector& vector = named(suite, "shared-vertices");
  const raster::DrawList& list = vector.list;
  for (const std::size_t corner : {0u, 2u}) {
    std::set<std::uint32_t> vertices;
    for (const raster::Draw& draw : list.draws) CHECK(vertices.insert(list.indices[draw.first + corner]).second);
  }
  CHECK(list.positions.size() < list.draws.size() + 9);  // two more a strip than triangles
  // A strip is a trapezoid 8 rows high with sides of 32 and 28 pixels, and so holds 240 samples.
  CHECK(countOf(coverCounts(vector), 1) == 4 * 240);
}

TEST_CASE("vectorSuite: a double hit in a mesh shows in one of the two orders of depths", "[suite]") {
  // Move one triangle so that it claims samples of others: in one of the two vectors its number shows there.
  const std::vector<TestVector> suite = reference::vectorSuite();
  for (const std::size_t moved : {std::size_t{0}, std::size_t{7}, std::size_t{15}}) {
    std::size_t changed = 0;
    for (const char* order : {"fans-later-nearer", "fans-earlier-nearer"}) {
      const TestVector& right = named(suite, order);
      TestVector wrong = right;
      for (std::size_t k = 0; k < 3; ++k) wrong.list.positions[3 * moved + k] *= glm::vec3(0.99f, 0.99f, 1);
      const std::vector<ItemId> expected = idsOf(right), found = idsOf(wrong);
      for (std::size_t p = 0; p < found.size(); ++p)
        changed += found[p] == moved && expected[p] != moved && expected[p] != 0xffffffff;
    }
    CHECK(changed > 0);
  }
}

TEST_CASE("vectorSuite: half sub-pixels snap to the even one, and any other rounding shows", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  for (const bool isRow : {false, true}) {
    const TestVector& vector = named(suite, isRow ? "snapping-rows" : "snapping-columns");
    std::vector<ItemId> expected;
    for (ItemId k = 0; k < 256; ++k) expected.push_back(k % 2 == 0 ? 2 * k + 1 : 2 * k);
    CHECK(idsOf(vector) == expected);
    // Positions are multiples of 2^-12 here, and the odd ones lie on half sub-pixels. Moving them up by less than a
    // half is rounding half up: wrong for even k alone; moving them down is rounding half down: wrong for odd k alone.
    for (const float direction : {1.0f, -1.0f}) {
      TestVector wrong = vector;
      for (glm::vec3& position : wrong.list.positions) {
        float& coordinate = isRow ? position.y : position.x;
        if (static_cast<int>(coordinate * 4096) % 2 != 0) coordinate += direction * 0x1p-14f;
      }
      const std::vector<ItemId> found = idsOf(wrong);
      bool holds = true;
      for (ItemId k = 0; k < 256; ++k) holds &= (found[k] != expected[k]) == (k % 2 == (direction > 0 ? 0 : 1));
      CHECK(holds);
    }
  }
}

TEST_CASE("vectorSuite: sheets cut at the near plane and the guard band have no holes", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  const auto hasNoHole = [](const std::vector<ItemId>& ids) {
    return std::find(ids.begin(), ids.end(), 0xffffffff) == ids.end();
  };
  CHECK(hasNoHole(idsOf(named(suite, "guard-band-sheet"))));
  CHECK(hasNoHole(idsOf(named(suite, "perspective-sheet"))));
  // The floor y = 1/2 is seen at w = 1 / (2 y/w): cut at w = 3/2, which is y/w = 1/3, and at its end behind w = 5,
  // y/w = 1/10. The view there is narrower than the floor.
  const std::vector<ItemId> ids = idsOf(named(suite, "near-plane-sheet"));
  for (std::size_t row = 0; row < 64; ++row) {
    INFO("row " << row);
    const double y = (2 * static_cast<double>(row) + 1) / 64 - 1;
    const std::vector<ItemId> line(ids.begin() + static_cast<std::ptrdiff_t>(64 * row),
                                   ids.begin() + static_cast<std::ptrdiff_t>(64 * row + 64));
    const auto empty = std::count(line.begin(), line.end(), 0xffffffff);
    if (y > 0.11 && y < 0.33) CHECK(empty == 0);
    if (y < 0.07 || y > 0.34) CHECK(empty == 64);
  }
}

TEST_CASE("vectorSuite: the frustum sheet is complete where its plane lies beyond the near plane", "[suite]") {
  // The plane y = 0.04 + 0.01 x - 0.2 z meets the ray (x, y, 1) w at w = 0.04 / (y - 0.01 x + 0.2). The sheet ends
  // behind w = 0.8, and there is wider than the view.
  const std::vector<TestVector> suite = reference::vectorSuite();
  const std::vector<ItemId> ids = idsOf(named(suite, "frustum-sheet"));
  int checked = 0;
  for (std::size_t p = 0; p < ids.size(); ++p) {
    const double x = (2 * static_cast<double>(p % 64) + 1) / 64 - 1, y = (2 * static_cast<double>(p / 64) + 1) / 64 - 1;
    const double w = 0.04 / (y - 0.01 * x + 0.2);
    if (w < 0.051 && w > 0.049) continue;
    const bool isSeen = w > 0.05 && w < 0.8;
    INFO("pixel " << p % 64 << ", " << p / 64 << " at w " << w);
    if (w < 0.8) CHECK((ids[p] != 0xffffffff) == isSeen);
    checked += isSeen;
  }
  CHECK(checked > 1400);
}

TEST_CASE("vectorSuite: texels beside k/N are those of the binary64 quotient", "[suite]") {
  // u is binary32 and N below 2^11, so u N is exact in binary64: floor(u N) is what the rules say.
  const std::vector<TestVector> suite = reference::vectorSuite();
  for (const int texels : {1, 3, 7, 100, 255, 256, 257, 1000, 1024}) {
    const TestVector& vector = named(suite, "texels-" + std::to_string(texels));
    const std::vector<ItemId> ids = idsOf(vector);
    const std::size_t steps = 3 * (static_cast<std::size_t>(texels) + 1);
    bool holds = true;
    for (std::size_t p = 0; p < 2 * steps; ++p) {
      const glm::vec2 t = vector.list.texcoords[3 * p];
      const double position = static_cast<double>(p < steps ? t.x : t.y) * texels;
      const double texel = std::clamp(std::floor(position), 0.0, texels - 1.0);
      holds &= ids[p] == (p < steps ? 0u : 0x10000u) + static_cast<ItemId>(texel);
    }
    INFO(texels);
    CHECK(holds);
    CHECK(std::count(ids.begin(), ids.end(), 0xffffffff) == static_cast<long>(ids.size() - 2 * steps));
  }
}

TEST_CASE("vectorSuite: every pair of bytes is added and clamped in every channel", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  const std::vector<ItemId> ids = idsOf(named(suite, "byte-pairs"));
  bool holds = true;
  for (ItemId offset = 0; offset < 256; ++offset)
    for (ItemId texel = 0; texel < 256; ++texel) {
      const ItemId id = ids[256 * offset + texel];
      const auto sum = [](ItemId a, ItemId b) { return std::min<ItemId>(a + b, 255); };
      holds &= (id & 255) == sum(offset, texel);
      holds &= (id >> 8 & 255) == sum(255 - offset, 255 - texel);
      holds &= (id >> 16 & 255) == sum(255 - offset, texel);
      holds &= id >> 24 == sum(offset, 255 - texel);
    }
  CHECK(holds);
}

TEST_CASE("vectorSuite: the edge item IDs and both reserved item IDs come out unchanged", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  for (const char* name :
       {"edge-offsets-r32ui", "edge-offsets-r8g8b8a8", "edge-texels-replaced", "edge-texels-added"}) {
    INFO(name);
    const std::vector<ItemId> ids = idsOf(named(suite, name));
    for (const ItemId id : {0u, (1u << 24) - 1, 1u << 24, (1u << 24) + 1, 0xfffffffdu, 0xfffffffeu, 0xffffffffu})
      CHECK(std::find(ids.begin(), ids.end(), id) != ids.end());
  }
}

TEST_CASE("vectorSuite: of coplanar surfaces the first one drawn is visible", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  const std::vector<ItemId> lightFirst = idsOf(named(suite, "coplanar-light-first"));
  const std::vector<ItemId> ceilingFirst = idsOf(named(suite, "coplanar-ceiling-first"));
  CHECK(std::count(lightFirst.begin(), lightFirst.end(), 1u) == 9 * 14);
  CHECK(std::count(lightFirst.begin(), lightFirst.end(), 0u) == 27 * 28 - 9 * 14);
  CHECK(std::count(ceilingFirst.begin(), ceilingFirst.end(), 0u) == 27 * 28);
  // On the slope each pixel shows the first of those that cover it: the order of draws alone decides.
  for (const char* name : {"coplanar-slope", "coplanar-slope-reversed", "same-triangle"}) {
    const TestVector& vector = named(suite, name);
    TestVector painted = vector;
    std::reverse(painted.list.draws.begin(), painted.list.draws.end());
    std::vector<ItemId> first(idsOf(vector).size(), 0xffffffff);
    for (const raster::Draw& draw : painted.list.draws) {
      TestVector one = vector;
      one.list.draws = {draw};
      const std::vector<ItemId> ids = idsOf(one);
      for (std::size_t p = 0; p < ids.size(); ++p)
        if (ids[p] != 0xffffffff) first[p] = ids[p];
    }
    INFO(name);
    CHECK(idsOf(vector) == first);
  }
}

TEST_CASE("vectorSuite: of two triangles with the same corners the first one is visible, and nearer ones before it",
          "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  for (const char* name : {"equal-depths", "equal-depths-sloped"}) {
    // A cell has two draws, or three in three of four cells; of these the odd one is nearer in columns 0 to 3.
    ItemId first = 0;
    const std::vector<ItemId> ids = idsOf(named(suite, name));
    bool holds = true;
    for (std::size_t cell = 0; cell < 64; ++cell) {
      const std::size_t place = (cell + cell / 8) % 4;
      const bool isOtherNearer = cell % 8 < 4;
      const std::array<ItemId, 4> nearest{0, isOtherNearer ? 0u : 1u, isOtherNearer ? 1u : 0u, isOtherNearer ? 2u : 0u};
      for (std::size_t p = 0; p < 16; ++p)
        holds &= ids[(cell / 8 * 4 + p / 4) * 32 + cell % 8 * 4 + p % 4] == first + nearest[place];
      first += place == 0 ? 2 : 3;
    }
    INFO(name);
    CHECK(holds);
  }
}

TEST_CASE("vectorSuite: the many vertices show a board, and another one with indices of 16 or 8 bits", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  const TestVector& vector = named(suite, "many-vertices");
  CHECK(vector.list.positions.size() > 65536);
  const auto ofBoard = [](std::size_t p) { return static_cast<ItemId>(p / 32 / 4 * 8 + p % 32 / 4); };
  const std::vector<ItemId> ids = idsOf(vector);
  bool holds = true;
  for (std::size_t p = 0; p < ids.size(); ++p) holds &= ids[p] == ofBoard(p);
  CHECK(holds);
  for (const std::uint32_t mask : {0xffffu, 0xffu}) {
    TestVector cut = vector;
    for (std::uint32_t& index : cut.list.indices) index &= mask;
    const std::vector<ItemId> found = idsOf(cut);
    holds = true;
    for (std::size_t p = 0; p < ids.size(); ++p) holds &= found[p] == ids[p] - 1 || ids[p] == 0;
    CHECK(holds);
  }
}

TEST_CASE("vectorSuite: samples on the edges beyond the view belong to the strip above", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  const std::vector<ItemId> ids = idsOf(named(suite, "edges-beyond-the-view"));
  bool holds = true;
  for (int p = 0; p < 1024; ++p) {
    const double strip =
        std::ceil(p / 32 - p % 32 / 3.0 - 1e-9) - 1;  // its upper edge passes through the sample (0, strip)
    holds &= ids[static_cast<std::size_t>(p)] == static_cast<ItemId>(strip + 32);
  }
  CHECK(holds);
}

TEST_CASE("vectorSuite: the sub-pixel sheet and the rotated view have no holes", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  const std::vector<ItemId> sheet = idsOf(named(suite, "sub-pixel-sheet")), view = idsOf(named(suite, "rotated-view"));
  for (std::size_t row = 4; row < 48; ++row)
    CHECK(std::count(&sheet[row * 52 + 4], &sheet[row * 52 + 48], 0xffffffff) == 0);
  CHECK(std::count(view.begin(), view.end(), 0xffffffff) == 0);
}

TEST_CASE("vectorSuite: the constant and the fine coordinates show the texels of their closed forms", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  const std::vector<ItemId> constant = idsOf(named(suite, "constant-coordinates"));
  bool holds = true;
  for (ItemId p = 0; p < 1024; ++p) {
    const ItemId cell = p / 32 / 4 * 8 + p % 32 / 4, texel = 2 * (cell % 32) + 1;
    holds &= constant[p] == (cell < 32 ? 64 + texel : 0x10000 + 4 * texel + 1);
  }
  CHECK(holds);
  const std::vector<ItemId> fine = idsOf(named(suite, "fine-coordinates"));
  holds = true;
  for (ItemId row = 0; row < 32; ++row)
    for (ItemId column = 0; column < 32; ++column) {
      const ItemId texel = row < 16 ? 3 + 250 * row + 7 * column : 0x10000 + 3 + 125 * column + 7 * (row - 16);
      holds &= fine[(row + 1) * 34 + column + 1] == texel;
    }
  CHECK(holds);
}

TEST_CASE("vectorSuite: of two adjacent binary32 depths the smaller is visible", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  for (const char* name : {"depth-steps", "depth-range"}) {
    const std::vector<ItemId> ids = idsOf(named(suite, name));
    bool holds = true;
    for (ItemId pixel = 0; pixel < 256; ++pixel) holds &= ids[pixel] == 2 * pixel + pixel % 2;
    INFO(name);
    CHECK(holds);
  }
}

TEST_CASE("vectorSuite: unaligned item IDs survive an integer add and not a clamped one", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  const std::vector<ItemId> sums = idsOf(named(suite, "unaligned-integer-add"));
  const std::vector<ItemId> clamped = idsOf(named(suite, "unaligned-clamped-add"));
  CHECK(std::set<ItemId>(sums.begin(), sums.end()).size() == 9 * 256);
  CHECK(std::set<ItemId>(clamped.begin(), clamped.end()).size() < 9 * 256);
}

TEST_CASE("vectorSuite: every item ID of the unique maps is visible, and no offset", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  std::vector<ItemId> ids = idsOf(named(suite, "unique-maps"));
  std::sort(ids.begin(), ids.end());
  bool holds = true;
  for (ItemId k = 0; k < 1024; ++k) holds &= ids[k] == 0x00ff80 + k;
  CHECK(holds);
}

TEST_CASE("vectorSuite: the five faces show every wall and the background, and no two faces are equal", "[suite]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  const TestVector& vector = named(suite, "five-faces");
  const std::vector<raster::ItemBuffer> buffers = reference::render(vector);
  std::set<ItemId> walls;
  for (std::size_t f = 0; f < 5; ++f) {
    for (const ItemId id : buffers[f].ids) walls.insert(id >> 8);
    CHECK(std::count(buffers[f].ids.begin(), buffers[f].ids.end(), 0xffffffff) > 0);
    for (std::size_t other = 0; other < f; ++other) CHECK(buffers[f].ids != buffers[other].ids);
  }
  // Ceiling and four walls; the back of the board shares its upper bits with the background.
  for (ItemId wall = 1; wall <= 5; ++wall) CHECK(walls.count(wall) == 1);
  CHECK(walls.count(0xffffff) == 1);
  CHECK(std::count(buffers[0].ids.begin(), buffers[0].ids.end(), 0xfffffffe) > 0);
}

TEST_CASE("vectorSuite: the narrow view shows how the vertex stage rounds", "[suite]") {
  // With the vertices already transformed, and a face that leaves them as they are, another stage can stand in.
  const std::vector<TestVector> suite = reference::vectorSuite();
  const TestVector& vector = named(suite, "narrow-view");
  const raster::Face& face = vector.faces[0].face;
  const auto idsBy = [&](const auto& dot) {
    TestVector transformed = vector;
    for (glm::vec3& p : transformed.list.positions) p = {dot(face.x, p), dot(face.y, p), dot(face.w, p)};
    raster::Face& plain = transformed.faces[0].face;
    plain.eye = glm::vec3(0);
    plain.x = {1, 0, 0};
    plain.y = {0, 1, 0};
    plain.w = {0, 0, 1};
    return idsOf(transformed);
  };
  const glm::vec3& e = face.eye;
  const std::vector<ItemId> ids = idsOf(vector);
  const auto differing = [&](const std::vector<ItemId>& found) {
    std::size_t count = 0;
    for (std::size_t p = 0; p < ids.size(); ++p) count += found[p] != ids[p];
    return count;
  };
  const auto byTheRules = [&](const glm::vec3& r, const glm::vec3& p) {
    return (r.x * (p.x - e.x) + r.y * (p.y - e.y)) + r.z * (p.z - e.z);
  };
  const auto otherOrder = [&](const glm::vec3& r, const glm::vec3& p) {
    return r.x * (p.x - e.x) + (r.y * (p.y - e.y) + r.z * (p.z - e.z));
  };
  const auto fused = [&](const glm::vec3& r, const glm::vec3& p) {
    return std::fma(r.z, p.z - e.z, std::fma(r.y, p.y - e.y, r.x * (p.x - e.x)));
  };
  const auto moreBits = [&](const glm::vec3& r, const glm::vec3& p) {
    return static_cast<float>(glm::dot(glm::dvec3(r), glm::dvec3(p) - glm::dvec3(e)));
  };
  CHECK(differing(idsBy(byTheRules)) == 0);
  CHECK(differing(idsBy(otherOrder)) > 0);
  CHECK(differing(idsBy(fused)) > 0);
  CHECK(differing(idsBy(moreBits)) > 0);
}
