/// hemitex solve: the written files, and the options that choose methods, edits, filters and errors.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/shell.h"
#include "tests/support/solved_folder.h"

using namespace hemitex::tests;
namespace fs = std::filesystem;
using nlohmann::json;

TEST_CASE("hemitex solve --max-error chooses the settings and reports them", "[cli]") {
  const Shell shell;
  const std::string given = "solve room.obj --texels 4 --size 40x30 --json ";
  const json loose = json::parse(shell.output(given + "--max-error 0.2 -o loose"));
  const json tight = json::parse(shell.output(given + "--max-error 0.0005 -o tight"));
  for (const json* solution : {&loose, &tight}) {
    for (const char* expected : {"expected_error", "expected_error_seen"}) {
      CHECK((*solution)[expected] > 0);
      CHECK((*solution)[expected] <= (*solution)["settings"]["max_error"]);
    }
    CHECK((*solution)["residual"] <= (*solution)["settings"]["residual"]);
  }
  CHECK(loose["settings"]["residual"] == 0.02);
  CHECK(loose["settings"]["resolution"] <= tight["settings"]["resolution"]);
  CHECK(loose["settings"]["split"] > tight["settings"]["split"]);
  CHECK(shell.output("solve room.obj --texels 4 --size 40x30 --max-error 0.2 -o text").find("expected error") !=
        std::string::npos);

  // Out of reach: one message with a bound that can be reached, and nothing is left behind.
  writeAll(shell.file("pair.mtl"), "newmtl grey\nKd .5 .5 .5\nnewmtl lamp\nKe 1 1 1\n");
  writeAll(shell.file("pair.obj"),
           "mtllib pair.mtl\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\n"
           "usemtl grey\ng floor\nf 1 4 3 2\nusemtl lamp\ng ceiling\nf 5 6 7 8\n");
  const Outcome outcome = shell.run("solve pair.obj --texels 2 --max-error 1e-9 --size 40x30 -o out");
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find("out of reach") != std::string::npos);
  CHECK_FALSE(fs::exists(shell.file("out")));
}

namespace {

/// A room with a window of 2 x 1 in its front, on a ground of 60 x 60. Its faces look inwards.
void writeRoomOnGround(const Shell& shell) {
  writeAll(shell.file("house.mtl"), "newmtl grey\nKd 0.6 0.6 0.6\n");
  writeAll(shell.file("house.obj"),
           "mtllib house.mtl\n"
           "v 0 .01 0\nv 5 .01 0\nv 5 .01 4\nv 0 .01 4\nv 0 3 0\nv 5 3 0\nv 5 3 4\nv 0 3 4\n"
           "v 1.5 .01 4\nv 1.5 3 4\nv 3.5 .01 4\nv 3.5 3 4\nv 1.5 1 4\nv 3.5 1 4\nv 1.5 2 4\nv 3.5 2 4\n"
           "v -30 0 -30\nv -30 0 30\nv 30 0 30\nv 30 0 -30\nusemtl grey\n"
           "g floor\nf 1 4 3 2\ng ceiling\nf 5 6 7 8\ng back\nf 1 2 6 5\ng left\nf 1 5 8 4\ng right\nf 2 3 7 6\n"
           "g front-a\nf 4 8 10 9\ng front-b\nf 11 12 7 3\ng front-c\nf 9 13 14 11\ng front-d\nf 15 10 12 16\n"
           "g ground\nf 17 18 19 20\n");
}

/// The error of the light in the room against a finer solution: the flux by which elements differ over their flux.
double errorInRoom(const Shell& shell, const std::string& found, const std::string& fine) {
  const std::vector<std::string> lines = linesOf(readAll(shell.file(found + "/elements.csv"))),
                                 finer = linesOf(readAll(shell.file(fine + "/elements.csv")));
  REQUIRE(lines.size() == finer.size());
  double different = 0, flux = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].starts_with("ground")) continue;
    const auto blueOf = [](const std::string& line) { return lastNumber(line); };  // the sky is grey
    std::istringstream fields(finer[i]);
    std::string field;
    for (int column = 0; column < 10; ++column) std::getline(fields, field, ',');
    const double area = std::stod(field);
    different += area * std::abs(blueOf(lines[i]) - blueOf(finer[i]));
    flux += area * blueOf(finer[i]);
  }
  return different / flux;
}

}  // namespace

