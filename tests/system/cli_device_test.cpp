/// hemitex as the author of a device uses it on a build server: expected results, and programs that
/// crash, hang or write wrong files. Each test runs the built program.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "cli/common/base64.h"
#include "raster/base/file_io.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/vector_file.h"
#include "tests/support/shell.h"

using namespace hemitex;
using nlohmann::json;
using raster::readFile;
using tests::Outcome;
using tests::Shell;
using tests::writeAll;

namespace {

bool says(const Outcome& outcome, const std::string& text) { return outcome.out.find(text) != std::string::npos; }

/// Three vectors of the suite in `suite`, and their right item IDs in `right`.
class Workshop {
 public:
  Workshop() {
    for (const std::string name : {"five-faces", "layout-r8g8b8a8", "same-triangle"}) addVector(name);
  }

  std::filesystem::path file(const std::string& name) const { return shell_.file(name); }
  void write(const std::string& name, const std::string& text) const { writeAll(file(name), text); }
  Outcome run(const std::string& arguments) const { return shell_.run("vector " + arguments); }
  Outcome execute(const std::string& line) const { return shell_.execute(line); }

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

  Shell shell_;
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
  CHECK(says(expected, "\nknown errors: five-faces (expected to fail: bug 12)\n"));
  CHECK_FALSE(says(expected, "error in"));
  CHECK(readFile(shop.file("report.xml")).find("<failure") == std::string::npos);
  CHECK(json::parse(shop.run(known + " --json").out)["pass"] == true);
  CHECK(shop.run("check suite/five-faces/ --candidate right/five-faces --expectations known.txt").exitCode == 0);

