/// hemitex bench and tradeoff: tables, objects and pages.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/support/shell.h"

using namespace hemitex::tests;
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// Removes the values that differ from run to run.
json withoutTimesOfJson(json value) {
  if (value.is_object()) value.erase("times");
  for (json& part : value)
    if (part.is_structured()) part = withoutTimesOfJson(part);
  return value;
}

}  // namespace

TEST_CASE("hemitex tradeoff --device has the errors of the software, by a judged device", "[cli]") {
  const Shell shell;
  const std::string quick = "tradeoff room.obj --texels 2 --patch 1 --samples 128 --method hemicube=32 --json ";
  const Outcome drawn = shell.run(quick + "-o drawn --device vulkan");
  if (drawn.exitCode == 2) {
    WARN("skipped: no Vulkan device: " << drawn.err);
    return;
  }
  const json result = json::parse(drawn.out), expected = json::parse(shell.output(quick + "-o expected"));
  CHECK(result["settings"]["device"].get<std::string>() != "");
  CHECK(result["choices"][0]["radiosity_error"] == expected["choices"][0]["radiosity_error"]);
  CHECK(result["choices"][0]["row_error"] == expected["choices"][0]["row_error"]);
}

TEST_CASE("hemitex tradeoff writes a table, an object and a page, the same for any number of threads except times",
          "[cli]") {
  const Shell shell;
  const std::string quick =
      "tradeoff room.obj --texels 4,2 --patch 2,1 --samples 256 --method hemicube=32,64 --method centre-rays=64 ";
  shell.output(quick + "-o one --threads 1");
  const json result = json::parse(shell.output(quick + "-o three --threads 3 --json"));
  const json one = json::parse(readAll(shell.file("one/tradeoff.json")));
  CHECK(withoutTimesOfJson(one) == withoutTimesOfJson(result));
  CHECK(result == json::parse(readAll(shell.file("three/tradeoff.json"))));
  CHECK(std::distance(fs::directory_iterator(shell.file("one")), {}) == 3);

  // Six faces: 4 x 4 texels in patches of 2 and 1, 2 x 2 in patches of 2 and 1. Hemicubes use both settings on the
  // first, and on the others those up to the middle of two, which is the second. Rays use their only setting.
  CHECK(result["scene"] == "room.obj");
  CHECK(result["truth"]["elements"] == 96);
  REQUIRE(result["choices"].size() == 4 * (2 + 1));
  const auto lines = linesOf(readAll(shell.file("one/tradeoff.csv")));
  REQUIRE(lines.size() == 1 + 4 * (2 + 1));
  CHECK(lines[1].starts_with("hemicube,resolution,32,3072,4,2,96,24,"));
  std::map<std::string, double> errors;  // by method, setting, texels and patch
  for (const json& choice : result["choices"]) {
    const auto is = [&](const char* key) { return choice[key].get<std::size_t>(); };
    const auto name = [&](std::size_t patch) {
      return json{choice["method"], choice["value"], choice["texels"], patch}.dump();
    };
    INFO(name(is("patch")));
    std::vector<double> rounds = choice["times"]["rounds_s"];
    std::sort(rounds.begin(), rounds.end());
    CHECK(rounds.front() > 0);
    CHECK(choice["times"]["median_s"] == rounds.at(1));
    // A patch of a closed box sees the elements of the other five faces: at most 12 bytes for each.
    const std::size_t most = is("patches") * (is("elements") * 5 / 6) * 12;
    if (choice["method"] == "hemicube") {
      CHECK(is("directions") == 3 * is("value") * is("value"));
      CHECK(choice["bytes"]["buffer"] == 4 * is("directions"));
      CHECK(choice["bytes"]["rows"] == most);
    } else {
      CHECK(choice["bytes"]["rows"] <= most);
    }
    // All flux arrives somewhere, so that patches of one element come nearer to the truth than those of four.
    errors[name(is("patch"))] = choice["radiosity_error"]["flux_weighted"];
    if (is("patch") == 1) CHECK(errors.at(name(1)) < errors.at(name(2)));
  }
  // Few rays have more noise than thousands of pixels.
  for (std::size_t k = 0; k < 4; ++k) {
    const auto error = [&](std::size_t choice) { return result["choices"][choice]["row_error"]["relative_l1"]; };
    CHECK(error(8 + k) > error(2 * k));
  }
  CHECK(result["same_points"]["hemicubes"].size() == 2);
  CHECK(result["same_points"]["rays"].size() == 1);
  // Other rays give another truth, and other errors.
  const json seeded = json::parse(shell.output(quick + "--seed 3 -o seeded --json"));
  CHECK(result["settings"]["seed"] == 0);
  CHECK(seeded["settings"]["seed"] == 3);
  CHECK(seeded["truth"]["radiosity_error"] != result["truth"]["radiosity_error"]);
  // A run named for an error bound is within it, and on the Pareto front.
  for (const json& level : result["times"]["within"]) {
    if (level["choice"].is_null()) continue;
    const json& choice = result["choices"][level["choice"].get<std::size_t>()];
    CHECK(choice["radiosity_error"]["flux_weighted"] <= level["error"]);
    CHECK(choice["times"]["pareto"] == true);
  }
  const std::string page = readAll(shell.file("one/report.html"));
  CHECK(page.find("{{") == std::string::npos);
  // The object of the page has pictures behind what the file has.
  const std::string file = readAll(shell.file("one/tradeoff.json"));
  CHECK(page.find(file.substr(0, file.rfind("\n}"))) != std::string::npos);
}

TEST_CASE("hemitex bench measures all documented times", "[cli]") {
  const Shell shell;
  const Outcome outcome = shell.run("bench room.obj --resolution 16 --resolution 32 --json -o out");
  REQUIRE(outcome.exitCode == 0);
  const std::string& out = outcome.out;
  const json result = json::parse(out);
  CHECK(readAll(shell.file("out/bench.json")) == out);
  std::map<int, std::set<std::string>> found;
  for (const json& run : result["runs"]) {
    CHECK(run["scene"] == "room");
    CHECK(run["triangles"] == 12);
    // Texels have the size for which 128 fit each of six equal squares. Sides of 8 and 16 are equally near to the root
    // of 128; the smaller is taken.
    CHECK(run["elements"] == 6 * 8 * 8);
    CHECK(run["threads"] == 1);
    CHECK(run["repeats"] == 11);
    CHECK(run["min_ms"] > 0.0);
    CHECK(run["median_ms"] >= run["min_ms"]);
    CHECK(run.size() == 9);
    found[run["resolution"]].insert(run["what"].get<std::string>());
  }
  std::set<std::string> all{"hemicube", "draw", "embree", "floor", "hemicube-mesh", "shot", "solution"};
  const bool hasOpenGl = !found.empty() && found.begin()->second.contains("opengl");
  if (hasOpenGl) all.insert({"opengl", "opengl-plain"});
  CHECK((outcome.err.find("OpenGL draws with ") != std::string::npos) == hasOpenGl);
  CHECK(found == std::map<int, std::set<std::string>>{{16, all}, {32, all}});
  // All but the hemicubes, the slower of both OpenGL paths, and the shots and solutions.
  CHECK(result["ratios"].size() == 2 * (all.size() - 1 - (hasOpenGl ? 1 : 0) - 2));
  const std::string page = readAll(shell.file("out/report.html"));
  CHECK(page.find("{{") == std::string::npos);
  CHECK(page.find(out) != std::string::npos);
  CHECK(readAll(shell.file("out/tables.md")).find("| room | 12 | 384 | 16 | ") != std::string::npos);
}
