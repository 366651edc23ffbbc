/// The files of a lit scene in foreign programs: f3d, VTK, and Blender (hidden, target blender_check). Both draw
/// scene.obj and scene.glb from the camera of render.png.
///
/// Pictures are compared as sRGB values in [0,1], after averaging 4 x 4 pixels in linear light, because the programs
/// smooth edges in other ways.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "radiosity/images/image.h"
#include "tests/support/glb.h"
#include "tests/support/shell.h"
#include "tests/support/solved_folder.h"

using namespace hemitex;
using namespace hemitex::tests;
using nlohmann::json;
using radiosity::Image;

namespace {

constexpr int block = 4;

/// The mean over all blocks and channels of the absolute difference. `mirrored` compares with the mirror image.
double difference(const Image& a, const Image& b, bool mirrored = false) {
  REQUIRE((a.width == b.width && a.height == b.height));
  const auto mean = [](const Image& image, int column, int row) {
    glm::dvec3 sum(0);
    for (int r = row; r < row + block; ++r)
      for (int c = column; c < column + block; ++c)
        sum += image.pixels[static_cast<std::size_t>(r) * static_cast<std::size_t>(image.width) +
                            static_cast<std::size_t>(c)];
    return sum / static_cast<double>(block * block);
  };
  double sum = 0;
  int count = 0;
  for (int row = 0; row < a.height; row += block)
    for (int column = 0; column < a.width; column += block, ++count) {
      const glm::dvec3 x = mean(a, column, row), y = mean(b, mirrored ? a.width - block - column : column, row);
      for (int band = 0; band < 3; ++band)
        sum += std::abs(radiosity::encodeSrgb(x[band]) - radiosity::encodeSrgb(y[band])) / 255.0 / 3;
    }
  return sum / count;
}

/// The picture is that of render.png, and the comparison notices a mirror image.
void checkPicture(const std::filesystem::path& picture, const std::filesystem::path& folder, double tolerance) {
  INFO(picture.string());
  const Image found = radiosity::readImage(picture), expected = radiosity::readImage(folder / "render.png");
  CHECK(difference(found, expected) < tolerance);
  CHECK(difference(found, expected, true) > 2 * tolerance);
}

/// Solves the Cornell box into the folder `lit`.
void solveCornellBox(const Shell& shell) {
  shell.output("solve " HEMITEX_DATA "/cornell-box.obj -o lit --texels 16 --residual 0.01 --resolution 128");
}

/// f3d 1.3 (VTK 9.1) draws unlit materials without their textures. This copy of scene.glb has the same textures as
/// emission of black materials.
void writeEmissive(const Shell& shell, const std::string& from, const std::string& to) {
  Glb glb = parseGlb(readAll(shell.file(from)));
  glb.description.erase("extensionsUsed");
  for (json& material : glb.description["materials"]) {
    material.erase("extensions");
    material["pbrMetallicRoughness"]["baseColorFactor"] = {0, 0, 0, 1};
    material["emissiveTexture"] = material["pbrMetallicRoughness"]["baseColorTexture"];
    material["emissiveFactor"] = {1, 1, 1};
  }
  writeAll(shell.file(to), glbBytes(glb));
}

std::string numbersOf(const json& vector) {
  std::ostringstream text;
  text << vector[0] << ',' << vector[1] << ',' << vector[2];
  return text.str();
}

}  // namespace

TEST_CASE("f3d draws scene.obj and scene.glb as render.png", "[viewers]") {
  const Shell shell;
  if (shell.execute("command -v f3d && command -v xvfb-run && command -v xauth").exitCode != 0) {
    WARN("skipped: f3d, xvfb or xauth is not installed");
    return;
  }
  solveCornellBox(shell);
  writeEmissive(shell, "lit/scene.glb", "lit/emissive.glb");
  const auto draw = [&](const std::string& name, const std::string& options) {
    const Outcome outcome = shell.execute("xvfb-run -a f3d --dry-run --quiet --resolution 800,600 --bg-color 0,0,0 " +
                                          options + " --output " + name + ".png lit/" + name);
    REQUIRE(outcome.exitCode == 0);
    return shell.file(name + ".png");
  };
  const json view = json::parse(readAll(shell.file("lit/scene.view.json")));
  const std::string camera = "--camera-position " + numbersOf(view["eye"]) + " --camera-focal-point " +
                             numbersOf(view["look_at"]) + " --camera-view-up " + numbersOf(view["up"]) +
                             " --camera-view-angle " + view["fov"].dump();
  // f3d takes one sample per pixel.
  checkPicture(draw("scene.obj", camera), shell.file("lit"), 0.003);
  // Black materials still reflect some percent of f3d's light.
  checkPicture(draw("emissive.glb", "--camera-index 0"), shell.file("lit"), 0.02);
}

TEST_CASE("VTK draws the cell data of scene.vtu as render.png", "[viewers]") {
  const Shell shell;
  if (shell.execute("command -v xvfb-run && command -v xauth && /usr/bin/python3 -c 'import vtk'").exitCode != 0) {
    WARN("skipped: python3-vtk9, xvfb or xauth is not installed");
    return;
  }
  shell.output("solve " HEMITEX_DATA "/cornell-box.obj -o lit --facets --max-error 0.02 --no-textures");
  const json settings = solutionOf(shell, "lit")["settings"];
  const Outcome outcome = shell.execute("xvfb-run -a /usr/bin/python3 " HEMITEX_SOURCE
                                        "/tests/viewers/draw_in_vtk.py lit/scene.vtu radiosity lit/scene.view.json " +
                                        settings["exposure"].dump() + " 800 600 vtk.png");
  INFO(outcome.out + outcome.err);
  REQUIRE(outcome.exitCode == 0);
  CHECK(outcome.out.find("cells: 19") != std::string::npos);
  checkPicture(shell.file("vtk.png"), shell.file("lit"), 0.003);
}

TEST_CASE("Blender imports scene.obj and scene.glb, and draws them as render.png", "[.blender]") {
  const Shell shell;
  solveCornellBox(shell);
  const json solution = solutionOf(shell, "lit");
  std::set<std::string> expected;
  for (const json& surface : solution["surfaces"]) {
    const std::string name = surface["name"];
    expected.insert(name.substr(0, name.find('#')));
  }
  for (const std::string name : {"scene.obj", "scene.glb"}) {
    const Outcome outcome = shell.execute("blender -b --python-exit-code 1 --python " HEMITEX_SOURCE
                                          "/tests/viewers/draw_in_blender.py -- lit/" +
                                          name + " " + name + ".png");
    INFO(outcome.out + outcome.err);
    REQUIRE(outcome.exitCode == 0);
    const std::string heading = "objects: ";
    std::set<std::string> found;
    for (const std::string& line : linesOf(outcome.out))
      if (line.starts_with(heading)) {
        std::istringstream words(line.substr(heading.size()));
        for (std::string word; words >> word;) found.insert(word);
      }
    CHECK(found == expected);
    // Blender takes a few random samples per pixel, and encodes black as 1/255.
    checkPicture(shell.file(name + ".png"), shell.file("lit"), 0.005);
  }
}
