// The tables of `hemitex paper`: medians and ratios of given runs, their JSON, and a small measurement.
#include "reference/measurement/paper/tables.h"

#include <catch2/catch.hpp>

#include "cli/report/paper_report.h"
#include "reference/measurement/paper/scenes.h"

using namespace hemitex;
using namespace hemitex::reference;

namespace {

PaperRun run(const std::string& scene, const std::string& discretize, const std::string& level, int resolution,
             int shots, const PaperTimes& seconds) {
  return {scene, 8088, "software", discretize, level, resolution, 1000, shots, seconds};
}

/// At the coarse level textures take 2 s for 100 shots. At the fine level they take 4 s, and meshing takes 1 s per
/// shot.
std::vector<PaperRun> table() {
  return {run("complex", "texture", "coarse", 128, 100, {2, 1, 0.5}),
          run("complex", "texture", "fine", 128, 100, {4, 1.1, 0.51}),
          run("complex", "mesh", "coarse", 128, 100, {8, 6, 5}),
          run("complex", "mesh", "fine", 128, 10, {10, 9, 8}),
          run("complex", "texture", "coarse", 512, 100, {20, 10, 5}),
          run("complex", "texture", "fine", 512, 100, {24, 10.6, 5.3}),
          run("plant", "texture", "coarse", 128, 100, {2, 2, 2})};
}

}  // namespace

TEST_CASE("mediansOf sums the medians of each shot and of the rest", "[paper]") {
  // Shots of 1, 2 and 3 s. Each repetition has a disturbance in a different shot. The rest takes 5, 7 and 6 s.
  const std::vector<ShotTimes> repeats{{.formFactors = {9, 2, 3}, .draw = {1, 1, 1}, .rest = 5},
                                       {.formFactors = {1, 9, 3}, .draw = {2, 0, 1}, .rest = 7},
                                       {.formFactors = {1, 2, 9}, .draw = {3, 1, 1}, .rest = 6}};
  const PaperTimes times = mediansOf(repeats);
  CHECK(times.formFactors == 6);
  CHECK(times.draw == 4);
  CHECK(times.total == 12);
  const PaperTimes two = mediansOf({repeats[0], repeats[1]});
  CHECK(two.formFactors == 5 + 5.5 + 3);
}

TEST_CASE("speedUps and growths are ratios of times per shot, beside those of the paper", "[paper]") {
  const std::vector<PaperRatio> speed = speedUps(table());
  REQUIRE(speed.size() == 2);
  CHECK(speed[0].run.level == "coarse");
  CHECK(speed[0].ratio.total == 4);
  CHECK(speed[0].ratio.formFactors == 6);
  CHECK(speed[0].ratio.draw == 10);
  CHECK(speed[1].ratio.total == 25);  // 1 s per shot over 0.04 s
  CHECK(*speed[1].published.total == 193 / 14.5);
  CHECK(*speed[1].published.formFactors == 186 / 7.8);

  const std::vector<PaperRatio> growth = growths(table());
  REQUIRE(growth.size() == 3);  // the plant has no fine level
  CHECK(growth[0].run.discretize == "texture");
  CHECK(growth[0].ratio.total == 2);
  CHECK(growth[0].ratio.formFactors == 1.1);
  CHECK(*growth[0].published.formFactors == 7.8 / 6.6);
  CHECK(growth[1].run.discretize == "mesh");
  CHECK(growth[1].ratio.total == 12.5);
  CHECK(*growth[2].published.formFactors == 1);
}

TEST_CASE("publishedTimes has the runs of the paper", "[paper]") {
  CHECK(publishedTimes(run("simple", "mesh", "fine", 512, 100, {}))->total == 21.1);
  CHECK(publishedTimes(run("complex", "mesh", "fine", 128, 100, {}))->formFactors == 186);
  CHECK_FALSE(publishedTimes(run("complex", "mesh", "fine", 512, 100, {}))->total);
  CHECK(publishedTimes(run("complex", "mesh", "fine", 512, 100, {}))->formFactors == 294);
  PaperRun hardware = run("complex", "texture", "medium", 512, 100, {});
  hardware.device = "opengl";
  CHECK(publishedTimes(hardware)->total == 17.2);
  CHECK_FALSE(publishedTimes(run("plant", "mesh", "coarse", 128, 100, {})));
}

TEST_CASE("paperJson has runs and ratios, and null for values that the paper does not have", "[paper]") {
  const nlohmann::ordered_json json = cli::paperJson(table());
  REQUIRE(json["runs"].size() == 7);
  std::vector<std::string> keys;
  for (const auto& [key, value] : json["runs"][0].items()) keys.push_back(key);
  CHECK(keys == std::vector<std::string>{"scene", "triangles", "device", "discretize", "level", "resolution",
                                         "elements", "shots", "total_s", "form_factor_s", "draw_s", "paper"});
  CHECK(json["runs"][3]["shots"] == 10);
  CHECK(json["runs"][3]["total_s"] == 10);
  CHECK(json["runs"][3]["paper"]["total_s"] == 193);
  CHECK(json["runs"][6]["paper"]["total_s"].is_null());
  REQUIRE(json["speed_ups"].size() == 2);
  CHECK(json["speed_ups"][1]["total"] == 25);
  CHECK(json["growth"].size() == 3);
}

TEST_CASE(
    "paperScenes has the elements and patches of the paper, and measurePaperRuns measures every cell of the table",
    "[paper]") {
  std::vector<PaperScene> scenes = paperScenes(HEMITEX_DATA);
  PaperScene simple = scenes.front();
  REQUIRE(simple.levels.size() == 3);
  const std::array<std::size_t, 3> elements{241, 961, 3841};
  for (std::size_t level = 0; level < 3; ++level) {
    CHECK(simple.levels[level].discretization.elements.size() == elements[level]);
    CHECK(simple.levels[level].discretization.patches.list.size() == 61);
  }
  CHECK(simple.shots == 100);

  const PaperScene& complex = scenes.at(1);
  REQUIRE(complex.levels.size() == 3);
  CHECK(radiosity::triangleCount(complex.scene) == 8088);
  for (const PaperLevel& level : complex.levels) {
    CHECK(level.layout.pages.size() == 8);
    // A block of texels that merged into its neighbours is not a patch. Fewer blocks merge at finer levels.
    CHECK(level.discretization.patches.list.size() >= complex.levels.front().discretization.patches.list.size());
    CHECK(double(level.discretization.patches.list.size()) <=
          1.01 * double(complex.levels.front().discretization.patches.list.size()));
  }

  simple.shots = 3;
  simple.levels.pop_back();
  const std::vector<PaperRun> runs = measurePaperRuns(
      {simple}, {{"software", radiosity::softwareRenderer}, {"slow", radiosity::softwareRenderer, 2 * 241}},
      {.resolutions = {16, 32}, .repeats = 2}, {});
  REQUIRE(runs.size() == 2 * 2 * 2 * 2);
  for (const PaperRun& cell : runs) {
    const bool isCut = cell.device == "slow" && cell.discretize == "mesh";
    CHECK(cell.shots == (!isCut ? 3 : cell.level == "coarse" ? 2 : 1));
    CHECK(cell.triangles == 26);
    CHECK(cell.elements == (cell.level == "coarse" ? 241u : 961u));
    CHECK(cell.seconds.draw > 0);
    CHECK(cell.seconds.formFactors > cell.seconds.draw);
    CHECK(cell.seconds.total > cell.seconds.formFactors);
  }
  CHECK(speedUps(runs).size() == 8);
}
