/// What hemitex prints of files, command lines and devices: its own words, no raw control characters, and an error that
/// names the option for every empty value. Each test runs the built program.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "raster/base/printable_text.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/vector_file.h"
#include "tests/support/shell.h"

using namespace hemitex;
using Catch::Contains;
using nlohmann::json;
using tests::linesOf;
using tests::Outcome;
using tests::readAll;
using tests::Shell;
using tests::writeAll;

namespace {

/// The first words of the lines of `hemitex --complete WORDS`.
std::vector<std::string> completions(const Shell& shell, const std::string& words) {
  std::vector<std::string> found;
  for (const std::string& line : linesOf(shell.output("--complete " + words)))
    found.push_back(line.substr(0, line.find('\t')));
  return found;
}

/// All commands with their inner ones, such as `vector check`; each ends with a blank.
std::vector<std::string> commands(const Shell& shell, const std::string& outer = "") {
  std::vector<std::string> found;
  for (const std::string& word : completions(shell, outer + "''")) {
    if (word.empty() || word.starts_with('-') || word.starts_with('<')) continue;
    found.push_back(outer + word + ' ');
    const std::vector<std::string> inner = commands(shell, outer + word + ' ');
    found.insert(found.end(), inner.begin(), inner.end());
  }
  return found;
}

bool isPrintable(const std::string& text) { return raster::printable(text, "\n\t") == text; }

/// ESC, a control sequence introducer of one character, a reversal of direction, DEL, and Latin-1.
const std::string hostile = "\x1B[2J\xC2\x9B\xE2\x80\xAE\x7F\xE4";

}  // namespace

TEST_CASE("hemitex refuses the empty value of every option, names the option, and writes nothing", "[messages]") {
  const Shell shell;
  const auto before = shell.files();
  std::set<std::string> refused;
  for (const std::string& command : commands(shell))
    for (const std::string& option : completions(shell, command + "--")) {
      if (option == "-h" || option == "--help" || option == "--help-all" || option == "--version") continue;
      const Outcome outcome = shell.run(command + option + " ''");
      CAPTURE(command, option, outcome.err);
      CHECK(outcome.exitCode == 2);
      const bool namesOption = outcome.err.find(option + ": the value is empty\n") != std::string::npos;
      // A flag takes no value; the empty word is an argument then.
      CHECK((namesOption || outcome.err.find("the value is empty\n") != std::string::npos ||
             outcome.err.find("takes no further argument ``") != std::string::npos ||
             outcome.err.find("`` is no command of") != std::string::npos));
      if (namesOption) refused.insert(command + option);
    }
  CHECK(refused.size() > 200);
  for (const char* option :
       {"solve --edits", "solve --bands", "solve --lights", "solve --matrix", "solve --resume", "solve --checkpoint",
        "solve --output", "solve --emit", "vector check --junit", "formfactors --from"})
    CHECK(refused.count(option) == 1);
  CHECK(shell.files() == before);
}

TEST_CASE("hemitex refuses `--option=` before another argument is taken as its value", "[messages]") {
  const Shell shell;
  const Outcome outcome = shell.run("solve -o out --lights= room.obj");
  CHECK(outcome.exitCode == 2);
  CHECK_THAT(outcome.err, Contains("--lights: the value is empty"));
}

TEST_CASE("hemitex reads numbers of options in one way", "[messages]") {
  const Shell shell;
  for (const char* number : {" 5", "5 ", "nan", "inf", "-inf", "1e999", "0x10", "0x1p3", "+5",
                             "\xE2\x88\x92"
                             "5",
                             "5,0", "1_0", "5f", "5;", "5%", "\xEF\xBC\x95", "5\n"})
    for (const char* option :
         {"--residual", "--fov", "--texel-size", "--max-reflectance", "--row-cache", "--threads", "--shots",
          "--magnify", "--split", "--size", "--eye", "--sky", "--samples", "--surface"}) {
      const std::string text = option == std::string("--size") ? std::string(number) + "x30"
                               : option == std::string("--eye") || option == std::string("--sky")
                                   ? "1,1," + std::string(number)
                               : option == std::string("--surface") ? "floor=" + std::string(number)
                                                                    : number;
      const Outcome outcome = shell.run("solve room.obj -o out " + std::string(option) + " '" + text + "'");
      CAPTURE(option, text, outcome.err);
      CHECK(outcome.exitCode == 2);
      CHECK_THAT(outcome.err, Contains(option));
    }
}

