// Coverage, depth, texels and item IDs of the pixels that SoftwareRenderer draws.
#include "raster/software/software_renderer.h"

#include <algorithm>
#include <atomic>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>

#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "raster/setup/triangle_setup.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::tests;
using raster::ItemId;

namespace {

constexpr ItemId background = 0xffffffff;

/// The number of triangles that cover each pixel, from drawing them one by one.
std::vector<int> coverCounts(const raster::DrawList& list, const raster::Face& face) {
  std::vector<int> counts(static_cast<std::size_t>(face.scissor.width * face.scissor.height));
  for (std::uint32_t t = 0; t < list.indices.size() / 3; ++t) {
    raster::DrawList one = list;
    one.draws = {{3 * t, 3, 0, {}, {}}};
    const raster::ItemBuffer buffer = drawOne(one, face);
    for (std::size_t p = 0; p < counts.size(); ++p) counts[p] += buffer.ids[p] != background;
  }
  return counts;
}

bool allAre(const std::vector<int>& counts, int value) {
  return std::all_of(counts.begin(), counts.end(), [value](int count) { return count == value; });
}

/// A square of `size` x `size` jittered cells, two triangles each, larger than the view. With this small jitter all
/// cells stay convex.
raster::DrawList jitteredGrid(std::mt19937& random, int size, float depthSpread, bool flip) {
  raster::DrawList list = plainList();
  addDraw(list, 0);
  std::vector<glm::vec3> points;
  for (int j = 0; j <= size; ++j)
    for (int i = 0; i <= size; ++i) {
      const bool border = i == 0 || j == 0 || i == size || j == size;
      const float jitter = border ? 0 : 0.2f;
      const float x = (static_cast<float>(i) + uniform(random, -jitter, jitter)) / static_cast<float>(size) * 3 - 1.5f;
      const float y = (static_cast<float>(j) + uniform(random, -jitter, jitter)) / static_cast<float>(size) * 3 - 1.5f;
      const float w = uniform(random, 1, 1 + depthSpread);
      points.push_back({x * w, y * w, w});
    }
  const auto at = [&](int i, int j) { return points[static_cast<std::size_t>(j * (size + 1) + i)]; };
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      if ((i + j) % 2 == 0 && flip) {
        addTriangle(list, {at(i + 1, j), at(i, j), at(i + 1, j + 1)});
        addTriangle(list, {at(i, j + 1), at(i + 1, j + 1), at(i, j)});
      } else {
        addTriangle(list, {at(i, j), at(i + 1, j), at(i, j + 1)});
        addTriangle(list, {at(i + 1, j + 1), at(i, j + 1), at(i + 1, j)});
      }
    }
  return list;
}

std::uint64_t fnv1a(const std::vector<ItemId>& ids, std::uint64_t hash = 0xcbf29ce484222325u) {
  for (const ItemId id : ids)
    for (int byte = 0; byte < 4; ++byte) hash = (hash ^ ((id >> (8 * byte)) & 0xff)) * 0x100000001b3u;
  return hash;
}

}  // namespace

