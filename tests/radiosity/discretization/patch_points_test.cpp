#include "radiosity/discretization/patch_points.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

Scene sceneOf(const Surface& surface) {
  Scene scene;
  scene.materials.emplace_back();
  scene.surfaces = {surface};
  return tests::finish(std::move(scene));
}

double areaOf(const std::vector<ShootingBlock>& blocks) {
  return std::accumulate(blocks.begin(), blocks.end(), 0.0,
                         [](double sum, const ShootingBlock& block) { return sum + block.area; });
}

}  // namespace

TEST_CASE("shootingBlocks of a square patch have their centres at the middles of the blocks", "[patch_points]") {
  const Scene scene = sceneOf(tests::parallelogram("square", {1, 2, 3}, {2, 0, 0}, {0, 4, 0}));
  const Discretization discretization = discretize(scene, {.texels = 1});
  Patch patch = discretization.patches.list.front();
  patch.points = 4;
  const std::vector<ShootingBlock> blocks = shootingBlocks(scene, discretization, patch);
  REQUIRE(blocks.size() == 16);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const ShootingBlock& block = blocks[static_cast<std::size_t>(4 * j + i)];
      CHECK(glm::length(block.centre.position - glm::dvec3(1.25 + 0.5 * i, 2.5 + j, 3)) < 1e-15);
      CHECK(block.centre.normal == glm::dvec3(0, 0, 1));
      CHECK(block.area == Approx(0.5).epsilon(1e-15));
    }
}

TEST_CASE("shootingBlocks cover the patch, and each centre lies in its block, on the surface", "[patch_points]") {
  for (const Surface& surface : {tests::lShape(), tests::ring(24), tests::star(40, 3), tests::bump(8)}) {
    CAPTURE(surface.name);
    const Scene scene = sceneOf(surface);
    const Discretization discretization = discretize(scene, {.texels = 1});
    double whole = 0;
    for (const Triangle& triangle : surface.triangles) whole += area(triangle);
    for (const int points : {1, 2, 4, 8, 16}) {
      Patch patch = discretization.patches.list.front();
      patch.points = points;
      const std::vector<ShootingBlock> blocks = shootingBlocks(scene, discretization, patch);
      CHECK(areaOf(blocks) == Approx(whole).epsilon(1e-12));
      for (const ShootingBlock& block : blocks) {
        REQUIRE(block.centre.triangle < surface.triangles.size());
        const Triangle& triangle = surface.triangles[block.centre.triangle];
        const double height = glm::dot(block.centre.position - triangle.position[0], normal(triangle));
        CHECK(std::abs(height) < 1e-15);
      }
    }
  }
}

TEST_CASE("shootingBlock returns nothing where the chart has a hole", "[patch_points]") {
  const Scene scene = sceneOf(tests::lShape());
  const Discretization discretization = discretize(scene, {.texels = 1});
  Patch patch = discretization.patches.list.front();
  patch.points = 2;
  CHECK(shootingBlocks(scene, discretization, patch).size() == 3);
  const Grid& grid = discretization.grids.front();
  CHECK_FALSE(shootingBlock(scene.surfaces.front(), grid, {0.5, 0.5}, {0.5, 0.5}).has_value());
  // A third of this block is covered, below and left of its middle; its centre is the centroid of that third.
  const auto block = shootingBlock(scene.surfaces.front(), grid, {0.25, 0.25}, {0.75, 0.75});
  REQUIRE(block.has_value());
  CHECK(block->area == Approx(0.75 * 0.25 + 0.25 * 0.5).epsilon(1e-14));
  CHECK((block->centre.position.x <= 0.5 || block->centre.position.y <= 0.5));
}
