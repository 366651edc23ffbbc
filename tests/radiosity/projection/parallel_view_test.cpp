// sphereDirections and ParallelViews: directions that integrate cosines, and views that measure cross-sections.
#include "radiosity/projection/parallel_view.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "radiosity/projection/patch_view.h"
#include "raster/software/software_renderer.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// The scene as it is drawn, each triangle with its number.
raster::DrawList trianglesOf(const Scene& scene) {
  raster::DrawList list;
  list.format = *raster::formatNamed("r32ui");
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles) {
      raster::Draw draw;
      draw.first = static_cast<std::uint32_t>(list.indices.size());
      draw.count = 3;
      draw.offset = static_cast<raster::ItemId>(list.draws.size());
      list.draws.push_back(draw);
      for (const glm::dvec3& corner : triangle.position) {
        list.indices.push_back(static_cast<std::uint32_t>(list.positions.size()));
        list.positions.emplace_back(corner - scene.origin);
        list.texcoords.emplace_back(0);
      }
    }
  return list;
}

}  // namespace

TEST_CASE("sphereDirections are unit vectors in all directions, which give the mean cosine over a plane",
          "[parallel_view]") {
  for (const int count : {64, 512, 4096}) {
    const std::vector<glm::dvec3> directions = sphereDirections(count);
    REQUIRE(directions.size() == static_cast<std::size_t>(count));
    glm::dvec3 sum(0);
    for (const glm::dvec3& direction : directions) {
      CHECK(glm::length(direction) == Approx(1).epsilon(1e-12));
      sum += direction;
    }
    CHECK(glm::length(sum) / count < 0.5 / count);
    // The mean of max(cos, 0) over the sphere is a quarter. The error falls faster than 1 / count.
    for (const glm::dvec3& normal : sphereDirections(61)) {
      double cosines = 0;
      for (const glm::dvec3& direction : directions) cosines += std::max(glm::dot(direction, normal), 0.0);
      CHECK(cosines / count == Approx(0.25).epsilon(1.0 / count));
    }
  }
}

TEST_CASE("sphereDirections have the same bits everywhere", "[parallel_view]") {
  const std::vector<glm::dvec3> directions = sphereDirections(512);
  CHECK(directions[0].z == 511.0 / 512);
  CHECK(directions[511].x == 0x1.98a732f4f4776p-6);
  CHECK(directions[511].y == 0x1.d53079f8e4476p-5);
}

TEST_CASE("ParallelViews show a triangle in as many pixels as its cross-section has", "[parallel_view]") {
  Scene scene;
  scene.surfaces = {tests::flat("sheet", {{glm::dvec2(0, 0), glm::dvec2(0.9, 0.1), glm::dvec2(0.3, 0.8)}}),
                    tests::parallelogram("far", {7, -3, 2}, {0.5, 0, 0}, {0, 0, 0.5})};
  scene = tests::finish(std::move(scene));
  const ParallelViews views{boundingSphere(scene), 512};
  const double pixelArea = views.pixelSide() * views.pixelSide();
  raster::SoftwareRenderer renderer(trianglesOf(scene));
  const std::vector<glm::dvec3> directions = sphereDirections(64);
  double pixels = 0, crossSection = 0, inScissor = 0;
  for (std::uint32_t i = 0; i < 64; ++i) {
    const raster::Face face = views.face(scene.origin, directions[i], i);
    raster::validate(face);
    raster::Face whole = face;
    whole.scissor = {0, 0, 512, 512};
    const std::vector<raster::ItemBuffer> buffers = raster::render(renderer, {{face, whole}});
    const raster::ItemId background = raster::backgroundId(*raster::formatNamed("r32ui"));
    const auto shown = [&](const raster::ItemBuffer& buffer) {
      return static_cast<std::ptrdiff_t>(buffer.ids.size()) -
             std::count(buffer.ids.begin(), buffer.ids.end(), background);
    };
    // The scissor rectangle leaves out no pixel of the scene, and most others.
    CHECK(shown(buffers[0]) == shown(buffers[1]));
    inScissor += static_cast<double>(buffers[0].ids.size());
    const double seen = static_cast<double>(std::count(buffers[1].ids.begin(), buffers[1].ids.end(), 0u));
    const double expected = std::abs(directions[i].z) * area(scene.surfaces[0].triangles[0]) / pixelArea;
    CHECK(std::abs(seen - expected) < 60);
    pixels += seen;
    crossSection += expected;
    // Nothing is cut off at the borders.
    for (std::size_t k = 0; k < 512; ++k) CHECK(buffers[1].ids[k] == background);
  }
  CHECK(inScissor < 0.7 * 64 * 512 * 512);
  CHECK(pixels == Approx(crossSection).epsilon(0.004));
}

TEST_CASE("trianglesFacingAway with onlyTwins are the hidden sides of two-sided scenes", "[parallel_view]") {
  Scene scene;
  scene.surfaces = {tests::parallelogram("front", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                    tests::parallelogram("back", {0, 0, 0}, {0, 1, 0}, {1, 0, 0})};
  CHECK(trianglesFacingAway(scene, {0, 0, 9}, true).empty());
  makeTwins(scene.surfaces, 0, 1);
  CHECK(trianglesFacingAway(scene, {0, 0, 9}, true) == std::vector<std::uint32_t>{2, 3});
  CHECK(trianglesFacingAway(scene, {0, 0, -9}, true) == std::vector<std::uint32_t>{0, 1});
}
