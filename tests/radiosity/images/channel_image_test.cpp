#include "radiosity/images/channel_image.h"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "radiosity/images/image.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

TEST_CASE("writeExr of the channels R, G and B gives the file of an image", "[image]") {
  const TemporaryFolder folder;
  writeExr(folder.path / "image.exr", Image{2, 1, {{1, 2, 3}, {-4, 5e30, 0}}});
  writeExr(folder.path / "channels.exr", ChannelImage{2, 1, {"R", "G", "B"}, {1, 2, 3, -4, 5e30, 0}});
  CHECK(raster::readFile(folder.path / "image.exr", "") == raster::readFile(folder.path / "channels.exr", ""));
}

// readImage gives the first three channels of a file, which are R, G and B, or in the order of their names.
TEST_CASE("writeExr keeps the values of channels with any names", "[image]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "bands.exr";
  writeExr(file, ChannelImage{1, 2, {"b_400", "b_500", "b_600"}, {1, 2, 3, 4, 5, 6}});
  CHECK(readImage(file).pixels == std::vector{glm::dvec3(1, 2, 3), glm::dvec3(4, 5, 6)});
  writeExr(file, ChannelImage{1, 1, {"R", "G", "B", "b_400", "b_500"}, {1, 2, 3, 4, 5}});
  CHECK(readImage(file).pixels == std::vector{glm::dvec3(1, 2, 3)});
  CHECK(raster::readFile(file, "").find(std::string("b_500") + '\0') != std::string::npos);
  CHECK_THROWS_AS(writeExr(file, ChannelImage{1, 1, {"b_400"}, {1e39}}), raster::InputError);
}
