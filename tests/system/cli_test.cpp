/// The hemitex program as a script uses it: exit codes, output streams, and written files. Each test runs the built
/// program.
#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "reference/vectors/draw_list_builder.h"
#include "reference/vectors/vector_file.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string readAll(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  REQUIRE(stream);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void writeAll(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

struct Outcome {
  int exitCode;
  std::string out, err;
};

/// Runs `hemitex ARGUMENTS` in a folder of its own with a small scene.
class Shell {
 public:
  Shell() {
    writeAll(folder_.path / "room.obj", room);
    writeAll(folder_.path / "room.mtl", roomMaterials);
  }

  Outcome run(const std::string& arguments) const {
    const fs::path out = streams_.path / "out", err = streams_.path / "err";
    const std::string line = "cd '" + folder_.path.string() + "' && '" HEMITEX_PROGRAM "' " + arguments + " >'" +
                             out.string() + "' 2>'" + err.string() + "'";
    const int status = std::system(line.c_str());
    REQUIRE(WIFEXITED(status));
    return {WEXITSTATUS(status), readAll(out), readAll(err)};
  }

  /// As run, but requires success.
  std::string output(const std::string& arguments) const {
    const Outcome outcome = run(arguments);
    INFO(arguments << '\n' << outcome.err);
    REQUIRE(outcome.exitCode == 0);
    return outcome.out;
  }

  fs::path file(const std::string& name) const { return folder_.path / name; }

  /// All files below the folder, with their content.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path))
      contents[fs::relative(entry.path(), folder_.path).string()] =
          entry.is_regular_file() ? readAll(entry.path()) : "a folder";
    return contents;
  }

 private:
  /// A closed cube of side 2 about the origin, seen from inside, one face of which emits.
  static constexpr const char* room = R"(mtllib room.mtl
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
usemtl white
g floor
f 1 4 8 5
g left
f 1 5 6 2
g right, with "quotes"
f 4 3 7 8
g back:1,2
f 1 2 3 4
g front
f 5 8 7 6
usemtl lamp
g ceiling/lamp
f 2 6 7 3
)";
  static constexpr const char* roomMaterials = R"(newmtl white
Kd 0.7 0.5 0.3
newmtl lamp
Kd 0 0 0
Ke 10 10 10
)";

  hemitex::TemporaryFolder folder_, streams_;
};

const std::string quickSolve = "solve room.obj --texels 4 --patch 2 --resolution 32 --size 40x30 ";

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The last field of a CSV line.
double lastNumber(const std::string& line) { return std::stod(line.substr(line.rfind(',') + 1)); }

}  // namespace

TEST_CASE("hemitex with bad usage exits with 2, prints the reason on stderr and leaves nothing behind", "[cli]") {
  const auto arguments = GENERATE(
      as<std::string>{},  //
      "", "no-such-command", "solve", "solve room.obj", "solve -o out", "solve room.obj -o out --no-such-option",
      "solve room.obj -o out extra", "solve room.obj -o out --texels 0", "solve room.obj -o out --texels 4097",
      "solve room.obj -o out --texels 3.5", "solve room.obj -o out --texels ''",
      "solve room.obj -o out --texels 99999999999", "solve room.obj -o out --texels 4 --texels 5",
      "solve room.obj -o out --texels 4 --texel-size 0.1", "solve room.obj -o out --texel-size 0",
      "solve room.obj -o out --texel-size nan", "solve room.obj -o out --patch 0",
      "solve room.obj -o out --resolution 255", "solve room.obj -o out --resolution 0",
      "solve room.obj -o out --resolution 4098", "solve room.obj -o out --split 0",
      "solve room.obj -o out --max-error 0", "solve room.obj -o out --max-error 1",
      "solve room.obj -o out --max-error 0.1 --resolution 64", "solve room.obj -o out --max-error 0.1 --method rays",
      "solve room.obj -o out --split -1", "solve room.obj -o out --split nan", "solve room.obj -o out --orientation up",
      "solve room.obj -o out --method rays --split 0", "solve room.obj -o out --discretize points",
      "solve room.obj -o out --method rays --discretize mesh", "solve room.obj -o out --residual 0",
      "solve room.obj -o out --residual -1", "solve room.obj -o out --residual nan",
      "solve room.obj -o out --residual 1e999", "solve room.obj -o out --residual inf",
      "solve room.obj -o out --residual 0.1x", "solve room.obj -o out --shots -1",
      "solve room.obj -o out --shots 3 --residual 0.1", "solve room.obj -o out --threads -1",
      "solve room.obj -o out --format r9g9b9", "solve room.obj -o out --blend add",
      "solve room.obj -o out --method guess", "solve room.obj -o out --samples 1024",
      "solve room.obj -o out --method rays --samples 63", "solve room.obj -o out --method rays --samples 96",
      "solve room.obj -o out --method rays --resolution 64", "solve room.obj -o out --method rays --format r5g6b5",
      "solve room.obj -o out --charts none", "solve room.obj -o out --max-reflectance 1",
      "solve room.obj -o out --surface floor", "solve room.obj -o out --surface =4",
      "solve room.obj -o out --surface floor=0", "solve room.obj -o out --surface flor=4",
      "solve room.obj -o out --eye 1,2", "solve room.obj -o out --eye 1,2,3,4", "solve room.obj -o out --eye 1,2,x",
      "solve room.obj -o out --eye 1,2,nan", "solve room.obj -o out --fov 180", "solve room.obj -o out --size 40",
      "solve room.obj -o out --size 0x30", "solve room.obj -o out --size 4000x30", "solve room.obj -o out --exposure 0",
      "solve room.obj -o out --eye 0,0,0 --look-at 0,0,0", "solve room.obj -o out -q -v", "solve room.obj -o room.obj",
      "solve room.obj -o /proc/none/out", "render room.obj", "render room.obj -o picture.jpg",
      "render room.obj -o out.png --show nothing", "render room.obj -o room.mtl/picture.png", "formfactors room.obj",
      "formfactors room.obj --all", "formfactors room.obj --from floor --all --by-surface",
      "formfactors room.obj --from flor", "formfactors room.obj --from floor:16,0",
      "formfactors room.obj --from floor:0,-1", "formfactors room.obj --from floor --method guess",
      "formfactors room.obj --from floor --method rays --samples 63",
      "formfactors room.obj --from floor --samples 1024", "formfactors room.obj --from floor --aimed",
      "formfactors room.obj --from floor --method analytic --aimed",
      "formfactors room.obj --from floor --method rays --resolution 64",
      "formfactors room.obj --from floor --method analytic --discretize texture",
      "formfactors room.obj --from floor --method analytic --orientation turned",
      "formfactors room.obj --from floor --method analytic --resolution 64",
      "solve room.obj -o out --method single-plane --max-error 0.1",
      "solve room.obj -o out --method tetrahedron --samples 64",
      "solve room.obj -o out --method rays --pixels-per-element 4", "solve room.obj -o out --pixels-per-element 0",
      "formfactors room.obj --from floor --method tetrahedron --samples 64",
      "formfactors room.obj --from floor --method rays --no-align",
      "formfactors room.obj --from floor --method rays --index-maps packed",
      "formfactors room.obj --from floor --index-maps unique --no-align",
      "solve room.obj -o out --index-maps unique --blend integer-add", "solve room.obj -o out --index-maps all",
      "solve room.obj -o out --index-maps unique --page 64", "solve room.obj -o out --index-maps packed --page 48",
      "solve room.obj -o out --page 8 --texels 9", "formfactors room.obj --from floor --smooth", "tradeoff room.obj",
      "tradeoff -o out", "tradeoff room.obj -o out --texels 6,4", "tradeoff room.obj -o out --texels 4,",
      "tradeoff room.obj -o out --texels 32", "tradeoff room.obj -o out --patch 0",
      "tradeoff room.obj -o out --method guess", "tradeoff room.obj -o out --method hemicube=48",
      "tradeoff room.obj -o out --method hemicube=1",
      "tradeoff room.obj -o out --method area-rays=", "tradeoff room.obj -o out --samples 127",
      "bench no-such-file.obj", "bench room.obj ./room.obj", "bench room.obj --resolution 33",
      "bench room.obj --resolution 8192", "bench room.obj --resolution 32 --resolution x",
      "bench room.obj --triangles 0", "bench room.obj -o room.obj", "bench --scene room.obj", "vector",
      "vector export room.obj -o out", "vector export room.obj -o out --eye 0,0,0 --normal 0,0,0",
      "vector export room.obj -o out --eye 1e300,0,0 --normal 0,0,1", "vector render room.obj -o out",
      "vector render no-such-folder -o out");
  const Shell shell;
  const auto before = shell.files();
  const Outcome outcome = shell.run(arguments);
  INFO(arguments << '\n' << outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.find("hemitex: error: ") != std::string::npos);
  CHECK(shell.files() == before);
}

