// Subdivided scenes: only the triangles change.
#include "tests/support/subdivided_scene.h"

#include <catch2/catch.hpp>
#include <map>
#include <tuple>

#include "radiosity/discretization/discretize.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/projection_kinds.h"
#include "radiosity/scene/load_scene.h"
#include "raster/software/software_renderer.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using radiosity::Scene;
using radiosity::Surface;
using radiosity::Triangle;
using tests::finerScene;

namespace {

const std::string room = HEMITEX_DATA "/paper-room.obj";

double areaOf(const Surface& surface) {
  double sum = 0;
  for (const Triangle& triangle : surface.triangles) sum += radiosity::area(triangle);
  return sum;
}

using Point = std::tuple<double, double, double>;
Point pointOf(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

/// Number of triangles with each directed edge.
std::map<std::pair<Point, Point>, int> edgesOf(const Surface& surface) {
  std::map<std::pair<Point, Point>, int> edges;
  for (const Triangle& triangle : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      ++edges[{pointOf(triangle.position[k]), pointOf(triangle.position[(k + 1) % 3])}];
  return edges;
}

}  // namespace

TEST_CASE("finerScene gives the number of triangles, or up to three more, which share the last edge", "[finer_scene]") {
  const Scene scene = radiosity::loadScene(room);
  const std::size_t own = radiosity::triangleCount(scene);
  CHECK(radiosity::triangleCount(finerScene(scene, 1)) == own);
  for (const std::size_t count : {own, own + 1, std::size_t{100}, std::size_t{5000}}) {
    const std::size_t found = radiosity::triangleCount(finerScene(scene, count));
    CHECK(found >= count);
    CHECK(found <= count + 3);
  }
}

TEST_CASE("finerScene keeps surfaces, areas, windings and elements", "[finer_scene]") {
  const Scene scene = radiosity::loadScene(room), finer = finerScene(scene, 3000);
  REQUIRE(finer.surfaces.size() == scene.surfaces.size());
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    CHECK(finer.surfaces[s].name == scene.surfaces[s].name);
    CHECK(finer.surfaces[s].triangles.size() > scene.surfaces[s].triangles.size());
    CHECK(areaOf(finer.surfaces[s]) == Approx(areaOf(scene.surfaces[s])).epsilon(1e-13));
    const glm::dvec3 normal = radiosity::normal(scene.surfaces[s].triangles.front());
    for (const Triangle& triangle : finer.surfaces[s].triangles)
      REQUIRE(glm::dot(radiosity::normal(triangle), normal) > 1 - 1e-12);
  }
  const radiosity::DiscretizationSettings settings{.texels = 12};
  const radiosity::Discretization whole = radiosity::discretize(scene, settings),
                                  cut = radiosity::discretize(finer, settings);
  REQUIRE(cut.elements.size() == whole.elements.size());
  for (std::size_t e = 0; e < whole.elements.size(); ++e) {
    CHECK(cut.elements[e].texel == whole.elements[e].texel);
    CHECK(cut.elements[e].area == Approx(whole.elements[e].area).epsilon(1e-12));
  }
}

TEST_CASE("finerScene leaves no vertex on an edge of a neighbour", "[finer_scene]") {
  // Then each edge of a square is either shared by two triangles, in opposite directions, or part of the border.
  const Scene square = tests::sceneOf({tests::parallelogram("square", {0, 0, 0}, {3, 0, 0}, {0, 2, 0})});
  for (const std::size_t count : {3U, 7U, 50U, 333U}) {
    const Scene finer = finerScene(square, count);
    double border = 0;
    const auto edges = edgesOf(finer.surfaces[0]);
    for (const auto& [edge, times] : edges) {
      CHECK(times == 1);
      const auto& [a, b] = edge;
      if (edges.contains({b, a})) continue;
      border += std::abs(std::get<0>(a) - std::get<0>(b)) + std::abs(std::get<1>(a) - std::get<1>(b));
      const bool isOutside = (std::get<0>(a) == std::get<0>(b) && (std::get<0>(a) == 0 || std::get<0>(a) == 3)) ||
                             (std::get<1>(a) == std::get<1>(b) && (std::get<1>(a) == 0 || std::get<1>(a) == 2));
      CHECK(isOutside);
    }
    CHECK(border == Approx(10));
  }
}

TEST_CASE("finerScene keeps neighbouring triangles together in the list", "[finer_scene]") {
  // 512 equal triangles of a square have short sides of 1/16. The distance of consecutive triangles is about that,
  // while the mean distance of any two triangles is half of the square.
  const Scene finer =
      finerScene(tests::sceneOf({tests::parallelogram("square", {0, 0, 0}, {1, 0, 0}, {0, 1, 0})}), 512);
  const std::vector<Triangle>& triangles = finer.surfaces[0].triangles;
  REQUIRE(triangles.size() == 512);
  double sum = 0;
  for (std::size_t t = 1; t < triangles.size(); ++t)
    sum += glm::length(triangles[t].position[0] - triangles[t - 1].position[0]);
  CHECK(sum / 511 < 2.0 / 16);
}

TEST_CASE("finerScene changes only pixels at borders", "[finer_scene]") {
  // New corners are rounded to binary32 and to 1/256 pixel. So only samples within that distance of a border between
  // texels or surfaces may change. Less than half of the pixels contain such a border, and in one of fifty of these the
  // sample is so close.
  const Scene scene = radiosity::loadScene(room), finer = finerScene(scene, 1000);
  const radiosity::DiscretizationSettings settings{.texels = 12};
  const auto drawn = [&](const Scene& what) {
    const radiosity::Discretization discretization = radiosity::discretize(what, settings);
    raster::SoftwareRenderer renderer(radiosity::makeDrawList(what, discretization, radiosity::layOut(discretization)));
    const auto faces =
        radiosity::facesOver(radiosity::hemicubeFaces(128), {0.1, 0.05, -0.2}, {0, 1, 0}, {0, 0, 1}, 0.01);
    return render(renderer, faces, {});
  };
  const std::vector<raster::ItemBuffer> before = drawn(scene), after = drawn(finer);
  std::size_t changed = 0, all = 0;
  for (std::size_t f = 0; f < before.size(); ++f)
    for (std::size_t i = 0; i < before[f].ids.size(); ++i, ++all)
      changed += before[f].ids[i] != after[f].ids[i] ? 1 : 0;
  INFO(changed << " of " << all);
  CHECK(changed > 0);
  CHECK(changed < all / 5000);
}
