/// The camera: framing, and the visible points of samples.
#include "radiosity/pictures/camera.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "radiosity/pictures/visibility.h"
#include "radiosity/projection/patch_view.h"
#include "raster/base/input_error.h"
#include "tests/support/picture_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

constexpr double pi = std::numbers::pi;

/// A camera in the room in a general direction.
const Camera skewed{{0.3, -0.2, 0.4}, {-0.7, 0.1, -0.9}, {0.1, 1, 0.2}, 65};

/// The place of a point in the picture of a pinhole camera, in pixels from the lower left corner, computed without the
/// face.
glm::dvec2 project(const Camera& camera, int width, int height, const glm::dvec3& point) {
  const glm::dvec3 forward = glm::normalize(camera.lookAt - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const glm::dvec3 d = point - camera.eye;
  const double pixels = height / (2 * std::tan(camera.fov * pi / 360)) / glm::dot(forward, d);
  return {width / 2.0 + pixels * glm::dot(right, d), height / 2.0 + pixels * glm::dot(up, d)};
}

/// The place where the face draws a point, in the same units.
glm::dvec2 drawn(const raster::Face& face, const glm::dvec3& point) {
  const glm::dvec3 d = point - glm::dvec3(face.eye);
  const double w = glm::dot(glm::dvec3(face.w), d);
  return {(glm::dot(glm::dvec3(face.x), d) / w + 1) / 2 * face.resolution - face.scissor.column,
          (glm::dot(glm::dvec3(face.y), d) / w + 1) / 2 * face.resolution - face.scissor.row};
}

glm::dvec3 pointOf(const Scene& scene, const Visible& visible) {
  const Triangle& triangle = scene.surfaces[visible.surface].triangles[visible.triangle];
  return visible.weights.x * triangle.position[0] + visible.weights.y * triangle.position[1] +
         visible.weights.z * triangle.position[2];
}

/// The first front that the ray through a point of the picture meets, numbered through the scene; -1 for none.
int firstHit(const Scene& scene, const Camera& camera, int width, int height, const glm::dvec2& pixel) {
  const glm::dvec3 forward = glm::normalize(camera.lookAt - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const double pixelSide = 2 * std::tan(camera.fov * pi / 360) / height;
  const glm::dvec3 ray = forward + pixelSide * ((pixel.x - width / 2.0) * right + (pixel.y - height / 2.0) * up);
  int number = 0, hit = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles) {
      const auto& [a, b, c] = triangle.position;
      const glm::dvec3 n = glm::cross(b - a, c - a);
      const double distance = glm::dot(n, a - camera.eye) / glm::dot(n, ray);
      const glm::dvec3 p = camera.eye + distance * ray;
      const bool inside = glm::dot(glm::cross(b - a, p - a), n) > 0 && glm::dot(glm::cross(c - b, p - b), n) > 0 &&
                          glm::dot(glm::cross(a - c, p - c), n) > 0;
      if (glm::dot(n, ray) < 0 && inside && distance > 0 && distance < nearest) {
        nearest = distance;
        hit = number;
      }
      ++number;
    }
  return hit;
}

/// Triangles of all sizes and directions in front of a camera at the origin that looks along -z.
Scene randomTriangles(unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<double>(random() % 2001) / 1000 - 1; };
  Surface surface;
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 corner(2 * number(), 2 * number(), -3 + 1.5 * number());
    const auto step = [&] { return glm::dvec3(number(), number(), number()); };
    surface.triangles.push_back({{corner, corner + step(), corner + step()}, {}, {}});
  }
  return sceneOf({surface});
}

int numberOf(const Scene& scene, const std::optional<Visible>& visible) {
  if (!visible) return -1;
  std::size_t number = visible->triangle;
  for (std::size_t s = 0; s < visible->surface; ++s) number += scene.surfaces[s].triangles.size();
  return static_cast<int>(number);
}

}  // namespace

