/// hemitex solve --sky and --sun: light from outside on the command line, in files of lights and in solution.json.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "radiosity/images/image.h"
#include "tests/support/shell.h"

using namespace hemitex::tests;
using nlohmann::json;

namespace {

/// A black ground of 2 x 2.
void writeGround(const Shell& shell) {
  writeAll(shell.file("ground.obj"),
           "mtllib ground.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\ng ground\nusemtl black\nf 1 2 3 4\n");
  writeAll(shell.file("ground.mtl"), "newmtl black\nKd 0 0 0\n");
}

json solvedUnder(const Shell& shell, const std::string& arguments) {
  return json::parse(shell.output("solve " + arguments + " --size 40x30 --json"));
}

void checkEnergyBalance(const json& energy) {
  for (std::size_t band = 0; band < 3; ++band) {
    const auto at = [&](const char* key) { return energy[key][band].get<double>(); };
    CHECK(at("absorbed") + at("unshot") + at("lost") == Approx(at("emitted")).epsilon(1e-12));
  }
}

}  // namespace

TEST_CASE("hemitex solve --sky lights an open plane with its irradiance, and counts the light on its back", "[cli]") {
  const Shell shell;
  writeGround(shell);
  const json solution = solvedUnder(shell, "ground.obj -o out --sky 3,2,1");
  const json& energy = solution["energy"];
  CHECK(energy["emitted"][0].get<double>() == Approx(4 * 3).epsilon(0.003));
  CHECK(energy["unshot"][0] == 0);
  checkEnergyBalance(energy);
  CHECK(energy["lost_to_backs"][0] == 0);
  CHECK(energy["sky_on_backs"][1].get<double>() == Approx(4 * 2).epsilon(0.003));
  CHECK(solution["settings"]["sky"] == json({3.0, 2.0, 1.0}));
  CHECK_FALSE(solution["settings"].contains("sun"));
}

TEST_CASE("hemitex solve --sun lights a plane with the cosine of its incidence", "[cli]") {
  const Shell shell;
  writeGround(shell);
  const json solution = solvedUnder(shell, "ground.obj -o out --sun 0,3,4=10,5,0 --sun 0,0,-2=1,1,1");
  CHECK(solution["energy"]["emitted"][0].get<double>() == Approx(4 * 10 * 0.8).epsilon(0.005));
  CHECK(solution["energy"]["sky_on_backs"][0].get<double>() == Approx(4 * 1).epsilon(0.005));
  CHECK(solution["settings"]["sun"][0]["irradiance"] == json({10.0, 5.0, 0.0}));
  CHECK(solution["settings"]["sun"][1]["towards"] == json({0.0, 0.0, -1.0}));
}

TEST_CASE("hemitex solve and render show the sky behind the scene", "[cli]") {
  const Shell shell;
  writeGround(shell);
  const std::string camera = " --eye 0,0,3 --look-at 0,0,0 --fov 90 --size 40x30 ";
  const auto corner = [&](const std::string& picture) {
    return hemitex::radiosity::readImage(shell.file(picture)).pixels.front();
  };
  const auto shown = [](const glm::dvec3& linear) {
    glm::dvec3 colour;
    for (int band = 0; band < 3; ++band)
      colour[band] = hemitex::radiosity::decodeSrgb(hemitex::radiosity::encodeSrgb(linear[band]) / 255.0);
    return colour;
  };
  const std::string textures = GENERATE("", "--no-textures ");
  shell.output("solve ground.obj -o out --sky 3,2,1 --exposure 0.25 " + textures + camera);
  CHECK(corner("out/render.png") == shown({0.75, 0.5, 0.25}));
  if (textures.empty()) {
    shell.output("render out/scene.obj -o again.png" + camera);
    const bool isSame = readAll(shell.file("again.png")) == readAll(shell.file("out/render.png"));
    CHECK(isSame);
    for (const std::string show : {"radiosity", "elements"}) {
      shell.output("render out/scene.obj -o brighter.png --exposure 0.5 --show " + show + camera);
      CHECK(corner("brighter.png") == shown({1, 1, 0.5}));
    }
  }
  // A sun has no extent.
  shell.output("solve ground.obj -o sun --sun 0,0,1=3,2,1 --exposure 0.25 " + textures + camera);
  CHECK(corner("sun/render.png") == glm::dvec3(0));
}

TEST_CASE("hemitex solve --lights reads the sky and the sun, and options override them", "[cli]") {
  const Shell shell;
  writeGround(shell);
  writeAll(shell.file("lights.json"),
           R"({"sky": [3, 2, 1], "sun": {"towards": [0, 3, 4], "irradiance": [10, 5, 0]}, "ground": [1, 1, 1]})");
  const std::string scene = "ground.obj -o ";
  solvedUnder(shell, scene + "file --lights lights.json");
  solvedUnder(shell, scene + "options --sky 3,2,1 --sun 0,3,4=10,5,0 --emit ground=1,1,1");
  CHECK(readAll(shell.file("file/elements.csv")) == readAll(shell.file("options/elements.csv")));
  const json both = solvedUnder(shell, scene + "both --lights lights.json --sky 0,0,0 --sun 1,0,0=1,1,1");
  CHECK_FALSE(both["settings"].contains("sky"));
  CHECK(both["settings"]["sun"].size() == 1);
}