  shop.write("known.txt", "five-faces flaky bug 12\nsame-triangle fail bug 13\nlayout-r8g8b8a8 flaky bug 14\n");
  const Outcome passed = shop.run(known);
  CHECK(passed.exitCode == 0);
  CHECK(says(passed, "\nunexpected pass: same-triangle (expected to fail: bug 13)\n"));
  CHECK(shop.run(known + " --strict").exitCode == 1);
  CHECK(shop.run(check + " --strict").exitCode == 2);
}

TEST_CASE("hemitex vector check judges the vectors beside a missing one", "[cli]") {
  const Workshop shop;
  const std::string check = "check suite --candidate right";
  std::filesystem::remove_all(shop.file("right/five-faces"));
  const Outcome missing = shop.run(check + " --diff picture.png");
  CHECK(missing.exitCode == 1);
  CHECK(says(missing, "\nmissing: five-faces was not drawn\n"));
  CHECK(says(missing, "\nsame-triangle,"));
  const json report = json::parse(shop.run(check + " --json").out);
  CHECK(report["pass"] == false);
  CHECK(report["vectors"][0]["outcome"] == "missing");
  CHECK(report["vectors"][1]["outcome"] == "pass");

  shop.write("known.txt", "five-faces unsupported no side faces\n");
  const Outcome unsupported = shop.run(check + " --expectations known.txt");
  CHECK(unsupported.exitCode == 0);
  CHECK(says(unsupported, "\nnot judged: five-faces (unsupported: no side faces)\n"));
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
  CHECK(says(shop.run(device), "\ndevice failed: layout-r8g8b8a8: exit code, ended with exit code 3\n  | drawing /"));

  shop.write("known.txt", "five-faces fail crash\nsame-triangle unsupported hang\nlayout-r8g8b8a8 flaky exit\n");
  CHECK(shop.run(device + " --expectations known.txt --strict").exitCode == 0);
}

namespace {

/// A program for --lines that copies the right item IDs, after `lines` of sh with $vector and $output.
std::string copierThat(const std::string& lines) {
  return "echo >>starts\ntab=$(printf '\\t')\nwhile IFS=$tab read -r vector output; do\n" + lines +
         "\n  cp right/$(basename \"$vector\")/* \"$output\"\n  echo drawn\n  echo done\ndone\n";
}

std::size_t startsIn(const Workshop& shop) {
  const std::size_t count = readFile(shop.file("starts")).size();
  shop.write("starts", "");
  return count;
}

const std::string lineRun = "run suite --device 'sh device.sh' --lines -o mine ";

}  // namespace

TEST_CASE("hemitex vector run --lines lets one program draw many vectors", "[cli]") {
  const Workshop shop;
  shop.write("device.sh", copierThat(""));
  const Outcome right = shop.run(lineRun + "--jobs 1");
  INFO(right.err);
  CHECK(right.exitCode == 0);
  CHECK(right.out == shop.run("check suite --candidate right").out);
  CHECK(startsIn(shop) == 1);
  CHECK(shop.run(lineRun + "--jobs 3").exitCode == 0);
  CHECK(startsIn(shop) <= 3);
  CHECK(shop.run(lineRun + "--jobs 1 --repeat 4").exitCode == 0);
  CHECK(startsIn(shop) == 1);
  CHECK(shop.run("run suite --device 'sh device.sh {vector} {output}' --lines -o mine").exitCode == 2);
  CHECK(shop.run("run suite --device ./no-such-program --lines -o mine").exitCode == 2);
  std::filesystem::rename(shop.file("suite"), shop.file("my\tsuite"));
  CHECK(shop.run("run \"$(printf 'my\\tsuite')\" --device 'sh device.sh' --lines -o mine").exitCode == 2);
}

TEST_CASE("hemitex vector run --lines makes a failing program the verdict of its vector, and starts another", "[cli]") {
  const Workshop shop;
  shop.write("device.sh", copierThat("  case $vector in\n"
                                     "    */five-faces) echo crashing >&2; kill -SEGV $$ ;;\n"
                                     "    */layout-r8g8b8a8) echo failed: no such format; continue ;;\n"
                                     "    */same-triangle) [ -f hang ] && sleep 60 ;;\n  esac"));
  const std::string run = lineRun + "--jobs 1 --time-limit 0.5 ";
  const json refused = json::parse(shop.run(run + "--json").out)["vectors"];
  CHECK(refused[0]["device"]["failure"] == "crash");
  CHECK(refused[0]["device"]["signal"] == 11);
  CHECK(refused[0]["device"]["stderr"] == json({"crashing"}));
  CHECK(refused[1]["device"]["failure"] == "refused");
  CHECK(refused[1]["device"]["message"] == "failed: no such format");
  CHECK(refused[2]["outcome"] == "pass");
  CHECK(startsIn(shop) == 2);
  shop.write("hang", "");
  CHECK(json::parse(shop.run(run + "--json").out)["vectors"][2]["device"]["failure"] == "time limit");
  shop.write("device.sh", "read line; echo done; read line");
  const json silent = json::parse(shop.run(run + "--json").out)["vectors"];
  CHECK(silent[0]["device"]["failure"] == "missing file");
  CHECK(silent[1]["device"]["failure"] == "exit code");
}

TEST_CASE("hemitex vector serve is a device for hemitex vector run --lines", "[cli]") {
  const Workshop shop;
  const std::string serve = "run suite --device \"'" HEMITEX_PROGRAM "' vector serve\" --lines -o mine ";
  CHECK(shop.run(serve).out == shop.run("check suite --candidate right").out);
  // The device changes each byte 1 to 2 behind the program.
  shop.write("device.sh",
             "tab=$(printf '\\t')\nwhile IFS=$tab read -r vector output; do\n"
             "printf '%s\\t%s\\n' \"$vector\" \"$output\" | '" HEMITEX_PROGRAM
             "' vector serve >answer\n"
             "for f in \"$output\"/*.u32; do tr '\\001' '\\002' <\"$f\" >changed; mv changed \"$f\"; done\n"
             "cat answer\ndone\n");
  CHECK(shop.run(lineRun + "--jobs 1 --minimize small").exitCode == 1);
  CHECK(reference::readVector(shop.file("small")).list.indices.size() == 3);
  // What is wrong with a line is the answer to it.
  shop.write("lines", "nowhere\tmine\nno tab\n");
  const std::string answers = shop.execute("'" HEMITEX_PROGRAM "' vector serve <lines").out;
  CHECK(answers.find("failed: nowhere") == 0);
  CHECK(answers.find("\nfailed: a line names no folder for item IDs") != std::string::npos);
}

TEST_CASE("hemitex vector serve and vector render draw the whole suite of version 2, pairs of 64 bits too", "[cli]") {
  const Shell shell;
  REQUIRE(shell.run("vector suite --rules 2 -o suite").exitCode == 0);
  const Outcome outcome =
      shell.run("vector run suite --device \"'" HEMITEX_PROGRAM "' vector serve\" --lines -o mine --json");
  CHECK(outcome.exitCode == 0);
  const json result = json::parse(outcome.out);
  CHECK(result["vectors"].size() == 32);
  CHECK(result["pixels"]["exact"] == 2077);
  // In place, also beside indices of 16 bits.
  CHECK(shell.run("vector render suite/restart-fan -o suite/restart-fan").exitCode == 0);
}

TEST_CASE("hemitex vector run and check --shard share a suite", "[cli]") {
  const Workshop shop;
  breakVector(shop.file("right/layout-r8g8b8a8"));
  const auto check = [&](const std::string& shard) {
    return json::parse(shop.run("check suite --candidate right --json --shard " + shard).out)["vectors"];
  };
  for (const std::size_t count : {1u, 2u, 3u}) {
    std::set<std::string> names;
    for (std::size_t number = 1; number <= count; ++number) {
      const json part = check(std::to_string(number) + '/' + std::to_string(count));
      CHECK(part.size() <= (3 + count - 1) / count);
      for (const json& vector : part) CHECK(names.insert(vector["vector"]).second);
    }
    CHECK(names == std::set<std::string>{"five-faces", "layout-r8g8b8a8", "same-triangle"});
  }
  CHECK(shop.run("check suite --candidate right --shard 1/2").exitCode == 0);
  CHECK(shop.run("check suite --candidate right --shard 2/2").exitCode == 1);
  shop.write("device.sh", copierThat(""));
  CHECK(shop.run(lineRun + "--shard 1/2").exitCode == 0);
  CHECK_FALSE(std::filesystem::exists(shop.file("mine/layout-r8g8b8a8")));
  CHECK(shop.run(lineRun + "--shard 2/2").exitCode == 1);
  CHECK(shop.run("check suite --candidate mine --shard 1/2").exitCode == 0);
  for (const char* wrong : {"0/2", "3/2", "1", "1/", "/2", "a/b", "1/2/3", "-1/2", "1/4"}) {
    INFO(wrong);
    CHECK(shop.run("check suite --candidate right --shard " + std::string(wrong)).exitCode == 2);
  }
  CHECK(shop.run("check suite --candidate right --shard 1/2 --record r.json --device-name a --driver b").exitCode == 2);
}

TEST_CASE("hemitex vector check --html shows each failing vector with its picture and a derivation", "[cli]") {
  const Workshop shop;
  const std::string check = "check suite --candidate right --html page.html ";
  CHECK(shop.run(check).exitCode == 0);
  const std::string passed = readFile(shop.file("page.html"));
  CHECK(passed.find("<td>same-triangle<td>pass<td>") != std::string::npos);
  CHECK(passed.find("<img") == std::string::npos);

  breakVector(shop.file("right/five-faces"));
  std::filesystem::remove_all(shop.file("right/same-triangle"));
  shop.write("known.txt", "five-faces fail rows & <columns>\n");
  CHECK(shop.run(check + "--diff picture.png --expectations known.txt").exitCode == 1);
  const std::string page = readFile(shop.file("page.html"));
  CHECK(page.find("base64," + cli::base64OfFile(shop.file("picture.png")) + "\">") != std::string::npos);
  CHECK(page.find("known errors: five-faces (expected to fail: rows &amp; &lt;columns&gt;)") != std::string::npos);
  CHECK(page.find("\n1 pixels of five-faces are errors\n") != std::string::npos);
  CHECK(page.find("missing: same-triangle was not drawn") != std::string::npos);
  for (const std::size_t k : {0, 2}) {
    CHECK(page.find("<a href=\"#vector-" + std::to_string(k) + "\">") != std::string::npos);
    CHECK(page.find("<h2 id=\"vector-" + std::to_string(k) + "\">") != std::string::npos);
  }
  // It needs no other file, and is the same for any number of threads.
  CHECK(page.find("http") == std::string::npos);
  CHECK(page.find("<script") == std::string::npos);
  CHECK(shop.run(check + "--expectations known.txt --threads 1").exitCode == 1);
  CHECK(readFile(shop.file("page.html")) == page);
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

TEST_CASE("hemitex vector verify computes the record of vector check again", "[cli]") {
  const Workshop shop;
  breakVector(shop.file("right/five-faces"));
  shop.write("known.txt", "same-triangle unsupported no depth\n");
  const std::string check = "check suite --candidate right --expectations known.txt --record record.json ";
  CHECK(shop.run(check).exitCode == 2);
  CHECK(shop.run(check + "--device-name 'a device' --driver 1.2").exitCode == 1);
  const std::string verify = "verify record.json --suite suite";
  const Outcome whole = shop.run(verify + " --candidate right");
  CHECK(whole.exitCode == 0);
  CHECK(says(whole, "record of a device, driver 1.2, raster rules 1, 3 vectors\n"));
  CHECK(says(whole, "not checked: same-triangle: the record has no item IDs (not judged)\n"));
  const Outcome suiteOnly = shop.run(verify);
  CHECK(suiteOnly.exitCode == 0);
  CHECK(says(suiteOnly, "not checked: item IDs and verdicts: no candidate was given\n"));

  // Another pixel, another suite, another text.
  breakVector(shop.file("right/layout-r8g8b8a8"));
  const Outcome pixel = shop.run(verify + " --candidate right");
  CHECK(pixel.exitCode == 1);
  CHECK(says(pixel, "wrong: layout-r8g8b8a8, "));
  CHECK(says(pixel, ": other item IDs than those of the record\n"));
  CHECK(shop.run(verify).exitCode == 0);
  shop.write("suite/same-triangle/positions.f32", "");
  std::string text = readFile(shop.file("record.json"));
  const std::string name = "\"a device\"";
  shop.write("record.json", text.replace(text.find(name), name.size(), "\"another\""));
  const Outcome damaged = shop.run(verify);
  CHECK(damaged.exitCode != 0);
  std::filesystem::remove_all(shop.file("suite/same-triangle"));
  const json result = json::parse(shop.run(verify + " --json").out);
  CHECK(result["valid"] == false);
  CHECK(result["problems"] ==
        json({"the header differs from its hash", "same-triangle: is in the record, but not in the suite"}));
  CHECK(shop.run("verify known.txt --suite suite").exitCode == 2);
}

// The device shows 2 in place of every byte 1.
TEST_CASE("hemitex vector run --minimize draws smaller vectors until nothing can go", "[cli]") {
  const Workshop shop;
  shop.write("device.sh", "'" HEMITEX_PROGRAM
                          "' vector render \"$1\" -o \"$2\" >drawn.txt\n"
                          "for f in \"$2\"/*.u32; do tr '\\001' '\\002' <\"$f\" >changed; mv changed \"$f\"; done\n");
  const std::string run = "run suite --device 'sh device.sh {vector} {output}' -o mine --jobs 1 --minimize small";
  CHECK(shop.run(run).exitCode == 1);
  const reference::TestVector small = reference::readVector(shop.file("small"));
  CHECK(small.list.indices.size() == 3);
  CHECK(small.faces.size() == 1);
  CHECK(small.faces[0].face.scissor.width * small.faces[0].face.scissor.height == 1);
  CHECK(shop.run("check small --candidate small/candidate").exitCode == 1);
  CHECK(shop.run("run small --device 'sh device.sh {vector} {output}' -o again").exitCode == 1);
  CHECK(shop.run("check small --candidate again --junit report.xml").exitCode == 1);
}

TEST_CASE("hemitex vector run --minimize keeps what makes the program fail", "[cli]") {
  const Workshop shop;
  // The program crashes where a draw has an index map.
  shop.write("device.sh",
             "grep -q '\"index_map\": [0-9]' $1/vector.json && kill -SEGV $$; cp right/same-triangle/* $2\n");
  const std::string run = "run suite --device 'sh device.sh {vector} {output}' -o mine --minimize small";
  CHECK(shop.run(run).exitCode == 1);
  const reference::TestVector small = reference::readVector(shop.file("small"));
  CHECK(small.list.indices.size() == 3);
  REQUIRE(small.list.indexMaps.size() == 1);
  CHECK(small.list.indexMaps[0].ids.size() == 1);
  CHECK_FALSE(std::filesystem::exists(shop.file("small/candidate")));
}

TEST_CASE("hemitex vector run --repeat finds item IDs that change from run to run", "[cli]") {
  const Workshop shop;
  // In the third run the first item ID is another one.
  shop.write(
      "device.sh",
      "cp right/same-triangle/* $2; echo >>runs\n"
      "if [ $(wc -l <runs) = 3 ]; then for f in $2/*; do printf ABCD | dd of=$f conv=notrunc status=none; done; fi\n");
  const std::string run = "run suite/same-triangle --device 'sh device.sh {vector} {output}' -o mine ";
  CHECK(shop.run(run + "--repeat 2").exitCode == 0);
  shop.write("runs", "");
  const Outcome found = shop.run(run + "--repeat 5 --junit report.xml");
  CHECK(found.exitCode == 1);
  CHECK(
      says(found, "not deterministic: same-triangle: 1 of 5 runs differ from the most frequent item IDs, at 1 pixels"));
  CHECK(readFile(shop.file("report.xml")).find("<failure message=\"not deterministic: 1 of 5 runs") !=
        std::string::npos);
  shop.write("runs", "");
  const json report = json::parse(shop.run(run + "--repeat 5 --json").out);
  CHECK(report["outcome"] == "not deterministic");
  CHECK(report["repetition"]["answers"] == json({4, 1}));
  CHECK(report["repetition"]["changing_pixels"] == 1);
  // Expected, or in a program that crashes in one of its runs.
  shop.write("runs", "");
  shop.write("known.txt", "same-triangle flaky bug 15\n");
  CHECK(shop.run(run + "--repeat 5 --expectations known.txt").exitCode == 0);
  shop.write("device.sh", "cp right/same-triangle/* $2; echo >>runs; [ $(wc -l <runs) != 4 ]\n");
  shop.write("runs", "");
  CHECK(says(shop.run(run + "--repeat 5"), "ended with exit code 1, in run 4 of 5\n"));
}