TEST_CASE("SoftwareRenderer covers a pixel once where eight triangles meet at its centre, in both windings",
          "[renderer]") {
  // The hub of the fan lies on the sample of pixel (8, 8) of 16 x 16, at (1/16, 1/16); all spokes pass through it.
  const float h = 1.0f / 16;
  for (const bool clockwise : {false, true})
    for (int rotation = 0; rotation < 3; ++rotation) {
      raster::DrawList list = plainList();
      addDraw(list, 0);
      const std::array<glm::vec2, 8> rim{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
      for (std::size_t k = 0; k < 8; ++k) {
        std::array<glm::vec3, 3> corner{glm::vec3(h, h, 1), glm::vec3(h + 0.5f * rim[k].x, h + 0.5f * rim[k].y, 1),
                                        glm::vec3(h + 0.5f * rim[(k + 1) % 8].x, h + 0.5f * rim[(k + 1) % 8].y, 1)};
        std::rotate(corner.begin(), corner.begin() + rotation, corner.end());
        if (clockwise) std::swap(corner[0], corner[1]);
        addTriangle(list, {corner[0], corner[1], corner[2]});
      }
      const std::vector<int> counts = coverCounts(list, frontFace(16));
      CHECK(counts[8 * 16 + 8] == 1);
      // The fan is the square from pixel (4, 4) to (12, 12) with samples on its border. Those on the top and left edges
      // are covered, the others are not: 8 x 8 pixels, each once.
      CHECK(std::count(counts.begin(), counts.end(), 1) == 64);
      CHECK(std::count(counts.begin(), counts.end(), 0) == 256 - 64);
    }
}

TEST_CASE("SoftwareRenderer covers each pixel exactly once where triangles share edges", "[renderer]") {
  std::mt19937 random(1);
  for (const bool flip : {false, true})
    for (const float depthSpread : {0.0f, 3.0f}) {
      INFO("flip " << flip << ", depth spread " << depthSpread);
      CHECK(allAre(coverCounts(jitteredGrid(random, 7, depthSpread, flip), frontFace(64)), 1));
    }
}

TEST_CASE("SoftwareRenderer gives samples on edges to the triangle whose top or left edge they are on", "[renderer]") {
  // Two triangles make the square [-1/2, 1/2]^2 of 4 x 4 pixels. Samples lie at +-1/4 and +-3/4, so shift the square by
  // 1/4. Then its borders pass through the samples of columns and rows 1 and 3.
  raster::DrawList list = plainList();
  addDraw(list, 7);
  const float a = -0.25f, b = 0.75f;
  addTriangle(list, {{a, a, 1}, {b, a, 1}, {b, b, 1}});
  addTriangle(list, {{a, a, 1}, {b, b, 1}, {a, b, 1}});
  const raster::ItemBuffer buffer = drawOne(list, frontFace(4));
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const bool expected = column >= 1 && column < 3 && row >= 1 && row < 3;
      INFO("pixel " << column << ", " << row);
      CHECK((buffer.ids[static_cast<std::size_t>(4 * row + column)] == 7) == expected);
    }
}

TEST_CASE("SoftwareRenderer maps y = -w to row 0 and x = -w to column 0", "[renderer]") {
  raster::DrawList list = plainList();
  addDraw(list, 1);
  addTriangle(list, {{-1, -1, 1}, {-0.4f, -1, 1}, {-1, -0.4f, 1}});
  const raster::ItemBuffer buffer = drawOne(list, frontFace(8));
  CHECK(buffer.ids[0] == 1);
  CHECK(buffer.ids[7] == background);
  CHECK(buffer.ids[56] == background);
}

TEST_CASE("SoftwareRenderer draws the pixels of the scissor rectangle as those of the whole face", "[renderer]") {
  std::mt19937 random(2);
  raster::DrawList list = jitteredGrid(random, 5, 2, true);
  list.draws.clear();
  for (std::uint32_t t = 0; t < list.indices.size() / 3; ++t) list.draws.push_back({3 * t, 3, t, {}, {}});
  const raster::Face whole = frontFace(32);
  raster::Face part = whole;
  part.scissor = {5, 16, 20, 9};
  const raster::ItemBuffer all = drawOne(list, whole), some = drawOne(list, part);
  REQUIRE(some.ids.size() == 180);
  bool holds = true;
  for (int row = 0; row < 9; ++row)
    for (int column = 0; column < 20; ++column)
      holds &= some.ids[static_cast<std::size_t>(20 * row + column)] ==
               all.ids[static_cast<std::size_t>(32 * (row + 16) + column + 5)];
  CHECK(holds);
}