TEST_CASE("tangentOfDegrees agrees with std::tan to the last digits", "[camera]") {
  CHECK(tangentOfDegrees(0) == 0);
  for (int i = 1; i < 90000; ++i) {
    const double degrees = i / 1000.0;
    // Above 45 degrees the rounding of the angle itself matters; in long double it stays below the tolerance.
    const long double expected = std::tan(static_cast<long double>(degrees) * std::numbers::pi_v<long double> / 180);
    REQUIRE(std::fabs(tangentOfDegrees(degrees) - expected) <= 1e-14L * expected);
  }
}

TEST_CASE("cameraFace frames the picture to the pixel, for even and odd sides", "[camera]") {
  const Scene scene = makeRoom();
  for (const auto& [width, height] :
       {std::pair(64, 64), {64, 48}, {63, 64}, {64, 63}, {63, 63}, {17, 100}, {1, 1}, {2, 1}, {1, 7}, {101, 30}}) {
    const raster::Face face = cameraFace(scene, skewed, width, height);
    CHECK(face.resolution % 2 == 0);
    CHECK(face.resolution >= std::max(width, height));
    CHECK(face.scissor.width == width);
    CHECK(face.scissor.height == height);
    for (const glm::dvec3& point :
         {skewed.lookAt, glm::dvec3(-1, -1, -1), glm::dvec3(-1, 1, 0), glm::dvec3(0, 0, -1)}) {
      const glm::dvec2 expected = project(skewed, width, height, point);
      // The rows are binary32: 2^-24 of coordinates below twice the picture's side.
      REQUIRE(glm::distance(drawn(face, point), expected) < 1e-6 * std::max(width, height));
    }
  }
}

TEST_CASE("cameraFace spans the field of view from bottom to top", "[camera]") {
  const Scene scene = makeRoom();
  const Camera camera{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 90};
  const raster::Face face = cameraFace(scene, camera, 30, 20);
  CHECK(drawn(face, {0, -1, -1}).y == Approx(0).margin(1e-5));
  CHECK(drawn(face, {0, 1, -1}).y == Approx(20).margin(1e-5));
  CHECK(drawn(face, {1.5, 0, -1}).x == Approx(30).margin(1e-5));
}

TEST_CASE("cameraFace throws InputError for a camera without a valid view", "[camera]") {
  const Scene scene = makeRoom();
  const Camera good{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 60};
  const auto refuses = [&](const Camera& camera, int width = 8, int height = 8) {
    CHECK_THROWS_AS(cameraFace(scene, camera, width, height), raster::InputError);
  };
  CHECK_NOTHROW(cameraFace(scene, good, 4096, 1));
  refuses(good, 4097, 8);
  refuses(good, 8, 0);
  refuses({good.eye, good.eye, good.up, 60});
  refuses({good.eye, good.lookAt, {0, 0, 3}, 60});
  refuses({good.eye, good.lookAt, {0, 0, 0}, 60});
  refuses({good.eye, good.lookAt, good.up, 0});
  refuses({good.eye, good.lookAt, good.up, 9e-7});
  refuses({good.eye, good.lookAt, good.up, 180});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refuses({good.eye, good.lookAt, good.up, nan});
  refuses({{nan, 0, 0}, good.lookAt, good.up, 60});
}

TEST_CASE("visibleSamples gives points in the middle of their pixels", "[camera]") {
  const Scene scene = makeRoom();
  for (const auto& [width, height] : {std::pair(40, 30), {31, 40}}) {
    const auto samples = visibleSamples(scene, skewed, width, height);
    for (int row = 0; row < height; ++row)
      for (int column = 0; column < width; ++column) {
        const auto& sample = samples[static_cast<std::size_t>(row * width + column)];
        REQUIRE(sample);
        const glm::dvec3& weights = sample->weights;
        REQUIRE(weights.x + weights.y + weights.z == Approx(1).epsilon(1e-14));
        REQUIRE(std::min({weights.x, weights.y, weights.z}) >= 0);
        if (std::min({weights.x, weights.y, weights.z}) == 0) continue;  // was moved to the border
        const glm::dvec2 pixel = project(skewed, width, height, pointOf(scene, *sample));
        REQUIRE(glm::distance(pixel, {column + 0.5, height - row - 0.5}) < 1e-4);
      }
  }
}

