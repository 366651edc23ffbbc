/// Limits of what `hemitex bench` and `hemitex paper` measure, and of the time per triangle. They depend on the machine
/// and take minutes, so they are run by hand on a machine that does nothing else: `cmake --build build/release --target
/// limits`.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "raster/base/file_io.h"
#include "raster/base/parallel.h"
#include "raster/software/software_renderer.h"
#include "reference/measurement/bench/equal_time_error.h"
#include "reference/measurement/bench/subdivided_scene.h"
#include "reference/measurement/bench/timing.h"
#include "tests/support/box_scene.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using nlohmann::json;

namespace {

/// What a command writes into its JSON file.
json resultOf(const std::string& command) {
  const hemitex::TemporaryFolder folder;
  const std::string line = "'" HEMITEX_PROGRAM "' " + command + " -o '" + folder.path.string() + "' >/dev/null";
  REQUIRE(std::system(line.c_str()) == 0);
  return json::parse(hemitex::raster::readFile(folder.path / (command + ".json")));
}

double number(const json& value) { return value.get<double>(); }

/// The number of triangles of each scene before it is cut: the fewest.
std::map<std::string, int> ownTriangles(const json& runs) {
  std::map<std::string, int> own;
  for (const json& run : runs) {
    const int triangles = run["triangles"];
    const auto known = own.try_emplace(run["scene"], triangles).first;
    known->second = std::min(known->second, triangles);
  }
  return own;
}

/// How many times longer Embree has to take than a hemicube of the gallery.
double leastOfGallery(int resolution) { return resolution >= 1024 ? 4 : 2; }

/// The same for a room cut into 8000 triangles.
double leastOfCutRoom(int resolution) { return resolution >= 256 ? 3 : 2; }

void checkRatio(const json& ratio, bool isOwn) {
  const std::string scene = ratio["scene"], what = ratio["what"];
  const int triangles = ratio["triangles"], resolution = ratio["resolution"];
  const bool isRoom = isOwn && scene == "paper-room", isGallery = isOwn && scene == "gallery";
  const double overHemicube = ratio["over_hemicube"];
  INFO(ratio.dump());
  if (what == "embree" && isRoom) CHECK(overHemicube >= 5);
  if (what == "embree" && isGallery) CHECK(overHemicube >= leastOfGallery(resolution));
  if (what == "embree" && scene == "paper-room" && triangles == 8000) CHECK(overHemicube >= leastOfCutRoom(resolution));
  if (what == "embree" && triangles >= 1000000 && resolution >= 512) CHECK(overHemicube >= 1);
  if (what.starts_with("opengl")) CHECK(overHemicube >= 1);
  if (what == "floor" && isRoom && resolution == 1024) CHECK(overHemicube >= 1 / 2.5);
  if (what == "hemicube-mesh" && isGallery && resolution == 128) CHECK(overHemicube >= 13.3);
}

}  // namespace

TEST_CASE("hemitex bench keeps its limits", "[.limits]") {
  const json result = resultOf("bench");
  const std::map<std::string, int> own = ownTriangles(result["runs"]);
  for (const json& ratio : result["ratios"]) checkRatio(ratio, ratio["triangles"] == own.at(ratio["scene"]));
  for (const json& error : result["equal_time_error"]) {
    INFO("hemicubes over rays in the same time: " << error.dump());
    CHECK(number(error["ratio"]) <= 0.5);
  }
  for (const json& growth : result["growth"]) {
    INFO("drawing the most elements over the fewest: " << growth.dump());
    CHECK(number(growth["points"].back()["draw_ms"]) / number(growth["points"].front()["draw_ms"]) <= 1.05);
  }
  for (const json& wall : result["tied_wall"]) {
    INFO("the wall that needs exact arithmetic: " << wall.dump());
    CHECK(number(wall["ratio"]) <= 2);
  }
  for (const json& parts : result["solution_parts"]) {
    INFO("what is not hemicubes: " << parts.dump());
    CHECK(number(parts["beside_percent"]) <= 20);
  }
  CHECK(number(result["memory"]["bytes_per_element"]) <= 64);
  CHECK(number(result["memory"]["bytes_per_pixel"]) <= 24);
  if (result["two_cores"].empty()) return;  // on one core
  CHECK(number(result["two_cores"]["hemicube_of_arithmetic"]) >= 0.93);
  CHECK(number(result["two_cores"]["solution_of_arithmetic"]) >= 0.95);
}

// Textures are as much faster than meshing as Table 2 of the paper says (193 / 14.5), and finer elements cost little.
TEST_CASE("hemitex paper keeps its limits on the complex scene", "[.limits]") {
  const json result = resultOf("paper");
  for (const json& speedUp : result["speed_ups"]) {
    if (speedUp["scene"] != "complex" || speedUp["device"] != "software" || speedUp["level"] != "fine" ||
        speedUp["resolution"] != 128)
      continue;
    INFO(speedUp.dump());
    CHECK(number(speedUp["total"]) >= 13.3);
    CHECK(number(speedUp["form_factor"]) >= 13.3);
  }
  for (const json& growth : result["growth"]) {
    if (growth["scene"] != "complex" || growth["device"] != "software" || growth["discretize"] != "texture") continue;
    INFO(growth.dump());
    CHECK(number(growth["draw"]) < 1.05);
    CHECK(number(growth["form_factor"]) <= (growth["resolution"] == 128 ? 1.18 : 1.05));
  }
}

// A hemicube of resolution 256 has 196,608 pixels, so that a triangle of a closed box of 8,112 has 24 in the mean.
TEST_CASE("Drawing triangles of 24 pixels takes at most 100 ns each", "[.limits]") {
  const raster::ThreadLimit oneThread(1);
  const Scene scene = reference::finerScene(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 8112);
  const Discretization discretization = discretize(scene, {.texels = 8});
  const IdLayout layout = layOut(discretization);
  raster::SoftwareRenderer renderer(makeDrawList(scene, discretization, layout));
  ProjectedFormFactors rows(scene, discretization, layout, renderer, {.resolution = 256});
  constexpr std::size_t views = 16;
  std::vector<View> seen;
  for (const std::uint32_t patch : reference::spreadPatches(discretization, views))
    seen.push_back(rows.viewsOfPatch(patch).front());
  std::vector<raster::ItemBuffer> buffers;
  const std::function<void()> drawAll = [&] {
    for (const View& view : seen) raster::draw(renderer, view.faces, view.skipped, buffers);
  };
  const double seconds = reference::shortTaskTimings({&drawAll, 1}, 25).front().median;
  CHECK(seconds / views / static_cast<double>(triangleCount(scene)) * 1e9 <= 100);
}
