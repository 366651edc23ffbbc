/// setSymmetry: a scene with images has the rows and the light of the same scene with its copies written out.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/light/light.h"
#include "radiosity/pictures/visibility.h"
#include "radiosity/scene/symmetry.h"
#include "raster/base/input_error.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

void addQuad(Scene& scene, const std::string& name, int material, const std::array<glm::dvec3, 4>& corner) {
  const std::array<glm::dvec2, 4> chart{glm::dvec2(0, 0), {1, 0}, {1, 1}, {0, 1}};
  Surface surface{.name = name, .family = name, .material = material, .triangles = {}};
  for (const auto& [b, c] : {std::pair(1U, 2U), {2U, 3U}})
    surface.triangles.push_back({.position = {corner[0], corner[b], corner[c]},
                                 .chart = {chart[0], chart[b], chart[c]},
                                 .texcoord = {chart[0], chart[b], chart[c]}});
  scene.surfaces.push_back(surface);
}

/// The corner x, y >= 0 of a room of 2 x 2.2 x 1 with a pillar in its middle and a lamp, or without the ceiling.
Scene cornerOfRoom(bool isClosed) {
  Scene scene;
  scene.materials = {{.name = "paint", .reflectance = glm::dvec3(0.6, 0.5, 0.3)},
                     {.name = "light", .emission = glm::dvec3(3, 2, 1)}};
  addQuad(scene, "floor", 0, {glm::dvec3(0, 0, 0), {1, 0, 0}, {1, 1.1, 0}, {0, 1.1, 0}});
  if (isClosed) addQuad(scene, "ceiling", 0, {glm::dvec3(0, 0, 1), {0, 1.1, 1}, {1, 1.1, 1}, {1, 0, 1}});
  addQuad(scene, "right", 0, {glm::dvec3(1, 0, 0), {1, 0, 1}, {1, 1.1, 1}, {1, 1.1, 0}});
  addQuad(scene, "far", 0, {glm::dvec3(0, 1.1, 0), {1, 1.1, 0}, {1, 1.1, 1}, {0, 1.1, 1}});
  addQuad(scene, "pillar/right", 0,
          {glm::dvec3(0.23, 0, 0.11), {0.23, 0.31, 0.11}, {0.23, 0.31, 0.67}, {0.23, 0, 0.67}});
  addQuad(scene, "pillar/far", 0, {glm::dvec3(0, 0.31, 0.11), {0, 0.31, 0.67}, {0.23, 0.31, 0.67}, {0.23, 0.31, 0.11}});
  addQuad(scene, "pillar/top", 0, {glm::dvec3(0, 0, 0.67), {0.23, 0, 0.67}, {0.23, 0.31, 0.67}, {0, 0.31, 0.67}});
  addQuad(scene, "pillar/bottom", 0, {glm::dvec3(0, 0, 0.11), {0, 0.31, 0.11}, {0.23, 0.31, 0.11}, {0.23, 0, 0.11}});
  addQuad(scene, "lamp", 1, {glm::dvec3(0.61, 0.42, 0.89), {0.61, 0.73, 0.89}, {0.87, 0.73, 0.89}, {0.87, 0.42, 0.89}});
  return scene;
}

const Symmetry inCorner{.mirrors = {std::vector{0.0}, std::vector{0.0}, std::vector<double>()}};
const Symmetry inBoxes{.period = {1, 1.1, 0}, .repeats = 1};

Scene cornerOfRoom(bool isClosed, const Symmetry& symmetry) {
  Scene scene = cornerOfRoom(isClosed);
  setSymmetry(scene, symmetry);
  return scene;
}

/// The scene with a surface for each image.
Scene writtenOut(Scene scene) {
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
    for (const Surface& surface : scene.surfaces) {
      surfaces.push_back(placed(surface, scene.instances[i]));
      surfaces.back().name += "@" + std::to_string(i);
    }
  scene.surfaces = std::move(surfaces);
  scene.instances = {Instance()};
  measureBounds(scene);
  return scene;
}

/// Grids of 4 x 3 texels, each of which is a patch. No centre lies on the diagonal of a quad, where rounding would
/// choose one of its triangles.
DiscretizationSettings elementsOf(const Scene& scene) {
  DiscretizationSettings settings{.patch = 1};
  for (const Surface& surface : scene.surfaces) settings.surfaceTexels[surface.family] = {4, 3};
  return settings;
}

