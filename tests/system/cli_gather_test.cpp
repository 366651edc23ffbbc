/// `hemitex solve --gather`: its files and its numbers.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "radiosity/images/image.h"
#include "tests/support/shell.h"

using namespace hemitex;
using namespace hemitex::tests;

TEST_CASE("solve --gather writes radiosity and light at the resolution of display textures", "[cli][gather]") {
  const Shell shell;
  const std::string room = "solve " HEMITEX_DATA "/paper-room.obj --texels 8 --residual 0.05 --resolution 64 ";
  const auto json = nlohmann::json::parse(shell.output(room + "--gather --lightmap --json -o lit --threads 2"));
  CHECK(json["gather"]["drawn"] < json["gather"]["texels"]);
  CHECK(json["gather"]["error"] < 0.03);
  const radiosity::Image floor = radiosity::readImage(shell.file("lit/floor.exr")),
                         shown = radiosity::readImage(shell.file("lit/floor.png")),
                         light = radiosity::readImage(shell.file("lit/lightmaps/floor.exr"));
  CHECK(floor.width == shown.width);
  CHECK(light.width == shown.width);
  CHECK(shell.output(room + "--gather -o lit --threads 1").find("texels gathered their light") != std::string::npos);
  const auto again = nlohmann::json::parse(shell.output(room + "--gather --lightmap --json -o again --threads 1"));
  CHECK(again["files"] == json["files"]);
}
