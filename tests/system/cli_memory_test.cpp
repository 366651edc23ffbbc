/// What hemitex refuses before it takes the memory: small files that become large, more elements than are meant, and
/// pipes; and how it ends where memory is too small. The limit of the address space keeps a fault from harming.
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "radiosity/scene/scene.h"
#include "tests/support/shell.h"

using namespace hemitex;
using namespace hemitex::tests;
using Catch::Contains;

namespace {

const std::string twoThreads = "'" HEMITEX_PROGRAM "' --threads 2 ";

/// Runs a command with an address space of so many MiB, for at most 20 seconds.
Outcome limited(const Shell& shell, int mebibytes, const std::string& arguments) {
  return shell.execute("ulimit -c 0; ulimit -v " + std::to_string(mebibytes * 1024) + "; timeout 20 " + twoThreads +
                       arguments);
}

/// Writes files with tests/system/bombs.py.
void writeBombs(const Shell& shell, const std::string& names) {
  const Outcome outcome = shell.execute("python3 " HEMITEX_SOURCE "/tests/system/bombs.py " + names);
  INFO(outcome.err);
  REQUIRE(outcome.exitCode == 0);
}

/// A command that ends, with an address space of so many MiB, with a message which names the file and the size.
void checkRefused(const Shell& shell, int mebibytes, const std::string& arguments, const std::string& file) {
  const Outcome outcome = limited(shell, mebibytes, arguments);
  INFO(arguments << ": " << outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK_THAT(outcome.err, Contains(file + ": ") && Contains("B of memory; ") && Contains("MB are free") &&
                              Contains("add --insist to run all the same"));
}

}  // namespace

TEST_CASE("hemitex refuses small files that become large", "[faults][little_memory]") {
  const Shell shell;
  writeBombs(shell, "npz pieces zlib instances many_images");
  checkRefused(shell, 300, "matrix check bomb.npz room.obj", "bomb.npz: indices");
  for (const std::string file : {"pieces.vtp", "zlib.vtp", "instances.gltf"})
    checkRefused(shell, 300, "solve " + file + " --sky 1,1,1 -o out", file);
  // The libraries for images alone take 430 MB of address space.
  checkRefused(shell, 1000, "solve many.obj -o out", "many.mtl");
  checkRefused(shell, 1000, "solve many.gltf -o out", "many.gltf");
}

TEST_CASE("hemitex decodes an image once, however many textures name it", "[faults][little_memory]") {
  const Shell shell;
  writeBombs(shell, "one_image");
  for (const char* file : {"one.obj", "one.gltf"}) {
    const Outcome outcome =
        limited(shell, 1000, "formfactors " + std::string(file) + " --by-surface --all --texels 1 --resolution 32");
    INFO(outcome.err);
    CHECK(outcome.exitCode == 0);
  }
}

TEST_CASE("hemitex refuses more than 2^24 elements in all commands, unless --insist is given", "[cli]") {
  const Shell shell;
  for (const char* command : {"formfactors room.obj --from floor --texel-size 1e-9",
                              "solve room.obj -o out --texel-size 1e-9", "tradeoff room.obj -o t --texels 4096"}) {
    const Outcome outcome = shell.execute("timeout 5 " + twoThreads + command);
    INFO(command << ": " << outcome.err);
    CHECK(outcome.exitCode == 2);
    CHECK_THAT(outcome.err, Contains("room.obj: ") && Contains("100663296 elements") &&
                                Contains("or add --insist to run all the same"));
  }
  // The option works before and after the command.
  const std::string row = "formfactors room.obj --from floor --texels 1700";
  for (const std::string& command : {row + " --insist", "--insist " + row})
    CHECK(shell.execute("timeout 1 " + twoThreads + command).exitCode == 124);
}

TEST_CASE("bytesPerTriangle is what a triangle of a mesh takes while it is read", "[faults]") {
  const Shell shell;
  const auto writeHills = [&](const std::string& name, int side) {
    std::string text = "mtllib room.mtl\n";
    for (int i = 0; i <= side; ++i)
      for (int j = 0; j <= side; ++j)
        text += "v " + std::to_string(i) + " " + std::to_string(i * j * 0.002) + " " + std::to_string(j) +
                " .5 .5 .5\nvt " + std::to_string(i) + " " + std::to_string(j) + "\nvn 0 1 0\n";
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        const auto corner = [&](int x, int y) {
          const std::string index = std::to_string((i + x) * (side + 1) + j + y + 1);
          return " " + index + "/" + index + "/" + index;
        };
        text += "f" + corner(0, 0) + corner(0, 1) + corner(1, 1) + "\nf" + corner(0, 0) + corner(1, 1) + corner(1, 0) +
                "\n";
      }
    writeAll(shell.file(name), text + "g lamp\nv 0 500 0\nv 1 500 0\nv 0 500 1\nf -3 -2 -1\n");
  };
  const auto peakOf = [&](const std::string& name) {  // of resident memory, in bytes
    const Outcome outcome = shell.execute(
        "python3 -c 'import resource, subprocess, sys; subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL); "
        "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)' " +
        twoThreads + "formfactors " + name + " --one-sided --from lamp --by-surface --texels 64 --resolution 16");
    INFO(outcome.err);
    return 1024 * std::stod(outcome.out);
  };
  writeHills("small.obj", 1);
  writeHills("large.obj", 200);
  const double perTriangle = (peakOf("large.obj") - peakOf("small.obj")) / (2 * 200 * 200);
  CHECK(perTriangle < radiosity::bytesPerTriangle);
  CHECK(perTriangle > 0.6 * radiosity::bytesPerTriangle);
}