Discretization discretized(const Scene& scene) { return discretize(scene, elementsOf(scene)); }
/// Hemicubes are mirrored where their patches are: those of Orientation::Turned depend on the numbers of patches.
constexpr DrawingSettings drawing{.resolution = 64, .orientation = Orientation::Aligned, .split = 1};

Light solved(const Scene& scene) {
  return light(scene, discretized(scene), {.drawing = drawing, .solver = {.residual = 1e-9}});
}

void checkAccount(const Energy& energy) {
  for (std::size_t band = 0; band < 3; ++band)
    CHECK(energy.absorbed[band] + energy.unshot[band] + energy.lost[band] ==
          Approx(energy.emitted[band]).epsilon(1e-12));
}

/// The largest difference of the radiosities of all elements of a, over their largest one; b may have more elements.
double difference(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double apart = 0, largest = 0;
  for (std::size_t e = 0; e < a.size(); ++e)
    for (int band = 0; band < 3; ++band) {
      apart = std::max(apart, std::abs(a[e][band] - b[e][band]));
      largest = std::max(largest, b[e][band]);
    }
  return apart / largest;
}

/// Solves a scene and its copy with images as surfaces, and returns the difference.
double differenceFromWhole(const Scene& scene) {
  const Light part = solved(scene), whole = solved(writtenOut(scene));
  const std::size_t count = part.discretization.elements.size();
  CHECK(whole.discretization.elements.size() == scene.instances.size() * count);
  checkAccount(part.solution.energy);
  CHECK(bandSum(part.solution.energy.emitted) * static_cast<double>(scene.instances.size()) ==
        Approx(bandSum(whole.solution.energy.emitted)).epsilon(1e-3));
  return difference(part.solution.radiosity, whole.solution.radiosity);
}

}  // namespace

TEST_CASE("setSymmetry leaves rows equal to those of the scene with its images as surfaces, with images added up",
          "[symmetry]") {
  const auto kind = GENERATE(ElementsBy::Texture, ElementsBy::Mesh);
  const Scene scene = cornerOfRoom(true, GENERATE(inCorner, inBoxes)), whole = writtenOut(scene);
  const Discretization own = discretized(scene), all = discretized(whole);
  DrawingSettings settings = drawing;
  settings.elementsBy = kind;
  // A mesh cuts a quad as a whole only if its triangles follow each other as in files, which mirrored surfaces do not.
  const double tolerance = kind == ElementsBy::Mesh && scene.instances.size() == 4 ? 1e-3 : 0;
  SceneFormFactors ofPart(scene, own, layOut(own), settings), ofWhole(whole, all, layOut(all), settings);
  for (std::size_t p = 0; p < own.patches.list.size(); ++p) {
    const FormFactorRow row = ofPart.row(own.patches.list[p]), rowOfAll = ofWhole.row(all.patches.list[p]);
    std::vector<std::uint64_t> shares(own.elements.size()), folded(own.elements.size());
    for (std::size_t i = 0; i < row.elements.size(); ++i) shares[row.elements[i]] += row.shares[i];
    for (std::size_t i = 0; i < rowOfAll.elements.size(); ++i)
      folded[rowOfAll.elements[i] % own.elements.size()] += rowOfAll.shares[i];
    CAPTURE(p);
    double apart = 0;
    for (std::size_t e = 0; e < shares.size(); ++e) apart += std::abs(formFactor(shares[e]) - formFactor(folded[e]));
    CHECK(apart <= tolerance);
    CHECK(row.background == rowOfAll.background);
    CHECK(row.back == rowOfAll.back);
  }
}

TEST_CASE("light of a mirrored quarter is that of the whole room", "[symmetry]") {
  // In a mirror, the rule for samples on edges (docs/item-buffers.md) puts them on the other side.
  CHECK(differenceFromWhole(cornerOfRoom(true, inCorner)) < 1e-4);
}