TEST_CASE("hemitex refuses a wrong scene with its file and line", "[cli]") {
  const Shell shell;
  const auto [text, place] = GENERATE(table<std::string, std::string>({
      {"v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n", "bad.obj:2: "},
      {"v 0 0 0\nv 1 0 1e999\nv 0 1 0\nf 1 2 3\n", "bad.obj:2: "},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "bad.obj:4: "},
      {"", "bad.obj"},
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "bad.obj"},  // nothing emits
  }));
  writeAll(shell.file("bad.obj"), text);
  const auto before = shell.files();
  const Outcome outcome = shell.run("solve bad.obj -o out");
  INFO(outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find(place) != std::string::npos);
  CHECK(outcome.out.empty());
  CHECK(shell.files() == before);
}

TEST_CASE("hemitex suggests names for a name that no surface has", "[cli]") {
  const Outcome outcome = Shell().run("formfactors room.obj --from flor");
  CHECK(outcome.err.find("`floor`") != std::string::npos);
}

TEST_CASE("hemitex prints --help and --version on stdout, before or after a command", "[cli]") {
  const Shell shell;
  for (const char* arguments : {"--help", "solve --help", "render -h", "formfactors --help", "tradeoff --help",
                                "vector --help", "vector export --help", "vector render --help"})
    CHECK(shell.output(arguments).find("--threads") != std::string::npos);
  for (const char* arguments : {"--version", "solve --version", "--version solve", "vector export --version"})
    CHECK(shell.output(arguments) == "hemitex " HEMITEX_VERSION "\n");
}

TEST_CASE("hemitex solve --max-error chooses the settings and reports them", "[cli]") {
  const Shell shell;
  const std::string given = "solve room.obj --texels 4 --size 40x30 --json ";
  const json loose = json::parse(shell.output(given + "--max-error 0.2 -o loose"));
  const json tight = json::parse(shell.output(given + "--max-error 0.0005 -o tight"));
  for (const json* solution : {&loose, &tight}) {
    CHECK((*solution)["expected_error"] <= (*solution)["settings"]["max_error"]);
    CHECK((*solution)["residual"] <= (*solution)["settings"]["residual"]);
  }
  CHECK(loose["settings"]["residual"] == 0.02);
  CHECK(loose["settings"]["resolution"] <= tight["settings"]["resolution"]);
  CHECK(loose["settings"]["split"] > tight["settings"]["split"]);
  CHECK(shell.output("solve room.obj --texels 4 --size 40x30 --max-error 0.2 -o text").find("expected error") !=
        std::string::npos);

  // Out of reach: one message with a bound that can be reached, and nothing is left behind.
  const Outcome outcome = shell.run("solve room.obj --texels 4 --max-error 1e-9 -o out");
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find("out of reach") != std::string::npos);
  CHECK_FALSE(fs::exists(shell.file("out")));
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
    json solution = json::parse(readAll(shell.file(name + "/solution.json")));
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
    for (const char* name : {"/elements.csv", "/render.png"})
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
      const json solution = json::parse(readAll(shell.file(name + "/solution.json")));
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