TEST_CASE("hemitex does not wait for a pipe", "[cli]") {
  const Shell shell;
  const auto check = [&](const std::string& name, const std::string& command) {
    shell.execute("mkfifo " + name);
    const Outcome outcome = shell.execute("timeout 5 " + twoThreads + command);
    INFO(command << ": " << outcome.err);
    CHECK(outcome.exitCode == 2);
    CHECK_THAT(outcome.err, Contains(name + ": is a pipe or a device, not a file"));
  };
  for (const char* name : {"a.csv", "a.mtx", "a.vf", "a.txt", "a.npz"})
    check(name, std::string("matrix check ") + name + " room.obj");
  for (const char* name : {"a.obj", "a.gltf", "a.glb", "a.ply", "a.stl", "a.vtk", "a.vtp", "a.vs3"})
    check(name, std::string("solve ") + name + " -o out");
}

TEST_CASE("hemitex ends with a message where memory is too small, at any limit", "[faults][little_memory]") {
  const Shell shell;
  shell.output("formfactors room.obj --all -o m.npz");
  shell.output("vector suite -o suite");
  const std::vector<std::string> commands{"solve room.obj -o out --texels 8 --resolution 32 --size 40x30",
                                          "formfactors room.obj --from floor --texels 16",
                                          "matrix check m.npz room.obj", "render room.obj -o picture.png --size 40x30",
                                          "vector check suite --candidate suite"};
  for (std::size_t c = 0; c < commands.size(); ++c) {
    const int unlimited = shell.run(commands[c]).exitCode;
    for (const int mebibytes : {68 + static_cast<int>(c) * 10, 440 + static_cast<int>(c) * 20}) {
      std::filesystem::remove_all(shell.file("out"));
      const std::map<std::string, std::string> before = shell.files();
      const Outcome outcome = limited(shell, mebibytes, commands[c]);
      INFO(commands[c] << " with " << mebibytes << " MiB ended with " << outcome.exitCode << ": " << outcome.err);
      for (const std::string& line : linesOf(outcome.err)) CHECK_THAT(line, Catch::StartsWith("hemitex: "));
      if (outcome.exitCode == unlimited) continue;
      CHECK((outcome.exitCode == 2 || outcome.exitCode == 3));
      CHECK_THAT(outcome.err, outcome.exitCode == 2 ? Contains(" are free; ") : Contains("out of memory"));
      CHECK(shell.files() == before);
    }
  }
}