TEST_CASE("SoftwareRenderer keeps the nearer triangle in any order, and the earlier one on a tie", "[renderer]") {
  const auto draw = [](std::initializer_list<float> depths) {
    raster::DrawList list = plainList();
    ItemId id = 0;
    for (const float w : depths) {
      addDraw(list, id++);
      addTriangle(list, {{-w, -w, w}, {3 * w, -w, w}, {-w, 3 * w, w}});
    }
    const raster::ItemBuffer buffer = drawOne(list, frontFace(8));
    CHECK(std::count(buffer.ids.begin(), buffer.ids.end(), buffer.ids[0]) == 64);
    return buffer.ids[0];
  };
  CHECK(draw({2, 1}) == 1);
  CHECK(draw({1, 2}) == 0);
  CHECK(draw({1, 1}) == 0);
  CHECK(draw({3, 2, 2, 4}) == 1);
  // The depths differ by one unit in the last place of binary32.
  CHECK(draw({std::nextafter(2.0f, 3.0f), 2}) == 1);
  CHECK(draw({2, std::nextafter(2.0f, 3.0f)}) == 0);
}

// Surfaces with maps have their own clusters, and the nearest clusters are drawn first. Here these belong to the later
// surfaces: their second triangles lie in front of the first ones, off to the side.
TEST_CASE("SoftwareRenderer keeps the earlier surface on a tie, even if a later one was drawn before it",
          "[renderer]") {
  raster::DrawList list = plainList();
  list.indexMaps.push_back({1, 1, {0}});
  for (ItemId id = 0; id < 6; ++id) {
    const float near = 1 - 0.1f * static_cast<float>(id);
    addDraw(list, id, {}, 0);
    addTriangle(list, {{-1, -1, 1}, {3, -1, 1}, {-1, 3, 1}});
    addTriangle(list, {{-near, -near, near}, {-0.75f * near, -near, near}, {-near, -0.75f * near, near}});
  }
  const raster::ItemBuffer buffer = drawOne(list, frontFace(64));
  CHECK(buffer.ids[0] == 5);
  CHECK(std::count(buffer.ids.begin(), buffer.ids.end(), 0U) > 64 * 64 * 9 / 10);
  CHECK(std::count(buffer.ids.begin(), buffer.ids.end(), 0U) + std::count(buffer.ids.begin(), buffer.ids.end(), 5U) ==
        64 * 64);
}

TEST_CASE("SoftwareRenderer finds ties of coplanar triangles exactly where their depth is constant", "[renderer]") {
  // In double precision 1/w rounds differently for different triangles of the plane w = 0.3; exact arithmetic finds the
  // tie.
  const float w = 0.3f;
  std::mt19937 random(3);
  bool holds = true;
  for (int repeat = 0; repeat < 20; ++repeat) {
    raster::DrawList list = plainList();
    for (ItemId id = 0; id < 6; ++id) {
      const auto far = [&](float x, float y) {
        return glm::vec3(w * x * uniform(random, 4, 7), w * y * uniform(random, 4, 7), w);
      };
      addDraw(list, id);
      addTriangle(list, {far(-1, -1), far(1, -1), far(0, 1)});
    }
    const raster::ItemBuffer buffer = drawOne(list, frontFace(16));
    holds &= std::count(buffer.ids.begin(), buffer.ids.end(), 0u) == 256;
  }
  CHECK(holds);
}

TEST_CASE("SoftwareRenderer draws back-facing triangles with the back item ID, also in mirrored views", "[renderer]") {
  raster::DrawList list;
  list.format = {{8, 8, 8}};
  list.indexMaps.push_back({1, 1, {5}});
  addDraw(list, 0x100, 0xfffffe, 0);
  addTriangle(list, {{-1, -1, 1}, {3, -1, 1}, {-1, 3, 1}});
  raster::Face face = frontFace(4);
  // With x to the right and rows downwards, the corners wind clockwise. The determinant is +1 and the snapped area is
  // positive. Equal signs mean back-facing.
  CHECK(drawOne(list, face).ids[0] == 0xfffffe);
  face.x = -face.x;  // mirrors the picture, not the surface
  CHECK(drawOne(list, face).ids[0] == 0xfffffe);
  std::swap(list.indices[0], list.indices[1]);
  CHECK(drawOne(list, face).ids[0] == 0x105);
  face.x = -face.x;
  CHECK(drawOne(list, face).ids[0] == 0x105);
  list.draws[0].back.reset();
  std::swap(list.indices[0], list.indices[1]);
  CHECK(drawOne(list, face).ids[0] == 0x105);
}

