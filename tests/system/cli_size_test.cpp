/// hemitex solve --no-elements and --no-textures: what the folder then holds, and what other commands say about it.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/support/shell.h"
#include "tests/support/solved_folder.h"

using namespace hemitex::tests;
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

std::set<std::string> namesIn(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

std::set<std::string> namedFiles(const json& solution) {
  std::set<std::string> names{"solution.json"};
  for (const auto& [name, hash] : solution["files"].items()) names.insert(name);
  return names;
}

}  // namespace

TEST_CASE("hemitex solve --no-elements and --no-textures leave out these files and nothing else", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "-o whole");
  shell.output(quickSolve + "-o small --no-elements --no-textures");
  CHECK(namesIn(shell.file("small")) == std::set<std::string>{"render.png", "scene.view.json", "solution.json"});
  json whole = solutionOf(shell, "whole"), small = solutionOf(shell, "small");
  CHECK(namedFiles(whole) == namesIn(shell.file("whole")));
  CHECK(namedFiles(small) == namesIn(shell.file("small")));
  for (const json& surface : small["surfaces"]) CHECK(surface["texture"].is_null());
  CHECK(small["settings"]["filter"].is_null());
  for (json* solution : {&whole, &small}) {
    for (const char* key : {"files", "times"}) solution->erase(key);
    (*solution)["settings"].erase("filter");
    for (json& surface : (*solution)["surfaces"]) surface.erase("texture");
  }
  CHECK(small == whole);

  // Each option leaves out its own files, also those of an earlier result in the same folder.
  std::set<std::string> names = namesIn(shell.file("whole"));
  names.erase("elements.csv");
  shell.output(quickSolve + "-o whole --no-elements");
  CHECK(namesIn(shell.file("whole")) == names);
  shell.output(quickSolve + "-o whole --no-textures");
  CHECK(namesIn(shell.file("whole")) ==
        std::set<std::string>{"elements.csv", "render.png", "scene.view.json", "solution.json"});
}

TEST_CASE("hemitex solve --no-textures shows elements without filtering in render.png", "[cli]") {
  const Shell shell;
  // Both pictures show the radiosity of elements: with so little unshot light the ambient estimate changes no colour.
  shell.output(quickSolve + "--residual 1e-9 -o whole");
  shell.output(quickSolve + "--residual 1e-9 -o small --no-textures");
  shell.output("render whole/scene.obj --show elements --size 40x30 -o elements.png");
  CHECK(readAll(shell.file("small/render.png")) != readAll(shell.file("whole/render.png")));
  CHECK(readAll(shell.file("small/render.png")) == readAll(shell.file("elements.png")));
}

TEST_CASE("Commands say that a folder of hemitex solve --no-textures holds no lit scene", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "-o small --no-textures");
  for (const char* command : {"view small", "render small/scene.obj -o picture.png"}) {
    const Outcome outcome = shell.run(command);
    INFO(command << ": " << outcome.err);
    CHECK(outcome.exitCode == 2);
    CHECK(outcome.err.find("without --no-textures") != std::string::npos);
  }
  for (const char* other : {"--filter bilinear", "--magnify 2"}) {
    const Outcome outcome = shell.run(quickSolve + "-o other --no-textures " + other);
    INFO(other);
    CHECK(outcome.exitCode == 2);
    CHECK(outcome.err.find("--no-textures") != std::string::npos);
  }
  shell.output(quickSolve + "-o small");
  shell.output("render small/scene.obj -o picture.png");
}

TEST_CASE("hemitex solve --no-textures --lightmap writes the light maps alone, with the bytes beside textures",
          "[cli]") {
  const Shell shell;
  const std::string ofMaps = "--lightmap --filter bilinear --magnify 2 ";
  shell.output(quickSolve + ofMaps + "-o whole");
  shell.output(quickSolve + ofMaps + "-o maps --no-textures");
  const json whole = solutionOf(shell, "whole"), maps = solutionOf(shell, "maps");
  json expected = json::object();
  for (const auto& [name, hash] : whole["files"].items())
    if (name.starts_with("lightmap") || name == "elements.csv" || name == "scene.view.json") expected[name] = hash;
  CHECK(expected.contains("lightmap.glb"));
  json files = maps["files"];
  CHECK(files.erase("render.png") == 1);  // it shows elements
  CHECK(files == expected);
  CHECK(maps["settings"]["filter"] == "bilinear");
}

TEST_CASE("The page of hemitex solve --no-textures says that it has no room to show", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "-o small --no-textures --report");
  CHECK_FALSE(shell.files().contains("small/scene.glb"));
  CHECK_THAT(readAll(shell.file("small/report.html")), Catch::Matchers::Contains(R"("glb": "missing")"));
}

TEST_CASE("hemitex solve refuses more than 2^24 elements before it starts, unless --insist is given", "[cli]") {
  const Shell shell;
  const std::string finest = "solve room.obj -o out --texels 4096";
  const Outcome refused = shell.run(finest);  // 6 surfaces
  CHECK(refused.exitCode == 2);
  CHECK(refused.err.find("the scene becomes 100663296 elements") != std::string::npos);
  CHECK(refused.err.find("--insist") != std::string::npos);
  CHECK_FALSE(fs::exists(shell.file("out")));
  CHECK(shell.execute("timeout 1 '" HEMITEX_PROGRAM "' " + finest + " --insist").exitCode == 124);
}
