/// hemitex solve --lamp and the lights of glTF files: units, names, edits and the account of flux.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/base64.h"
#include "tests/support/shell.h"
#include "tests/support/solved_folder.h"

using namespace hemitex::tests;
using nlohmann::json;
using std::numbers::pi;

namespace {

/// A closed cube [0, 1]^3 of one reflectance, seen from inside, without light.
void writeCube(const Shell& shell) {
  writeAll(shell.file("cube.obj"),
           "mtllib cube.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\nusemtl grey\n"
           "g back\nf 1 2 4 3\ng front\nf 5 7 8 6\ng floor\nf 1 5 6 2\ng ceiling\nf 3 4 8 7\ng left\nf 1 3 7 5\n"
           "g right\nf 2 6 8 4\n");
  writeAll(shell.file("cube.mtl"), "newmtl grey\nKd 0.5 0.5 0.5\n");
}

/// A ground of 8 x 8 under lights of a glTF file.
void writeGround(const Shell& shell, const json& lights) {
  const std::vector<float> corners{-4, 0, 4, 4, 0, 4, 4, 0, -4, -4, 0, -4};
  const std::string bytes(reinterpret_cast<const char*>(corners.data()), corners.size() * sizeof(float));
  json text = json::parse(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 6}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}], "extensionsUsed": ["KHR_lights_punctual"]})");
  text["buffers"] = {{{"byteLength", 48}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
  text["extensions"]["KHR_lights_punctual"]["lights"] = lights;
  for (std::size_t light = 0; light < lights.size(); ++light) {
    json node = {{"name", "bulb"}, {"translation", {0, 2, 0}}, {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}};
    node["extensions"]["KHR_lights_punctual"]["light"] = light;
    text["nodes"].push_back(node);
    text["scenes"][0]["nodes"].push_back(light + 1);
  }
  writeAll(shell.file("ground.gltf"), text.dump());
}

json solved(const Shell& shell, const std::string& arguments) {
  return json::parse(shell.output("solve " + arguments + " --size 40x30 --json"));
}

double flux(const json& solution, const char* name, std::size_t band = 0) {
  return solution["energy"][name][band].get<double>();
}

void checkBalance(const json& solution) {
  for (std::size_t band = 0; band < 3; ++band)
    CHECK(flux(solution, "absorbed", band) + flux(solution, "unshot", band) + flux(solution, "lost", band) ==
          Approx(flux(solution, "emitted", band)).epsilon(1e-12).margin(1e-9));
}

}  // namespace

TEST_CASE("hemitex solve --lamp lights a closed cube, and its account closes", "[cli]") {
  const Shell shell;
  writeCube(shell);
  const std::string options =
      GENERATE(as<std::string>(), "", "--method single-plane", "--method rays --samples 1024", "--discretize mesh",
               "--adaptive 0.001 --texels 8", "--max-error 0.2", "--shots 3", "--index-maps packed", "--two-sided");
  INFO(options);
  const json solution = solved(shell, "cube.obj -o out --lamp 0.5,0.5,0.5=1,2,0 --lamp 0.5,0.8,0.2=0,0,3 " + options);
  checkBalance(solution);
  for (std::size_t band = 0; band < 3; ++band)
    CHECK(flux(solution, "emitted", band) == Approx(4 * pi * double(band + 1)).epsilon(1e-12));
  CHECK_FALSE(solution["energy"].contains("sky_on_backs"));
  CHECK(solution["settings"]["lamp"][1] ==
        json({{"name", "lamp-2"}, {"position", {0.5, 0.8, 0.2}}, {"intensity", {0.0, 0.0, 3.0}}}));
  CHECK_FALSE(solution["settings"].contains("lumens_per_watt"));
  if (options == "--method single-plane" || options == "--shots 3" || options == "--max-error 0.2") return;
  double reflected = 0;
  for (const json& surface : solution["surfaces"])
    reflected += surface["radiosity"][0].get<double>() * surface["area"].get<double>();
  CHECK(reflected == Approx(4 * pi).epsilon(0.01));
}

TEST_CASE("hemitex solve --lamp keeps W and W/m^2 in any unit of length", "[cli]") {
  const Shell shell;
  writeCube(shell);
  const json metres = solved(shell, "cube.obj -o m --lamp 0.5,0.7,0.5=1,1,1 --texels 4"),
             feet = solved(shell, "cube.obj -o ft --lamp 0.5,0.7,0.5=1,1,1 --texels 4 --scale 0.5");
  CHECK(flux(feet, "emitted") == Approx(4 * pi).epsilon(1e-12));
  CHECK(feet["surfaces"][0]["radiosity"][0].get<double>() ==
        Approx(4 * metres["surfaces"][0]["radiosity"][0].get<double>()).epsilon(1e-12));
}