TEST_CASE("hemitex solve --max-error bounds the error in a room that has a thousandth of all light", "[cli]") {
  const Shell shell;
  writeRoomOnGround(shell);
  const std::string given =
      "solve house.obj --one-sided --sky 1,1,1 --size 40x30 --eye 4.5,1.6,3.5 --look-at 1.5,1.2,0 --json ";
  shell.output(given + "--resolution 512 --split 0.0002 --residual 5e-6 -o fine");
  for (const double bound : {0.05, 0.02}) {
    const json solution = json::parse(shell.output(given + "--max-error " + std::to_string(bound) + " -o found"));
    const double all = solution["expected_error"], seen = solution["expected_error_seen"];
    const double error = errorInRoom(shell, "found", "fine");
    CAPTURE(bound, all, seen, error);
    CHECK(std::max(all, seen) <= bound);
    CHECK(error <= std::max(all, seen));
    CHECK(error > all);  // the ground has most of the light, and hides the error in the room
  }
}

TEST_CASE(
    "hemitex solve --edits writes a folder per frame, the same for any number of threads, beside the first solution",
    "[cli]") {
  const Shell shell;
  writeAll(shell.file("box.obj"), "v 0 -1 0\nv 0.5 -1 0\nv 0.5 0 0\nv 0 0 0\ng sheet\nf 1 2 3 4\n");
  writeAll(shell.file("edits.json"), R"({"frames": [
    [{"add": "box.obj"}, {"reflectance": ["left", "fr*"], "to": [0.2, 0.2, 0.2]}],
    [{"move": "sheet", "by": [0.25, 0, 0.25]}],
    [{"remove": "sheet"}, {"emission": "ceiling/lamp", "to": [0, 5, 5]}],
    [{"restore": "sheet"}]]})");
  shell.output(quickSolve + "-o without");
  shell.output(quickSolve + "-o one --edits edits.json --threads 1");
  shell.output(quickSolve + "-o two --edits edits.json --threads 2");
  for (const char* name : {"elements.csv", "render.png", "scene.obj"})
    CHECK(readAll(shell.file("one") / name) == readAll(shell.file("without") / name));
  const auto withoutTimes = [&](const std::string& name) {
    json solution = solutionOf(shell, name);
    solution.erase("times");
    if (solution.contains("frames"))
      for (json& frame : solution["frames"]) frame.erase("times");
    return solution;
  };
  CHECK(withoutTimes("one") == withoutTimes("two"));
  const json index = withoutTimes("one")["frames"];
  REQUIRE(index.size() == 4);
  for (int number = 1; number <= 4; ++number) {
    const std::string folder = "/frame-" + std::to_string(number);
    const json frame = withoutTimes("one" + folder);
    CHECK(frame == withoutTimes("two" + folder));
    CHECK(frame["settings"] == withoutTimes("without")["settings"]);
    CHECK(frame["residual"] <= 0.001);
    CHECK(index[static_cast<std::size_t>(number - 1)]["shots"] == frame["shots"]);
    for (const char* name : {"/elements.csv", "/render.png", "/scene.glb"})
      CHECK(readAll(shell.file("one" + folder + name)) == readAll(shell.file("two" + folder + name)));
  }
  CHECK(withoutTimes("one/frame-1")["surfaces"].size() == 7);
  CHECK(withoutTimes("one/frame-3")["surfaces"].size() == 6);
  CHECK(withoutTimes("one/frame-3")["energy"]["emitted"] == json({0.0, 20.0, 20.0}));
}

TEST_CASE("hemitex solve --emission radiance multiplies the emission of scenes, added files and edits by pi", "[cli]") {
  const Shell shell;
  writeAll(shell.file("lamp.obj"), "mtllib lamp.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng bulb\nusemtl bulb\nf 1 2 3\n");
  writeAll(shell.file("lamp.mtl"), "newmtl bulb\nKd 0\nKe 2\n");
  writeAll(shell.file("edits.json"),
           R"({"frames": [[{"add": "lamp.obj"}, {"emission": "ceiling/lamp", "to": [0, 1, 2]}]]})");
  const auto emitted = [&](const std::string& folder, const std::string& options) {
    shell.output(quickSolve + "--edits edits.json -o " + folder + options);
    std::vector<double> flux;
    for (const std::string& name : {folder, folder + "/frame-1"}) {
      const json solution = solutionOf(shell, name);
      CHECK(solution["settings"]["emission"] == (options.empty() ? "radiosity" : "radiance"));
      for (const json& band : solution["energy"]["emitted"]) flux.push_back(band);
    }
    return flux;
  };
  const std::vector<double> radiosity = emitted("one", ""), radiance = emitted("two", " --emission radiance");
  // The ceiling has an area of 4, the lamp of 1/2.
  const std::vector<double> expected{40, 40, 40, 1, 5, 9};
  REQUIRE(radiosity.size() == expected.size());
  REQUIRE(radiance.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(radiosity[i] == Approx(expected[i]));
    CHECK(radiance[i] == Approx(expected[i] * std::numbers::pi));
  }
  CHECK(shell.run("solve room.obj -o out --emission lumen").exitCode == 2);
}

