/// hemitex render: pictures of solved folders, and malformed files beside the scene.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "radiosity/images/image.h"
#include "tests/support/shell.h"

using namespace hemitex::tests;
namespace fs = std::filesystem;

TEST_CASE("hemitex names a malformed file beside the scene", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "-o out");
  const auto [name, text] = GENERATE(table<std::string, std::string>({
      {"room.view.json", "{"},
      {"room.view.json", R"({"eye": [0, 0]})"},
      {"room.view.json", R"({"eye": [0, 0, 1e999]})"},
      {"out/solution.json", "{}"},
      {"out/solution.json",
       R"({"settings": {"texels": 4, "patch": 2, "texel_size": null, "exposure": 1}, "surfaces": []})"},
  }));
  writeAll(shell.file(name), text);
  const std::string scene = name == "room.view.json" ? "room.obj" : "out/scene.obj";
  const Outcome outcome = shell.run("render " + scene + " -o picture.png");
  INFO(outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find(name) != std::string::npos);
  CHECK_FALSE(fs::exists(shell.file("picture.png")));
}

// The charts of a solved scene lie inside its radiosity textures, and a picture of its item IDs must invert that.
TEST_CASE("hemitex render of a solved folder shows the grids that were solved", "[cli]") {
  const Shell shell;
  const std::string grids = GENERATE(as<std::string>{}, "--texels 4 --surface floor=3 --surface left=1 ",
                                     "--texel-size 0.4 --surface floor=3 ");
  const std::string camera = " --eye 0,0.5,0 --look-at 0,0,-1 --fov 90 --size 40x30 ";
  shell.output("solve room.obj --resolution 32 --size 40x30 -o out " + grids);
  const std::string show = GENERATE(as<std::string>{}, "ids", "index-map", "offsets", "map");
  shell.output("render out/scene.obj -o solved.png --show " + show + camera);
  shell.output("render room.obj -o bare.png --show " + show + camera + grids);
  INFO(show << ' ' << grids);
  const bool isSame = readAll(shell.file("solved.png")) == readAll(shell.file("bare.png"));
  CHECK(isSame);
}

// Where faces of the solved scene touch, the reader cuts them. All parts belong to the surface.
TEST_CASE("hemitex render of a solved folder shows all parts of its faces", "[cli]") {
  const Shell shell;
  const std::string scene = HEMITEX_DATA "/furnished-room.obj";
  shell.output("solve " + scene + " -o out --shots 5 --texels 2 --resolution 32 --size 160x120");
  shell.output("render out/scene.obj -o again.png --size 160x120");
  const auto shown = hemitex::radiosity::readImage(shell.file("out/render.png"));
  const auto again = hemitex::radiosity::readImage(shell.file("again.png"));
  REQUIRE(again.pixels.size() == shown.pixels.size());
  std::ptrdiff_t other = 0;
  for (std::size_t p = 0; p < shown.pixels.size(); ++p)
    other += glm::any(glm::greaterThan(glm::abs(shown.pixels[p] - again.pixels[p]), glm::dvec3(.05)));
  CHECK(other == 0);
}
