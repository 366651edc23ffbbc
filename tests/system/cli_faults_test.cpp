/// Faults around the program: outputs that would replace inputs, full disks, closed pipes, files that cannot be read,
/// and too little memory. Each ends with one message and the exit code of the contract, and leaves no half-written
/// result.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "radiosity/images/image.h"
#include "tests/support/shell.h"
#include "tests/support/solved_folder.h"

using namespace hemitex;
using namespace hemitex::tests;
namespace fs = std::filesystem;

namespace {

const std::string quickly = " --texels 4 --patch 2 --resolution 32 --size 40x30 ";

/// Puts the room into the folder `o`, with a texture whose name is also that of a display texture.
void makeRoomInOutput(const Shell& shell) {
  fs::create_directory(shell.file("o"));
  writeAll(shell.file("o/scene.obj"), readAll(shell.file("room.obj")));
  writeAll(shell.file("o/room.mtl"), readAll(shell.file("room.mtl")));
  writeAll(shell.file("o/other.obj"), readAll(shell.file("room.obj")));
  writeAll(shell.file("o/other.mtl"),
           "newmtl white\nKd 0.9 0.9 0.9\nmap_Kd floor.png\nnewmtl lamp\nKd 0 0 0\nKe 9 9 9\n");
  std::string textured = readAll(shell.file("room.obj"));
  textured.replace(textured.find("room.mtl"), 8, "other.mtl");
  writeAll(shell.file("o/other.obj"), textured);
  radiosity::writePng(shell.file("o/floor.png"), {1, 1, {glm::dvec3(0.5)}});
  writeAll(shell.file("o/elements.csv"), R"({"ceiling/lamp": [1, 2, 3]})");
  writeAll(shell.file("o/report.html"), R"({"frames": [[{"remove": "floor"}]]})");
}

/// Runs a line, which must fail with this exit code, print one error and nothing else on stderr, and change no file.
std::string faultOf(const Shell& shell, const std::string& line, int exitCode = 2) {
  const auto before = shell.files();
  const Outcome outcome = shell.execute(line);
  INFO(line << '\n' << outcome.err);
  CHECK(outcome.exitCode == exitCode);
  CHECK(linesOf(outcome.err).size() == 1);
  CHECK_THAT(outcome.err, Catch::StartsWith("hemitex: error: "));
  CHECK(shell.files() == before);
  return outcome.err;
}

}  // namespace

TEST_CASE("hemitex refuses an output that is one of its inputs, before it works", "[faults]") {
  const Shell shell;
  makeRoomInOutput(shell);
  const auto arguments = GENERATE(
      as<std::string>{}, "solve o/scene.obj -o o" + quickly, "solve o/other.obj -o o" + quickly,
      "solve o/other.obj -o ./o/../o" + quickly, "solve room.obj --lights o/elements.csv -o o" + quickly,
      "solve room.obj --edits o/report.html --report -o o" + quickly, "render o/other.obj -o o/floor.png --size 40x30");
  const std::string error = faultOf(shell, program + arguments);
  CHECK_THAT(error, Catch::Contains("is read by this run, and its result would replace it"));
}

TEST_CASE("hemitex solve names a folder that has the name of a file of the result", "[faults]") {
  const Shell shell;
  fs::create_directories(shell.file("o/floor.exr"));
  CHECK_THAT(faultOf(shell, program + "solve room.obj -o o" + quickly),
             Catch::Contains("floor.exr: is a folder, but a file of the result has this name"));
}

TEST_CASE("hemitex --help and --version fail if they cannot be printed", "[faults]") {
  const Shell shell;
  for (const char* arguments : {"--help", "--version", "solve --help-all"})
    CHECK_THAT(faultOf(shell, program + arguments + " >/dev/full"),
               Catch::Contains("standard output cannot be written"));
}

TEST_CASE("hemitex solve says that its result is complete if the summary cannot be printed", "[faults]") {
  const Shell shell;
  const Outcome outcome = shell.execute(program + "solve room.obj -o o" + quickly + ">/dev/full");
  CHECK(outcome.exitCode == 2);
  CHECK_THAT(outcome.err, Catch::Contains("the result in o is complete"));
  CHECK(tests::solutionOf(shell, "o").contains("shots"));
}