TEST_CASE("SoftwareRenderer determines the facing by the side of the plane on which the eye lies", "[renderer]") {
  // The normal of a counter-clockwise triangle points at a viewer for whom (p - eye) . normal < 0.
  std::mt19937 random(11);
  bool holds = true;
  for (int repeat = 0; repeat < 500; ++repeat) {
    raster::DrawList list = plainList();
    addDraw(list, 1, 2);
    const auto point = [&] { return glm::vec3{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, 2, 3)}; };
    const glm::vec3 a = point(), b = point(), c = point();
    addTriangle(list, {a, b, c});
    const float side = glm::dot(a, glm::cross(b - a, c - a));
    raster::Face face = frontFace(32);
    if (random() % 2 == 0) face.y = -face.y;
    for (const ItemId id : drawOne(list, face).ids)
      holds &= id == background || std::abs(side) < 1e-3f || id == (side < 0 ? 1u : 2u);
  }
  CHECK(holds);
}

TEST_CASE("SoftwareRenderer gives a sample on a texel border the texel that begins there", "[renderer]") {
  // A wall seen straight on covers the view with u = (x + 1)/2 and a map of N columns. With R = N pixels the border k/N
  // lies at x = 2k/N - 1, between samples. Shifting the wall by half a pixel puts each border on a sample: sample i
  // then has u = (i + 1)/N, exactly the lower border of texel i + 1.
  const int n = 64;
  raster::DrawList list = plainList();
  list.indexMaps.push_back(countingMap(n, 1));
  addDraw(list, 0, {}, 0);
  const float shift = -1.0f / n;
  addTriangle(list, {{-1 + shift, -1, 1}, {3 + shift, -1, 1}, {-1 + shift, 3, 1}}, {{0, 0}, {2, 0}, {0, 2}});
  const raster::ItemBuffer buffer = drawOne(list, frontFace(n));
  bool holds = true;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column)
      holds &=
          buffer.ids[static_cast<std::size_t>(n * row + column)] == static_cast<ItemId>(std::min(column + 1, n - 1));
  CHECK(holds);
}

TEST_CASE("SoftwareRenderer shows the texels of a wall also where small triangles make the wall", "[renderer]") {
  // A wall in the picture plane. Corners are on pixels, so that 1/w and the texture coordinates are the same linear
  // functions. A small triangle has one texel, or some. The bits of the offset are none of the texels', or some.
  const raster::Face face = frontFace(128);
  for (const auto& [columns, rows] : {std::pair(4, 4), std::pair(5, 5), std::pair(64, 64), std::pair(1, 64)})
    for (const raster::ItemId offset : {0x10000U, 3U})
      for (const int cuts : {8, 32, 64}) {
        INFO(columns << " x " << rows << " texels, " << cuts << " cuts, offset " << offset);
        const auto wallOf = [&, width = columns, height = rows](int parts) {
          raster::DrawList list = plainList();
          list.indexMaps.push_back(countingMap(width, height));
          addDraw(list, offset, std::nullopt, 0);
          const auto texcoord = [&](int i, int j) { return glm::vec2(i, j) / static_cast<float>(parts); };
          const auto point = [&](int i, int j) { return glm::vec3(2.0F * texcoord(i, j) - 1.0F, 1); };
          for (int j = 0; j < parts; ++j)
            for (int i = 0; i < parts; ++i)
              for (const int k : {0, 1})
                addTriangle(list, {point(i, j), point(i + 1, j + k), point(i + 1 - k, j + 1)},
                            {texcoord(i, j), texcoord(i + 1, j + k), texcoord(i + 1 - k, j + 1)});
          return list;
        };
        const std::vector<ItemId> whole = drawOne(wallOf(1), face).ids;
        CHECK(std::count(whole.begin(), whole.end(), background) == 0);
        CHECK(drawOne(wallOf(cuts), face).ids == whole);
      }
}

