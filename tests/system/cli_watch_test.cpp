/// hemitex watch: follows the files of a scene.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/shell.h"
#include "tests/support/solved_folder.h"

using namespace hemitex::tests;
using nlohmann::json;

namespace {

/// Lines of `sh` that run `hemitex watch` while `changes` run, and then interrupt it. `next` waits until the program
/// has printed one more line, for at most 60 s. The last line that is printed is the exit code.
std::string watching(const std::string& options, const std::string& changes) {
  return ": > log; lines=0; next() { lines=$((lines + 1)); n=0; while [ $(wc -l < log) -lt $lines ] && [ $n -lt 600 ]; "
         "do "
         "sleep 0.1; n=$((n + 1)); done; }\n"
         "'" HEMITEX_PROGRAM "' watch room.obj --json --texels 4 --resolution 32 --size 40x30 -o lit " +
         options + " > log 2> messages &\nnext\n" + changes +
         "\nkill -TERM $!\nwait $!\ncode=$?\ncat log; cat messages >&2; echo $code";
}

json lineOf(const Outcome& outcome, std::size_t number) { return json::parse(linesOf(outcome.out).at(number)); }

json newsOf(const Shell& shell) {
  const std::string script = readAll(shell.file("lit/watch.js"));
  const std::string call = "hemitexWatch(";
  REQUIRE(script.starts_with(call));
  return json::parse(script.substr(call.size(), script.rfind(')') - call.size()));
}

}  // namespace

TEST_CASE("hemitex watch updates the solution after a saved colour, and solves anew after a new shape", "[cli]") {
  const Shell shell;
  const Outcome outcome =
      shell.execute(watching("",
                             "sed -i '0,/^Kd.*/s//Kd 0.1 0.7 0.3/' room.mtl\nnext\ncp -r lit coloured\n"
                             "sed -i 's/^v -1 -1 -1$/v -1 -1 -1.5/' room.obj\nnext"));
  CAPTURE(outcome.err);
  REQUIRE(linesOf(outcome.out).size() == 4);
  CHECK(linesOf(outcome.out).back() == "143");
  CHECK(lineOf(outcome, 0)["updated"] == false);
  CHECK(lineOf(outcome, 1)["updated"] == true);
  CHECK(lineOf(outcome, 1)["changed"] == "room.mtl");
  CHECK(newsOf(shell)["state"] == "ended");
  // The page names the version that the script names.
  CHECK(readAll(shell.file("lit/report.html")).find(newsOf(shell)["version"].get<std::string>()) != std::string::npos);
}

TEST_CASE("hemitex watch solves in bands, along other rows and in the unit of the file, as hemitex solve does",
          "[cli]") {
  const Shell shell;
  writeAll(shell.file("room.obj"), "# units: mm\n" + readAll(shell.file("room.obj")));
  writeAll(shell.file("bands.json"), R"({"wavelengths": [450, 500, 550, 600]})");
  for (const std::string options : {"--bands bands.json", "--discretize mesh", "--lamp 0.5,0.5,0.5=1,2,3"}) {
    CAPTURE(options);
    const Outcome outcome = shell.execute(watching(options, "sed -i 's/^Ke .*/Ke 3 3 3/' room.mtl\nnext"));
    CAPTURE(outcome.err);
    REQUIRE(linesOf(outcome.out).size() == 3);
    CHECK(lineOf(outcome, 1)["updated"] == true);
    shell.output("solve room.obj --texels 4 --resolution 32 --size 40x30 -o new --no-textures " + options);
    const json watched = solutionOf(shell, "lit")["energy"]["emitted"],
               solved = solutionOf(shell, "new")["energy"]["emitted"];
    REQUIRE(watched.size() == solved.size());
    for (std::size_t band = 0; band < solved.size(); ++band)
      CHECK(watched[band].get<double>() == Approx(solved[band].get<double>()).epsilon(1e-12));
    shell.execute("rm -rf lit new; sed -i 's/^Ke .*/Ke 10 10 10/' room.mtl");
  }
}

TEST_CASE("hemitex watch tells a fault of the scene in the page, and goes on when it is repaired", "[cli]") {
  const Shell shell;
  const Outcome outcome =
      shell.execute(watching("",
                             "cp room.obj good.obj\necho 'f 1 2 999' >> room.obj\nn=0\n"
                             "while ! grep -q failed lit/watch.js && [ $n -lt 600 ]; do sleep 0.1; n=$((n + 1)); done\n"
                             "cp lit/watch.js failed.js; cp lit/solution.json kept.json\ncp good.obj room.obj\nnext"));
  CAPTURE(outcome.err);
  REQUIRE(linesOf(outcome.out).size() == 3);
  CHECK(readAll(shell.file("failed.js")).find("room.obj") != std::string::npos);
  CHECK(outcome.err.find("error: room.obj") != std::string::npos);
  CHECK(json::parse(readAll(shell.file("kept.json")))["shots"] == lineOf(outcome, 0)["shots"]);
  CHECK(lineOf(outcome, 1)["updated"] == true);
}

TEST_CASE("hemitex watch refuses options that updates do not allow", "[cli]") {
  const Shell shell;
  for (const char* option :
       {"--adaptive 0.001", "--no-textures", "--edits e.json", "--checkpoint c", "--progress json", "--matrix F.npz"}) {
    CAPTURE(option);
    const Outcome outcome = shell.run("watch room.obj -o lit " + std::string(option));
    CHECK(outcome.exitCode == 2);
    CHECK_FALSE(std::filesystem::exists(shell.file("lit")));
  }
}