TEST_CASE("hemitex solve --edits updates light along the rows of a matrix, and refuses to move objects", "[cli]") {
  const Shell shell;
  shell.output("formfactors room.obj --all --facets --resolution 64 -o F.npz");
  writeAll(shell.file("light.json"), R"({"frames": [[{"emission": "ceiling", "to": [0, 1, 2]}]]})");
  writeAll(shell.file("move.json"), R"({"frames": [[], [{"move": "ceiling*", "by": [0, 0.5, 0]}]]})");
  const std::string alongRows = "solve room.obj --matrix F.npz --residual 1e-9 --no-textures --size 40x30 -o ";
  shell.output(alongRows + "edited --edits light.json");
  shell.output(alongRows + "new --emit ceiling=0,1,2");
  const auto surfaces = [&](const std::string& folder) { return solutionOf(shell, folder)["surfaces"]; };
  const json edited = surfaces("edited/frame-1"), fresh = surfaces("new");
  REQUIRE(edited.size() == fresh.size());
  REQUIRE(edited.size() == 6);
  for (std::size_t s = 0; s < edited.size(); ++s)
    for (std::size_t band = 0; band < 3; ++band)
      CHECK(edited[s]["radiosity"][band].get<double>() ==
            Approx(fresh[s]["radiosity"][band].get<double>()).epsilon(1e-7).margin(1e-7));
  const Outcome moved = shell.run(alongRows + "moved --edits move.json");
  CHECK(moved.exitCode == 2);
  CHECK(moved.err.find("move.json: frame 2: --matrix holds the rows of one geometry") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(shell.file("moved")));
}

TEST_CASE("hemitex solve finds the light of a room that lies far from the origin, or beside a far triangle", "[cli]") {
  const Shell shell;
  shell.execute(
      "cp room.obj stray.obj; printf 'v 3e6 0 0\\nv 3000001 0 0\\nv 3e6 1 0\\ng far\\nf -3 -2 -1\\n' >> stray.obj");
  shell.execute(
      "awk '/^v /{$2 += 1e7; $3 += 1e7; $4 += 1e7; printf \"v %.0f %.0f %.0f\\n\", $2, $3, $4; next} 1' "
      "room.obj > moved.obj");
  const auto radiosity = [&](const std::string& name) {
    shell.output("solve " + name + ".obj --texels 4 --no-textures --size 40x30 -o " + name);
    std::vector<double> values;
    for (const json& surface : solutionOf(shell, name)["surfaces"]) values.push_back(surface["radiosity"][0]);
    values.resize(6);
    return values;
  };
  const std::vector<double> right = radiosity("room");
  for (const char* name : {"stray", "moved"}) {
    const std::vector<double> found = radiosity(name);
    // The eye over a surface is 2^-10 of a triangle's size above it where coordinates may be rounded.
    for (std::size_t s = 0; s < right.size(); ++s) CHECK(found[s] == Approx(right[s]).epsilon(0.005));
  }
}

TEST_CASE("hemitex solve reads names in Latin-1, and writes valid UTF-8", "[cli]") {
  const Shell shell;
  shell.execute(
      "LC_ALL=C sed -i 's/white/wei\\xdf/' room.mtl room.obj; LC_ALL=C sed -i 's/^g floor/g b\\xf6den/' room.obj");
  shell.output("solve room.obj -o lit --texels 4 --size 40x30 --resolution 32 --report");
  const std::string solution = readAll(shell.file("lit/solution.json"));
  CHECK(json::parse(solution)["surfaces"][0]["name"] ==
        "b\xef\xbf\xbd"
        "den");
  CHECK(readAll(shell.file("lit/scene.glb")).find("wei\xef\xbf\xbd") != std::string::npos);
}

TEST_CASE("hemitex solve --units gives fluxes in W, and the same radiosity", "[cli]") {
  const Shell shell;
  const std::string solve = "solve room.obj --texels 4 --size 40x30 --resolution 32 --json ";
  const json metres = json::parse(shell.output(solve + "-o metres")),
             millimetres = json::parse(shell.output(solve + "-o millimetres --units mm")),
             scaled = json::parse(shell.output(solve + "-o scaled --scale 0.001"));
  for (const char* flux : {"emitted", "absorbed", "unshot", "lost", "lost_to_backs"})
    for (int band = 0; band < 3; ++band) {
      // A square millimetre is a millionth of a square metre.
      const double watts = metres["energy"][flux][band];
      CHECK(millimetres["energy"][flux][band].get<double>() == Approx(1e-6 * watts).epsilon(1e-12));
    }
  CHECK(millimetres["energy"] == scaled["energy"]);
  CHECK(metres["surfaces"] == millimetres["surfaces"]);
  CHECK(millimetres["settings"]["metres_per_unit"] == 0.001);
  CHECK(readAll(shell.file("metres/elements.csv")) == readAll(shell.file("millimetres/elements.csv")));
  CHECK(shell.run("solve room.obj -o both --units mm --scale 2").exitCode == 2);
}