TEST_CASE("SoftwareRenderer equals the rational definition of depth, texel and coverage on random triangles",
          "[renderer]") {
  // docs/item-buffers.md, "cover" to "texel", in rational numbers for unclipped triangles.
  using Rational = boost::multiprecision::cpp_rational;
  const int resolution = 16, mapSize = 23;
  std::mt19937 random(5);
  bool coverageHolds = true, texelHolds = true;
  int covered = 0;
  for (int repeat = 0; repeat < 300; ++repeat) {
    raster::DrawList list = plainList();
    list.indexMaps.push_back(countingMap(mapSize, mapSize));
    addDraw(list, 0, {}, 0);
    std::array<glm::vec3, 3> p;
    std::array<glm::vec2, 3> t;
    for (std::size_t k = 0; k < 3; ++k) {
      const float w = uniform(random, 0.5f, repeat % 2 == 0 ? 1.0f : 40.0f);
      // Half of the vertices lie on multiples of half a sub-pixel, and half of the coordinates on texel borders.
      const auto grid = [&](float x) { return k != 0 ? x : std::nearbyint(x * 4096) / 4096; };
      p[k] = {grid(uniform(random, -2, 2)) * w, grid(uniform(random, -2, 2)) * w, w};
      const auto border = [&](float x) { return k == 1 ? x : std::nearbyint(x * mapSize) / mapSize; };
      t[k] = {border(uniform(random, -0.1f, 1.1f)), border(uniform(random, 0, 1))};
    }
    addTriangle(list, {p[0], p[1], p[2]}, {t[0], t[1], t[2]});
    const raster::ItemBuffer buffer = drawOne(list, frontFace(resolution));

    std::array<std::int64_t, 3> x, y;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto snap = [&](float a, float w) {
        return static_cast<std::int64_t>(
            std::nearbyint((static_cast<double>(a) / static_cast<double>(w) + 1) * (128.0 * resolution)));
      };
      x[k] = snap(p[k].x, p[k].z);
      y[k] = snap(p[k].y, p[k].z);
    }
    const std::int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    for (int row = 0; row < resolution; ++row)
      for (int column = 0; column < resolution; ++column) {
        const std::int64_t sx = 256 * column + 128, sy = 256 * row + 128;
        bool inside = area != 0;
        std::array<Rational, 3> weight;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
          const std::int64_t sign = area > 0 ? 1 : -1;
          const std::int64_t value = sign * ((x[b] - x[a]) * (sy - y[a]) - (y[b] - y[a]) * (sx - x[a]));
          const bool top = y[a] == y[b] && sign * (x[b] - x[a]) > 0;
          const bool left = sign * (y[a] - y[b]) > 0;
          inside &= value > 0 || (value == 0 && (top || left));
          weight[k] = Rational(value);
        }
        const ItemId id = buffer.ids[static_cast<std::size_t>(resolution * row + column)];
        coverageHolds &= inside == (id != background);
        if (!inside) continue;
        ++covered;
        Rational inverseDepth, u, v;
        for (std::size_t k = 0; k < 3; ++k) {
          inverseDepth += weight[k] / Rational(p[k].z);
          u += weight[k] * Rational(t[k].x) / Rational(p[k].z);
          v += weight[k] * Rational(t[k].y) / Rational(p[k].z);
        }
        const auto texel = [&](const Rational& sum) {
          const Rational position = sum / inverseDepth * mapSize;
          if (position < 0) return 0;
          return std::min(boost::multiprecision::cpp_int(numerator(position) / denominator(position)).convert_to<int>(),
                          mapSize - 1);
        };
        texelHolds &= id == static_cast<ItemId>(texel(v) * mapSize + texel(u));
      }
  }
  CHECK(covered > 10000);
  CHECK(coverageHolds);
  CHECK(texelHolds);
}