TEST_CASE("visibleSamples sees the triangles that rays meet, except for the rounding of edges", "[camera]") {
  const Camera camera{{0, 0, 0}, {0.1, 0, -1}, {0, 1, 0}, 70};
  constexpr int size = 64;
  int seen = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Scene scene = randomTriangles(seed);
    const auto samples = visibleSamples(scene, camera, size, size);
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column) {
        const int number = numberOf(scene, samples[static_cast<std::size_t>(row * size + column)]);
        const glm::dvec2 middle(column + 0.5, size - row - 0.5);
        bool explained = firstHit(scene, camera, size, size, middle) == number;
        // Snapping moves a corner by at most 1/512 pixel in each direction.
        for (const glm::dvec2& shift : {glm::dvec2(1, 1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(-1, -1)})
          explained = explained || firstHit(scene, camera, size, size, middle + shift / 400.0) == number;
        REQUIRE(explained);
        seen += number >= 0;
      }
  }
  CHECK(seen > 4000);
}

TEST_CASE("seenSurfaces are those of which an eighth is in the picture, or that fill half of it", "[camera]") {
  // A square ground at x < 0 below the eye, in a picture of 90 degrees. If the camera looks down and by 0.3 to the
  // right, 35 % of the picture show 0.948 of it, in units of the height; to the left, 65 % show 4.55 (by integration).
  const auto isGroundSeen = [](double side, double height, double towards) {
    const Scene scene = sceneOf({parallelogram("ground", {-side, -side / 2, 0}, {side, 0, 0}, {0, side, 0}),
                                 parallelogram("away", {5, 5, 9}, {0, 1, 0}, {1, 0, 0})});
    const Camera camera{{0, 0, height}, {towards * height, 0, 0}, {0, 1, 0}, 90};
    const std::vector<bool> seen = seenSurfaces(scene, camera, 200, 200);
    CHECK_FALSE(seen[1]);
    return static_cast<bool>(seen[0]);
  };
  const double limit = std::sqrt(8 * 0.948);
  for (const double height : {1.0, 3.0}) {
    CHECK(isGroundSeen(0.98 * limit * height, height, 0.3));
    CHECK_FALSE(isGroundSeen(1.02 * limit * height, height, 0.3));
    CHECK(isGroundSeen(20 * height, height, -0.3));
  }
  CHECK(seenSurfaces(makeRoom(), {{0, 0, 0.9}, {0, 0, 0}, {0, 1, 0}, 70}, 80, 60) ==
        std::vector<bool>{true, true, true, true, true, false});
}

TEST_CASE("trianglesFacingAway are the walls whose backs face the eye", "[camera]") {
  const Scene room = makeRoom();
  CHECK(trianglesFacingAway(room, {0, 0, 0}).empty());
  CHECK(trianglesFacingAway(room, {0, 0, 5}) == std::vector<std::uint32_t>{10, 11});  // the front wall
  const auto samples = visibleSamples(room, {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 20}, 8, 8);
  for (const auto& sample : samples) CHECK((sample && room.surfaces[sample->surface].name == "back"));
}

TEST_CASE("visibleSamples sees the front of two coincident sides", "[camera]") {
  const Surface front = parallelogram("front", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  const Surface back = parallelogram("back", {1, -1, 0}, {-2, 0, 0}, {0, 2, 0});
  const Scene scene = sceneOf({front, back, parallelogram("far", {-9, -9, -9}, {1, 0, 0}, {0, 0, 1})});
  for (const auto& [z, name] : {std::pair(2.0, "front"), {-2.0, "back"}})
    for (const auto& sample : visibleSamples(scene, {{0, 0, z}, {0, 0, 0}, {0, 1, 0}, 40}, 16, 16))
      REQUIRE((sample && scene.surfaces[sample->surface].name == name));
}