TEST_CASE("hemitex prints no raw control characters of names", "[messages]") {
  const Shell shell;
  std::string scene = readAll(shell.file("room.obj"));
  scene.replace(scene.find("g left"), 6, "g left" + hostile);
  scene.replace(scene.find("usemtl lamp"), 11, "usemtl lamp" + hostile);
  writeAll(shell.file("room.obj"), scene);
  writeAll(shell.file("room.mtl"),
           "newmtl white\nKd 0.5 0.5 0.5\nnewmtl lamp" + hostile + "\nKd 0.5 0.5 0.5\nKe 1 1 1\nd 0.5\n");
  const std::string folder = "'out" + hostile + "'";
  for (const std::string& arguments :
       {std::string("formfactors room.obj --from floor --resolution 32"),
        std::string("formfactors room.obj --from floor --resolution 32 --by-surface --json"),
        "formfactors room.obj --from 'lef" + hostile + "'", "solve room.obj -o out --emit '" + hostile + "=1,1,1'",
        "solve 'no" + hostile + ".obj' -o out", "solve room.obj -o out --ed" + hostile + " x",
        "solve room.obj -o out --format '" + hostile + "'", "'" + hostile + "'", tests::quickSolve + "-v -o " + folder,
        tests::quickSolve + "--json -o " + folder, "view " + folder,
        "vector check 'no" + hostile + "' --candidate x"}) {
    const Outcome outcome = shell.run(arguments);
    CAPTURE(arguments, outcome.out, outcome.err);
    CHECK(outcome.exitCode != 3);
    CHECK(isPrintable(outcome.out));
    CHECK(isPrintable(outcome.err));
  }
  CHECK(isPrintable(readAll(shell.file("out" + hostile + "/elements.csv"))));
  // JSON has the names themselves, with escapes.
  const json row = json::parse(shell.output("formfactors room.obj --from floor --resolution 32 --by-surface --json"));
  CHECK_THAT(row.dump(), Contains("left\x1b[2J") || Contains(R"(left\u001b[2J)"));
  for (const char* name : {"m.mtx", "n.csv"}) {
    shell.output("formfactors room.obj --all --texels 1 --resolution 32 -o " + std::string(name));
    CHECK(isPrintable(readAll(shell.file(name))));
  }
}

TEST_CASE("hemitex vector run prints no raw control characters of a device", "[messages]") {
  const Shell shell;
  for (const reference::TestVector& vector : reference::vectorSuite())
    if (vector.name == "five-faces") {
      std::filesystem::create_directories(shell.file("suite/five-faces"));
      reference::writeVector(shell.file("suite/five-faces"), vector, reference::render(vector));
    }
  writeAll(shell.file("device.sh"), "printf 'boom \\033[2J\\302\\233\\342\\200\\256\\177\\344\\r\\n' >&2\nexit 7\n");
  for (const std::string format : {"", " --json"}) {
    const Outcome outcome =
        shell.run("vector run suite --device 'sh device.sh {vector} {output}' -o mine" +
                  std::string(format.empty() ? "" : "2") + " --junit results.xml --html results.html" + format);
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exitCode == 1);
    CHECK_THAT(outcome.out, Contains("boom "));
    CHECK(isPrintable(outcome.out));
    CHECK(isPrintable(outcome.err));
    CHECK_THAT(readAll(shell.file("results.xml")), Contains("boom ?[2J????"));
    for (const char* name : {"results.xml", "results.html"}) {
      CHECK(isPrintable(readAll(shell.file(name))));
      std::filesystem::remove(shell.file(name));
    }
  }
}