TEST_CASE("hemitex solve refuses a wrong file of edits first, with its frame and an advice", "[cli]") {
  const Shell shell;
  const auto [text, message] = GENERATE(table<std::string, std::string>({
      {"", "edits.json: "},
      {"[]", "is no list of frames"},
      {R"({"frames": [[]], "speed": 2})", "is no list of frames"},
      {R"({"frames": [[], [{"move": "flor", "by": [1, 0, 0]}]]})", "frame 2: no surface of the scene is named `flor`"},
      {R"({"frames": [[{"move": "flor", "by": [1, 0, 0]}]]})", "`floor`"},
      {R"({"frames": [[{"mov": "floor", "by": [1, 0, 0]}]]})", "`move`"},
      {R"({"frames": [[{"move": "floor", "to": [1, 0, 0]}]]})", "`to` is no key of `move`"},
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

TEST_CASE("hemitex solve treats a missing file of edits, and methods that cannot use edits, as bad usage", "[cli]") {
  const Shell shell;
  writeAll(shell.file("edits.json"), R"({"frames": []})");
  for (const char* arguments :
       {"none.json", "edits.json --method rays", "edits.json --discretize mesh", "edits.json --pixels-per-element 4"})
    CHECK(shell.run(quickSolve + "-o out --edits " + arguments).exitCode == 2);
}

TEST_CASE("hemitex solve --discretize mesh gives the results of textures", "[cli]") {
  const Shell shell;
  const auto solutionBy = [&](const std::string& method) {
    shell.output(quickSolve + "--discretize " + method + " -o " + method);
    return json::parse(readAll(shell.file(method + "/solution.json")));
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
  for (const char* name : {"scene.obj", "scene.mtl", "render.png", "elements.csv", "solution.json", "scene.view.json"})
    CHECK(fs::file_size(shell.file("out") / name) > 0);

  // Six faces of 4 x 4 elements and area 4; the fifth field from the end is the area.
  const auto lines = linesOf(readAll(shell.file("out/elements.csv")));
  REQUIRE(lines.size() == 1 + 6 * 16);
  CHECK(lines[0] == "surface,column,row,x,y,z,nx,ny,nz,area,b_r,b_g,b_b");
  CHECK(lines[1].starts_with("floor,0,0,"));
  CHECK(lines[2].starts_with("floor,1,0,"));
  CHECK(lines[1 + 2 * 16].starts_with("\"right, with \"\"quotes\"\"\",0,0,"));

  const json solution = json::parse(readAll(shell.file("out/solution.json")));
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
  CHECK(shell.output("solve --help").find("differs between machines") != std::string::npos);
}

TEST_CASE("hemitex --json prints one object on stdout and nothing else", "[cli]") {
  const Shell shell;
  json solution = json::parse(shell.output(quickSolve + "-o out --json"));
  CHECK(solution == json::parse(readAll(shell.file("out/solution.json"))));
  CHECK(json::parse(shell.output("--json render out/scene.obj -o picture.png --size 40x30")).is_object());
  const json row = json::parse(shell.output("formfactors room.obj --from floor --by-surface --resolution 32 --json"));
  CHECK(row["row"].size() == 6);
  const json exported =
      json::parse(shell.output("vector export room.obj --eye 0,0,0 --normal 0,0,1 --resolution 8 -o vector --json"));
  CHECK(exported["faces"].size() == 5);
}

TEST_CASE("hemitex accepts options of the program before or after the command", "[cli]") {
  const Shell shell;
  CHECK(shell.run("-q --threads 1 " + quickSolve + "-o out").err.empty());
  CHECK(shell.run(quickSolve + "-o out -q --threads 1").err.empty());
  CHECK(!shell.run(quickSolve + "-o out -v").err.empty());
}

TEST_CASE("hemitex writes the same bytes except timings for any number of threads", "[cli]") {
  const auto solved = [](int threads) {
    const Shell shell;
    const std::string limit = " --threads " + std::to_string(threads);
    shell.output(quickSolve + "-o out" + limit);
    shell.output("render out/scene.obj --size 40x30 -o out/again.png" + limit);
    shell.output("formfactors room.obj --from floor --resolution 32 >out/row.csv" + limit);
    shell.output("formfactors room.obj --from floor --method rays --samples 1024 >out/rays.csv" + limit);
    shell.output("solve room.obj --method rays --samples 1024 --texels 4 --size 40x30 -o rays" + limit);
    auto files = shell.files();
    for (const char* name : {"out/solution.json", "rays/solution.json"}) {
      json solution = json::parse(files.at(name));
      solution.erase("times");
      files[name] = solution.dump();
    }
    return files;
  };
  const auto one = solved(1);
  CHECK(solved(2) == one);
  CHECK(solved(7) == one);
}

TEST_CASE("hemitex leaves an old result unchanged if a run fails", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "-o out");
  const auto before = shell.files();
  CHECK(shell.run(quickSolve + "-o out --surface flor=3").exitCode == 2);
  CHECK(shell.run("vector render out -o out").exitCode == 2);
  CHECK(shell.files() == before);
}

TEST_CASE("hemitex names a malformed file beside the scene", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "-o out");
  const auto [name, text] = GENERATE(table<std::string, std::string>({
      {"room.view.json", "{"},
      {"room.view.json", R"({"eye": [0, 0]})"},
      {"room.view.json", R"({"eye": [0, 0, 1e999]})"},
      {"out/solution.json", "{}"},
      {"out/solution.json",
       R"({"settings": {"texels": 4, "patch": 2, "texel_size": null, "exposure": 1}, "surfaces": []})"},
  }));
  writeAll(shell.file(name), text);
  const std::string scene = name == "room.view.json" ? "room.obj" : "out/scene.obj";
  const Outcome outcome = shell.run("render " + scene + " -o picture.png");
  INFO(outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find(name) != std::string::npos);
  CHECK_FALSE(fs::exists(shell.file("picture.png")));
}

TEST_CASE("hemitex fails if it cannot print the result", "[cli]") {
  CHECK(Shell().run("formfactors room.obj --from floor --resolution 32 >/dev/full; (exit $?)").exitCode == 2);
}

// The charts of a solved scene lie inside its radiosity textures, and a picture of its item IDs must invert that.
TEST_CASE("hemitex render of a solved folder shows the grids that were solved", "[cli]") {
  const Shell shell;
  const std::string grids = GENERATE(as<std::string>{}, "--texels 4 --surface floor=3 --surface left=1 ",
                                     "--texel-size 0.4 --surface floor=3 ");
  const std::string camera = " --eye 0,0.5,0 --look-at 0,0,-1 --fov 90 --size 40x30 ";
  shell.output("solve room.obj --resolution 32 -o out " + grids);
  const std::string show = GENERATE(as<std::string>{}, "ids", "index-map", "offsets", "map");
  shell.output("render out/scene.obj -o solved.png --show " + show + camera);
  shell.output("render room.obj -o bare.png --show " + show + camera + grids);
  INFO(show << ' ' << grids);
  const bool isSame = readAll(shell.file("solved.png")) == readAll(shell.file("bare.png"));
  CHECK(isSame);
}

namespace {

/// Removes the values that differ from run to run.
json withoutTimes(json value) {
  if (value.is_object()) value.erase("times");
  for (json& part : value)
    if (part.is_structured()) part = withoutTimes(part);
  return value;
}

}  // namespace

TEST_CASE("hemitex tradeoff writes a table, an object and a page, the same for any number of threads except times",
          "[cli]") {
  const Shell shell;
  const std::string quick =
      "tradeoff room.obj --texels 4,2 --patch 2,1 --samples 256 --method hemicube=32,64 --method centre-rays=64 ";
  shell.output(quick + "-o one --threads 1");
  const json result = json::parse(shell.output(quick + "-o three --threads 3 --json"));
  const json one = json::parse(readAll(shell.file("one/tradeoff.json")));
  CHECK(withoutTimes(one) == withoutTimes(result));
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
  for (const json& choice : result["choices"]) {
    CHECK(choice["radiosity_error"]["flux_weighted"] > 0);
    CHECK(choice["row_error"]["relative_l1"] > 0);
    CHECK(choice["bytes"]["rows"] > 0);
    CHECK(choice["times"]["median_s"] > 0);
  }
  CHECK(result["same_points"]["hemicubes"].size() == 2);
  CHECK(result["same_points"]["rays"].size() == 1);
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

TEST_CASE("hemitex formfactors from a surface of a closed room sum to 1", "[cli]") {
  const Shell shell;
  // A share has 60 bits and a double 53, so that each of up to 96 numbers has a rounding error of at most half of
  // 2^-53.
  for (const char* from : {"floor", "floor:3,0", "'ceiling/lamp'", "'back:1,2'"}) {
    const auto lines =
        linesOf(shell.output("formfactors room.obj --texels 4 --resolution 32 --from " + std::string(from)));
    CHECK(lines.at(0) == "surface,column,row,area,form_factor");
    REQUIRE(lines.size() == 1 + 96);
    double sum = 0;
    for (std::size_t i = 1; i < lines.size(); ++i) sum += lastNumber(lines[i]);
    CHECK(sum == Approx(1).margin(96 * 1.2e-16));
  }
}

TEST_CASE("hemitex formfactors --all prints the rows of its surfaces", "[cli]") {
  const Shell shell;
  const std::string settings = " --texels 4 --resolution 32 --by-surface";
  const auto matrix = linesOf(shell.output("formfactors room.obj --all" + settings));
  const auto row = linesOf(shell.output("formfactors room.obj --from left" + settings));
  CHECK(matrix.at(0) == "from,to,form_factor");
  CHECK(row.at(0) == "surface,area,form_factor");
  REQUIRE(matrix.size() == 1 + 36);
  REQUIRE(row.size() == 1 + 6);
  for (std::size_t to = 0; to < 6; ++to) CHECK(lastNumber(matrix[1 + 6 + to]) == lastNumber(row[1 + to]));
}

TEST_CASE("hemitex formfactors --method rays prints standard errors", "[cli]") {
  // The faces of a cube: 0.1998 to the opposite one (Howell C-11), and a quarter of the rest to each of the others.
  const Shell shell;
  for (const std::string settings : {"", " --aimed", " --texels 3"}) {
    const auto lines =
        linesOf(shell.output("formfactors room.obj --from floor --by-surface --method rays --samples 8192" + settings));
    REQUIRE(lines.size() == 1 + 6);
    CHECK(lines[0] == "surface,area,form_factor,standard_error");
    for (const std::string& line : lines) {
      if (line.starts_with("surface")) continue;
      const double error = lastNumber(line), value = lastNumber(line.substr(0, line.rfind(',')));
      const double exact = line.starts_with("floor") ? 0 : line.starts_with("ceiling") ? 0.199824896 : 0.200043776;
      INFO(settings << ": " << line);
      CHECK(std::abs(value - exact) <= 4 * error + 1e-9);
      CHECK(error < 0.01);
    }
  }
  const auto elements = linesOf(shell.output("formfactors room.obj --from floor:1,2 --texels 4 --method rays"));
  CHECK(elements.at(0) == "surface,column,row,area,form_factor,standard_error");
  CHECK(elements.size() == 1 + 96);
  const json row = json::parse(shell.output("formfactors room.obj --from floor --by-surface --method rays --json"));
  CHECK(row["samples"] == 65536);
  CHECK(row["row"][1]["standard_error"].get<double>() > 0);
}

TEST_CASE("hemitex formfactors --method analytic equals the closed forms, and reports that blockers are ignored",
          "[cli]") {
  // Faces of a cube: Howell C-11 and C-14 with all lengths equal, from the mean over the floor or over one of its
  // texels.
  const Shell shell;
  const Outcome outcome = shell.run("formfactors room.obj --from floor --by-surface --method analytic");
  CHECK(outcome.exitCode == 0);
  CHECK(outcome.err.find("blockers are not looked at") != std::string::npos);
  const auto lines = linesOf(outcome.out);
  REQUIRE(lines.size() == 1 + 6);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const bool isFloor = lines[i].starts_with("floor"), isOpposite = lines[i].starts_with("ceiling");
    const double exact = isFloor ? 0 : isOpposite ? 0.199824895698387 : 0.200043776075403;
    INFO(lines[i]);
    CHECK(lastNumber(lines[i]) == Approx(exact).epsilon(1e-9));
  }
  const json row = json::parse(shell.output("formfactors room.obj --from floor --method analytic --texels 1 --json"));
  CHECK(row["blockers_ignored"] == true);
  for (const char* from : {"floor", "floor:1,2"}) {
    const auto elements =
        linesOf(shell.output("formfactors room.obj --texels 4 --method analytic --from " + std::string(from)));
    REQUIRE(elements.size() == 1 + 96);
    double sum = 0;
    for (std::size_t i = 1; i < elements.size(); ++i) sum += lastNumber(elements[i]);
    CHECK(sum == Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("hemitex formfactors of the paper's room: hemicubes and closed forms agree for unblocked surfaces", "[cli]") {
  // From the light, no ray to these surfaces meets the box; a part of the floor is behind it. A hemicube of 256 pixels
  // misses a few pixels along a surface's rim, each of up to 1/(pi 128^2) = 2e-5. The light shoots from 8 x 8 patches.
  const Shell shell;
  const std::string command =
      "formfactors " HEMITEX_DATA "/paper-room.obj --texels 16 --patch 2 --from light --by-surface --json --method ";
  const json analytic = json::parse(shell.output(command + "analytic"))["row"];
  const json hemicube = json::parse(shell.output(command + "hemicube"))["row"];
  REQUIRE(analytic.size() == 13);
  for (std::size_t i = 0; i < analytic.size(); ++i) {
    const auto name = analytic[i]["surface"].get<std::string>();
    const double excess = analytic[i]["form_factor"].get<double>() - hemicube[i]["form_factor"].get<double>();
    INFO(name << " " << excess);
    if (name == "floor") CHECK(excess > 0.05);
    for (const char* lit : {"wall-front", "wall-left", "ceiling", "box-top", "box-front", "box-left"})
      if (name == lit) CHECK(std::abs(excess) < 2e-4);
  }
}

TEST_CASE("hemitex formfactors and solve with other projections report the captured share", "[cli]") {
  // A cubic tetrahedron sees the same as a hemicube. The plane, of half-width 4, captures 4/pi c atan(c) of the light
  // with c = 4 / sqrt(17); in a closed room only the rest leaves.
  const Shell shell;
  const double c = 4 / std::sqrt(17.0), captured = 4 / M_PI * c * std::atan(c);
  const auto row = [&](const std::string& method) {
    return json::parse(shell.output("formfactors room.obj --from floor --by-surface --json --method " + method));
  };
  const json hemicube = row("hemicube"), tetrahedron = row("tetrahedron"), plane = row("single-plane");
  CHECK(hemicube["captured"] == 1);
  CHECK(tetrahedron["captured"] == 1);
  CHECK(tetrahedron["background"] == 0);
  CHECK(plane["captured"].get<double>() == Approx(captured).epsilon(1e-12));
  CHECK(plane["background"].get<double>() == Approx(1 - captured).epsilon(1e-12));
  for (std::size_t i = 0; i < hemicube["row"].size(); ++i)
    CHECK(tetrahedron["row"][i]["form_factor"].get<double>() ==
          Approx(hemicube["row"][i]["form_factor"].get<double>()).margin(1e-3));

  const Outcome lossy = shell.run("solve room.obj -o plane --texels 4 --resolution 64 --method single-plane --json");
  REQUIRE(lossy.exitCode == 0);
  const json solution = json::parse(lossy.out);
  CHECK(solution["settings"]["method"] == "single-plane");
  CHECK(solution["captured"].get<double>() == Approx(captured).epsilon(1e-12));
  CHECK(solution["warnings"].size() == 1);
  CHECK(solution["energy"]["lost"][0].get<double>() > 0.04 * solution["energy"]["emitted"][0].get<double>());
  const json whole =
      json::parse(shell.output("solve room.obj -o all --texels 4 --resolution 64 --method tetrahedron --json"));
  CHECK(whole["captured"] == 1);
  CHECK(whole["warnings"].empty());
  CHECK(whole["energy"]["lost"][0] == 0);
}

TEST_CASE("hemitex formfactors --pixels-per-element gives smoother rows", "[cli]") {
  // A ceiling of 32 x 32 elements in at most 16 x 16 pixels: at most one element in four is met, but all blocks are.
  const Shell shell;
  const auto seen = [&](const std::string& options) {
    const json result = json::parse(shell.output(
        "formfactors room.obj --from floor:16,16 --texels 32 --resolution 16 --split 1 --json " + options));
    double sum = result["background"].get<double>() + result["back"].get<double>();
    int met = 0;
    for (const json& element : result["row"]) {
      sum += element["form_factor"].get<double>();
      met += element["surface"] == "ceiling/lamp" && element["form_factor"].get<double>() > 0;
    }
    CHECK(sum == Approx(1).epsilon(1e-12));
    return std::pair(met, result["pixels_per_element"].get<double>());
  };
  const auto [few, none] = seen("");
  const auto [all, four] = seen("--pixels-per-element 4");
  CHECK(none == 0);
  CHECK(four == 4);
  CHECK((few > 0 && few <= 256));
  CHECK(all == 1024);
}

TEST_CASE("hemitex solve --adaptive keeps elements together where light changes little", "[cli]") {
  const Shell shell;
  shell.output("solve room.obj --texels 16 --patch 4 --resolution 32 --size 40x30 --adaptive 0.001 -o out");
  const json solution = json::parse(readAll(shell.file("out/solution.json")));
  CHECK(solution["settings"]["adaptive"] == 0.001);
  CHECK(solution["settings"]["filter"] == "quadtree");
  // Six faces of at least 4 x 4 elements, at most 16 x 16.
  const auto elements = solution["elements"].get<std::size_t>();
  CHECK(elements > 6 * 16);
  CHECK(elements < 6 * 16 * 16 / 2);
  CHECK(linesOf(readAll(shell.file("out/elements.csv"))).size() == elements + 1);
  CHECK(shell.run("solve room.obj --texels 12 --adaptive 0.01 -o none").exitCode == 2);
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
    const json settings = json::parse(readAll(shell.file(filter + "/solution.json")))["settings"];
    CHECK(settings["filter"] == filter);
    CHECK(settings["magnify"] == (filter == "one-to-one" || filter == "triangle" ? 1 : 4));
  }
  for (const char* options : {"--filter none", "--filter bicubic --magnify 0", "--magnify 17"})
    CHECK(shell.run(quickSolve + options + " -o none").exitCode == 2);
}

TEST_CASE("hemitex formfactors --all reports the checks of matrices", "[cli]") {
  // In a closed cube rows sum to 1. The errors of rays, about 1e-3 each, and those of hemicubes break reciprocity.
  const Shell shell;
  for (const std::string method : {"rays", "hemicube"}) {
    const std::string command = "formfactors room.obj --all --by-surface --json --method " + method;
    const Outcome outcome = shell.run(command);
    REQUIRE(outcome.exitCode == 0);
    const json result = json::parse(outcome.out);
    CHECK(result["matrix"].size() == 36);
    CHECK(result["matrix"][1].contains("standard_error") == (method == "rays"));
    CHECK(result["row_sums"][0].get<double>() == Approx(1).epsilon(1e-12));
    CHECK(result["row_sums"][1].get<double>() == Approx(1).epsilon(1e-12));
    CHECK(result["reciprocity"].get<double>() < 0.01);
    CHECK(outcome.err.find("rows sum to ") != std::string::npos);
    CHECK(outcome.err.find("at most 0 (from ") != std::string::npos);
    CHECK(outcome.err.find("reciprocity is missed by at most ") != std::string::npos);
    CHECK(shell.run(command + " -q").err.empty());

    const Outcome smooth = shell.run(command + " --smooth");
    CHECK(smooth.err.find("smoothing moved form factors by at most ") != std::string::npos);
    const json smoothed = json::parse(smooth.out);
    CHECK(smoothed["reciprocity"].get<double>() < 1e-12);
    CHECK(smoothed["row_sums"][0].get<double>() == Approx(1).epsilon(1e-12));
    double largest = 0;
    for (std::size_t i = 0; i < 36; ++i)
      largest = std::max(largest, std::abs(smoothed["matrix"][i]["form_factor"].get<double>() -
                                           result["matrix"][i]["form_factor"].get<double>()));
    CHECK(smoothed["smoothing"]["largest"].get<double>() == largest);
    CHECK((largest > 1e-6 && largest < 0.01));
  }
}

TEST_CASE("hemitex vector export writes a vector without item IDs, and vector render adds them", "[cli]") {
  const Shell shell;
  shell.output("vector export room.obj --eye 0,0,0 --normal 0,0,1 --resolution 8 -o vector");
  CHECK(fs::exists(shell.file("vector/vector.json")));
  CHECK_FALSE(fs::exists(shell.file("vector/top.u32")));
  const std::string faces = shell.output("vector render vector -o vector");
  CHECK(fs::file_size(shell.file("vector/top.u32")) == 8 * 8 * 4);
  CHECK(shell.output("vector render vector -o elsewhere") == faces);
  // A name that is not UTF-8 is repaired.
  shell.output("vector export room.obj --eye 0,0,0 --normal 0,0,1 --resolution 8 --name \xe9 -o latin");
  CHECK(json::parse(readAll(shell.file("latin/vector.json")))["name"] == "\xef\xbf\xbd");
  CHECK(readAll(shell.file("elsewhere/vector.json")) == readAll(shell.file("vector/vector.json")));
}

TEST_CASE("hemitex vector calibrate finds the profile of the reference renderer, and none of a device that fits none",
          "[cli]") {
  const Shell shell;
  const json vectors = json::parse(shell.output("vector calibrate --probes probes --json"))["vectors"];
  CHECK(vectors.size() >= 10);
  for (const json& vector : vectors) {
    const std::string name = vector["name"];
    CHECK_FALSE(fs::exists(shell.file("probes/" + name + "/front.u32")));
    shell.output("vector render probes/" + name + " -o device/" + name);
  }
  const std::string calibrate = "vector calibrate probes --candidate device -o profile.json";
  const json found = json::parse(shell.output(calibrate + " --json"));
  CHECK(found["faults"].empty());
  CHECK(found["profile"] == json::parse(readAll(shell.file("profile.json"))));
  CHECK(found["profile"]["subpixel_bits"] == 8);
  CHECK(found["profile"]["snap_rounding"] == "nearest");
  CHECK(found["profile"]["edge_rule"] == "top-left");
  CHECK(linesOf(shell.output(calibrate)).at(2) == "subpixel_bits,8");
  shell.output("vector check device/edge-rule --candidate device/edge-rule --profile profile.json");

  fs::remove(shell.file("profile.json"));
  writeAll(shell.file("device/edge-rule/front.u32"), std::string(256 * 4, 'x'));
  const Outcome faulty = shell.run(calibrate);
  CHECK(faulty.exitCode == 1);
  CHECK(faulty.out.find("coverage: ") == 0);
  CHECK_FALSE(fs::exists(shell.file("profile.json")));

  fs::remove(shell.file("device/edge-rule/front.u32"));
  CHECK(shell.run(calibrate).exitCode == 2);
  fs::copy(shell.file("probes/snapping-5/positions.f32"), shell.file("probes/snapping-4/positions.f32"),
           fs::copy_options::overwrite_existing);
  const Outcome strange = shell.run(calibrate);
  CHECK(strange.exitCode == 2);
  CHECK(strange.err.find("--probes") != std::string::npos);
  for (const char* arguments : {"", " probes", " probes -o profile.json", " probes --candidate device",
                                " --probes again probes --candidate device -o profile.json", " --probes again -o out"})
    CHECK(shell.run(std::string("vector calibrate") + arguments).exitCode == 2);
  CHECK_FALSE(fs::exists(shell.file("again")));
}

TEST_CASE("hemitex vector explain derives an item ID from the vertices to the blend", "[cli]") {
  // A triangle from w = 2 to w = 0 is clipped at n = 1/2, a quarter of the way from its far corner. There x/w is 1 and
  // -1, and y/w is 2. In units of 1/256 pixel the sample lies at 1152/4096 of the picture's width and 1152/6144 of the
  // height of the rest: b = (9/32, 17/32, 6/32). 1/w = (9 + 17)/64 + 6/16 = 25/32, and u/w = 9/64 + 9/64 as well as v/w
  // = 9/32 give u = v = 9/25. Behind the triangle is a wall at w = 4.
  using namespace hemitex;
  reference::TestVector vector;
  vector.name = "by-hand";
  raster::DrawList& list = vector.list;
  list.format = {{8, 8}};
  list.indexMaps.push_back(reference::countingMap(4, 4));
  for (raster::ItemId& id : list.indexMaps[0].ids) id *= 0x102;
  reference::addDraw(list, 0x10fa, {}, 0);
  reference::addTriangle(list, {{2, -2, 2}, {-2, -2, 2}, {0, 2, 0}}, {{1, 0}, {0, 0}, {0.5f, 1}});
  reference::addDraw(list, 7);
  reference::addTriangle(list, {{-8, -8, 4}, {-8, 24, 4}, {24, -8, 4}});
  vector.faces.push_back({"front", reference::frontFace(16, 0.5f), "front.u32", {}});
  const Shell shell;
  fs::create_directory(shell.file("vector"));
  reference::writeVector(shell.file("vector"), vector, {});

  CHECK(shell.output("vector explain vector --pixel front,4,4") == R"(pixel 4,4 of front holds 5631: no draw
face: eye (0, 0, 0), x (1, 0, 0), y (0, 1, 0), w (0, 0, 1), near 0.5, resolution 16
triangle: 0
draw: 0
vertices (d = P - eye; x = X.d, y = Y.d, w = W.d in binary32):
  index 0, position (2, -2, 2), from_eye (2, -2, 2), view (2, -2, 2), texcoord (1, 0)
  index 1, position (-2, -2, 2), from_eye (-2, -2, 2), view (-2, -2, 2), texcoord (0, 0)
  index 2, position (0, 2, 0), from_eye (0, 2, 0), view (0, 2, 0), texcoord (0.5, 1)
clip (to w >= n and |x|, |y| <= 8w): cut_by (near, top), piece 0, pieces 2
corners (q = (x/w, y/w), clamped to [-8, 8]; snapped = nearbyint((q + 1) 128 R)):
  view (2, -2, 2), texcoord (1, 0), q (1, -1), snapped (4096, 0)
  view (-2, -2, 2), texcoord (0, 0), q (-1, -1), snapped (0, 0)
  view (-0.5, 1, 0.5), texcoord (0.375, 0.75), q (-1, 2), snapped (0, 6144)
sample (in 1/256 pixel): (1152, 1152)
area (doubled): -25165824
faces_away (area and det(X, Y, W) have the same sign): false
edges (opposite the corners; inside > 0, and = 0 on top and left edges):
  value 7077888, kind left
  value 13369344, kind other
  value 4718592, kind top
weights (b = edge / |area|): (0.28125, 0.53125, 0.1875)
inverse_depth (sum of b/w): 0.78125
u (sum of b u/w over 1/w): 0.36
v (sum of b v/w over 1/w): 0.36
texel (floor of position = (u N, v M), clamped to the map): width 4, height 4, position (1.44, 1.44), column 1, row 1, index 1290
sums (offset + texel, clamped or modulo 2^bits):
  bits 8, offset 250, texel 10, result 255
  bits 8, offset 16, texel 5, result 21
word (the item ID): 5631
runner_up (the next triangle; difference of 1/w): triangle 1, draw 1, inverse_depth 0.25, difference 0.53125
triangles that cover it, nearest first:
triangle,draw,facing,w,u,v,column,row,word
0,0,front,1.28,0.36,0.36,1,1,5631
1,1,front,4,0,0,,,7
)");
  const json derivation = json::parse(shell.output("vector explain vector --pixel front,4,4 --json"))["derivation"];
  CHECK(derivation["clip"] == json::parse(R"({"cut_by": ["near", "top"], "piece": 0, "pieces": 2})"));
  CHECK(derivation["corners"][2]["snapped"] == json({0, 6144}));
  CHECK(derivation["weights"] == json({0.28125, 0.53125, 0.1875}));
  CHECK(derivation["inverse_depth"] == 0.78125);
  CHECK(derivation["texel"]["index"] == 1290);
  CHECK(derivation["runner_up"]["difference"] == 0.53125);
  CHECK(derivation["word"] == 5631);
}

TEST_CASE("hemitex vector export and render write stages beside the vector", "[cli]") {
  const Shell shell;
  shell.output("vector export room.obj --eye 0,0,0 --normal 0,0,1 --resolution 8 --stages -o vector");
  const json faces = json::parse(readAll(shell.file("vector/stages.json")))["faces"];
  REQUIRE(faces.size() == 5);
  CHECK(fs::file_size(shell.file("vector") / faces[0]["triangles"]) == 8 * 8 * 4);
  CHECK_FALSE(fs::exists(shell.file("vector/top.u32")));
  shell.output("vector render vector --stages -o rendered");
  CHECK(readAll(shell.file("rendered/stages.json")) == readAll(shell.file("vector/stages.json")));
  CHECK(fs::file_size(shell.file("rendered/top.u32")) == 8 * 8 * 4);
  shell.output("vector render vector -o plain");
  CHECK_FALSE(fs::exists(shell.file("plain/stages.json")));
}

TEST_CASE("hemitex vector suite writes folders and a table with the pinned hashes", "[cli]") {
  const Shell shell;
  const json vectors = json::parse(shell.output("vector suite -o suite --json"))["vectors"];
  const std::vector<std::string> pinned = linesOf(readAll(HEMITEX_SUITE_HASHES));
  REQUIRE(vectors.size() == pinned.size() - 1);  // the last line is for the whole suite
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    const std::string name = vectors[k]["name"];
    CHECK(vectors[k]["hash"].get<std::string>() + " " + name == pinned[k]);
    const json written = json::parse(readAll(shell.file("suite/" + name + "/vector.json")));
    CHECK(written["name"] == name);
    CHECK(written["catches"] == vectors[k]["catches"]);
    CHECK(fs::exists(shell.file("suite/" + name) / written["faces"][0]["words"]));
  }
  // An existing folder is filled again.
  const std::vector<std::string> table = linesOf(shell.output("vector suite -o suite"));
  CHECK(table.size() == 1 + vectors.size());
  CHECK(table[0] == "name,catches,hash");
}

TEST_CASE("hemitex vector render --device draws a vector on another device if there is one", "[cli]") {
  const Shell shell;
  shell.output("vector export room.obj --eye 0.5,0.5,0.01 --normal 0,0,1 --resolution 16 -o vector");
  CHECK(shell.run("vector render vector --device abacus -o device").exitCode == 2);
  const Outcome drawn = shell.run("vector render vector --device opengl -o device");
  if (drawn.exitCode == 0)
    CHECK(shell.run("vector check vector --candidate device").exitCode == 0);
  else
    CHECK((drawn.exitCode == 2 && drawn.err.find("OpenGL") != std::string::npos));
}

TEST_CASE("hemitex vector check judges a suite of vectors", "[cli]") {
  const Shell shell;
  for (const std::string name : {"near", "far"}) {
    shell.output("vector export room.obj --eye 0.5,0.5," + std::string(name == "near" ? "0.01" : "0.3") +
                 " --normal 0,0,1 --resolution 16 --name " + name + " -o suite/" + name);
    shell.output("vector render suite/" + name + " -o device/" + name);
  }
  const std::string check = "vector check suite --candidate device";
  const std::vector<std::string> right = linesOf(shell.output(check));
  REQUIRE(right.size() == 4);
  CHECK(right[0].substr(0, 13) == "vector,exact,");
  CHECK(right[3] == "all,1536,0,0,0,0,0");
  CHECK(right[1].substr(0, 8) == "far,768,");  // 16 x 16 pixels, and four times 16 x 8

  std::string ids = readAll(shell.file("device/near/top.u32"));
  for (std::size_t byte = 0; byte < ids.size(); byte += 4) std::reverse(&ids[byte], &ids[byte] + 4);
  writeAll(shell.file("device/near/top.u32"), ids);
  const Outcome wrong = shell.run(check + " --json --junit report.xml --diff report.png --minimize small");
  CHECK(wrong.exitCode == 1);
  const json report = json::parse(wrong.out);
  CHECK(report["vectors"][0]["pass"] == true);
  CHECK(report["vectors"][1]["pass"] == false);
  const std::string xml = readAll(shell.file("report.xml"));
  CHECK(xml.find("<testsuite name=\"far\" tests=\"5\" failures=\"0\">") != std::string::npos);
  CHECK(xml.find("<testsuite name=\"near\" tests=\"5\" failures=\"1\">") != std::string::npos);
  CHECK(shell.run("vector check small --candidate small/candidate").exitCode == 1);
  // The result of an earlier failure is replaced.
  CHECK(shell.run(check + " --minimize small").exitCode == 1);
  CHECK(shell.run("vector check small --candidate small/candidate").exitCode == 1);

  fs::remove_all(shell.file("device/far"));
  const Outcome missing = shell.run(check);
  CHECK(missing.exitCode == 1);
  CHECK(missing.out.find("\nmissing: far was not drawn\n") != std::string::npos);
  CHECK(shell.run("vector check suite --candidate nowhere").exitCode == 2);
  fs::create_directory(shell.file("empty"));
  CHECK(shell.run("vector check empty --candidate device").exitCode == 2);
}

TEST_CASE("hemitex vector check --exact judges the reference and the candidate by the independent evaluator", "[cli]") {
  const Shell shell;
  for (const std::string height : {"0.01", "0.3"}) {
    shell.output("vector export room.obj --eye 0.5,0.5," + height + " --normal 0,0,1 --resolution 8 -o suite/" +
                 height);
    shell.output("vector render suite/" + height + " -o device/" + height);
  }
  const std::string one = "vector check suite/0.3 --candidate device/0.3 --exact",
                    all = "vector check suite --candidate device --exact";
  const std::string agrees = "reference: agrees with the independent evaluator at all ";
  CHECK(shell.output(one).find("\n" + agrees + "192 pixels\n") != std::string::npos);
  CHECK(shell.output(all).find("\n" + agrees + "384 pixels\n") != std::string::npos);
  CHECK(json::parse(shell.output(one + " --json"))["reference"] == json({{"pixels", 192}, {"differing", 0}}));
  for (const json& vector : json::parse(shell.output(all + " --json"))["vectors"])
    CHECK(vector["reference"]["differing"] == 0);

  std::string ids = readAll(shell.file("device/0.3/top.u32"));
  ids[3] = static_cast<char>(ids[3] ^ 64);
  writeAll(shell.file("device/0.3/top.u32"), ids);
  const Outcome wrong = shell.run(one + " --minimize small");
  CHECK(wrong.exitCode == 1);
  CHECK(wrong.out.find("error in top: pixel 0,0") != std::string::npos);
  CHECK(wrong.out.find(agrees) != std::string::npos);
  CHECK(shell.run("vector check small --candidate small/candidate --exact").exitCode == 1);
  CHECK(shell.run("vector check suite/0.3 --candidate nowhere --exact").exitCode == 2);
}

TEST_CASE("hemitex vector check names a systematic fault", "[cli]") {
  const Shell shell;
  shell.output("vector export room.obj --eye 0.5,0.5,0.01 --normal 0,0,1 --resolution 16 -o vector");
  shell.output("vector render vector -o device");
  for (const char* face : {"top", "side-right", "side-up", "side-left", "side-down"}) {
    const std::string file = "device/" + std::string(face) + ".u32";
    std::string ids = readAll(shell.file(file));
    for (std::size_t byte = 0; byte < ids.size(); byte += 4) std::reverse(&ids[byte], &ids[byte] + 4);
    writeAll(shell.file(file), ids);
  }
  const Outcome wrong = shell.run("vector check vector --candidate device");
  CHECK(wrong.exitCode == 1);
  CHECK(wrong.out.find("\ndiagnosis: byte order, in item ID files (100.0 % agreement): ") != std::string::npos);
  const json report = json::parse(shell.run("vector check vector --candidate device --json").out);
  REQUIRE(report["diagnosis"].size() == 1);
  CHECK(report["diagnosis"][0]["fault"] == "byte order");
}

TEST_CASE("hemitex vector check passes the reference, fails on one wrong item ID, and refuses a short file", "[cli]") {
  const Shell shell;
  shell.output("vector export room.obj --eye 0.5,0.5,0.01 --normal 0,0,1 --resolution 16 -o vector");
  shell.output("vector render vector -o device");
  const std::string check = "vector check vector --candidate device";
  CHECK(json::parse(shell.output(check + " --json"))["pixels"]["error"] == 0);

  std::string ids = readAll(shell.file("device/top.u32"));
  ids[100] = static_cast<char>(ids[100] ^ 1);
  ids[103] = static_cast<char>(ids[103] ^ 64);
  writeAll(shell.file("device/top.u32"), ids);
  const Outcome wrong = shell.run(check + " --json --junit report.xml --diff report.png");
  CHECK(wrong.exitCode == 1);
  const json report = json::parse(wrong.out);
  CHECK(report["pixels"]["error"] == 1);
  CHECK(report["errors"][0]["column"] == 9);  // byte 100 belongs to item ID 25: row 1, column 9
  CHECK(report["errors"][0]["row"] == 1);
  CHECK(readAll(shell.file("report.xml")).find("failures=\"1\"") != std::string::npos);
  CHECK(readAll(shell.file("report.png")).substr(1, 3) == "PNG");

  CHECK(shell.run(check + " --minimize small").exitCode == 1);
  const Outcome small = shell.run("vector check small --candidate small/candidate --json");
  CHECK(small.exitCode == 1);
  CHECK(json::parse(small.out)["pixels"]["error"] == 1);
  CHECK(json::parse(small.out)["errors"][0]["kind"] == report["errors"][0]["kind"]);
  CHECK(fs::file_size(shell.file("small/indices.u32")) <= 2 * 3 * 4);

  const json explained = json::parse(shell.output("vector explain vector --pixel top,9,1 --json"));
  CHECK(explained["word"] == report["errors"][0]["expected"]);
  CHECK(explained["triangles"][0]["word"] == explained["word"]);

  writeAll(shell.file("device/top.u32"), ids.substr(4));
  CHECK(shell.run(check).exitCode == 2);
  writeAll(shell.file("device/top.u32"), ids + "more");
  CHECK(shell.run(check).exitCode == 2);
  CHECK(shell.run("vector check vector --candidate nowhere").exitCode == 2);
  CHECK(shell.run("vector explain vector --pixel top,16,1").exitCode == 2);
  CHECK(shell.run("vector explain vector --pixel top,1").exitCode == 2);
  CHECK(shell.run(check + " --profile room.obj").exitCode == 2);
}

TEST_CASE("hemitex bench measures all documented times, for the original and the subdivided scene", "[cli]") {
  const Shell shell;
  const std::string out = shell.output("bench room.obj --resolution 16 --resolution 32 --triangles 100 --json -o out");
  const json result = json::parse(out);
  CHECK(readAll(shell.file("out/bench.json")) == out);
  std::map<std::pair<int, int>, std::set<std::string>> found;
  for (const json& run : result["runs"]) {
    CHECK(run["scene"] == "room");
    // Texels have the size for which 128 fit each of six equal squares. Sides of 8 and 16 are equally near to the root
    // of 128; the smaller is taken.
    CHECK(run["elements"] == 6 * 8 * 8);
    CHECK(run["threads"] == 1);
    CHECK(run["repeats"] == 11);
    CHECK(run["min_ms"] > 0.0);
    CHECK(run["median_ms"] >= run["min_ms"]);
    CHECK(run.size() == 9);
    found[{run["triangles"], run["resolution"]}].insert(run["what"].get<std::string>());
  }
  std::set<std::string> cut{"hemicube", "draw", "embree", "floor"};
  if (!found.empty() && found.begin()->second.contains("opengl")) cut.insert("opengl");
  std::set<std::string> whole = cut;
  whole.insert({"hemicube-mesh", "shot", "solution"});
  REQUIRE(found.size() == 4);
  for (const auto& [place, what] : found) CHECK(what == (place.first == 12 ? whole : cut));
  for (const char* key : {"two_cores", "memory"}) CHECK(result[key] == json::object());
  for (const char* key : {"tied_wall", "growth", "equal_time_error", "solution_parts"})
    CHECK(result[key] == json::array());
  REQUIRE(result["crossover"].size() == 2);
  CHECK(result["crossover"][0]["scene"] == "room");
  // All but the four hemicubes, and the shots and solutions of the scene as it is.
  CHECK(result["ratios"].size() == result["runs"].size() - 4 - 2 * 2);
  const std::string page = readAll(shell.file("out/report.html"));
  CHECK(page.find("{{") == std::string::npos);
  CHECK(page.find(out) != std::string::npos);
  CHECK(readAll(shell.file("out/tables.md")).find("| room | 12 | 384 | 16 | ") != std::string::npos);
}
