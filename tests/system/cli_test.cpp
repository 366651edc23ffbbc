/// The hemitex program as a script uses it: bad usage, global options, exit codes and output streams. Each test runs
/// the built program.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/shell.h"

using namespace hemitex::tests;
using nlohmann::json;

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
      "solve room.obj -o out --split 1.001", "solve room.obj -o out --split 2",
      "formfactors room.obj --from floor --split 2", "solve room.obj -o out --no-align",
      "formfactors room.obj --from floor --no-align", "solve room.obj -o out --max-error 0",
      "solve room.obj -o out --max-error 1", "solve room.obj -o out --max-error 0.1 --resolution 64",
      "solve room.obj -o out --max-error 0.1 --method rays", "solve room.obj -o out --split -1",
      "solve room.obj -o out --split nan", "solve room.obj -o out --orientation up",
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
      "formfactors room.obj --from floor --samples 1024", "formfactors room.obj --from floor --seed 1",
      "formfactors room.obj --from floor --method rays --seed -1", "solve room.obj -o out --seed 1",
      "solve room.obj -o out --method rays --seed x", "formfactors room.obj --from floor --aimed",
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
      "bench room.obj --resolution 8192", "bench room.obj --resolution 32 --resolution x", "bench room.obj -o room.obj",
      "bench --scene room.obj", "vector", "vector export room.obj -o out",
      "vector export room.obj -o out --eye 0,0,0 --normal 0,0,0",
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