TEST_CASE("hemitex solve says how emission was read, and that a flux of megawatts may be a matter of units", "[cli]") {
  const Shell shell;
  const std::string solve = "solve room.obj --texels 4 --size 40x30 --resolution 32 -o out ";
  CHECK(shell.output(solve).find("read as radiosity, in W/m^2; --emission radiance") != std::string::npos);
  CHECK(shell.output(solve + "--emission radiance").find("read as radiance, in W/(m^2 sr)") != std::string::npos);
  CHECK(shell.run(solve).err.find("--units") == std::string::npos);
  const std::string bright = "--emit 'lamp=1e9,1e9,1e9'";
  CHECK(shell.run(solve + bright).err.find("--units mm") != std::string::npos);
  CHECK(shell.run(solve + bright + " --units mm").err.find("--units") == std::string::npos);
}

TEST_CASE("hemitex solve --emit, --reflectance and --lights give the bytes of a scene with these materials", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "-o without");
  const auto check = [&](const std::string& folder, const std::string& options) {
    shell.output("solve dark.obj --texels 4 --patch 2 --resolution 32 --size 40x30 -o " + folder + " " + options);
    for (const char* name : {"elements.csv", "render.png", "scene.obj", "floor.exr"})
      CHECK(readAll(shell.file(folder) / name) == readAll(shell.file("without") / name));
    return solutionOf(shell, folder)["settings"];
  };
  std::string dark = readAll(shell.file("room.obj"));
  dark.replace(dark.find("room.mtl"), 8, "dark.mtl");
  writeAll(shell.file("dark.obj"), dark);
  writeAll(shell.file("dark.mtl"), "newmtl white\nKd 0.1 0.1 0.1\nnewmtl lamp\nKd 0.2 0.2 0.2\n");
  writeAll(shell.file("lights.json"), R"({"*": [1, 2, 3], "white": [0, 0, 0], "lamp": [10, 10, 10]})");
  const std::string paint = "--reflectance '*=0.7,0.5,0.3' --reflectance 'ceil*=0,0,0' ";

  CHECK(check("option", paint + "--emit ceiling/lamp=10,10,10")["materials"][0] ==
        json({{"emission", "ceiling/lamp"}, {"to", {10, 10, 10}}}));
  CHECK(check("later", paint + "--emit floor=7,7,7 --emit lamp=10,10,10 --emit floor=0,0,0")["materials"].size() == 5);
  check("lights", paint + "--lights lights.json");
  check("overridden", paint + "--emit floor=0,0,0 --lights lights.json --emit ceiling/lamp=10,10,10");
  check("radiance", paint + "--emission radiance --emit lamp=3.183098861837907,3.183098861837907,3.183098861837907");
  CHECK_FALSE(solutionOf(shell, "without")["settings"].contains("materials"));
}

TEST_CASE("hemitex solve lowers a --reflectance of 1 or more with a warning", "[cli]") {
  const Shell shell;
  const std::string given = quickSolve + "--json --max-reflectance 0.9 -o ";
  const json solution = json::parse(shell.output(given + "high --reflectance floor=1,2,0.5"));
  CHECK(solution["warnings"] == json({"`floor`: a reflectance of 1 or more is lowered to 0.9"}));
  CHECK(json::parse(shell.output(given + "low --reflectance floor=0.9,0.9,0.5"))["energy"] == solution["energy"]);
}