TEST_CASE("SoftwareRenderer leaves out skipped triangles and draws the others as before", "[renderer]") {
  std::mt19937 random(4);
  const raster::DrawList list = jitteredGrid(random, 4, 1, false);
  const std::vector<std::vector<std::uint32_t>> cases{{0, 3, 4, 17, 31}, {0}, {31}};
  for (const std::vector<std::uint32_t>& skipped : cases) {
    raster::DrawList rest = list;
    rest.draws.clear();
    for (std::uint32_t t = 0; t < list.indices.size() / 3; ++t)
      if (!std::binary_search(skipped.begin(), skipped.end(), t)) rest.draws.push_back({3 * t, 3, 0, {}, {}});
    CHECK(drawOne(list, frontFace(32), skipped).ids == drawOne(rest, frontFace(32)).ids);
  }
}

TEST_CASE("SoftwareRenderer drops and counts triangles with values that are not finite", "[renderer]") {
  raster::DrawList list = plainList();
  addDraw(list, 0);
  const float nan = std::numeric_limits<float>::quiet_NaN(), huge = std::numeric_limits<float>::max();
  addTriangle(list, {{-1, -1, 1}, {3, -1, 1}, {nan, 3, 1}});
  addTriangle(list, {{-1, -1, 1}, {3, -1, 1}, {-1, 3, 1}}, {{0, 0}, {nan, 0}, {0, 0}});
  addTriangle(list, {{huge, huge, huge}, {3, -1, 1}, {-1, 3, 1}});
  raster::Face face = frontFace(4);
  face.x = {2, 0, 0};  // twice the largest float overflows
  raster::SoftwareRenderer renderer(list);
  const raster::ItemBuffer buffer = render(renderer, {&face, 1}, {}).front();
  CHECK(std::count(buffer.ids.begin(), buffer.ids.end(), background) == 16);
}

TEST_CASE("SoftwareRenderer draws pinned bits with any number of threads", "[renderer]") {
  const raster::DrawList list = crossingTriangles();
  const std::array<raster::Face, 3> faces = threeFaces();
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 7}) {
    const raster::ThreadLimit limit(threads);
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const raster::ItemBuffer& buffer : render(raster::SoftwareRenderer(list), faces, {}))
      hash = fnv1a(buffer.ids, hash);
    hashes.push_back(hash);
  }
  CHECK(hashes[0] == hashes[1]);
  CHECK(hashes[0] == hashes[2]);
  CHECK(hashes[0] == 0x371ce9d26ebca796u);
}

/// The item IDs of each face, copied when drawEach reports the face, and the number of reports.
struct Told {
  std::vector<raster::ItemBuffer> buffers;
  std::vector<std::atomic<int>> times;
};

Told drawnEach(raster::ItemBufferRenderer& renderer, std::span<const raster::Face> faces) {
  Told told{std::vector<raster::ItemBuffer>(faces.size()), std::vector<std::atomic<int>>(faces.size())};
  std::vector<raster::ItemBuffer> buffers;
  renderer.draw(faces, {}, buffers, [&](std::size_t f) {
    told.buffers[f] = buffers[f];
    ++told.times[f];
  });
  return told;
}

TEST_CASE("draw calls drawn(f) once for each face, when its buffer is complete", "[renderer]") {
  raster::SoftwareRenderer renderer(crossingTriangles());
  const std::array<raster::Face, 3> faces = threeFaces();
  const std::vector<raster::ItemBuffer> expected = render(renderer, faces, {});
  for (const int threads : {1, 2, 7}) {
    const raster::ThreadLimit limit(threads);
    const Told told = drawnEach(renderer, faces);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      CHECK(told.times[f] == 1);
      CHECK(told.buffers[f].ids == expected[f].ids);
    }
  }
}

