/// The hemitex program as a script uses it: bad usage, global options, exit codes and output streams. Each test runs
/// the built program.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/shell.h"
#include "tests/support/solved_folder.h"

using namespace hemitex::tests;
using nlohmann::json;

TEST_CASE("hemitex with bad usage exits with 2, prints the reason on stderr and leaves nothing behind", "[cli]") {
  const auto [arguments, reason] = GENERATE(table<std::string, std::string>({
      {"", "no command is given"},
      {"no-such-command", "`no-such-command` is no command of `hemitex`"},
      {"solve", "SCENE and --output are missing"},
      {"solve room.obj", "--output is missing"},
      {"solve -o out", "SCENE is missing"},
      {"solve room.obj -o out --no-such-option", "`--no-such-option` is no option of `hemitex solve`"},
      {"solve room.obj -o out extra", "`hemitex solve` takes no further argument `extra`"},
      {"solve room.obj -o out --texels 0", "--texels: `0` is not an integer from 1 to 4096"},
      {"solve room.obj -o out --texels 4097", "--texels: `4097` is not an integer from 1 to 4096"},
      {"solve room.obj -o out --texels 3.5", "--texels: `3.5` is not an integer from 1 to 4096"},
      {"solve room.obj -o out --texels ''", "--texels: the value is empty"},
      {"solve room.obj -o out --texels 99999999999", "--texels: `99999999999` is not an integer from 1 to 4096"},
      {"solve room.obj -o out --texels 4 --texels 5", "--texels is given more than once"},
      {"solve room.obj -o out --texels 4 --texel-size 0.1", "--texels excludes --texel-size"},
      {"solve room.obj -o out --texel-size 0", "--texel-size: `0` is not a number above 0"},
      {"solve room.obj -o out --texel-size nan", "--texel-size: `nan` is not a number above 0"},
      {"solve room.obj -o out --patch 0", "--patch: `0` is not an integer from 1 to 4096"},
      {"solve room.obj -o out --resolution 255", "--resolution: `255` is not an even number"},
      {"solve room.obj -o out --resolution 0", "--resolution: `0` is not an integer from 2 to 4096"},
      {"solve room.obj -o out --resolution 4098", "--resolution: `4098` is not an integer from 2 to 4096"},
      {"solve room.obj -o out --split 0", "--split: `0` is not a number above 0"},
      {"solve room.obj -o out --split 1.001", "--split: `1.001` is above 1, the share of all flux"},
      {"solve room.obj -o out --split 2", "--split: `2` is above 1, the share of all flux"},
      {"formfactors room.obj --from floor --split 2", "--split: `2` is above 1, the share of all flux"},
      {"solve room.obj -o out --no-align", "offsets without alignment overflow the channels of a clamped add"},
      {"formfactors room.obj --from floor --no-align",
       "offsets without alignment overflow the channels of a clamped add"},
      {"solve room.obj -o out --max-error 0", "--max-error: `0` is not a number above 0 and below 1"},
      {"solve room.obj -o out --max-error 1", "--max-error: `1` is not a number above 0 and below 1"},
      {"solve room.obj -o out --max-error 0.1 --resolution 1026",
       "no finer effort is left to estimate the error with; with a"},
      {"solve room.obj -o out --max-error 0.1 --method rays", "--max-error: is not used with --method rays"},
      {"solve room.obj -o out --split -1", "--split: `-1` is not a number above 0"},
      {"solve room.obj -o out --split nan", "--split: `nan` is not a number above 0"},
      {"solve room.obj -o out --orientation up", "--orientation: `up` is none of"},
      {"solve room.obj -o out --method rays --split 0", "--split: `0` is not a number above 0"},
      {"solve room.obj -o out --discretize points", "--discretize: `points` is none of"},
      {"solve room.obj -o out --method rays --discretize mesh", "--discretize: is not used with --method rays"},
      {"solve room.obj -o out --residual 0", "--residual: `0` is not a number above 0"},
      {"solve room.obj -o out --residual -1", "--residual: `-1` is not a number above 0"},
      {"solve room.obj -o out --residual nan", "--residual: `nan` is not a number above 0"},
      {"solve room.obj -o out --residual 1e999", "--residual: `1e999` is not a number above 0"},
      {"solve room.obj -o out --residual inf", "--residual: `inf` is not a number above 0"},
      {"solve room.obj -o out --residual 0.1x", "--residual: `0.1x` is not a number above 0"},
      {"solve room.obj -o out --shots -1", "--shots: `-1` is not an integer of at least 0"},
      {"solve room.obj -o out --no-textures --magnify 2", "--magnify: is of textures, which --no-textures leaves out"},
      {"solve room.obj -o out --threads -1", "--threads: `-1` is not an integer from 0 to 4096"},
      {"solve room.obj -o out --format r9g9b9", "--format: `r9g9b9` is none of"},
      {"solve room.obj -o out --blend add", "--blend: `add` is none of"},
      {"solve room.obj -o out --method guess", "--method: `guess` is none of"},
      {"solve room.obj -o out --samples 1024", "--samples: is not used with --method hemicube"},
      {"solve room.obj -o out --method rays --samples 63", "--samples: `63` is not an integer from 64 to 16777216"},
      {"solve room.obj -o out --method rays --samples 96", "--samples: `96` is not a power of two"},
      {"solve room.obj -o out --method rays --resolution 64", "--resolution: is not used with --method rays"},
      {"solve room.obj -o out --method rays --format r5g6b5", "--format: is not used with --method rays"},
      {"solve room.obj -o out --charts none", "--charts: `none` is none of"},
      {"solve room.obj -o out --max-reflectance 1", "--max-reflectance: `1` is not a number above 0 and below 1"},
      {"solve room.obj -o out --surface floor", "--surface: `floor` is not NAME=N"},
      {"solve room.obj -o out --surface =4", "--surface: `=4` is not NAME=N"},
      {"solve room.obj -o out --surface floor=0", "--surface: `0` is not an integer from 1 to 4096"},
      {"solve room.obj -o out --surface flor=4", "no surface is named `flor`"},
      {"solve room.obj -o out --eye 1,2", "--eye: `1,2` is not a vector x,y,z of three finite numbers"},
      {"solve room.obj -o out --eye 1,2,3,4", "--eye: `1,2,3,4` is not a vector x,y,z of three finite numbers"},
      {"solve room.obj -o out --eye 1,2,x", "--eye: `1,2,x` is not a vector x,y,z of three finite numbers"},
      {"solve room.obj -o out --eye 1,2,nan", "--eye: `1,2,nan` is not a vector x,y,z of three finite numbers"},
      {"solve room.obj -o out --fov 180", "--fov: `180` is not a number above 0 and below 180"},
      {"solve room.obj -o out --size 40", "--size: `40` is not WIDTHxHEIGHT, such as 800x600"},
      {"solve room.obj -o out --size 0x30", "--size: `0` is not an integer from 1 to 2048"},
      {"solve room.obj -o out --size 4000x30", "--size: `4000` is not an integer from 1 to 2048"},
      {"solve room.obj -o out --exposure 0", "--exposure: `0` is not a number above 0"},
      {"solve room.obj -o out --eye 0,0,0 --look-at 0,0,0", "the camera has no direction"},
      {"solve room.obj -o out -q -v", "--quiet excludes --verbose"},
      {"solve room.obj -o room.obj", "room.obj: is not a folder that can be written"},
      {"solve room.obj -o /proc/none/out", "/proc/none/out: is not a folder that can be written"},
      {"render room.obj", "--output is missing"},
      {"render room.obj -o picture.jpg", "--output: the name of the picture must end in .png"},
      {"render room.obj -o out.png --show nothing", "--show: `nothing` is none of"},
      {"render room.obj -o room.mtl/picture.png", "room.mtl: is not a folder that can be written"},
      {"formfactors room.obj", "--from: is required"},
      {"formfactors room.obj --all", "--all: needs --by-surface, or -o with a file that ends in .npz, .mtx or .csv"},
      {"formfactors room.obj --from floor --all --by-surface", "--from excludes --all"},
      {"formfactors room.obj --from flor", "no surface is named `flor`"},
      {"formfactors room.obj --from floor:16,0", "`floor` has no texel 16,0"},
      {"formfactors room.obj --from floor:0,-1", "`floor` has no texel 0,-1"},
      {"formfactors room.obj --from floor --method guess", "--method: `guess` is none of"},
      {"formfactors room.obj --from floor --method rays --samples 63",
       "--samples: `63` is not an integer from 64 to 268435456"},
      {"formfactors room.obj --from floor --samples 1024", "--samples: is not used with --method hemicube"},
      {"formfactors room.obj --from floor --seed 1", "--seed: is not used with --method hemicube"},
      {"formfactors room.obj --from floor --method rays --seed -1", "--seed: `-1` is not an integer of at least 0"},
      {"solve room.obj -o out --seed 1", "--seed: is not used with --method hemicube"},
      {"solve room.obj -o out --method rays --seed x", "--seed: `x` is not an integer of at least 0"},
      {"formfactors room.obj --from floor --aimed", "--aimed: is not used with --method hemicube"},
      {"formfactors room.obj --from floor --method analytic --aimed", "--aimed: is not used with --method analytic"},
      {"formfactors room.obj --from floor --method rays --resolution 64",
       "--resolution: is not used with --method rays"},
      {"formfactors room.obj --from floor --method analytic --discretize texture",
       "--discretize: is not used with --method analytic"},
      {"formfactors room.obj --from floor --method analytic --orientation turned",
       "--orientation: is not used with --method analytic"},
      {"formfactors room.obj --from floor --method analytic --resolution 64",
       "--resolution: is not used with --method analytic"},
      {"solve room.obj -o out --method single-plane --max-error 0.1",
       "--max-error: is not used with --method single-plane"},
      {"solve room.obj -o out --method tetrahedron --samples 64", "--samples: is not used with --method tetrahedron"},
      {"solve room.obj -o out --method rays --pixels-per-element 4",
       "--pixels-per-element: is not used with --method rays"},
      {"solve room.obj -o out --pixels-per-element 0", "--pixels-per-element: `0` is not a number above 0"},
      {"formfactors room.obj --from floor --method tetrahedron --samples 64",
       "--samples: is not used with --method tetrahedron"},
      {"formfactors room.obj --from floor --method rays --no-align", "--no-align: is not used with --method rays"},
      {"formfactors room.obj --from floor --method rays --index-maps packed",
       "--index-maps: is not used with --method rays"},
      {"formfactors room.obj --from floor --index-maps unique --no-align", "unique index maps have no offsets"},
      {"solve room.obj -o out --index-maps unique --blend integer-add", "unique index maps have no offsets"},
      {"solve room.obj -o out --index-maps all", "--index-maps: `all` is none of"},
      {"solve room.obj -o out --index-maps unique --page 64", "unique index maps have no offsets"},
      {"solve room.obj -o out --index-maps packed --page 48", "--page: `48` is not a power of two"},
      {"solve room.obj -o out --page 8 --texels 9", "a surface has more than the 8 texels of a page along a side"},
      {"formfactors room.obj --from floor --smooth", "--smooth requires --all"},
      {"tradeoff room.obj", "--output is missing"},
      {"tradeoff -o out", "SCENE is missing"},
      {"tradeoff room.obj -o out --texels 6,4", "--texels: 4 does not divide the largest number, 6"},
      {"tradeoff room.obj -o out --texels 4,", "--texels: `` is not an integer from 1 to 4096"},
      {"tradeoff room.obj -o out --texels 32", "the scene has 6144 elements, and the truth is found for 5000 at most"},
      {"tradeoff room.obj -o out --patch 0", "--patch: `0` is not an integer from 1 to 4096"},
      {"tradeoff room.obj -o out --method guess", "--method: `guess` is none of"},
      {"tradeoff room.obj -o out --method hemicube=48", "--method: 48 is not a power of two"},
      {"tradeoff room.obj -o out --method hemicube=1", "--method: `1` is not an integer from 2 to 4096"},
      {"tradeoff room.obj -o out --method area-rays=", "--method: `` is not an integer from 16 to 16777216"},
      {"tradeoff room.obj -o out --samples 127", "--samples: `127` is not an integer from 128 to 1048576"},
      {"bench no-such-file.obj", "no-such-file.obj: cannot be read: it does not exist"},
      {"bench room.obj ./room.obj", "./room.obj: another scene has the same name"},
      {"bench room.obj --resolution 33", "--resolution: `33` is not an even number"},
      {"bench room.obj --resolution 8192", "--resolution: `8192` is not an integer from 2 to 4096"},
      {"bench room.obj --resolution 32 --resolution x", "--resolution: `x` is not an integer from 2 to 4096"},
      {"bench room.obj -o room.obj", "room.obj: is not a folder that can be written"},
      {"bench --scene room.obj", "`--scene` is no option of `hemitex bench`"},
      {"vector", "no command is given"},
      {"vector export room.obj -o out", "--eye and --normal are missing"},
      {"vector export room.obj -o out --eye 0,0,0 --normal 0,0,0", "--normal has no direction"},
      {"vector export room.obj -o out --eye 1e300,0,0 --normal 0,0,1", "a face has an eye or a row that is not finite"},
      {"vector render room.obj -o out", "room.obj/vector.json: is missing or not a file"},
      {"vector render no-such-folder -o out", "no-such-folder/vector.json: is missing or not a file"},
  }));
  const Shell shell;
  const auto before = shell.files();
  const Outcome outcome = shell.run(arguments);
  INFO(arguments << '\n' << outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.out.empty());
  CHECK_THAT(outcome.err, Catch::StartsWith("hemitex: error: " + reason));
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

TEST_CASE("hemitex --json prints one object on stdout and nothing else", "[cli]") {
  const Shell shell;
  json solution = json::parse(shell.output(quickSolve + "-o out --json"));
  CHECK(solution == solutionOf(shell, "out"));
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

TEST_CASE("hemitex fails if it cannot print the result", "[cli]") {
  CHECK(Shell().run("formfactors room.obj --from floor --resolution 32 >/dev/full; (exit $?)").exitCode == 2);
}

TEST_CASE("hemitex names the arguments that are missing, the scene first", "[cli]") {
  const auto [arguments, missing] = GENERATE(table<std::string, std::string>({
      {"solve", "SCENE and --output are missing"},
      {"solve room.obj", "--output is missing"},
      {"solve -o out", "SCENE is missing"},
      {"solve room.obj -o out --sky 1", "`1` is not R,G,B with three finite numbers"},
  }));
  const Outcome outcome = Shell().run(arguments);
  INFO(arguments);
  CHECK(outcome.exitCode == 2);
  CHECK_THAT(outcome.err, Catch::Contains(missing));
}
