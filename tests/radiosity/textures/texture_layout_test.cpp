/// Layouts of textures: which surfaces share one, and how display textures are magnified.
#include "radiosity/textures/texture_layout.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/picture_scenes.h"

using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

/// The magnification of each surface.
std::vector<int> magnificationsOf(const TextureLayout& layout) {
  std::vector<int> magnifications;
  for (const TexturePlace& place : layout.places)
    magnifications.push_back(layout.textures[static_cast<std::size_t>(place.texture)].magnification);
  return magnifications;
}

std::vector<int> magnificationsOf(const ChartScene& charts, const Magnification& magnification) {
  return magnificationsOf(layOutTextures(charts.scene, charts.discretization, magnification));
}

}  // namespace

TEST_CASE("layOutTextures gives few surfaces their own textures, and many surfaces shared ones", "[texture]") {
  const ChartScene few = makeCharts(std::vector<glm::ivec2>(64, {4, 2}));
  const TextureLayout separate = layOutTextures(few.scene, few.discretization, {1});
  CHECK(separate.textures.size() == 64);
  CHECK(separate.textures[5].width == 6);
  CHECK(separate.textures[5].height == 4);
  CHECK(separate.names[0] == "chart");
  CHECK(separate.names[63] == "chart-64");

  const ChartScene many = makeCharts(std::vector<glm::ivec2>(65, {4, 2}));
  const TextureLayout packed = layOutTextures(many.scene, many.discretization, {1});
  REQUIRE(packed.textures.size() == 1);  // 65 x 6 x 4 = 1560 pixels
  CHECK(packed.textures[0].width == 64);
  CHECK(packed.names[0] == "radiosity-1");
}

TEST_CASE("layOutTextures gives a chart larger than a shared texture its own texture", "[texture]") {
  const ChartScene charts = makeCharts({{4096, 1}, {1, 1}});
  const TextureLayout layout = layOutTextures(charts.scene, charts.discretization, {1}, 0);
  REQUIRE(layout.textures.size() == 2);
  CHECK(layout.places[0].texture == 1);
  CHECK(layout.textures[1].width == 4098);
  CHECK(layout.textures[1].height == 3);
}

TEST_CASE("layOutTextures magnifies by the smallest power of two that gives 128 texels along the longer side",
          "[texture]") {
  const ChartScene charts = makeCharts({{128, 5}, {127, 127}, {3, 64}, {16, 16}, {2, 1}, {4096, 4}});
  CHECK(magnificationsOf(charts, {}) == std::vector{1, 2, 2, 8, 64, 1});
  CHECK(magnificationsOf(charts, {3}) == std::vector(6, 3));
}

TEST_CASE("layOutTextures does not magnify surfaces of one element in several texels, which have one colour",
          "[texture]") {
  ChartScene charts = makeCharts({{1, 1}, {4, 4}, {4, 4}});
  Grid& merged = charts.discretization.grids[2];
  merged.elementCount = 1;
  merged.elementOfTexel.assign(16, merged.firstElement);
  CHECK(magnificationsOf(charts, {}) == std::vector{4, 32, 1});
}

TEST_CASE("layOutTextures gives surfaces of one texel 4 x 4 texels, or 8 per triangle", "[texture]") {
  ChartScene charts = makeCharts({{1, 1}, {1, 1}, {1, 1}});
  std::vector<Triangle>& many = charts.scene.surfaces[1].triangles;
  while (many.size() < 9) many.push_back(many.front());
  std::vector<Triangle>& very = charts.scene.surfaces[2].triangles;
  very.resize(5000, very.front());
  CHECK(magnificationsOf(charts, {}) == std::vector{4, 16, 128});
}

TEST_CASE("layOutTextures halves the largest magnification until all display texels are within the budget",
          "[texture]") {
  const ChartScene charts = makeCharts({{4, 4}, {16, 16}, {16, 16}});
  const auto texels = [](int small, int large) {  // with borders
    return std::int64_t{36} * small * small + std::int64_t{2 * 18 * 18} * large * large;
  };
  CHECK(displayTexels(layOutTextures(charts.scene, charts.discretization, {}).textures) == texels(32, 8));
  const std::vector<std::array<int, 2>> steps{{32, 8}, {16, 8}, {8, 8}, {4, 4}, {2, 2}, {1, 1}};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto [small, large] = steps[i];
    const std::vector<int> expected{small, large, large};
    CHECK(magnificationsOf(charts, {{}, texels(small, large)}) == expected);
    if (i > 0) CHECK(magnificationsOf(charts, {{}, texels(steps[i - 1][0], steps[i - 1][1]) - 1}) == expected);
  }
  CHECK(magnificationsOf(charts, {{}, 1}) == std::vector{1, 1, 1});  // one texel per element remains
}

TEST_CASE("layOutTextures counts borders and gaps of shared textures in the budget", "[texture]") {
  // Each surface has 6 x 6 texels with its border. 25 of them fit into 32 x 32 texels, which are 1024 display texels.
  const ChartScene charts = makeCharts(std::vector<glm::ivec2>(250, {4, 4}));
  const TextureLayout layout = layOutTextures(charts.scene, charts.discretization, {});
  CHECK(layout.textures.size() == 10);
  CHECK(displayTexels(layout.textures) == 10 * 1024 * 1024);
  CHECK(magnificationsOf(layout) == std::vector(250, 32));
  CHECK(magnificationsOf(charts, {{}, 10 * 1024 * 1024 - 1}) == std::vector(250, 16));
  CHECK(displayTexels(layOutTextures(charts.scene, charts.discretization, {{}, 250 * 36 * 256}).textures) <=
        250 * 36 * 256);
}

TEST_CASE("layOutTextures shares textures of at most 1024 x 1024 display texels among equal magnifications",
          "[texture]") {
  std::vector<glm::ivec2> grids;
  for (int i = 0; i < 400; ++i) grids.emplace_back(1 + i % 31, 1 + i % 17);
  const ChartScene charts = makeCharts(grids);
  const TextureLayout layout = layOutTextures(charts.scene, charts.discretization, {});
  const std::vector<int> found = magnificationsOf(layout);
  for (std::size_t s = 0; s < grids.size(); ++s) {
    const int side = std::max(grids[s].x, grids[s].y), magnified = side * found[s];
    CHECK((side == 1 ? found[s] == 4 : magnified >= 128 && magnified < 256));
  }
  for (const TextureLayout::Size& size : layout.textures) {
    CHECK(size.width * size.magnification <= 1024);
    CHECK(size.height * size.magnification <= 1024);
  }
}
