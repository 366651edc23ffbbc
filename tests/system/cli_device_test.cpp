/// hemitex as the author of a device uses it on a build server: expected results, and programs that
/// crash, hang or write wrong files. Each test runs the built program.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "raster/base/file_io.h"
#include "reference/vectors/candidate.h"
#include "reference/vectors/vector_suite.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using nlohmann::json;
using raster::readFile;

namespace {

struct Outcome {
  int exitCode;
  std::string out, err;

  bool says(const std::string& text) const { return out.find(text) != std::string::npos; }
};

/// Three vectors of the suite in `suite`, and their right item IDs in `right`.
class Workshop {
 public:
  Workshop() {
    for (const std::string name : {"five-faces", "layout-r8g8b8a8", "same-triangle"}) addVector(name);
  }

  std::filesystem::path file(const std::string& name) const { return folder_.path / name; }

  void write(const std::string& name, const std::string& text) const { std::ofstream(file(name)) << text; }

  Outcome run(const std::string& arguments) const {
    const std::string line = "cd '" + folder_.path.string() + "' && '" HEMITEX_PROGRAM "' vector " + arguments + " >'" +
                             (streams_.path / "out").string() + "' 2>'" + (streams_.path / "err").string() + "'";
    const int status = std::system(line.c_str());
    REQUIRE(WIFEXITED(status));
    return {WEXITSTATUS(status), readFile(streams_.path / "out"), readFile(streams_.path / "err")};
  }

 private:
  void addVector(const std::string& name) const {
    for (const reference::TestVector& vector : reference::vectorSuite()) {
      if (vector.name != name) continue;
      const std::vector<raster::ItemBuffer> buffers = reference::render(vector);
      for (const char* folder : {"suite", "right"}) std::filesystem::create_directories(file(folder) / name);
      reference::writeVector(file("suite") / name, vector, buffers);
      reference::writeCandidate(file("right") / name, vector, buffers);
      return;
    }
    FAIL("the suite has no vector " << name);
  }

  TemporaryFolder folder_, streams_;
};

/// Flips a bit of one item ID.
void breakVector(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::string ids = readFile(entry.path());
    ids[3] = static_cast<char>(ids[3] ^ 64);
    raster::writeFile(entry.path(), ids);
    return;
  }
}

}  // namespace

TEST_CASE("hemitex vector check --expectations fails only on news", "[cli]") {
  const Workshop shop;
  const std::string check = "check suite --candidate right", known = check + " --expectations known.txt";
  breakVector(shop.file("right/five-faces"));
  CHECK(shop.run(check).exitCode == 1);
  shop.write("known.txt", "# known\nfive-faces fail bug 12\n");
  const Outcome expected = shop.run(known + " --strict --junit report.xml");
  CHECK(expected.exitCode == 0);
  CHECK(expected.says("\nknown errors: five-faces (expected to fail: bug 12)\n"));
  CHECK_FALSE(expected.says("error in"));
  CHECK(readFile(shop.file("report.xml")).find("<failure") == std::string::npos);
  CHECK(json::parse(shop.run(known + " --json").out)["pass"] == true);
  CHECK(shop.run("check suite/five-faces/ --candidate right/five-faces --expectations known.txt").exitCode == 0);

  shop.write("known.txt", "five-faces flaky bug 12\nsame-triangle fail bug 13\nlayout-r8g8b8a8 flaky bug 14\n");
  const Outcome passed = shop.run(known);
  CHECK(passed.exitCode == 0);
  CHECK(passed.says("\nunexpected pass: same-triangle (expected to fail: bug 13)\n"));
  CHECK(shop.run(known + " --strict").exitCode == 1);
  CHECK(shop.run(check + " --strict").exitCode == 2);
}

TEST_CASE("hemitex vector check judges the vectors beside a missing one", "[cli]") {
  const Workshop shop;
  const std::string check = "check suite --candidate right";
  std::filesystem::remove_all(shop.file("right/five-faces"));
  const Outcome missing = shop.run(check + " --diff picture.png");
  CHECK(missing.exitCode == 1);
  CHECK(missing.says("\nmissing: five-faces was not drawn\n"));
  CHECK(missing.says("\nsame-triangle,"));
  const json report = json::parse(shop.run(check + " --json").out);
  CHECK(report["pass"] == false);
  CHECK(report["vectors"][0]["outcome"] == "missing");
  CHECK(report["vectors"][1]["outcome"] == "pass");

  shop.write("known.txt", "five-faces unsupported no side faces\n");
  const Outcome unsupported = shop.run(check + " --expectations known.txt");
  CHECK(unsupported.exitCode == 0);
  CHECK(unsupported.says("\nnot judged: five-faces (unsupported: no side faces)\n"));
  shop.write("known.txt", "five-faces fail crashes\n");
  CHECK(shop.run(check + " --expectations known.txt").exitCode == 1);
  shop.write("known.txt", "\nfour-faces fail crashes\n");
  const Outcome unknown = shop.run(check + " --expectations known.txt");
  CHECK(unknown.exitCode == 2);
  CHECK(unknown.err.find("known.txt:2: the suite has no vector \"four-faces\"") != std::string::npos);
  CHECK(shop.run("check suite --candidate nowhere").exitCode == 2);
}