TEST_CASE("light of a mirrored quarter under a sky and a sun is that of the whole", "[symmetry]") {
  Scene scene = cornerOfRoom(false, inCorner);
  scene.outside.sky = {1, 2, 3};
  scene.outside.suns = {{{0, 0, 1}, {5, 4, 3}}};
  CHECK(differenceFromWhole(scene) < 0.02);
}

TEST_CASE("outsideFlux counts the light on the surfaces themselves, which their images shade", "[symmetry]") {
  Scene scene = cornerOfRoom(false, inBoxes);
  scene.outside.sky = {1, 1, 1};
  scene.outside.suns = {{glm::normalize(glm::dvec3(1, 2, 1.5)), {4, 4, 4}}};
  const Scene whole = writtenOut(scene);
  const auto fluxOf = [](const Scene& of, const Discretization& discretization) {
    const OutsideFlux flux = SceneFormFactors(of, discretization, layOut(discretization), drawing).outsideFlux();
    std::vector<glm::dvec3> received(flux.received.size());
    for (std::size_t e = 0; e < received.size(); ++e)
      received[e] = {flux.received[e][0], flux.received[e][1], flux.received[e][2]};
    return received;
  };
  const Discretization own = discretized(scene), all = discretized(whole);
  const std::vector<glm::dvec3> part = fluxOf(scene, own), others = fluxOf(whole, all);
  REQUIRE(part.size() == own.elements.size());
  double sum = 0, sumOfWhole = 0;
  for (std::size_t e = 0; e < part.size(); ++e) {
    sum += part[e].x;
    sumOfWhole += others[e].x;
  }
  CHECK(sum == Approx(sumOfWhole).epsilon(0.01));
  CHECK(difference(part, others) < 0.1);

  Scene mirrored = cornerOfRoom(false, inCorner);
  mirrored.outside = scene.outside;
  const Discretization elementsOfIt = discretized(mirrored);
  CHECK_THROWS_WITH(fluxOf(mirrored, elementsOfIt), Catch::Matchers::Contains("mirror"));
}

TEST_CASE("light between two endless plates is a geometric series", "[symmetry]") {
  Scene plates;
  plates.materials = {{.name = "lit", .reflectance = glm::dvec3(0.8), .emission = glm::dvec3(1)},
                      {.name = "unlit", .reflectance = glm::dvec3(0.5)}};
  addQuad(plates, "floor", 0, {glm::dvec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  addQuad(plates, "ceiling", 1, {glm::dvec3(0, 0, 1), {0, 1, 1}, {1, 1, 1}, {1, 0, 1}});
  setSymmetry(plates, {.period = {1, 1, 0}, .repeats = 40});
  const Light found =
      light(plates, discretize(plates, {.texels = 2}), {.drawing = {.resolution = 512}, .solver = {.residual = 1e-6}});
  REQUIRE(found.solution.radiosity.size() == 8);
  checkAccount(found.solution.energy);
  // About 1 / 40^2 of the light leaves between the plates on each way.
  CHECK(found.solution.radiosity[0].x == Approx(1 / (1 - 0.8 * 0.5)).epsilon(2e-3));
  CHECK(found.solution.radiosity[4].x == Approx(0.5 / (1 - 0.8 * 0.5)).epsilon(2e-3));
}

TEST_CASE("visibleSamples show images behind a mirror with the coordinates of their surfaces", "[symmetry]") {
  const Scene scene = cornerOfRoom(true, inCorner);
  const auto from = [&](double side) {
    return visibleSamples(scene, {.eye = {side * 0.9, 0.9, 0.5}, .lookAt = {0, 0.1, 0.45}, .up = {0, 0, 1}, .fov = 80},
                          40, 30);
  };
  const auto right = from(1), left = from(-1);
  std::size_t equal = 0;
  for (std::size_t row = 0; row < 30; ++row)
    for (std::size_t column = 0; column < 40; ++column) {
      const auto &a = right[row * 40 + column], &b = left[row * 40 + 39 - column];
      REQUIRE(a);
      REQUIRE(b);
      if (a->surface != b->surface || a->triangle != b->triangle) continue;
      CHECK(glm::distance(a->weights, b->weights) < 1e-6);
      CHECK(a->instance != b->instance);
      ++equal;
    }
  CHECK(equal > 1150);  // of 1200: a sample on an edge may show either side
}