TEST_CASE("hemitex solve --edits moves and dims a lamp", "[cli]") {
  const Shell shell;
  writeCube(shell);
  writeAll(shell.file("edits.json"), R"({"frames": [[{"move": "lamp-1", "by": [0.2, 0.1, -0.3]}],
                                                    [{"emission": "lamp-*", "to": [0, 0.5, 1]}],
                                                    [{"move": "floor", "by": [0, 0.1, 0]}]]})");
  solved(shell, "cube.obj -o out --lamp 0.5,0.5,0.5=1,1,1 --texels 6 --residual 1e-5 --edits edits.json");
  const auto frame = [&](const std::string& name) {
    const json solution = json::parse(readAll(shell.file("out/" + name + "/solution.json")));
    checkBalance(solution);
    return solution;
  };
  const json moved = frame("frame-1"), dimmed = frame("frame-2"),
             again = solved(shell, "cube.obj -o again --lamp 0.7,0.6,0.2=1,1,1 --texels 6 --residual 1e-5");
  for (std::size_t s = 0; s < 6; ++s) {
    const auto of = [s](const json& solution) { return solution["surfaces"][s]["radiosity"][1].get<double>(); };
    CHECK(of(moved) == Approx(of(again)).epsilon(1e-3));
    CHECK(of(dimmed) == Approx(of(again) / 2).epsilon(1e-3));
  }
  CHECK(flux(dimmed, "emitted") == Approx(0).margin(1e-12));
  CHECK(flux(frame("frame-3"), "emitted", 2) == Approx(4 * pi).epsilon(1e-12));
}

TEST_CASE("hemitex solve says how candela and lux of a glTF file were read", "[cli]") {
  const Shell shell;
  writeGround(shell, {{{"type", "spot"}, {"intensity", 683}, {"spot", {{"outerConeAngle", 0.6}}}},
                      {{"type", "directional"}, {"intensity", 1366}}});
  const std::string scene = "solve ground.gltf -o out --size 40x30 ";
  CHECK(shell.output(scene).find("candela and lux of the file were divided by 683 lm/W; --lumens-per-watt 1") !=
        std::string::npos);
  const json solution = solutionOf(shell, "out");
  CHECK(solution["settings"]["lumens_per_watt"] == 683.0);
  CHECK(solution["settings"]["sun"][0]["irradiance"] == json({2.0, 2.0, 2.0}));
  CHECK(solution["settings"]["lamp"][0]["intensity"] == json({1.0, 1.0, 1.0}));
  const double ofSpot = 2 * pi * (1 - std::cos(0.6)) / 3;
  CHECK(flux(solution, "emitted") == Approx(2 * 64 + ofSpot).epsilon(0.01));
  const json asRead = solved(shell, "ground.gltf -o again --lumens-per-watt 1 --emit bulb=0,0,0 --sun 0,1,0=1,1,1");
  CHECK(flux(asRead, "emitted") == Approx(1367 * 64).epsilon(0.01));
  CHECK(asRead["settings"]["lamp"][0]["intensity"] == json({0.0, 0.0, 0.0}));
  CHECK(asRead["settings"]["sun"].size() == 2);
}

TEST_CASE("hemitex solve gives a lamp the same light whether an option or the file states the unit", "[cli]") {
  const Shell shell;
  writeCube(shell);
  writeAll(shell.file("mm.obj"), "# units: mm\n" + readAll(shell.file("cube.obj")));
  const std::string options = "--lamp 0.5,0.7,0.5=1,1,1 --texels 4";
  const json byOption = solved(shell, "cube.obj -o option --units mm " + options),
             byFile = solved(shell, "mm.obj -o file " + options);
  CHECK(flux(byFile, "emitted") == flux(byOption, "emitted"));
  CHECK(readAll(shell.file("file/elements.csv")) == readAll(shell.file("option/elements.csv")));
}

TEST_CASE("hemitex solve goes on from a checkpoint with lamps, and refuses one with others", "[cli]") {
  const Shell shell;
  writeCube(shell);
  const std::string scene = "solve cube.obj --texels 4 --size 40x30 -q ";
  shell.output(scene + "-o whole --lamp 0.5,0.7,0.5=1,1,1 --shots 40 --checkpoint state");
  shell.output(scene + "-o again --lamp 0.5,0.7,0.5=1,1,1 --shots 40 --resume state");
  CHECK(readAll(shell.file("whole/elements.csv")) == readAll(shell.file("again/elements.csv")));
  CHECK(shell.run(scene + "-o other --lamp 0.5,0.7,0.4=1,1,1 --shots 40 --resume state").exitCode == 2);
}

TEST_CASE("hemitex refuses wrong lamps with exit code 2 and an advice", "[cli]") {
  const Shell shell;
  const auto [options, message] = GENERATE(table<std::string, std::string>({
      {"--lamp 1,2,3", "`1,2,3` is not x,y,z=R,G,B"},
      {"--lamp 1,2=1,2,3", "`1,2=1,2,3` is not x,y,z=R,G,B"},
      {"--lamp 0,0,0=1,2", "--lamp"},
      {"--lamp 0,0,0=1,-2,3", "below 0"},
      {"--lamp 0,0,0=1,2e30,3", "above 1e30"},
      {"--lamp 0,0,1e9=1,1,1", "the lamp `lamp-1` is farther from the scene"},
      {"--lumens-per-watt 0", "--lumens-per-watt"},
      {"--emit '*=0,0,0' --lamp 0,0,0=0,0,0", "nothing in the scene emits light"},
  }));
  const Outcome outcome = shell.run(quickSolve + "-o out " + options);
  INFO(options << '\n' << outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find(message) != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(shell.file("out")));
  CHECK(shell.run("tradeoff room.obj -o out --lamp 0,0,0=1,1,1").exitCode == 2);
}