TEST_CASE("hemitex vector run starts a program per vector and judges its item IDs", "[cli]") {
  const Workshop shop;
  shop.write("copy.sh", "exec cp right/$(basename \"$1\")/* \"$2\"\n");
  const std::string device = "run suite --device '/bin/sh \"copy.sh\" {vector} {output}'";
  const Outcome right = shop.run(device + " -o mine --jobs 3");
  INFO(right.err);
  CHECK(right.exitCode == 0);
  const Outcome check = shop.run("check suite --candidate mine");
  CHECK(check.exitCode == 0);
  CHECK(right.out == check.out);
  CHECK(shop.run(device + " -o mine --json --jobs 1").out == shop.run("check suite --candidate mine --json").out);
  CHECK(shop.run("run suite/five-faces --device 'sh copy.sh {vector} {output}' -o one").exitCode == 0);
  CHECK(shop.run("check suite/five-faces --candidate one").exitCode == 0);

  breakVector(shop.file("right/five-faces"));
  CHECK(shop.run(device + " -o mine").exitCode == 1);
  shop.write("known.txt", "five-faces fail bug 12\n");
  CHECK(shop.run(device + " -o mine --expectations known.txt").exitCode == 0);
  CHECK(shop.run(device + " -o suite").exitCode == 2);
  CHECK(shop.run("run suite/five-faces --device true -o suite/five-faces/").exitCode == 2);
  CHECK(shop.run("check suite --candidate suite").exitCode == 0);
  CHECK(shop.run("run suite --device ./no-such-program -o mine").exitCode == 2);
  CHECK(shop.run("run suite --device \"'open\" -o mine").exitCode == 2);
  CHECK(shop.run(device + " -o mine --time-limit 0").exitCode == 2);
}

TEST_CASE("hemitex vector run makes a failing program the verdict of its vector", "[cli]") {
  const Workshop shop;
  shop.write("device.sh",
             "echo drawing $1 >&2\n"
             "case $1 in\n"
             "  */five-faces) kill -SEGV $$ ;;\n"
             "  */same-triangle) sleep 60 ;;\n"
             "  */layout-r8g8b8a8) exit 3 ;;\n"
             "esac\n");
  const std::string device = "run suite --device 'sh device.sh {vector} {output}' -o mine --time-limit 0.5";
  const Outcome failed = shop.run(device + " --json --junit report.xml");
  CHECK(failed.exitCode == 1);
  const json vectors = json::parse(failed.out)["vectors"];
  REQUIRE(vectors.size() == 3);
  CHECK(vectors[0]["device"]["failure"] == "crash");
  CHECK(vectors[0]["device"]["signal"] == 11);
  CHECK(vectors[0]["outcome"] == "device failed");
  CHECK(vectors[1]["device"]["exit_code"] == 3);
  CHECK(vectors[1]["device"]["stderr"][0].get<std::string>().find("/layout-r8g8b8a8") != std::string::npos);
  CHECK(vectors[2]["device"]["failure"] == "time limit");
  CHECK(readFile(shop.file("report.xml")).find("<failure message=\"exit code: ended with exit code 3\">drawing /") !=
        std::string::npos);
  CHECK(shop.run(device).says("\ndevice failed: layout-r8g8b8a8: exit code, ended with exit code 3\n  | drawing /"));

  shop.write("known.txt", "five-faces fail crash\nsame-triangle unsupported hang\nlayout-r8g8b8a8 flaky exit\n");
  CHECK(shop.run(device + " --expectations known.txt --strict").exitCode == 0);
}

TEST_CASE("hemitex vector run reports item ID files that are missing or have the wrong size", "[cli]") {
  const Workshop shop;
  shop.write("device.sh", "cp right/five-faces/* $2; case $1 in */five-faces) for f in $2/*; do echo >$f; done; esac");
  const json report = json::parse(shop.run("run suite --device 'sh device.sh {vector} {output}' -o mine --json").out);
  CHECK(report["pass"] == false);
  CHECK(report["vectors"][0]["device"]["failure"] == "wrong size");
  CHECK(report["vectors"][0]["pixels"]["error"] == 0);
  const std::string one = "run suite/five-faces --device 'sh device.sh x {output}' -o one";
  CHECK(shop.run(one).exitCode == 0);
  // The item IDs of an earlier run do not stay.
  const json missing = json::parse(shop.run("run suite/five-faces --device true -o one --json").out);
  CHECK(missing["device"]["failure"] == "missing file");
  CHECK(shop.run("check suite/five-faces --candidate one").exitCode == 2);
}
