// The error of a single hemicube: small random rectangles above its point, compared with closed forms.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/projection_kinds.h"
#include "raster/software/software_renderer.h"
#include "reference/truth/closed_forms/point_to_polygon.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// A unit direction above the horizon, cosine-distributed.
glm::dvec3 direction(std::mt19937& random) {
  const auto draw = [&random] { return double(random()) / 4294967296.0; };
  const double radius2 = draw(), angle = 2 * M_PI * draw();
  return {std::sqrt(radius2) * std::cos(angle), std::sqrt(radius2) * std::sin(angle), std::sqrt(1 - radius2)};
}

/// A rectangle at a distance of 1 whose front faces the origin, rotated about the line to it and tilted by up to
/// 60 degrees.
Surface randomRectangle(std::mt19937& random) {
  const auto draw = [&random](double low, double high) {
    return low + (high - low) * (double(random()) / 4294967296.0);
  };
  const glm::dvec3 centre = direction(random);
  const double turn = draw(0, 2 * M_PI), lean = draw(-M_PI / 3, M_PI / 3);
  const glm::dvec3 axis = std::abs(centre.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(axis, centre)), up = glm::cross(centre, right);
  const glm::dvec3 along = std::cos(turn) * right + std::sin(turn) * up;
  const glm::dvec3 across = std::cos(lean) * glm::cross(centre, along) + std::sin(lean) * centre;
  const glm::dvec3 u = draw(0.22, 0.56) * across, v = draw(0.22, 0.56) * along;
  return tests::parallelogram("rectangle", centre - 0.5 * (u + v), u, v);
}

/// The form factor of a hemicube over the origin by its definition (Cohen and Greenberg 1985): the sum of the delta
/// form factors of all pixels whose centre shows the rectangle, found with one ray per pixel in double precision.
double byRays(const Projection& hemicube, const Surface& rectangle) {
  const std::array<glm::dvec3, 3>& corner = rectangle.triangles.front().position;  // the first three of four corners
  const glm::dvec3 u = corner[1] - corner[0], v = corner[2] - corner[1], normal = glm::cross(u, v);
  const auto isSeen = [&](const glm::dvec3& ray) {
    const glm::dvec3 hit = glm::dot(corner[0], normal) / glm::dot(ray, normal) * ray;
    const double s = glm::dot(hit - corner[0], u) / glm::dot(u, u), t = glm::dot(hit - corner[0], v) / glm::dot(v, v);
    return glm::dot(hit, ray) > 0 && s > 0 && s < 1 && t > 0 && t < 1;
  };
  std::uint64_t share = 0;
  for (std::size_t f = 0; f < hemicube.faces.size(); ++f) {
    const ProjectionFace& face = hemicube.faces[f];
    const auto coordinate = [&](int pixel) { return (2 * pixel + 1.0) / face.resolution - 1; };
    for (int row = face.scissor.row; row < face.scissor.row + face.scissor.height; ++row)
      for (int column = 0; column < face.resolution; ++column)
        if (isSeen(face.w + coordinate(column) * face.x + coordinate(row) * face.y))
          share += shareOf(hemicube, f, column, row);
  }
  return formFactor(share);
}

double byHemicube(const Scene& scene, int resolution) {
  const Discretization discretization = discretize(scene, {.texels = 1});
  const IdLayout layout = layOut(discretization);
  raster::SoftwareRenderer renderer(makeDrawList(scene, discretization, layout));
  const FormFactorRow row = ProjectedFormFactors(scene, discretization, layout, renderer, {.resolution = resolution})
                                .ofPatch(discretization.patches.list[0]);
  REQUIRE(row.back == 0);
  return row.elements.empty() ? 0 : formFactor(row.shares[0]);
}

constexpr int rectangles = 400;

/// A small floor around the origin and one of 400 rectangles, always the same.
std::vector<Scene> randomScenes() {
  std::mt19937 random(7);
  std::vector<Scene> scenes;
  const Surface floor = tests::parallelogram("floor", {-1e-3, -1e-3, 0}, {2e-3, 0, 0}, {0, 2e-3, 0});
  for (int i = 0; i < rectangles; ++i) scenes.push_back(tests::sceneOf({floor, randomRectangle(random)}));
  return scenes;
}

}  // namespace

// The eye is lifted by 2^-21 of the scene, which may move an edge across the centre of a pixel or two. The largest
// pixel has 4 / (pi R^2) of the light.
TEST_CASE("hemicube counts the pixels that rays count", "[hemicube]") {
  const std::vector<Scene> scenes = randomScenes();
  for (const int resolution : {32, 64}) {
    const Projection projection = hemicube(resolution);
    for (const Scene& scene : scenes)
      CHECK(byHemicube(scene, resolution) ==
            Approx(byRays(projection, scene.surfaces[1])).margin(2 * 4 / (M_PI * resolution * resolution)));
  }
}

// Pixels on the border of a rectangle are counted as wholes, which is wrong by about half a pixel either way.
// Their number grows with R and their light falls with R^2, so that the root mean square of the independent errors
// falls with R^0.5 / R^2. Over 400 rectangles it is known to 13 % (one standard deviation): the exponent between R = 32
// and 256 is known to sqrt(2) * 0.13 / ln(8) = 0.09.
TEST_CASE("hemicube has errors that fall with the power 1.5 of its resolution", "[hemicube]") {
  const std::vector<Scene> scenes = randomScenes();
  const auto rmsAt = [&](int resolution) {
    double sum = 0;
    for (const Scene& scene : scenes) {
      double exact = 0;
      for (const Triangle& triangle : scene.surfaces[1].triangles)
        exact += reference::pointToPolygon(glm::dvec3(0), glm::dvec3(0, 0, 1), triangle.position);
      sum += std::pow(byHemicube(scene, resolution) - exact, 2);
    }
    return std::sqrt(sum / rectangles);
  };
  const double exponent = std::log(rmsAt(32) / rmsAt(256)) / std::log(8);
  CHECK(exponent == Approx(1.5).margin(2 * 0.09));
}