TEST_CASE("hemitex refuses wrong lights and reflectances with exit code 2 and an advice", "[cli]") {
  const Shell shell;
  writeAll(shell.file("two.json"), R"({"floor": [1, 2]})");
  writeAll(shell.file("negative.json"), R"({"floor": [1, 2, -3]})");
  writeAll(shell.file("list.json"), "[[1, 2, 3]]");
  writeAll(shell.file("broken.json"), R"({"floor": [1, 2)");
  writeAll(shell.file("name.json"), R"({"flor": [1, 2, 3]})");
  const auto [options, message] = GENERATE(table<std::string, std::string>({
      {"--emit flor=1,2,3", "similar names: `floor`"},
      {"--emit lam=1,2,3", "similar names: `lamp`"},
      {"--reflectance flor=1,2,3", "similar names: `floor`"},
      {"--emit floor=1,2", "`floor=1,2` is not NAME=R,G,B"},
      {"--emit floor", "`floor` is not NAME=R,G,B"},
      {"--emit =1,2,3", "is not NAME=R,G,B"},
      {"--emit floor=1,nan,3", "is not NAME=R,G,B"},
      {"--emit floor=1,-2,3", "below 0"},
      {"--reflectance floor=1,-2,3", "below 0"},
      {"--emit floor=1,2e30,3", "above 1e30"},
      {"--lights none.json", "none.json: "},
      {"--lights two.json", "two.json: `floor` has the value [1,2]"},
      {"--lights negative.json", "at least 0"},
      {"--lights list.json", "list.json: is no JSON object"},
      {"--lights broken.json", "broken.json:1: is not JSON"},
      {"--lights name.json", "name.json: no surface, group or material of the scene is named `flor`"},
      {"--emit '*=0,0,0'", "nothing in the scene emits light"},
  }));
  const Outcome outcome = shell.run(quickSolve + "-o out " + options);
  INFO(options << '\n' << outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find(message) != std::string::npos);
  CHECK_FALSE(fs::exists(shell.file("out")));
}

TEST_CASE("hemitex solve of a dark scene names the three largest surfaces, and its --emit option solves it", "[cli]") {
  const Shell shell;
  // Four triangles with the areas 1, 4, 9 and 4.
  writeAll(shell.file("dark.obj"),
           "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 1\nv 4 0 1\nv 0 2 1\nv 0 0 2\nv 6 0 2\nv 0 3 2\n"
           "g one\nf 1 2 3\ng two\nf 4 5 6\ng big one\nf 7 8 9\ng four\nf 4 6 5\n");
  const Outcome outcome = shell.run("solve dark.obj -o out");
  CHECK(outcome.exitCode == 2);
  const std::string option = "--emit 'big one=10,10,10'";
  CHECK(outcome.err.find("dark.obj: nothing in the scene emits light; add " + option +
                         " (largest surfaces: `big one`, `two`, `four`)") != std::string::npos);
  CHECK(shell.run("solve dark.obj --size 40x30 -o out " + option).exitCode == 0);
  CHECK(shell.run("tradeoff dark.obj -o out").err.find(option) != std::string::npos);
}

TEST_CASE("hemitex render --reflectance changes the picture of a bare scene, and is refused for a solved one",
          "[cli]") {
  const Shell shell;
  shell.output("render room.obj --size 40x30 -o before.png");
  shell.output("render room.obj --size 40x30 -o same.png --reflectance white=0.7,0.5,0.3");
  shell.output("render room.obj --size 40x30 -o red.png --reflectance white=0.7,0,0");
  CHECK(readAll(shell.file("same.png")) == readAll(shell.file("before.png")));
  CHECK(readAll(shell.file("red.png")) != readAll(shell.file("before.png")));
  shell.output(quickSolve + "-o out");
  const Outcome outcome = shell.run("render out/scene.obj -o lit.png --emit floor=1,1,1");
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find("is a solved scene") != std::string::npos);
}

TEST_CASE("hemitex solve refuses a wrong file of edits first, with its frame and an advice", "[cli]") {
  const Shell shell;
  const auto [text, message] = GENERATE(table<std::string, std::string>({
      {"", "edits.json:1: is not JSON"},
      {"[]", "is no list of frames"},
      {R"({"frames": [[]], "speed": 2})", "is no list of frames"},
      {R"({"frames": [[], [{"move": "flor", "by": [1, 0, 0]}]]})", "frame 2: no surface of the scene is named `flor`"},
      {R"({"frames": [[{"move": "flor", "by": [1, 0, 0]}]]})", "`floor`"},
      {R"({"frames": [[{"mov": "floor", "by": [1, 0, 0]}]]})", "`move`"},
      {R"({"frames": [[{"move": "floor", "to": [1, 0, 0]}]]})", "`to` is no key of `move`"},
      {R"({"frames": [[{"": [1, 0, 0]}]]})", "`` is no key of an edit"},
      {R"({"frames": [[{"remove": "floor", "": 1}]]})", "`` is no key of `remove`"},
      {R"({"frames": [[{"move": "floor"}]]})", "`move` has no `by`"},
      {R"({"frames": [[{"move": "floor", "by": [1, 0]}]]})", "frame 1: "},
      {R"({"frames": [[{"move": "floor", "remove": "floor", "by": [1, 0, 0]}]]})", "an edit is two"},
      {R"({"frames": [[{"restore": "floor"}]]})", "nothing was removed"},
      {R"({"frames": [[{"emission": "floor", "to": [-1, 0, 0]}]]})", "below 0"},
      {R"({"frames": [[{"add": "none.obj"}]]})", "none.obj"},
  }));
  writeAll(shell.file("edits.json"), text);
  const auto before = shell.files();
  const Outcome outcome = shell.run(quickSolve + "-o out --edits edits.json");
  INFO(text << '\n' << outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find(message) != std::string::npos);
  CHECK(shell.files() == before);
}

