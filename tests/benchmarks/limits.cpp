/// Limits of what `hemitex bench`, `hemitex paper` and hemitex_benchmarks measure, and of the time per triangle. They
/// depend on the machine and take minutes, so they are run by hand on a machine that does nothing else: `cmake --build
/// build/release --target limits`.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "raster/base/file_io.h"
#include "raster/base/parallel.h"
#include "raster/software/software_renderer.h"
#include "reference/measurement/bench/equal_time_error.h"
#include "reference/measurement/bench/timing.h"
#include "tests/support/box_scene.h"
#include "tests/support/subdivided_scene.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using nlohmann::json;

namespace {

json resultOf(const std::string& program, const std::string& arguments, const std::filesystem::path& file) {
  const std::string line = "'" + program + "' " + arguments + " >/dev/null";
  REQUIRE(std::system(line.c_str()) == 0);
  return json::parse(hemitex::raster::readFile(file));
}

/// What a command of hemitex writes into its JSON file.
json resultOf(const std::string& command) {
  const hemitex::TemporaryFolder folder;
  return resultOf(HEMITEX_PROGRAM, command + " -o '" + folder.path.string() + "'", folder.path / (command + ".json"));
}

/// The benchmarks with these names by name. Those that are repeated have the medians of their repetitions.
std::map<std::string, json> benchmarksOf(const std::string& names) {
  const hemitex::TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "benchmarks.json";
  const json result = resultOf(HEMITEX_BENCHMARKS,
                               "--benchmark_filter='^(" + names +
                                   ")' --benchmark_repetitions=11 --benchmark_enable_random_interleaving "
                                   "--benchmark_report_aggregates_only --benchmark_out='" +
                                   file.string() + "'",
                               file);
  std::map<std::string, json> found;
  for (const json& benchmark : result["benchmarks"])
    if (benchmark.value("aggregate_name", "median") == "median") found[benchmark["run_name"]] = benchmark;
  return found;
}

double number(const json& value) { return value.get<double>(); }

/// How many times longer Embree has to take than a hemicube of the gallery.
double leastOfGallery(int resolution) { return resolution >= 1024 ? 4 : 2; }

/// The same for a room cut into 8000 triangles.
double leastOfCutRoom(int resolution) { return resolution >= 256 ? 3 : 2; }

void checkRatio(const json& ratio) {
  const std::string scene = ratio["scene"], what = ratio["what"];
  const int resolution = ratio["resolution"];
  const double overHemicube = ratio["over_hemicube"];
  INFO(ratio.dump());
  if (what == "embree" && scene == "paper-room") CHECK(overHemicube >= 5);
  if (what == "embree" && scene == "gallery") CHECK(overHemicube >= leastOfGallery(resolution));
  if (what.starts_with("opengl")) CHECK(overHemicube >= 1);
  if (what == "floor" && scene == "paper-room" && resolution == 1024) CHECK(overHemicube >= 1 / 2.5);
  if (what == "hemicube-mesh" && scene == "gallery" && resolution == 128) CHECK(overHemicube >= 13.3);
}

/// The time of one benchmark over that of another.
double ratioOf(const std::map<std::string, json>& benchmarks, const std::string& name, const std::string& other) {
  return number(benchmarks.at(name)["real_time"]) / number(benchmarks.at(other)["real_time"]);
}

}  // namespace

TEST_CASE("hemitex bench keeps its limits", "[.limits]") {
  const json result = resultOf("bench");
  for (const json& ratio : result["ratios"]) checkRatio(ratio);
}

TEST_CASE("Rays and OpenGL keep their limits in subdivided scenes", "[.limits]") {
  for (const auto& [name, counters] : benchmarksOf("triangles")) {
    const int resolution = std::stoi(name.substr(name.find("R:") + 2));
    INFO(counters.dump());
    if (name.find("paper_room") != std::string::npos)
      CHECK(number(counters["embree of 8000"]) >= leastOfCutRoom(resolution));
    if (resolution >= 512) CHECK(number(counters["embree of 1000000"]) >= 1);
    for (const auto& [counter, value] : counters.items())
      if (counter.starts_with("opengl")) CHECK(number(value) >= 1);
  }
}

TEST_CASE("Hemicubes have at most half of the error of rays in the same time", "[.limits]") {
  for (const auto& [name, counters] : benchmarksOf("errorAtEqualTime"))
    for (const auto& [counter, value] : counters.items()) {
      INFO(name << ", " << counter);
      if (counter.starts_with("ratio")) CHECK(number(value) <= 0.5);
    }
}

TEST_CASE("Finer elements and exact arithmetic keep their limits", "[.limits]") {
  const auto benchmarks = benchmarksOf("growthOfDrawing|wall");
  for (const std::string growth : {"growthOfDrawing/paper_room/side:", "growthOfDrawing/cornell_box/side:"})
    CHECK(ratioOf(benchmarks, growth + "1024", growth + "16") <= 1.05);
  for (const std::string side : {"/R:32", "/R:512"})
    CHECK(ratioOf(benchmarks, "wall/worst_case" + side, "wall/control" + side) <= 2);
}

TEST_CASE("Solutions keep their limits of time, memory and speed-up", "[.limits]") {
  auto benchmarks = benchmarksOf("parts|memory|arithmetic|hemicubes|solution");
  for (const int resolution : {128, 256, 512, 1024})
    CHECK(number(benchmarks.at("parts/R:" + std::to_string(resolution))["beside"]) <= 20);
  const json& memory = benchmarks.at("memory/iterations:1/repeats:1");
  CHECK(number(memory["bytes per element"]) <= 64);
  CHECK(number(memory["bytes per pixel"]) <= 24);
  if (std::thread::hardware_concurrency() == 1) return;
  const auto speedUp = [&](const std::string& task) {
    return ratioOf(benchmarks, task + "/threads:1/real_time", task + "/threads:2/real_time");
  };
  CHECK(speedUp("hemicubes") / speedUp("arithmetic") >= 0.93);
  CHECK(speedUp("solution") / speedUp("arithmetic") >= 0.95);
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
  const Scene scene = tests::finerScene(tests::closedCube(glm::dvec3(0.5), glm::dvec3(1)), 8112);
  const Discretization discretization = discretize(scene, {.texels = 8});
  const IdLayout layout = layOut(discretization);
  raster::SoftwareRenderer renderer(makeDrawList(scene, discretization, layout));
  ProjectedFormFactors rows(scene, discretization, layout, renderer, {.resolution = 256});
  constexpr std::size_t views = 16;
  std::vector<View> seen;
  for (const Patch& patch : reference::spreadPatches(discretization, views))
    seen.push_back(rows.viewsOfPatch(patch).front());
  std::vector<raster::ItemBuffer> buffers;
  const std::function<void()> drawAll = [&] {
    for (const View& view : seen) raster::draw(renderer, view.faces, view.skipped, buffers);
  };
  const double seconds = reference::shortTaskTimings({&drawAll, 1}, 25).front().median;
  CHECK(seconds / views / static_cast<double>(triangleCount(scene)) * 1e9 <= 100);
}
