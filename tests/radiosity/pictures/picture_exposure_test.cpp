/// pictureExposure: the median of the seen pixels, the share of clipped ones, and what counts as seen.
#include "radiosity/pictures/picture_exposure.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "radiosity/pictures/pictures.h"
#include "tests/support/picture_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::tests;

namespace {

/// Sees the quads of `Strip` from edge to edge.
const Camera straight{{0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 90};

/// A square that fills the picture, of `texels` columns, and others that the camera does not see: one behind it, and
/// one that shows its back.
struct Strip {
  Scene scene;
  Discretization discretization;
  std::vector<glm::dvec3> radiosity;

  explicit Strip(int texels) : radiosity(static_cast<std::size_t>(texels) + 2, glm::dvec3(0.0)) {
    scene = sceneOf({parallelogram("seen", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
                     parallelogram("behind", {-9, -9, 9}, {0, 18, 0}, {18, 0, 0}),
                     parallelogram("back", {-1, -1, 0.5}, {0, 2, 0}, {2, 0, 0})},
                    {Material{}, Material{.name = "light", .emission = glm::dvec3(0, 7, 0)}});
    addGrid(discretization, texels, 1);
    addGrid(discretization, 1, 1);
    addGrid(discretization, 1, 1);
  }

  double exposure(const Camera& camera = straight) const {
    return pictureExposure(scene, discretization, valuesIn(radiosity), camera, 512, 512);
  }
};

}  // namespace

TEST_CASE("pictureExposure shows the median of the seen pixels as 0.18", "[picture]") {
  Strip strip(4);
  strip.radiosity = {{1, 2, 3}, {2, 3, 4}, {2, 3, 4}, {5, 6, 7}, {1000, 1000, 1000}, {0.001, 0.001, 0.001}};
  CHECK(strip.exposure() == 0.18 / 3);
  // Nothing behind the camera and no back changes that.
  strip.radiosity[4] = strip.radiosity[5] = glm::dvec3(0);
  CHECK(strip.exposure() == 0.18 / 3);
  // The value is relative: light of another unit has the same picture.
  for (glm::dvec3& value : strip.radiosity) value *= 1024.0;
  CHECK(strip.exposure() == 0.18 / 3072);
}

TEST_CASE("pictureExposure clips at most 1 % of the seen pixels", "[picture]") {
  // Each of 128 texels fills two columns of pixels: one is less than 1 %, two are more.
  Strip strip(128);
  std::fill_n(strip.radiosity.begin(), 128, glm::dvec3(1));
  strip.radiosity[17] = {0, 100, 0};
  CHECK(strip.exposure() == 0.18);
  strip.radiosity[90] = {50, 0, 0};
  CHECK(strip.exposure() == 1.0 / 50);
  // The same, counted in a picture of these elements.
  const double exposure = strip.exposure();
  const auto clipped = [&](double factor) {
    const Image picture =
        elementPicture(strip.scene, strip.discretization, valuesIn(strip.radiosity), straight, 256, 256);
    return std::count_if(picture.pixels.begin(), picture.pixels.end(), [&](const glm::dvec3& value) {
      return std::max({value.r, value.g, value.b}) * factor > 1;
    });
  };
  CHECK(clipped(exposure) <= 256 * 256 / 100);
  CHECK(clipped(1.01 * exposure) > 256 * 256 / 100);
}

TEST_CASE("pictureExposure counts neither lamps nor unlit surfaces", "[picture]") {
  Strip strip(2);
  strip.scene.surfaces[0].material = 1;
  strip.radiosity = {{9, 9, 9}, {9, 9, 9}, {6, 6, 6}, {0, 0, 0}};
  // Only a lamp is seen: it counts.
  CHECK(strip.exposure() == 0.18 / 9);
  // From behind the quads the camera sees a lit surface and no lamp.
  const Camera turned{{0, 0, 1}, {0, 0, 9}, {0, 1, 0}, 90};
  CHECK(strip.exposure(turned) == 0.18 / 6);
  // Half of the picture is unlit.
  strip.scene.surfaces[0].material = 0;
  strip.radiosity[0] = glm::dvec3(0);
  CHECK(strip.exposure() == 0.18 / 9);
}

TEST_CASE("pictureExposure uses all elements if none with light is seen", "[picture]") {
  Strip strip(2);
  strip.radiosity = {{0, 0, 0}, {0, 0, 0}, {4, 4, 4}, {4, 4, 4}};
  CHECK(strip.exposure() == 0.18 / 4);
  strip.radiosity.assign(4, glm::dvec3(0));
  CHECK(strip.exposure() == 1);
  // To the side there is nothing.
  strip.radiosity.assign(4, glm::dvec3(2));
  CHECK(strip.exposure({{20, 0, 0}, {30, 0, 0}, {0, 1, 0}, 60}) == 0.18 / 2);
}