TEST_CASE("hemitex solve treats a missing file of edits as bad usage", "[cli]") {
  CHECK(Shell().run(quickSolve + "-o out --edits none.json").exitCode == 2);
}

TEST_CASE("hemitex solve --discretize mesh gives the results of textures", "[cli]") {
  const Shell shell;
  const auto solutionBy = [&](const std::string& method) {
    shell.output(quickSolve + "--discretize " + method + " -o " + method);
    return solutionOf(shell, method);
  };
  const json texture = solutionBy("texture"), mesh = solutionBy("mesh");
  CHECK(texture["settings"]["discretize"] == "texture");
  CHECK(mesh["settings"]["discretize"] == "mesh");
  for (const char* count : {"elements", "patches", "phantoms"}) CHECK(texture[count] == mesh[count]);
  // Pixels at the borders of elements may belong to either neighbour, but that loses no light.
  for (std::size_t band = 0; band < 3; ++band) {
    const double emitted = texture["energy"]["emitted"][band], a = texture["energy"]["absorbed"][band],
                 b = mesh["energy"]["absorbed"][band];
    CHECK(std::abs(a - b) <= 0.001 * emitted);
  }
  const std::string row = "formfactors room.obj --from floor --by-surface --resolution 64 ";
  CHECK(linesOf(shell.output(row + "--discretize mesh")).size() == linesOf(shell.output(row)).size());
}

TEST_CASE("hemitex solve writes the documented files", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "--split 1 -o out");
  for (const char* name :
       {"scene.obj", "scene.mtl", "scene.glb", "render.png", "elements.csv", "solution.json", "scene.view.json"})
    CHECK(fs::file_size(shell.file("out") / name) > 0);

  // Six faces of 4 x 4 elements and area 4; the fifth field from the end is the area.
  const auto lines = linesOf(readAll(shell.file("out/elements.csv")));
  REQUIRE(lines.size() == 1 + 6 * 16);
  CHECK(lines[0] == "surface,column,row,x,y,z,nx,ny,nz,area,b_r,b_g,b_b");
  CHECK(lines[1].starts_with("floor,0,0,"));
  CHECK(lines[2].starts_with("floor,1,0,"));
  CHECK(lines[1 + 2 * 16].starts_with("\"right, with \"\"quotes\"\"\",0,0,"));

  const json solution = solutionOf(shell, "out");
  CHECK(solution["elements"] == 96);
  CHECK(solution["patches"] == 24);
  CHECK(solution["residual"] <= 0.001);
  CHECK(solution["surfaces"].size() == 6);
  CHECK(solution["settings"]["texels"] == 4);
  // The lamp's 2 x 2 square emits 10 per unit of area in each band, and all emitted flux is accounted for.
  for (int band = 0; band < 3; ++band) {
    const auto& energy = solution["energy"];
    CHECK(energy["emitted"][band].get<double>() == Approx(40).epsilon(1e-12));
    const double accounted = energy["absorbed"][band].get<double>() + energy["unshot"][band].get<double>() +
                             energy["lost"][band].get<double>();
    CHECK(accounted == Approx(40).epsilon(1e-12));
  }
}

TEST_CASE("hemitex solve --method rays agrees with hemicubes within their errors", "[cli]") {
  // Rays start all over a patch, but a hemicube lies over its centre; beside an edge they differ by 1 % of the light.
  const Shell shell;
  const std::string settings = "solve room.obj --texels 4 --patch 1 --size 40x30 --json ";
  const json rays = json::parse(shell.output(settings + "--method rays --samples 16384 -o rays"));
  const json hemicubes = json::parse(shell.output(settings + "--resolution 256 -o hemicubes"));
  CHECK(rays["settings"]["method"] == "rays");
  CHECK(rays["settings"]["samples"] == 16384);
  CHECK(rays["settings"]["resolution"].is_null());
  CHECK(hemicubes["settings"]["samples"].is_null());
  CHECK(rays["settings"]["seed"] == 0);
  CHECK(hemicubes["settings"]["seed"].is_null());
  CHECK(rays["energy"]["lost"] == json({0, 0, 0}));
  const auto byRays = linesOf(readAll(shell.file("rays/elements.csv"))),
             byHemicubes = linesOf(readAll(shell.file("hemicubes/elements.csv")));
  REQUIRE(byRays.size() == byHemicubes.size());
  double difference = 0, whole = 0;
  for (std::size_t i = 1; i < byRays.size(); ++i) {
    difference += std::abs(lastNumber(byRays[i]) - lastNumber(byHemicubes[i]));
    whole += lastNumber(byHemicubes[i]);
  }
  CHECK(difference < 0.015 * whole);
  CHECK(shell.output("solve --help-all").find("differs between machines") != std::string::npos);
  const json other = json::parse(shell.output(settings + "--method rays --samples 16384 --seed 7 -o other"));
  CHECK(other["settings"]["seed"] == 7);
  const auto byOther = linesOf(readAll(shell.file("other/elements.csv")));
  CHECK(byOther != byRays);
}

