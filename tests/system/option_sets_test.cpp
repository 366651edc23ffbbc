/// Options of `hemitex solve` compose: random sets of them solve a scene, its account closes, and its light is that
/// without them; or docs/options.md says that two of them exclude each other.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "raster/base/file_io.h"
#include "tests/support/shell.h"
#include "tests/support/solved_folder.h"

using namespace hemitex;
using namespace hemitex::tests;
using nlohmann::json;

namespace {

/// A closed room, whose light is spread over all surfaces.
const std::string scene = HEMITEX_DATA "/paper-room.obj";

/// One spelling per option. None changes what is lit; the coarsest resolution and grid bound the error.
const std::vector<std::string> choices{"--texels 6",
                                       "--texel-size 1",
                                       "--adaptive 0.002",
                                       "--max-error 0.2",
                                       "--residual 0.0005",
                                       "--shots 2000",
                                       "--resolution 48",
                                       "--split 0.01",
                                       "--orientation aligned",
                                       "--pixels-per-element 4",
                                       "--method tetrahedron",
                                       "--method rays --samples 4096 --seed 3",

                                       "--discretize mesh",
                                       "--index-maps packed",
                                       "--format r8g8b8a8",
                                       "--no-align --blend integer-add",
                                       "--row-cache 1",
                                       "--patch 2",
                                       "--bands bands.json",
                                       "--edits edits.json",
                                       "--checkpoint state",
                                       "--report",
                                       "--lightmap",
                                       "--no-textures",
                                       "--no-elements",
                                       "--filter one-to-one",
                                       "--magnify 2",
                                       "--units cm",
                                       "--scale 2",
                                       "--lamp 0,2,1=3,2,1",
                                       "--facets",
                                       "--no-facets",
                                       "--mirror x=-3",
                                       "--periodic 0,5,5 --repeats 1",
                                       "--size 40x30",
                                       "--threads 1"};

/// The shares of the emitted flux that are absorbed, in each band.
std::vector<double> absorbedShares(const json& solution) {
  const json& energy = solution["energy"];
  std::vector<double> shares;
  for (std::size_t band = 0; band < energy["emitted"].size(); ++band) {
    const auto flux = [&](const char* name) { return energy[name][band].get<double>(); };
    CHECK(flux("absorbed") + flux("unshot") + flux("lost") == Approx(flux("emitted")).epsilon(1e-9));
    shares.push_back((flux("absorbed") + flux("unshot")) / flux("emitted"));
  }
  return shares;
}

std::string nameOf(const std::string& option) { return option.substr(0, option.find(' ')); }

/// Whether a row of docs/options.md about what is refused has both options.
bool arePaired(const std::string& a, const std::string& b) {
  const std::string page = raster::readFile(HEMITEX_DOCS "/options.md");
  for (const std::string& line : linesOf(page.substr(0, page.find("What options mean together"))))
    if (line.find('`' + a) != std::string::npos && line.find('`' + b) != std::string::npos) return true;
  return false;
}

void checkSet(const Shell& shell, const std::vector<std::string>& options) {
  std::string text;
  for (const std::string& option : options) text += option + ' ';
  // A picture of the default size takes four times as long as the solution.
  if (text.find("--size") == std::string::npos) text += "--size 40x30 ";
  INFO(text);
  const std::filesystem::path folder = shell.file("out");
  std::filesystem::remove_all(folder);
  std::filesystem::remove(shell.file("state"));
  const Outcome outcome = shell.run("solve " + scene + " -o out -q " + text);
  INFO(outcome.err);
  if (outcome.exitCode == 2) {
    bool isExplained = false;
    for (const std::string& a : options)
      for (const std::string& b : options)
        isExplained = isExplained || (nameOf(a) < nameOf(b) && arePaired(nameOf(a), nameOf(b)));
    CHECK(isExplained);
    CHECK_FALSE(std::filesystem::exists(folder));
    return;
  }
  REQUIRE(outcome.exitCode == 0);
  const json solution = json::parse(readAll(folder / "solution.json"));
  for (const double share : absorbedShares(solution)) CHECK(share == Approx(1).margin(0.02));

  // A run that goes on from the last checkpoint, or two solutions one after the other, have the same light.
  const bool hasState = std::filesystem::exists(shell.file("state"));
  shell.output("solve " + scene + " -o again -q " + text + (hasState ? "--resume state" : ""));
  const json again = solutionOf(shell, "again");
  for (const char* name : {"energy", "surfaces", "residual", "files", "settings"}) {
    INFO(name);
    CHECK(again.value(name, json()) == solution.value(name, json()));
  }
  std::filesystem::remove_all(shell.file("again"));
}

void checkSets(std::uint32_t seed, int count) {
  const Shell shell;
  writeAll(shell.file("bands.json"), R"({"wavelengths": [450, 500, 550, 600]})");
  writeAll(shell.file("edits.json"), R"({"frames": [[], [{"reflectance": "*", "to": [0.2, 0.3, 0.4]}]]})");
  std::mt19937 random(seed);
  for (int i = 0; i < count; ++i) {
    std::vector<std::string> options;
    const std::size_t wanted = 2 + random() % 3;
    while (options.size() < wanted) {
      const std::string& option = choices[random() % choices.size()];
      bool isNew = true;
      for (const std::string& chosen : options) isNew = isNew && nameOf(chosen) != nameOf(option);
      if (isNew) options.push_back(option);
    }
    checkSet(shell, options);
  }
}

}  // namespace

TEST_CASE("Sets of options of hemitex solve work together, or the table says why not", "[cli]") { checkSets(1, 25); }

TEST_CASE("Many sets of options of hemitex solve work together, or the table says why not", "[.option_sets]") {
  checkSets(2, 300);
}
