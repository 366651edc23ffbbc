// Kernels::place gives the same results with each instruction set, bit for bit, and those of the rules.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <limits>

#include "raster/kernels/kernels.h"
#include "raster/plain/rules.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::raster;

namespace {

/// Draws of 1 to 32 triangles around the eye and far beyond the range of binary32. Some vertices lie on the near plane,
/// on the sides of the view and on those of the guard band.
DrawList allAround() {
  std::mt19937 random(3);
  DrawList list = tests::plainList();
  const auto value = [&](float size) { return tests::uniform(random, -size, size); };
  for (std::uint32_t draw = 0; draw < 400; ++draw) {
    tests::addDraw(list, draw);
    const float size = draw % 50 == 0 ? 3e38F : draw % 7 == 0 ? 1e20F : 4;
    for (std::uint32_t t = 0; t <= draw % 32; ++t) {
      std::array<glm::vec3, 3> corners;
      for (glm::vec3& p : corners) {
        p = {value(size), value(size), value(size)};
        if (random() % 8 == 0) p.z = 0.5F;
        if (random() % 8 == 0) p.x = p.z * static_cast<float>(1U << (random() % 4));
        if (random() % 8 == 0) p.y = -p.z * static_cast<float>(1U << (random() % 4));
        if (random() % 200 == 0) p.x = std::numeric_limits<float>::infinity();
      }
      tests::addTriangle(list, {corners[0], corners[1], corners[2]});
    }
  }
  return list;
}

/// All results of `place` for a part; floats as bits.
std::vector<std::uint32_t> placed(const Kernels& kernels, const ClusterMesh& mesh, const ClusterPart& part,
                                  const Face& face) {
  PlacedVertices vertices;
  const TriangleSets sets = kernels.place(mesh, part, face, vertices);
  std::vector<std::uint32_t> all{sets.whole, sets.cut, sets.small, sets.tiny};
  for (std::size_t i = 0; i < part.vertices; ++i) {
    const float w = vertices.w[i];
    all.insert(all.end(), {w == w ? std::bit_cast<std::uint32_t>(w) : 0, static_cast<std::uint32_t>(vertices.x[i]),
                           static_cast<std::uint32_t>(vertices.y[i]), static_cast<std::uint32_t>(vertices.sides[i])});
  }
  return all;
}

std::vector<Face> facesOfAllSizes() {
  std::vector<Face> all;
  for (const Face& face : tests::threeFaces()) all.push_back(face);
  all.push_back(tests::frontFace(4096));
  all.back().scissor = {1000, 7, 200, 4089};
  all.push_back(tests::frontFace(2));
  all.push_back(all.back());
  all.back().w *= 1e30F;
  return all;
}

}  // namespace

TEST_CASE("Kernels::place gives the same vertices with each instruction set", "[vertex_kernels]") {
  const DrawList list = allAround();
  const ClusterMesh mesh = meshOf(list, clustersOf(list));
  std::uint32_t whole = 0, cut = 0, small = 0, tiny = 0, sides = 0;
  for (const Face& face : facesOfAllSizes())
    for (const ClusterPart& part : mesh.parts) {
      const std::vector<std::uint32_t> plain = placed(allKernels().back(), mesh, part, face);
      for (const Kernels& kernels : allKernels()) {
        INFO(kernels.instructionSet << ", " << part.vertices << " vertices");
        REQUIRE(placed(kernels, mesh, part, face) == plain);
      }
      whole |= plain[0];
      cut |= plain[1];
      small |= plain[2];
      tiny |= plain[3];
      CHECK((plain[2] & ~plain[0]) == 0);
      CHECK((plain[3] & ~plain[2]) == 0);
      for (std::size_t i = 7; i < plain.size(); i += 4) sides |= plain[i];
    }
  CHECK(whole == 0xffffffff);
  CHECK(cut == 0xffffffff);
  CHECK(std::popcount(small) > 20);
  CHECK(std::popcount(tiny) > 2);
  CHECK(sides == (beyondAny | notInside));
}

TEST_CASE("Kernels::place transforms and snaps a vertex inside the half-spaces as docs/item-buffers.md defines",
          "[vertex_kernels]") {
  const DrawList list = allAround();
  const ClusterMesh mesh = meshOf(list, clustersOf(list));
  const Face face = tests::frontFace(128);
  int inside = 0;
  PlacedVertices vertices;
  for (const ClusterPart& part : mesh.parts) {
    bestKernels().place(mesh, part, face, vertices);
    for (std::size_t i = 0; i < part.vertices; ++i) {
      const std::size_t v = part.firstVertex + i;
      const ViewVertex p = view(face, {mesh.positions[0][v], mesh.positions[1][v], mesh.positions[2][v]}, {});
      const ClippedPolygon unclipped = isFinite(p) ? clip({p, p, p}, face.nearDistance) : ClippedPolygon{};
      CHECK(((vertices.sides[i] & notInside) == 0) == (unclipped.count > 0));
      if (unclipped.count == 0) continue;
      ++inside;
      CHECK(vertices.w[i] == static_cast<float>(p.w));
      CHECK(vertices.x[i] == snap(p.x / p.w, face.resolution));
      CHECK(vertices.y[i] == snap(p.y / p.w, face.resolution));
    }
  }
  CHECK(inside > 1000);
}