TEST_CASE("ItemBufferRenderer::draw ignores previous contents of the buffers", "[renderer]") {
  const std::array<raster::Face, 3> faces = threeFaces();
  raster::SoftwareRenderer renderer(crossingTriangles());
  std::vector<raster::ItemBuffer> buffers(5, {7, 1, std::vector<raster::ItemId>(7, 12345)});
  // More, fewer, larger and smaller buffers than before.
  for (const std::size_t first : {2, 0, 1}) {
    const std::span<const raster::Face> some = std::span(faces).subspan(first);
    draw(renderer, some, {}, buffers);
    const std::vector<raster::ItemBuffer> expected = render(renderer, some, {});
    REQUIRE(buffers.size() == expected.size());
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      CHECK(buffers[i].width == expected[i].width);
      CHECK(buffers[i].height == expected[i].height);
      CHECK(buffers[i].ids == expected[i].ids);
    }
  }
}

TEST_CASE("validate accepts index maps of at most 2^31 texels, whose numbers all kernels can store", "[renderer]") {
  raster::DrawList list = plainList();
  list.indexMaps.push_back({65536, 32769, {}});
  CHECK_THROWS_WITH(raster::validate(list), Catch::Contains("2^31"));
  // The largest size, without its item IDs.
  list.indexMaps[0] = {65536, 32768, {}};
  CHECK_THROWS_WITH(raster::validate(list), Catch::Contains("width x height item IDs"));
}

TEST_CASE("validate throws InputError for draw lists and faces that break the rules", "[renderer]") {
  const auto list = [] {
    raster::DrawList good;
    good.format = {{8, 8, 8}};
    good.indexMaps.push_back(countingMap(16, 16));
    addDraw(good, 0, 0xfffffe, 0);
    addTriangle(good, {{-1, -1, 1}, {3, -1, 1}, {-1, 3, 1}});
    return good;
  };
  CHECK_NOTHROW(raster::validate(list()));
  const auto broken = [&](auto&& change) {
    raster::DrawList bad = list();
    change(bad);
    CHECK_THROWS_AS(raster::SoftwareRenderer(bad), raster::InputError);
  };
  broken([](raster::DrawList& l) { l.indices[2] = 3; });
  broken([](raster::DrawList& l) { l.texcoords.pop_back(); });
  broken([](raster::DrawList& l) { l.draws[0].count = 6; });
  broken([](raster::DrawList& l) { l.draws[0].count = 2; });
  broken([](raster::DrawList& l) { l.draws[0].first = 1; });
  broken([](raster::DrawList& l) { l.draws[0].indexMap = 1; });
  broken([](raster::DrawList& l) { l.indexMaps[0].ids.pop_back(); });
  broken([](raster::DrawList& l) { l.indexMaps[0].ids[3] = 0x1000000; });
  broken([](raster::DrawList& l) { l.draws[0].offset = 0x1000000; });
  broken([](raster::DrawList& l) { l.draws[0].back = 0xffffff; });
  broken([](raster::DrawList& l) { l.draws[0].offset = 0xffff00; });  // texel 255 gives the background
  broken([](raster::DrawList& l) { l.format.channelBits = {8, 8, 8, 9}; });

  const auto brokenFace = [&](auto&& change) {
    raster::Face face = frontFace(8);
    change(face);
    CHECK_THROWS_AS(render(raster::SoftwareRenderer(list()), {&face, 1}, {}), raster::InputError);
  };
  brokenFace([](raster::Face& f) { f.resolution = 7; });
  brokenFace([](raster::Face& f) { f.resolution = 4098; });
  brokenFace([](raster::Face& f) { f.nearDistance = 0; });
  brokenFace([](raster::Face& f) { f.w = f.x; });
  brokenFace([](raster::Face& f) { f.scissor.width = 9; });
  brokenFace([](raster::Face& f) { f.scissor.row = -1; });
  brokenFace([](raster::Face& f) { f.eye.x = std::numeric_limits<float>::infinity(); });
}