TEST_CASE("hemitex ends without a message when the reader of its output closes the pipe", "[faults]") {
  const Shell shell;
  const std::string arguments =
      GENERATE(as<std::string>{}, "--help", "formfactors room.obj --from floor -q", "solve room.obj -o o -q --json");
  const Outcome outcome = shell.execute("{ sleep 1; " + program + arguments + "; echo $? >code; } | true");
  CHECK(readAll(shell.file("code")) == "141\n");  // as of a program that SIGPIPE ends
  CHECK(outcome.err.empty());
}

TEST_CASE("hemitex leaves nothing behind on a full disk", "[faults]") {
  // A limit on the size of files makes write fail as on a full disk: here after 4 KiB.
  const Shell shell;
  CHECK_THAT(faultOf(shell, "ulimit -f 8; " + program + "solve room.obj -o o" + quickly),
             Catch::Contains("cannot be written"));
}

TEST_CASE("hemitex solve says where the light is if its result cannot be written", "[faults]") {
  // The pictures exceed the limit on the size of files, the checkpoint does not.
  const Shell shell;
  const std::string solve = "solve room.obj -o o --texels 2 --patch 2 --resolution 32 --size 400x300 --checkpoint c ";
  const Outcome outcome = shell.execute("ulimit -f 16; " + program + solve);
  CHECK(outcome.exitCode == 2);
  CHECK_THAT(outcome.err, Catch::Contains("cannot be written") &&
                              Catch::Contains("the light is in the checkpoint; the same command with --resume 'c'"));
  CHECK_FALSE(fs::exists(shell.file("o")));
  shell.output(solve + "--resume c");
  CHECK(fs::exists(shell.file("o/solution.json")));
}

TEST_CASE("hemitex names a folder that cannot be written", "[faults]") {
  const Shell shell;
  for (const char* folder : {"/proc/none", "/sys/kernel/none"})
    CHECK_THAT(faultOf(shell, program + "solve room.obj -o " + folder + quickly), Catch::Contains(folder));
}

TEST_CASE("hemitex names a file that cannot be read to its end", "[faults]") {
  // Its status is that of a regular file, and reading it is an I/O error, as where a file disappears on the way.
  const Shell shell;
  CHECK_THAT(faultOf(shell, program + "solve /proc/self/mem -o o"), Catch::Contains("/proc/self/mem: cannot be read"));
  CHECK_THAT(faultOf(shell, program + "solve room.obj --edits /proc/self/mem -o o"),
             Catch::Contains("/proc/self/mem: cannot be read"));
  CHECK_THAT(faultOf(shell, program + "solve gone.obj -o o"), Catch::Contains("gone.obj: cannot be read"));
}

TEST_CASE("hemitex says that memory is too small, and leaves nothing behind", "[faults][little_memory]") {
  const Shell shell;
  CHECK_THAT(
      faultOf(shell,
              "ulimit -v 600000; " + program + "--threads 1 solve room.obj -o o --texels 2000 --resolution 32 --insist",
              3),
      Catch::Contains("out of memory"));
}

TEST_CASE("hemitex keeps messages of image libraries to itself, and names the broken image", "[faults]") {
  const Shell shell;
  makeRoomInOutput(shell);
  std::string png = readAll(shell.file("o/floor.png"));
  for (std::size_t at = png.size() - 20; at < png.size() - 14; ++at) png[at] = '~';
  for (const std::string& broken : {png, png.substr(0, png.size() / 2), std::string("\x89PNG\r\n\x1a\n and no more")}) {
    writeAll(shell.file("o/floor.png"), broken);
    const Outcome outcome = shell.execute(program + "render o/other.obj -o picture.png --size 40x30");
    INFO(outcome.err);
    CHECK(outcome.exitCode == 0);
    for (const std::string& line : linesOf(outcome.err)) CHECK_THAT(line, Catch::StartsWith("hemitex: "));
    CHECK_THAT(outcome.err, Catch::Contains("o/floor.png: ") && Catch::Contains("; 0.5 stands for it"));
  }
}

TEST_CASE("hemitex quotes at most some hundred characters of its input", "[faults]") {
  const Shell shell;
  const std::string text(50000, 'y');
  writeAll(shell.file("long.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 " + text + "\n");
  for (const std::string& arguments :
       std::vector<std::string>{"solve long.obj -o o", "solve room.obj -o o --texels " + text,
                                "solve room.obj -o o --emit " + text, "solve room.obj -o o --emit " + text + "=1,1,1",
                                "formfactors room.obj --from " + text, "solve room.obj --" + text, text}) {
    const Outcome outcome = shell.execute(program + arguments);
    CHECK(outcome.exitCode == 2);
    CHECK(outcome.err.size() < 1200);
  }
}
