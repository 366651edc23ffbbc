// viewportOf needs no device: the viewports of all devices.
#include "reference/devices/viewport.h"

#include <catch2/catch.hpp>

#include "raster/base/input_error.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using reference::viewportOf;

TEST_CASE("viewportOf puts the scissor rectangle of a face at the origin of the framebuffer", "[devices]") {
  raster::Face face = tests::frontFace(16);
  face.scissor = {3, 8, 5, 6};
  const reference::DeviceViewport narrow = viewportOf(face, 1, 16, "Vulkan");
  CHECK(narrow.x == -3);
  CHECK(narrow.y == -8);
  CHECK(narrow.columns == 16);
  const reference::DeviceViewport wide = viewportOf(face, 8, 128, "Vulkan");
  CHECK(wide.x == -56 - 3);
  CHECK(wide.y == -56 - 8);
  CHECK(wide.columns == 128);
  CHECK(wide.rows == 128);
}

TEST_CASE("viewportOf takes the widest viewport that the device allows", "[devices]") {
  const raster::Face face = tests::frontFace(16);
  CHECK(viewportOf(face, 8, 127, "Vulkan").columns == 4 * 16);
  CHECK(viewportOf(face, 8, 63, "Vulkan").columns == 2 * 16);
  CHECK(viewportOf(face, 8, 31, "Vulkan").columns == 16);
  CHECK(viewportOf(face, 8, 16, "Vulkan").columns == 16);
  CHECK(viewportOf(face, 1, 4096, "Vulkan").columns == 16);
}

TEST_CASE("viewportOf has whole pixels on either side of a face, also of an odd one, along each axis", "[devices]") {
  raster::Face face = tests::frontFace(16);
  for (const int columns : {1, 7, 16, 4095, 16384})
    for (const int rows : {1, 3, 8}) {
      face.viewport = raster::Viewport{columns, rows};
      face.scissor = {0, 0, columns, rows};
      const reference::DeviceViewport viewport = viewportOf(face, 8, 16384, "Vulkan");
      CHECK(viewport.columns == columns - 2 * viewport.x);
      CHECK(viewport.rows == rows - 2 * viewport.y);
      CHECK(viewport.rows == 8 * rows - rows % 2);
      CHECK(viewport.columns <= 16384);
    }
}

TEST_CASE("viewportOf throws InputError for a face that is larger than the device's viewport", "[devices]") {
  for (const std::string api : {"OpenGL", "Vulkan"}) {
    try {
      viewportOf(tests::frontFace(16), 8, 15, api);
      FAIL("no InputError");
    } catch (const raster::InputError& error) {
      CHECK(error.what() ==
            "a face is larger than the viewport of the " + api + " device; use a resolution of at most 15");
    }
  }
}