TEST_CASE("hemitex says in its own words what is wrong with JSON", "[messages]") {
  const Shell shell;
  shell.output(tests::quickSolve + "-o lit");
  std::filesystem::create_directories(shell.file("vector"));
  const std::string lights = "solve room.obj -o out --resolution 16 --lights file.json",
                    edits = "solve room.obj -o out --edits file.json",
                    bands = "solve room.obj -o out --bands file.json",
                    profile = "vector check vector --candidate x --profile file.json",
                    vector = "vector render vector -o drawn", record = "vector verify file.json --suite vector",
                    gltf = "solve file.gltf -o out", view = "render room.obj -o picture.png --size 20x20",
                    solved = "render lit/scene.obj -o lit.png --show elements", page = "view lit";
  const std::vector<std::string> all{lights, edits, bands, profile, vector, record, gltf, view, solved, page};
  const auto check = [&](const std::string& text, const std::vector<std::string>& commands) {
    for (const std::string& arguments : commands) {
      for (const char* name : {"file.json", "file.gltf", "vector/vector.json", "room.view.json", "lit/solution.json"})
        writeAll(shell.file(name), text);
      if (arguments != view) std::filesystem::remove(shell.file("room.view.json"));
      const Outcome outcome = shell.execute("BROWSER=true '" HEMITEX_PROGRAM "' " + arguments);
      CAPTURE(text, arguments, outcome.err);
      CHECK((outcome.exitCode == 0 || outcome.exitCode == 2));
      CHECK(outcome.err.find("exception") == std::string::npos);
      shell.execute("rm -rf out lit/report.html");
    }
  };
  for (const std::string text : {"", "{", "[1,\n2,,]", "{\"a\": \"\x80\"}", "{}", "[]", "3"}) check(text, all);
  check("{\"frames\": 3}", {edits});
  check("{\"frames\": [[{\"move\": 3, \"by\": [0,0,0]}]]}", {edits});
  check("{\"frames\": [[{\"move\": [[]], \"by\": \"x\"}]]}", {edits});
  check("{\"a\": 1e999}", {lights, edits, vector});
  check("{\"fov\": \"wide\"}", {view});
  check("{\"eye\": {}}", {view, vector});
  check("{\"version\": \"x\"}", {profile, record});
  check("{\"vertex_error\": []}", {profile});
  check("{\"format\": 3}", {record});
  check("{\"format\": \"hemitex conformance record\"}", {record});
  check("{\"format\": \"hemitex conformance record\", \"version\": 1, \"entries\": [3]}", {record});
  check("{\"format\": \"hemitex conformance record\", \"version\": 1, \"entries\": [{\"rules\": []}]}", {record});
  check("{\"wavelengths\": [1, \"2\"]}", {bands});
  check("{\"rules\": 1, \"name\": 3}", {vector});
  check("{\"sun\": 3}", {lights});
  check("{\"settings\": 3}", {solved, page});
  check("{\"settings\": {\"texels\": \"x\"}, \"files\": 3}", {solved, page});
  check("{\"asset\": 3}", {gltf});
  check("{\"asset\": {\"version\": \"2.0\"}, \"meshes\": 3}", {gltf});
}

TEST_CASE("hemitex tells a reflectance near 1 from 1", "[messages]") {
  const Shell shell;
  writeAll(shell.file("room.mtl"), "newmtl white\nKd 1 1 1\nnewmtl lamp\nKd 0 0 0\nKe 10 10 10\n");
  const Outcome outcome = shell.run("render room.obj -o picture.png --size 20x20 --max-reflectance 0.9999999");
  CHECK_THAT(outcome.err, Contains("a reflectance of 1 or more is lowered to 0.9999999\n"));
}

TEST_CASE("hemitex computes no light with item IDs that overflow, but draws them", "[messages]") {
  const Shell shell;
  for (const char* command : {"solve room.obj -o out --no-align", "formfactors room.obj --from floor --no-align"}) {
    const Outcome outcome = shell.run(command);
    CHECK(outcome.exitCode == 2);
    CHECK_THAT(outcome.err, Contains("error: offsets without alignment overflow") && Contains("--blend integer-add"));
  }
  CHECK_FALSE(std::filesystem::exists(shell.file("out")));
  shell.output(tests::quickSolve + "--no-align --blend integer-add -o out");
  const Outcome drawn = shell.run("render room.obj --no-align --show blend-errors --size 40x30 -o picture.png");
  CHECK(drawn.exitCode == 0);
  CHECK_THAT(drawn.err, Contains("warning: offsets without alignment overflow"));
}