TEST_CASE("hemitex solve --adaptive keeps elements together where light changes little", "[cli]") {
  const Shell shell;
  shell.output("solve room.obj --texels 16 --patch 4 --resolution 32 --size 40x30 --adaptive 0.001 -o out");
  const json solution = solutionOf(shell, "out");
  CHECK(solution["settings"]["adaptive"] == 0.001);
  CHECK(solution["settings"]["filter"] == "quadtree");
  // Six faces of at least 4 x 4 elements, at most 16 x 16.
  const auto elements = solution["elements"].get<std::size_t>();
  CHECK(elements > 6 * 16);
  CHECK(elements < 6 * 16 * 16 / 2);
  CHECK(linesOf(readAll(shell.file("out/elements.csv"))).size() == elements + 1);
  // 12 texels grow to 16.
  shell.output("solve room.obj --texels 12 --patch 4 --resolution 32 --size 40x30 --adaptive 0.001 -o grown");
  CHECK(readAll(shell.file("grown/elements.csv")) == readAll(shell.file("out/elements.csv")));
  CHECK(shell.run("solve room.obj --texels 16 --filter quadtree --adaptive 0 -o none").exitCode == 2);
  CHECK_FALSE(fs::exists(shell.file("none")));
}

TEST_CASE("hemitex solve --filter changes display textures and no measured values", "[cli]") {
  const Shell shell;
  for (const std::string filter : {"one-to-one", "triangle", "bilinear", "bicubic", "gouraud"}) {
    shell.output(quickSolve + "--filter " + filter + " -o " + filter);
    for (const std::string name : {"/elements.csv", "/floor.exr", "/scene.obj"})
      CHECK(readAll(shell.file(filter + name)) == readAll(shell.file("one-to-one" + name)));
    CHECK((readAll(shell.file(filter + "/floor.png")) == readAll(shell.file("one-to-one/floor.png"))) ==
          (filter == "one-to-one"));
    const json settings = solutionOf(shell, filter)["settings"];
    CHECK(settings["filter"] == filter);
    CHECK(settings["magnify"].is_null());
    const json solution = solutionOf(shell, filter);
    for (const json& surface : solution["surfaces"]) {
      const int longer = std::max(surface["columns"].get<int>(), surface["rows"].get<int>());
      const int magnified = longer * surface["texture"]["magnification"].get<int>();
      CHECK((filter == "one-to-one" || longer == 1 ? magnified == longer : magnified >= 128 && magnified < 256));
    }
  }
  shell.output(quickSolve + "--magnify 3 -o three");
  const json three = solutionOf(shell, "three");
  CHECK(three["settings"]["magnify"] == 3);
  CHECK(three["settings"]["filter"] == "bicubic");
  for (const json& surface : three["surfaces"]) CHECK(surface["texture"]["magnification"] == 3);
  for (const char* options : {"--filter none", "--filter bicubic --magnify 0", "--magnify 17"})
    CHECK(shell.run(quickSolve + options + " -o none").exitCode == 2);
}

TEST_CASE("hemitex solve ends at the first of --shots and --residual, and says which", "[cli]") {
  const Shell shell;
  const auto solved = [&](const std::string& options) {
    INFO(options);
    const std::string text =
        shell.output("solve room.obj --texels 4 --resolution 32 --no-textures --size 40x30 -o lit " + options);
    const json solution = solutionOf(shell, "lit");
    CHECK((text.find("where --shots ended it") != std::string::npos) == (solution["ended_by"] == "shots"));
    return solution;
  };
  const json alone = solved("--residual 0.01");
  CHECK(alone["ended_by"] == "residual");
  const int shots = alone["shots"];
  REQUIRE(shots > 3);
  const json few = solved("--residual 0.01 --shots 3"), many = solved("--residual 0.01 --shots 100000");
  CHECK(few["shots"] == 3);
  CHECK(few["ended_by"] == "shots");
  CHECK(few["residual"] > 0.01);
  CHECK(many["shots"] == shots);
  CHECK(many["ended_by"] == "residual");
  CHECK(many["energy"] == alone["energy"]);
}