TEST_CASE("hemitex solve --sky works with every method, discretization and stopping rule, and its account closes",
          "[cli]") {
  const Shell shell;
  const std::string options =
      GENERATE(as<std::string>(), "", "--method single-plane", "--method tetrahedron", "--method rays --samples 1024",
               "--discretize mesh", "--two-sided", "--adaptive 0.001", "--max-error 0.2", "--shots 3",
               "--index-maps unique", "--index-maps packed");
  INFO(options);
  writeAll(shell.file("open.obj"),
           "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 1\nv 2 0 1\nv 2 2 1\nv 0 2 1\ng floor\nf 1 2 3 4\ng wall-1\n"
           "f 1 5 6 2\ng wall-2\nf 2 6 7 3\ng wall-3\nf 3 7 8 4\n");
  const bool isSized = options.starts_with("--adaptive");
  const json solution = solvedUnder(shell, "open.obj -o out --sky 1,2,3 --sun 1,-1,2=3,2,1 " + options +
                                               (isSized ? " --texels 8" : " --texels 4") +
                                               (options.starts_with("--max-error") ? "" : " --split 0.1"));
  checkEnergyBalance(solution["energy"]);
  CHECK(solution["energy"]["emitted"][0].get<double>() > 4);
  const bool hasBacks = options != "--two-sided";
  CHECK((solution["energy"]["sky_on_backs"][2].get<double>() > 1) == hasBacks);
}

TEST_CASE("hemitex solve --edits lets the light of the sky follow an object", "[cli]") {
  const Shell shell;
  writeGround(shell);
  writeAll(shell.file("roof.obj"), "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\ng roof\nf 1 2 3 4\n");
  writeAll(shell.file("edits.json"), R"({"frames": [[{"add": "roof.obj"}], [{"move": "roof", "by": [0, 0, 10]}]]})");
  solvedUnder(shell, "ground.obj -o out --sky 1,1,1 --texels 4 --edits edits.json");
  const auto absorbed = [&](const std::string& folder) {
    const json energy = json::parse(readAll(shell.file("out/" + folder + "solution.json")))["energy"];
    checkEnergyBalance(energy);
    return energy["absorbed"][0].get<double>();
  };
  const double open = absorbed(""), roofed = absorbed("frame-1/"), high = absorbed("frame-2/");
  CHECK(open == Approx(4).epsilon(0.003));
  // The roof absorbs half of 4 W. Two equal squares at a distance of half their side have the form factor 0.4153.
  CHECK(roofed == Approx(2 + 4 * (1 - 0.41525)).epsilon(0.02));
  CHECK(high > roofed + 1.3);
}

TEST_CASE("hemitex solve without light from outside names no sky in solution.json", "[cli]") {
  const Shell shell;
  const std::string text = shell.output(quickSolve + "-o out --json");
  CHECK(text.find("sky") == std::string::npos);
  CHECK(text.find("sun") == std::string::npos);
}

TEST_CASE("hemitex solve --sky brings no light into a closed room", "[cli]") {
  const Shell shell;
  const json dark = solvedUnder(shell, "room.obj -o dark --emit '*=0,0,0' --sky 1,1,1 --texels 4");
  CHECK(dark["energy"]["emitted"] == json({0.0, 0.0, 0.0}));
  CHECK(dark["shots"] == 0);
}

TEST_CASE("hemitex refuses wrong light from outside with exit code 2 and an advice", "[cli]") {
  const Shell shell;
  writeAll(shell.file("sky.json"), R"({"sky": [1, 2]})");
  writeAll(shell.file("sun.json"), R"({"sun": [1, 2, 3]})");
  writeAll(shell.file("level.json"), R"({"sun": [{"towards": [0, 0, 0], "irradiance": [1, 1, 1]}]})");
  const auto [options, message] = GENERATE(table<std::string, std::string>({
      {"--sky 1,2", "--sky"},
      {"--sky 1,-2,3", "below 0"},
      {"--sky 1,2e30,3", "above 1e30"},
      {"--sun 1,2,3", "`1,2,3` is not x,y,z=R,G,B"},
      {"--sun 0,0,0=1,2,3", "has no direction"},
      {"--sun 0,0,1=1,-2,3", "below 0"},
      {"--sun 0,0,1=1,2", "--sun"},
      {"--lights sky.json", "sky.json: `sky` has the value [1,2]"},
      {"--lights sun.json", "sun.json: `sun` has the value 1"},
      {"--lights level.json", R"(write {"towards": [x,y,z], "irradiance": [R,G,B]})"},
      {"--emit '*=0,0,0' --sky 0,0,0", "nothing in the scene emits light"},
      {"--emit '*=0,0,0'", "or --sky 1,1,1 for light from outside"},
  }));
  const Outcome outcome = shell.run(quickSolve + "-o out " + options);
  INFO(options << '\n' << outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find(message) != std::string::npos);
  const Outcome tradeoff = shell.run("tradeoff room.obj -o out --sky 1,1,1");
  CHECK(tradeoff.exitCode == 2);
  CHECK(tradeoff.err.find("omit --sky, --sun and --lamp") != std::string::npos);
}
