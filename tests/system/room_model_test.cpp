// roomModel: the geometry and textures of a page, and what it leaves out.
#include "cli/view/room_model.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <string>

#include "cli/report/html_page.h"
#include "tests/support/box_scene.h"

using namespace hemitex;
using namespace hemitex::cli;
using radiosity::Image;
using radiosity::Scene;

namespace {

/// A cube of side 1 whose faces show one image, except for the last, which has corner colours.
Scene litCube() {
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(0));
  scene.materials[0].reflectanceMap = 0;
  scene.materials.push_back(tests::material("gouraud", glm::dvec3(0.5), glm::dvec3(0)));
  scene.surfaces.back().material = 1;
  for (radiosity::Triangle& triangle : scene.surfaces.back().triangles)
    triangle.cornerColor = {{glm::dvec3(0), glm::dvec3(0.2, 0.4, 0.6), glm::dvec3(1)}};
  return scene;
}

std::vector<radiosity::CodedImage> textures(int width, int height) {
  return {{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height))}};
}

const std::vector<std::uint32_t> numbers{5, 4, 3, 2, 1, 0};

/// The base64 text of binary32 numbers.
std::string lettersOf(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return base64(bytes);
}

glm::dvec3 meanOf(const Image& image) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& pixel : image.pixels) sum += pixel;
  return sum / static_cast<double>(image.pixels.size());
}

}  // namespace

TEST_CASE("roomModel holds each corner once, by texture, relative to the scene's centre and extent", "[cli]") {
  const Scene lit = litCube();
  const auto model = roomModel({lit, textures(4, 2), numbers});
  std::vector<float> positions;
  for (const radiosity::Surface& surface : lit.surfaces)
    for (const radiosity::Triangle& triangle : surface.triangles)
      for (const glm::dvec3& corner : triangle.position)
        for (int axis = 0; axis < 3; ++axis)
          positions.push_back(static_cast<float>((corner[axis] - 0.5) / std::sqrt(3.0)));
  CHECK(model["positions"] == lettersOf(positions));
  CHECK(model["parts"].dump() == R"([{"texture":0,"triangles":10},{"texture":null,"triangles":2}])");
  // Two triangles with the codes 0, (51, 102, 153) and 255 at their corners.
  const std::string colours = std::string(3, '\0') + "\x33\x66\x99" + std::string(3, '\xff');
  CHECK(model["colours"] == base64(colours + colours));
  std::string surfaces;
  for (char number = 5; number >= 0; --number)
    for (int triangle = 0; triangle < 2; ++triangle) surfaces += std::string(1, number) + std::string(3, '\0');
  CHECK(model["surfaces"] == base64(surfaces));
  CHECK(model["textures"].size() == 1);
  CHECK(model["left_out"].dump() == R"({"triangles":0,"texture_divisor":1})");
}

TEST_CASE("roomModel leaves out the smallest triangles and shrinks textures above its limits", "[cli]") {
  Scene lit = litCube();
  for (radiosity::Triangle& triangle : lit.surfaces[1].triangles)
    for (glm::dvec3& corner : triangle.position) corner *= 0.1;
  const auto model = roomModel({lit, textures(40, 40), numbers}, {.triangles = 10, .texels = 100});
  CHECK(model["left_out"].dump() == R"({"triangles":2,"texture_divisor":4})");
  CHECK(model["parts"].dump() == R"([{"texture":0,"triangles":8},{"texture":null,"triangles":2}])");
  std::string surfaces;
  for (const char number : std::vector<char>{5, 3, 2, 1, 0})
    for (int triangle = 0; triangle < 2; ++triangle) surfaces += std::string(1, number) + std::string(3, '\0');
  CHECK(model["surfaces"] == base64(surfaces));
}

TEST_CASE("shrunk keeps the mean of an image, for any sides and divisors", "[cli]") {
  for (const auto& [width, height] : {std::pair{12, 8}, {7, 5}, {1, 9}, {2, 1}}) {
    Image image{width, height, {}};
    for (int i = 0; i < width * height; ++i) image.pixels.emplace_back(i % 5, (i * 7) % 11, i);
    for (const int divisor : {1, 2, 3, 4, 100}) {
      const Image small = shrunk(image, divisor);
      INFO(width << " x " << height << " by " << divisor);
      CHECK(small.width == std::max(1, width / divisor));
      CHECK(small.height == std::max(1, height / divisor));
      REQUIRE(small.pixels.size() == static_cast<std::size_t>(small.width * small.height));
      CHECK(glm::length(meanOf(small) - meanOf(image)) < 1e-12 * (1 + glm::length(meanOf(image))));
    }
  }
  // Texels that the division does not cut are means of whole blocks.
  const Image halved =
      shrunk({4, 2, {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 4, 0}, {4, 0, 8}, {4, 0, 0}}}, 2);
  CHECK(halved.pixels == std::vector<glm::dvec3>{{1, 2, 0}, {4, 0, 2}});
}