TEST_CASE("hemitex solve --max-error keeps the limits that are given beside it", "[cli]") {
  const Shell shell;
  const auto solved = [&](const std::string& options) {
    INFO(options);
    const Outcome outcome =
        shell.run("solve room.obj --texels 4 --max-error 0.1 --size 40x30 --no-textures -o lit " + options);
    REQUIRE(outcome.exitCode == 0);
    json solution = solutionOf(shell, "lit");
    const bool isWithin = !solution["expected_error"].is_null() && solution["expected_error"] <= 0.1 &&
                          solution["expected_error_seen"] <= 0.1;
    CHECK((outcome.err.find("--shots ended the solution") == std::string::npos) == isWithin);
    return solution;
  };
  const json alone = solved("");
  CHECK(alone["settings"]["residual"] == Approx(0.01));
  CHECK(alone["settings"]["resolution"] < 256);

  const json small = solved("--residual 0.002"), large = solved("--residual 0.5");
  CHECK(small["settings"]["residual"] == 0.002);
  CHECK(small["residual"] <= 0.002);
  CHECK(large["energy"] == alone["energy"]);

  const json fine = solved("--resolution 256"), split = solved("--split 0.0002");
  CHECK(fine["settings"]["resolution"] > 256);
  CHECK(split["settings"]["split"] < 0.0002);
  CHECK(split["patches"] >= alone["patches"]);

  const json ended = solved("--shots 5"), enough = solved("--shots 100000");
  CHECK(ended["shots"] == 5);
  CHECK(ended["ended_by"] == "shots");
  CHECK(ended["expected_error"].is_null());
  CHECK(enough["energy"] == alone["energy"]);
  CHECK(enough["ended_by"] == "residual");
}

TEST_CASE("hemitex solve --adaptive --texel-size has quadtrees of the next power of two", "[cli]") {
  const Shell shell;
  shell.output("solve room.obj --adaptive 0.001 --texel-size 0.3 --resolution 32 --no-textures --size 40x30 -o lit");
  for (const json& surface : solutionOf(shell, "lit")["surfaces"]) {
    const int columns = surface["columns"];
    CHECK(columns == surface["rows"]);
    CHECK((columns & (columns - 1)) == 0);
  }
}

TEST_CASE("hemitex solve bounds the light of facets that are divided, and the end along a matrix", "[cli]") {
  const Shell shell;
  const std::string box = "solve " HEMITEX_DATA "/cornell-box.obj --no-textures --size 40x30 -o lit ";
  const auto solved = [&](const std::string& options) {
    INFO(options);
    shell.output(box + options);
    return solutionOf(shell, "lit");
  };
  const json divided = solved("--facets --max-error 0.2 --texels 2"), trees = solved("--facets --adaptive 0.01");
  CHECK(divided["expected_error"] <= 0.2);
  CHECK_FALSE(divided.contains("row_error"));
  CHECK(divided["elements"] > divided["surfaces"].size());
  CHECK(trees["elements"] > trees["surfaces"].size());
  CHECK(fs::exists(shell.file("lit/scene.vtu")));

  shell.output("formfactors " HEMITEX_DATA "/cornell-box.obj --all --facets -o F.npz");
  const json given = solved("--matrix F.npz --max-error 0.02"), same = solved("--matrix F.npz --residual 0.002");
  CHECK(given["residual"] <= 0.002);
  CHECK(given["energy"] == same["energy"]);
  CHECK(given["shots"] == same["shots"]);
}

// The truth is that of `--max-error 0.004`, with a stated error of 0.32 % of the seen light.
TEST_CASE("hemitex solve gives the last of five rooms its light, with the lamp in the first and the camera in the last",
          "[cli]") {
  constexpr double truth = 0.000141699;
  const Shell shell;
  shell.output("solve " HEMITEX_SOURCE "/tests/truth/scenes/chain.obj --no-textures --size 40x30 -o lit");
  const auto column = [&](const std::string& name) { return columnOf(shell, "lit", name); };
  const std::vector<std::string> surface = column("surface"), area = column("area");
  double flux = 0;
  for (const char* band : {"b_r", "b_g", "b_b"}) {
    const std::vector<std::string> radiosity = column(band);
    for (std::size_t e = 0; e < surface.size(); ++e)
      if (surface[e].starts_with("floor4")) flux += std::stod(area[e]) * std::stod(radiosity[e]);
  }
  CHECK(std::abs(flux / truth - 1) < 0.03);
}
